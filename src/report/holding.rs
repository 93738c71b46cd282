//! Ways to hold the cable: force against movement.

use super::content::Report;
use super::figure::figure;
use super::html::Html;
use super::measures::{Comparison, Way};
use super::quantity::{Shown, significant};
use crate::CableEnd;
use crate::design::{Place, TradeOff};
use crate::figure::{Axis, Chart, Series};
use crate::scene::End;
use crate::shown::{exact_percent, percent};

/// Its name, the value, and how that is written.
type Column = (String, fn(&TradeOff) -> f64, fn(&Shown, f64) -> String);

pub fn holding(html: &mut Html, report: &Report) {
    let (comparison, shown) = (&report.measures, &report.shown);
    let end = end(comparison);
    let own = comparison.own_stiffness.map_or(String::new(), |own| {
        format!(
            " Stiffnesses are from a tenth to ten times that of the whole cable, EA/L = {}.",
            shown.stiffness(own)
        )
    });
    html.paragraph(&format!(
        "The same traffic with the {} end held in other ways, and with a clamp in addition to what the scene has.{own} Forces and movements \
         are the largest during all passes. The row “as in the scene” is the run of this page; each other row is a run of its own with a \
         tolerance of {}. The command “creepage design” finds the stiffness for given limits.",
        end.name(),
        exact_percent(comparison.tolerance)
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    if let Some(chart) = chart(comparison, shown) {
        figure(html, [chart], &caption(comparison, shown));
    }
    let columns = columns(report, end);
    let rows = comparison.ways.iter().map(|way| {
        let numbers: Vec<String> = match &way.answer {
            Ok(answer) => {
                let clamp = answer.clamp_force_n;
                let clamp = clamp.map_or("–".into(), |force| shown.units.force(force));
                // Where no end is pressed there is no error of the force.
                let error = if answer.force_n == 0.0 {
                    "–".into()
                } else {
                    percent(answer.error_estimate)
                };
                let values = columns
                    .iter()
                    .map(|(_, value, written)| written(shown, value(answer)));
                values.chain([clamp, error]).collect()
            }
            Err(_) => std::iter::once("failed")
                .chain(std::iter::repeat_n("–", columns.len() + 1))
                .map(str::to_owned)
                .collect(),
        };
        std::iter::once(way.name(shown)).chain(numbers).collect()
    });
    let on_clamp = shown.in_force("on clamp");
    let names = columns.iter().map(|(name, ..)| name.as_str());
    let head: Vec<&str> = std::iter::once("held by")
        .chain(names)
        .chain([on_clamp.as_str(), "error"])
        .collect();
    html.table(1, &head, rows);
    html.list(&failures(&comparison.ways, shown));
}

/// The end that is varied.
fn end(comparison: &Comparison) -> CableEnd {
    match comparison.end {
        Place::Upstream => CableEnd::Upstream,
        _ => CableEnd::Downstream,
    }
}

/// Force on an end \[N\], and how far it moves \[m\].
fn of_end(end: CableEnd) -> [fn(&TradeOff) -> f64; 2] {
    match end {
        CableEnd::Upstream => [|way| way.upstream_force_n, |way| way.upstream_movement_m],
        CableEnd::Downstream => [|way| way.downstream_force_n, |way| way.downstream_movement_m],
    }
}

/// Force and movement of the end that is varied; of the other one its movement where it is free, and otherwise the force on it.
fn columns(report: &Report, end: CableEnd) -> Vec<Column> {
    // Soft hyphens: a phone is narrow.
    let name = |end: CableEnd| end.name().replace("stream", "\u{ad}stream");
    let (other, held) = match end {
        CableEnd::Upstream => (CableEnd::Downstream, report.scene.ends.downstream),
        CableEnd::Downstream => (CableEnd::Upstream, report.scene.ends.upstream),
    };
    let [force, movement] = of_end(end);
    let [other_force, other_movement] = of_end(other);
    let shown = &report.shown;
    let force_on = |end, force| -> Column {
        let named = shown.in_force(&format!("force {}", name(end)));
        (named, force, |shown, newtons| shown.units.force(newtons))
    };
    let moved = |end, movement| -> Column {
        let named = shown.in_movement(&format!("moved {}", name(end)));
        (named, movement, |shown, metres| {
            significant(shown.units.movement.of_si(metres))
        })
    };
    vec![
        force_on(end, force),
        moved(end, movement),
        if held == End::Free {
            moved(other, other_movement)
        } else {
            force_on(other, other_force)
        },
    ]
}

/// Force against movement of the end that is varied, by all ways that have an answer; `None` without any. A free end carries nothing and would
/// set the axis, so it is left out.
fn chart(comparison: &Comparison, shown: &Shown) -> Option<Chart> {
    let end = end(comparison);
    let [force, movement] = of_end(end);
    let points = |wanted: fn(&Way) -> bool| -> Vec<(f64, f64)> {
        let ways = comparison.ways.iter();
        let drawn = ways.filter(|way| wanted(way) && !way.is_free_end());
        let units = &shown.units;
        let point = |answer: &TradeOff| {
            (
                units.movement.of_si(movement(answer)),
                units.force.of_si(force(answer)),
            )
        };
        drawn.flat_map(|way| &way.answer).map(point).collect()
    };
    let name = end.name();
    let chart = Chart::new(
        "Force against movement",
        Axis::linear(shown.in_movement(&format!("movement of the {name} end"))),
        Axis::linear(shown.in_force("force on it")),
    );
    let springs = points(|way| !way.is_clamp());
    let (clamps, own) = (points(Way::is_clamp), points(|way| way.is_scene));
    let has = [&springs, &clamps, &own].map(|points| !points.is_empty());
    let series = [
        Series::line_points("springs … fixed end", springs).look(0),
        Series::points("with a clamp", clamps).look(1),
        Series::points("the scene’s end", own).look(2).marker(5),
    ];
    let drawn = series.into_iter().zip(has).filter(|(_, has)| *has);
    has.contains(&true)
        .then(|| drawn.fold(chart, |chart, (series, _)| chart.with(series)))
}

fn caption(comparison: &Comparison, shown: &Shown) -> String {
    let [_, movement] = of_end(end(comparison));
    let free = comparison.ways.iter().find(|way| way.is_free_end());
    let free = free.and_then(|way| way.answer.as_ref().ok());
    let free = free.map_or(String::new(), |answer| {
        format!(
            " A free end, which carries nothing, moves {} {} and is not drawn.",
            significant(shown.units.movement.of_si(movement(answer))),
            shown.units.movement.symbol()
        )
    });
    format!("Largest force against largest movement: a softer end moves more and is pressed less.{free}")
}

/// Ways that failed and why, those with the same reason together.
fn failures(ways: &[Way], shown: &Shown) -> Vec<String> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for way in ways {
        let Err(error) = &way.answer else { continue };
        let error = error.to_string();
        match reasons.iter_mut().find(|(reason, _)| *reason == error) {
            Some((_, names)) => names.push(way.name(shown)),
            None => reasons.push((error, vec![way.name(shown)])),
        }
    }
    let line = |(reason, names): (String, Vec<String>)| format!("Failed: {}: {reason}", names.join("; "));
    reasons.into_iter().map(line).collect()
}
