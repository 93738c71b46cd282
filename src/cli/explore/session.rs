//! What the page asks and gets.

use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use super::bench::Desk;
use super::controls::sliders;
use super::figures::Figures;
use super::film::film;
use super::question::{Asked, Question, Refusal};
use super::server::Reply;
use crate::cli::report::date;
use crate::cli::run::{Judged, Judgement};
use crate::cli::terminal;
use crate::report::{Report, ReportOptions, Source};
use crate::scene::Unit;
use crate::shown::percent;
use crate::words::{Answer, Reader};
use crate::{Run, SceneFile, Verdict};

/// The page, with places for the scene and for the nonce of its script.
const PAGE: &str = include_str!("page.html");
const JSON: &str = "application/json";
const HTML: &str = "text/html; charset=utf-8";
/// Vehicles that the page lets choose from at most.
const VEHICLES: usize = 20;

/// One scene and what is asked about it.
pub struct Session {
    file: SceneFile,
    /// Name of its file.
    name: String,
    /// What the command line sets on top of the scene.
    overrides: Vec<String>,
    /// Marks the page's own script, beside which none runs.
    nonce: String,
    desk: Desk,
}

/// A run as `creepage run --json` has it, and what the page shows of it.
#[derive(Serialize)]
struct Answered<'a> {
    #[serde(flatten)]
    judged: Judged<'a>,
    figures: Figures,
    #[serde(flatten)]
    shown: Value,
}

impl Session {
    pub fn new(file: SceneFile, path: &Path, overrides: Vec<String>, nonce: String) -> Self {
        let name = terminal::line(&path.file_name().unwrap_or_default().to_string_lossy());
        let desk = Desk::default();
        Self {
            file,
            name,
            overrides,
            nonce,
            desk,
        }
    }

    /// The reply to a request that may be answered.
    pub fn reply(&self, method: &str, path: &str, body: &[u8]) -> Reply {
        let question = || Question::read(body, &self.file);
        let reply = match (method, path) {
            ("GET", "/") => self.page(),
            ("POST", "/answer") => question().and_then(|(_, asked)| self.answer(&asked)),
            ("POST", "/pass") => question().and_then(|(question, asked)| {
                let film = self
                    .desk
                    .compute(|bench, progress| film(bench, &asked.scene, &question, progress));
                reply(&asked.located(film)?)
            }),
            ("POST", "/scene") => question().map(|(_, asked)| self.scene(&asked)),
            ("POST", "/report") => question().and_then(|(_, asked)| self.report(&asked)),
            ("POST", "/end") => Ok(Reply {
                is_last: true,
                ..Reply::new(200, JSON, "{}")
            }),
            _ => Err(Refusal::new(
                404,
                None,
                "there is nothing but the page and its questions".into(),
            )),
        };
        reply.unwrap_or_else(|refusal| Reply::new(refusal.status, JSON, json!(refusal).to_string()))
    }

    /// The page with the scene as it is.
    fn page(&self) -> Result<Reply, Refusal> {
        let Asked { file, scene, .. } = Question::default().about(&self.file)?;
        let vehicles = scene.vehicles.iter().take(VEHICLES).map(|vehicle| &vehicle.name);
        let scene = json!({
            "title": scene.title,
            "file": self.name,
            "tolerance": scene.solver.tolerance,
            "sliders": sliders(&file),
            "vehicles": vehicles.collect::<Vec<_>>(),
        });
        // Nothing in it ends the script that it stands in.
        let scene = scene.to_string().replace('<', "\\u003c");
        let page = PAGE
            .replacen("NONCE", &self.nonce, 1)
            .replacen("\"SCENE\"", &scene, 1);
        let policy = format!(
            "default-src 'none'; script-src 'nonce-{}'; style-src 'unsafe-inline'; connect-src 'self'; img-src data:; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
            self.nonce
        );
        Ok(Reply {
            policy,
            ..Reply::new(200, HTML, page)
        })
    }

    fn answer(&self, asked: &Asked) -> Result<Reply, Refusal> {
        let run = self
            .desk
            .compute(|bench, progress| bench.run(&asked.scene, progress));
        let mut run = asked.located(run)?;
        let slips = asked.file.slips().into_iter();
        run.warnings.splice(
            0..0,
            slips.map(|(location, words)| format!("{location}: {words}")),
        );
        let reader = Reader::new(asked.units, &asked.scene);
        let judgement = asked.limits.as_ref().map(|limits| Judgement::new(&run, limits));
        reply(&Answered {
            figures: Figures::new(&run, &reader)?,
            shown: shown(asked, &run, reader, judgement.as_ref()),
            judged: Judged { run: &run, judgement },
        })
    }

    /// The scene as a file, with what was changed.
    fn scene(&self, asked: &Asked) -> Reply {
        let changes = self.overrides.iter().chain(&asked.overrides);
        let changes: String = changes
            .map(|set| format!("#   {}\n", terminal::line(set)))
            .collect();
        let head = format!(
            "# {} in SI units, as left by `creepage explore`, which has set on top of it:\n",
            self.name
        );
        Reply::new(
            200,
            "application/toml",
            format!("{head}{changes}\n{}", asked.scene.to_toml()),
        )
    }

    fn report(&self, asked: &Asked) -> Result<Reply, Refusal> {
        let sources = [Source::new(&*self.name, self.file.text().as_bytes())];
        let overrides = [&self.overrides[..], &asked.overrides].concat();
        let date = date()?;
        let report = self.desk.compute(|_, progress| {
            let options = ReportOptions {
                limits: asked.limits.clone().unwrap_or_default(),
                units: asked.units,
                sources: &sources,
                overrides: &overrides,
                date: Some(&date),
                progress,
                ..ReportOptions::default()
            };
            Report::new(&asked.scene, &options)
        });
        Ok(Reply::new(200, HTML, asked.located(report)?.to_html()))
    }
}

/// The answer in words, the sliders as they are now, and symbols of the reader's units with how many of each are one in SI.
fn shown(asked: &Asked, run: &Run, reader: Reader, judgement: Option<&Judgement>) -> Value {
    let Asked { scene, file, .. } = asked;
    let answer = Answer { scene, run, reader };
    let limits = judgement.map_or(&[][..], |judgement| &judgement.limits);
    let is_kept = |verdict: &Verdict| !verdict.is_exceeded() && verdict.levels_off_above.is_none();
    let verdicts = limits
        .iter()
        .map(|verdict| (answer.verdict(verdict), is_kept(verdict)));
    let facts = answer
        .facts()
        .into_iter()
        .map(|fact| (fact.name, fact.value, fact.note));
    let unit = |unit: Unit| (unit.symbol(), unit.of_si(1.0));
    json!({
        "headline": {
            "sentences": answer.sentences(),
            "error": percent(run.error_estimate.relative),
            "facts": facts.collect::<Vec<_>>(),
            "verdicts": verdicts.collect::<Vec<_>>(),
            "summary": (limits.len() > 1).then(|| Verdict::summary(limits)),
        },
        "sliders": sliders(file),
        "units": {
            "force": unit(reader.units.force),
            "movement": unit(reader.units.movement),
            "length": unit(reader.units.length),
        },
        "most_movement_m": reader.most,
    })
}

fn reply(answer: &impl Serialize) -> Result<Reply, Refusal> {
    let text = serde_json::to_vec(answer).map_err(std::io::Error::from)?;
    Ok(Reply::new(200, JSON, text))
}
