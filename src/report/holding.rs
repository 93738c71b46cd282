//! Ways to hold the cable: force against movement.

use super::content::Report;
use super::figure::{MILLI, figure};
use super::html::Html;
use super::measures::Way;
use crate::design::{Place, TradeOff};
use crate::figure::{Axis, Chart, Series};
use crate::shown::{exact_percent, percent, rounded};

/// Ratio of the largest to the smallest movement beyond which their axis is logarithmic.
const WIDE: f64 = 50.0;

pub fn holding(html: &mut Html, report: &Report) {
    let comparison = &report.measures;
    let end = match comparison.end {
        Place::Upstream => "upstream",
        _ => "downstream",
    };
    html.paragraph(&format!(
        "The same traffic with the {end} end held in other ways, and with a clamp in addition to what the scene has. Force and movement are \
         the largest at either end during all passes. Each row is a separate run with a tolerance of {}, all on one mesh, so that they \
         can be compared; they may differ a little from the numbers above. The command “creepage design” finds the stiffness for given \
         limits.",
        exact_percent(comparison.tolerance)
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    if let Some(chart) = chart(&comparison.ways) {
        let caption = "Largest force against largest movement: a softer end moves more and is pressed less.";
        figure(html, [chart], caption);
    }
    let rows = comparison.ways.iter().map(|way| {
        let numbers = match &way.answer {
            Ok(answer) => [
                rounded(answer.force_n, 1),
                rounded(MILLI * answer.movement_m, 3),
                answer.clamp_force_n.map_or("–".into(), |force| rounded(force, 1)),
                // Where no end is pressed there is no error of the force.
                if answer.force_n == 0.0 {
                    "–".into()
                } else {
                    percent(answer.error_estimate)
                },
            ],
            Err(_) => ["failed", "–", "–", "–"].map(str::to_owned),
        };
        std::iter::once(way.name()).chain(numbers).collect()
    });
    let head = ["held by", "force, N", "movement, mm", "on clamp, N", "error"];
    html.table(1, &head, rows);
    html.list(&failures(&comparison.ways));
}

/// Force against movement of all ways that have an answer; `None` without any.
fn chart(ways: &[Way]) -> Option<Chart> {
    let points = |wanted: fn(&Way) -> bool| -> Vec<(f64, f64)> {
        let answers = ways.iter().filter(|way| wanted(way)).flat_map(|way| &way.answer);
        let point = |answer: &TradeOff| (MILLI * answer.movement_m, answer.force_n);
        answers.map(point).collect()
    };
    let all = points(|_| true);
    let movements = || all.iter().map(|(movement, _)| *movement);
    let least = movements().fold(f64::INFINITY, f64::min);
    let most = movements().fold(0.0, f64::max);
    let wide = least > 0.0 && most > WIDE * least;
    let axis = if wide { Axis::logarithmic } else { Axis::linear };
    let (x, y) = ("largest movement of an end, mm", "largest force on an end, N");
    let chart = Chart::new("Force against movement", axis(x), Axis::linear(y));
    let springs = points(|way| !way.is_clamp());
    let (clamps, own) = (points(Way::is_clamp), points(|way| way.is_scene));
    let has = [&springs, &clamps, &own].map(|points| !points.is_empty());
    let series = [
        Series::line_points("end free … springs … fixed", springs).look(0),
        Series::points("with a clamp", clamps).look(1),
        Series::points("the scene’s end", own).look(2).marker(5),
    ];
    let drawn = series.into_iter().zip(has).filter(|(_, has)| *has);
    (!all.is_empty()).then(|| drawn.fold(chart, |chart, (series, _)| chart.with(series)))
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
    let line = |(reason, names): (String, Vec<String>)| format!("Failed: {}: {reason}", names.join("; "));
    reasons.into_iter().map(line).collect()
}
