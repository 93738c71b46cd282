//! The page: its head, its style, and its sections in their order.

use super::cause::cause;
use super::content::Report;
use super::force::force;
use super::headline::headline;
use super::heat::heat;
use super::holding::holding;
use super::html::{Html, escaped};
use super::plan::plan;
use super::record::record;
use super::route::route;
use super::section::section;
use super::words;
use crate::figure::dark_style;

const STYLE: &str = include_str!("style.css");

/// Only where there are some.
const WARNINGS: &str = "Warnings";
/// Only of a cable that is heated.
const HEAT: &str = "Heat, day by day";
/// Not of a run that begins from a state.
const MEASURES: &str = "Ways to hold the cable";

type Section = (&'static str, fn(&mut Html, &Report));

const SECTIONS: [Section; 9] = [
    (WARNINGS, warnings),
    ("Scene", scene),
    ("Force and movement", force),
    (HEAT, heat),
    ("Why the cable creeps", cause),
    (MEASURES, holding),
    ("How it was computed", plan),
    ("What is left out", limits),
    ("Where this page comes from", record),
];

impl Report {
    /// The page.
    pub fn to_html(&self) -> String {
        let mut html = Html::default();
        html.raw(&format!(
            include_str!("head.html"),
            version = env!("CARGO_PKG_VERSION"),
            title = escaped(&self.scene.title),
            style = STYLE,
            dark = dark_style(),
        ));
        headline(&mut html, self);
        for (title, write) in SECTIONS {
            let is_empty = match title {
                WARNINGS => self.warnings.is_empty(),
                HEAT => self.run.heat.is_none(),
                MEASURES => self.measures.is_none(),
                _ => false,
            };
            if is_empty {
                continue;
            }
            html.raw("<section>");
            html.element("h2", title);
            write(&mut html, self);
            html.raw("</section>");
        }
        html.raw("</main>\n</body>\n</html>");
        html.finish()
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
    html.list(&words::scene(report));
    words::ground(html, report);
    if let Some(scaling) = words::scaling(&report.scene) {
        html.paragraph(&scaling);
    }
    words::vehicles(html, report);
}

fn limits(html: &mut Html, report: &Report) {
    let heat = if report.run.heat.is_some() {
        "A swing of temperature over the seasons"
    } else {
        "Heat (a loaded cable expands every day, and may press on its ends harder than creepage does; the scene has no [heat])"
    };
    html.paragraph(&format!(
        "{heat}, vehicles near the speed of the ground’s waves, and any change of the ground with \
         time."
    ));
    html.paragraph(
        "Method: K. Kashiro, K. Iwamura, T. Kamibayashi, T. Nagayama, H. Nishikubo, “Development of an Analysis Method for Power \
         Cable Creepage Phenomenon in the Duct”, Furukawa Review.",
    );
}
