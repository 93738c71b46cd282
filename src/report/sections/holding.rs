//! Ways to hold the cable.

use crate::design::{Place, TradeOff};
use crate::report::Report;
use crate::report::figures;
use crate::report::html::{Html, Table};
use crate::report::measures::Way;
use crate::shown::{percent, rounded};

use super::{MILLI, figure};

pub fn holding(html: &mut Html, report: &Report) {
    let comparison = &report.measures;
    let end = match comparison.end {
        Place::Upstream => "upstream",
        _ => "downstream",
    };
    html.paragraph(&format!(
        "The same traffic with the {end} end held in other ways, and with a clamp beside what the scene has. Force and movement are the \
         largest at either end during all passes. Each row is a run of its own at a tolerance of {} %, all on one mesh: good for \
         comparing, rougher than the numbers above. The command “creepage design” finds the stiffness for given limits.",
        100.0 * comparison.tolerance
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    if let Some(panels) = figures::measures(report) {
        figure(
            html,
            &panels,
            "Largest force against largest movement: a softer end moves more and is pressed less.",
        );
    }
    let rows = comparison.ways.iter().map(|way| {
        let mut row = vec![way.name()];
        row.extend(match &way.answer {
            Ok(answer) => [
                rounded(answer.force_n, 1),
                rounded(MILLI * answer.movement_m, 3),
                answer.clamp_force_n.map_or("–".into(), |force| rounded(force, 1)),
                error(answer),
            ],
            Err(_) => ["failed", "–", "–", "–"].map(str::to_owned),
        });
        row
    });
    html.table(&Table {
        head: ["held by", "force, N", "movement, mm", "on clamp, N", "error"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
        numbers: vec![false, true, true, true, true],
    });
    html.list(&failures(&comparison.ways));
}

/// Error of the forces; where no end is pressed there is none to tell.
fn error(answer: &TradeOff) -> String {
    if answer.force_n == 0.0 {
        "–".into()
    } else {
        percent(answer.error_estimate)
    }
}

/// Ways that failed and why, those with the same reason together.
fn failures(ways: &[Way]) -> Vec<String> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for way in ways {
        let Err(error) = &way.answer else { continue };
        let error = error.to_string();
        match reasons.iter_mut().find(|(reason, _)| *reason == error) {
            Some((_, names)) => names.push(way.name()),
            None => reasons.push((error, vec![way.name()])),
        }
    }
    reasons
        .into_iter()
        .map(|(reason, names)| format!("Failed: {}: {reason}", names.join("; ")))
        .collect()
}
