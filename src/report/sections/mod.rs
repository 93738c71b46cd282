//! What each section of the page says.

mod cause;
mod force;
mod heading;
mod holding;
mod plan;

pub use cause::cause;
pub use force::force;
pub use heading::heading;
pub use holding::holding;
pub use plan::plan;

use super::Report;
use super::html::Html;
use super::words;
use crate::figure::Panels;

const MILLI: f64 = 1e3;
const MICRO: f64 = 1e6;

pub fn warnings(html: &mut Html, report: &Report) {
    if report.warnings.is_empty() {
        html.paragraph("None.");
    } else {
        html.list(&report.warnings);
    }
}

pub fn scene(html: &mut Html, report: &Report) {
    html.list(&words::scene(&report.scene));
    html.table(&words::ground(&report.scene));
    if let Some(scaling) = words::scaling(&report.scene) {
        html.paragraph(&scaling);
    }
    html.table(&words::vehicles(&report.scene));
}

pub fn limits(html: &mut Html, _: &Report) {
    html.paragraph(
        "Heat (a loaded cable expands every day, and may press on its ends harder than creepage does), bends and slopes of the route, \
         vehicles near the speed of the ground’s waves, and any change of the ground with time.",
    );
    html.paragraph(
        "Method: K. Kashiro, K. Iwamura, T. Kamibayashi, T. Nagayama, H. Nishikubo, “Development of an Analysis Method for Power \
         Cable Creepage Phenomenon in the Duct”, Furukawa Review.",
    );
}

/// A figure, or why it could not be drawn.
fn figure(html: &mut Html, panels: &Panels, caption: &str) {
    match panels.to_svg() {
        Ok(svg) => html.figure(&svg, caption),
        Err(error) => html.paragraph(&format!("A figure could not be drawn: {error}. {caption}")),
    }
}
