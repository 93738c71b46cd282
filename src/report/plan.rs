//! How the answer was computed, and how wrong it may be.

use super::content::Report;
use super::html::Html;
use crate::shown::{percent, spacing, time};
use crate::{ErrorSource, Part};

pub fn plan(html: &mut Html, report: &Report) {
    let error = &report.run.error_estimate;
    html.paragraph(&format!(
        "The estimated error of the forces is {}. It says how well the equations are solved, not how well they describe a duct.",
        percent(error.relative)
    ));
    html.details(
        "Technical detail: method, mesh, what was considered, parts of the error",
        |html| {
            detail(html, report);
        },
    );
}

fn detail(html: &mut Html, report: &Report) {
    let (run, plan) = (&report.run, &report.plan);
    let length = report.shown.units.length;
    html.paragraph(&format!(
        "Ground {}, cable {}, node spacing {} {metres}, vehicle step {} {metres}.",
        run.plan.ground,
        run.plan.cable,
        spacing(length.of_si(run.plan.node_spacing_m)),
        spacing(length.of_si(run.plan.vehicle_step_m)),
        metres = length.symbol(),
    ));
    html.list(&run.plan.reasons);
    html.element("h3", "What was considered");
    let rows = plan.candidates.iter().map(|candidate| {
        let cost = [
            candidate.estimated_error.map(percent),
            candidate.estimated_seconds.map(time),
        ];
        let fate = match candidate.part {
            _ if candidate.chosen => "chosen",
            Part::Mesh => "not taken at first",
            _ => "rejected",
        };
        vec![
            format!("{} {}: {fate}", candidate.part, candidate.name),
            cost.into_iter().flatten().collect::<Vec<_>>().join(", "),
            candidate.reason.clone(),
        ]
    });
    html.table(
        3,
        &["model", "before the run: error, time", "why, or why not"],
        rows,
    );
    html.element("h3", "Error of the forces");
    let error = &run.error_estimate;
    html.paragraph(&format!("{} in all, {}.", percent(error.relative), error.method));
    let row = |name: &str, share: f64| vec![name.to_owned(), percent(share)];
    let parts = ErrorSource::ALL.map(|source| row(source.name(), error.parts.of(source)));
    let movement = row("movement of the ends, all parts together", error.parts.movement);
    html.table(1, &["part", "error"], parts.into_iter().chain([movement]));
}
