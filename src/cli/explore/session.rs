//! What the page asks and gets.

use serde_json::{Value, json};

use super::bench::{Bench, Desk};
use super::controls::sliders;
use super::film::film;
use super::question::{Asked, Question, Refusal};
use super::server::{LAST, Reply};
use crate::cli::report::date;
use crate::cli::run::{Judged, Judgement};
use crate::cli::terminal;
use crate::report::{Report, ReportOptions, Source};
use crate::scene::Unit;
use crate::shown::percent;
use crate::words::{Answer, Reader};
use crate::{Progress, Run, SceneFile, Verdict};

/// The page, with places for the scene and for the nonce of its script.
const PAGE: &str = include_str!("page.html");
const JSON: &str = "application/json";
const HTML: &str = "text/html; charset=utf-8";
/// Vehicles that the page lets choose from at most.
const VEHICLES: usize = 20;

/// One scene and what is asked about it.
pub struct Session {
    pub file: SceneFile,
    /// Name of its file.
    pub name: String,
    /// What the command line sets on top of the scene.
    pub overrides: Vec<String>,
    /// Marks the page's own script, beside which none runs.
    pub nonce: String,
    pub desk: Desk,
}

impl Session {
    /// The reply to a request that may be answered.
    pub fn reply(&self, method: &str, path: &str, body: &[u8]) -> Reply {
        let asked = || Question::read(body, &self.file);
        let reply = match (method, path) {
            ("GET", "/") => self.page(),
            ("POST", "/answer") => asked().and_then(|(_, asked)| self.answer(&asked)),
            ("POST", "/pass") => asked().and_then(|(question, asked)| self.pass(&question, &asked)),
            ("POST", "/scene") => asked().map(|(_, asked)| self.scene(&asked)),
            ("POST", "/report") => asked().and_then(|(_, asked)| self.report(&asked)),
            ("POST", "/end") => Ok((LAST, JSON, Vec::new())),
            _ => Err(Refusal::new(404, None, "found neither the page nor a question")),
        };
        reply.unwrap_or_else(|refusal| (refusal.status, JSON, json!(refusal).to_string().into()))
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
        let page = PAGE.replace("NONCE", &self.nonce);
        Ok((200, HTML, page.replacen("\"SCENE\"", &scene, 1).into()))
    }

    /// A run as `creepage run --json` has it, with figures, words, and the sliders as they are now.
    fn answer(&self, asked: &Asked) -> Result<Reply, Refusal> {
        let run = |bench: &mut Bench, progress: Progress<'_>| bench.run(&asked.scene, progress);
        let mut run = asked.located(self.desk.compute(run))?;
        let slips = asked.file.slips().into_iter();
        let slips = slips.map(|(location, words)| format!("{location}: {words}"));
        run.warnings.splice(0..0, slips);
        let reader = Reader::new(asked.units, &asked.scene);
        let judgement = asked.limits.as_ref().map(|limits| Judgement::new(&run, limits));
        let headline = headline(asked, &run, reader, judgement.as_ref());
        // Symbols, and how many of each are one in SI.
        let unit = |unit: Unit| json!([unit.symbol(), unit.of_si(1.0)]);
        let units = reader.units;
        let mut answer = json!(Judged { run: &run, judgement });
        answer["headline"] = headline;
        answer["sliders"] = json!(sliders(&asked.file));
        answer["units"] = json!({ "force": unit(units.force), "movement": unit(units.movement),
            "length": unit(units.length) });
        Ok((200, JSON, answer.to_string().into()))
    }

    /// One simulated pass.
    fn pass(&self, question: &Question, asked: &Asked) -> Result<Reply, Refusal> {
        let take = |bench: &mut Bench, progress: Progress<'_>| film(bench, &asked.scene, question, progress);
        let film = asked.located(self.desk.compute(take))?;
        Ok((200, JSON, film.to_string().into()))
    }

    /// The scene as a file, with what was changed.
    fn scene(&self, asked: &Asked) -> Reply {
        let changes = self.overrides.iter().chain(&asked.overrides);
        let changes = changes.map(|set| format!("#   {}\n", terminal::line(set)));
        let (name, changes, scene) = (&self.name, changes.collect::<String>(), asked.scene.to_toml());
        let text = format!("# {name} in SI units, with what `creepage explore` set:\n{changes}\n{scene}");
        (200, "application/toml", text.into())
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
        Ok((200, HTML, asked.located(report)?.to_html().into()))
    }
}

/// The answer in words: sentences, facts with their remarks, each limit and whether it is kept.
fn headline(asked: &Asked, run: &Run, reader: Reader, judgement: Option<&Judgement>) -> Value {
    let scene = &asked.scene;
    let answer = Answer { scene, run, reader };
    let limits = judgement.map_or(&[][..], |judgement| &judgement.limits);
    let is_kept = |verdict: &Verdict| !verdict.is_exceeded() && verdict.levels_off_above.is_none();
    let judged = |verdict: &Verdict| (answer.verdict(verdict), is_kept(verdict));
    let facts = answer.facts().into_iter();
    let facts = facts.map(|fact| (fact.name, fact.value, fact.note));
    json!({
        "sentences": answer.sentences(),
        "error": percent(run.error_estimate.relative),
        "facts": facts.collect::<Vec<_>>(),
        "verdicts": limits.iter().map(judged).collect::<Vec<_>>(),
    })
}
