//! The page, from its head to its end.

use super::cause::cause;
use super::certainty::certainty;
use super::content::Report;
use super::force::force;
use super::heat::heat;
use super::html::Html;
use super::route::route;
use super::section::section;
use crate::words::measures::holds_for;
use crate::words::{Table, candidates, error_parts, solved};
use creepage_plan::shown::{percent, words_if};
use creepage_run::Verdict;
use creepage_study::design::Place;
use plain_figure::{dark_style, escaped};

/// Writes a part of the page.
type Section = fn(&mut Html, &Report);

impl Report {
    /// The page.
    pub fn to_html(&self) -> String {
        let mut html = Html::default();
        html.raw(&format!(
            include_str!("head.html"),
            version = env!("CARGO_PKG_VERSION"),
            title = escaped(&self.scene.title),
            style = include_str!("style.css"),
            dark = dark_style(),
        ));
        self.answer_and_verdicts(&mut html);
        let sections: [(bool, &str, Section); 9] = [
            (!self.warnings.is_empty(), "Warnings", warnings),
            (true, "Scene", scene),
            (true, "Force and movement", force),
            (self.run.heat.is_some(), "Heat, day by day", heat),
            (true, "Why the cable creeps", cause),
            (self.history.is_empty(), "What to fit", certainty),
            (true, "How it was computed", computed),
            (true, "What is left out", left_out),
            (true, "Where this page comes from", record),
        ];
        for (_, title, write) in sections.iter().filter(|(is_there, ..)| *is_there) {
            html.raw("<section>");
            html.element("h2", title);
            write(&mut html, self);
            html.raw("</section>");
        }
        html.raw("</main>\n</body>\n</html>");
        html.finish()
    }

    /// Title, answer in words, verdicts, and the most important numbers.
    fn answer_and_verdicts(&self, html: &mut Html) {
        let answer = self.answer();
        html.element("h1", &self.scene.title);
        let warnings = words_if(self.warnings.is_empty(), " No warnings.");
        let what = format!("Creepage of the cable in its duct under traffic, {}", self.made());
        html.paragraph(&format!("{what}.{warnings}"));
        html.raw("<div class=\"answer\">");
        html.paragraph(&answer.sentences());
        html.raw("</div>");
        if !self.verdicts.is_empty() {
            html.raw("<ul class=\"verdicts\">");
        }
        let mut point = |is_kept: bool, verdict: &str| {
            let class = if is_kept { "kept" } else { "exceeded" };
            html.element(&format!("li class=\"{class}\""), verdict);
        };
        for verdict in &self.verdicts {
            let is_kept = !verdict.is_exceeded() && verdict.levels_off_above.is_none();
            point(is_kept, &answer.verdict(verdict));
        }
        if let Some(compared) = &self.compared {
            let as_it_is = &compared.measures[0];
            let how = holds_for(as_it_is, compared.combinations);
            let verdict = format!("with what is not known, the cable as it is holds for {how}");
            point(as_it_is.within_limits, &verdict);
        }
        if !self.verdicts.is_empty() {
            html.raw("</ul>");
        }
        if self.verdicts.len() > 1 {
            html.paragraph(&format!("Together: {}.", Verdict::summary(&self.verdicts)));
        }
        let is_of_clamp = |verdict: &Verdict| matches!(verdict.end, Place::Clamp(_));
        let has_clamps = !self.verdicts.is_empty() && !self.scene.restraints.is_empty();
        if has_clamps && !self.verdicts.iter().any(is_of_clamp) {
            html.paragraph("The clamps are not judged, as no limit names them (--limit-force clamp=FORCE).");
        }
        html.raw("<dl class=\"headlines\">");
        for fact in answer.facts() {
            html.raw("<div>");
            html.element("dt", fact.name);
            html.element("dd class=\"value\"", &fact.value);
            html.element("dd", &fact.note);
            html.raw("</div>");
        }
        html.raw("</dl>");
    }

    /// When, by which program and from which file the page was made.
    fn made(&self) -> String {
        let date = self.date.as_ref().map(|date| format!(" on {date}"));
        let file = self.sources.first().filter(|_| self.is_from_file);
        let from = file.map(|source| format!(" from {}", source.name));
        let [date, from] = [date, from].map(Option::unwrap_or_default);
        format!("computed{date} by creepage {}{from}", env!("CARGO_PKG_VERSION"))
    }
}

fn warnings(html: &mut Html, report: &Report) {
    html.list(&report.warnings);
}

fn scene(html: &mut Html, report: &Report) {
    html.raw("<div class=\"figures\">");
    for (svg, caption) in [section(report), route(report)] {
        html.figure(&svg, &caption);
    }
    html.raw("</div>");
    let words = report.answer();
    html.list(&words.points());
    words.ground().iter().for_each(|ground| html.table(ground));
    words.scaling().iter().for_each(|scaling| html.paragraph(scaling));
    html.table(&words.vehicles());
}

fn computed(html: &mut Html, report: &Report) {
    let (run, error) = (&report.run, &report.run.error_estimate);
    html.paragraph(&format!(
        "The estimated error of the forces is {}. It says how well the equations are solved, not how well they describe a duct.",
        percent(error.relative)
    ));
    let summary = "Technical detail: method, mesh, what was considered, parts of the error";
    html.details(summary, |html| {
        html.paragraph(&solved(&run.plan, &report.reader));
        html.list(&run.plan.reasons);
        html.element("h3", "What was considered");
        html.table(&candidates(&report.plan.candidates));
        html.element("h3", "Error of the forces");
        html.paragraph(&format!("{} in all, {}.", percent(error.relative), error.method));
        html.table(&error_parts(run));
    });
}

fn left_out(html: &mut Html, report: &Report) {
    let no_heat = "Heat (a loaded cable expands every day, and may press on its ends harder than creepage does; the scene has no [heat])";
    let heat = report.run.heat.as_ref();
    let heat = heat.map_or(no_heat, |_| "A swing of temperature over the seasons");
    html.paragraph(&format!(
        "{heat}, vehicles near the speed of the ground’s waves, and any change of the ground with time."
    ));
    html.paragraph(
        "Method: K. Kashiro, K. Iwamura, T. Kamibayashi, T. Nagayama, H. Nishikubo, “Development of an Analysis Method for Power \
         Cable Creepage Phenomenon in the Duct”, Furukawa Review.",
    );
}

/// The record by which the page can be checked later.
fn record(html: &mut Html, report: &Report) {
    if !report.overrides.is_empty() {
        html.paragraph("Set on top of the scene’s file:");
        html.list(&report.overrides);
    }
    let sources = report.sources.iter();
    let rows = sources.map(|source| vec![source.name.clone(), source.sha256.clone()]);
    html.raw("<div class=\"digests\">");
    html.table(&Table::new(["read", "SHA-256"], rows.collect(), 2));
    html.raw("</div>");
}
