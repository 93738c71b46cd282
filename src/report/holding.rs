//! Ways to hold the cable: force against movement.

use super::content::Report;
use super::ends::OTHER;
use super::figure::figure;
use super::html::Html;
use super::measures::{Comparison, Way};
use super::quantity::Shown;
use crate::design::TradeOff;
use crate::figure::{Axis, Chart, Reference, Series};
use crate::scene::End;
use crate::shown::{exact_percent, percent};
use crate::{CableEnd, Limited};

/// Room of the chart to the left of the least movement and to the right of the largest, as a factor.
const ROOM: f64 = 2.0;

/// Its name, whose value it has, and how that is written.
type Column = (String, (CableEnd, Limited), fn(&Shown, f64) -> String);

pub fn holding(html: &mut Html, report: &Report) {
    let (Some(comparison), shown) = (&report.measures, &report.shown) else {
        return;
    };
    let end = end(comparison);
    let own = comparison.own_stiffness.map_or(String::new(), |own| {
        format!(
            " Stiffnesses are from a tenth to ten times that of the whole cable, EA/L = {}, and around that of the scene’s spring where it is beyond.",
            shown.stiffness(own)
        )
    });
    let heat = report
        .run
        .heat
        .as_ref()
        .map_or("", |_| ", all of them also in heat");
    html.paragraph(&format!(
        "The same traffic with the {} end held in other ways, and with a clamp in addition to what the scene has.{own} Of all passes, forces \
         are the largest during a pass, movements of free ends the largest after a pass{heat}. The row “as in the scene” is the run of this page; each other row is a run of its own with a \
         tolerance of {}. The command “creepage design” finds the stiffness for given limits.",
        end.name(),
        exact_percent(comparison.tolerance)
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    if let Some(chart) = chart(report, comparison) {
        figure(html, [chart], &caption(comparison, shown));
    }
    let columns = columns(report, end);
    let rows = comparison.ways.iter().map(|way| {
        let numbers: Vec<String> = match &way.answer {
            Ok(answer) => {
                let clamps = answer.clamps.iter().map(|clamp| clamp.force_n);
                let clamp = clamps.reduce(f64::max);
                let clamp = clamp.map_or("–".into(), |force| shown.force_number(force));
                // Where no end is pressed there is no error of the force.
                let error = if answer.force_n == 0.0 {
                    "–".into()
                } else {
                    percent(answer.error_estimate)
                };
                let values = columns
                    .iter()
                    .map(|(_, (end, quantity), written)| written(shown, answer.value(*end, *quantity)));
                values.chain([clamp, error]).collect()
            }
            Err(_) => std::iter::once("failed")
                .chain(std::iter::repeat_n("–", columns.len() + 1))
                .map(str::to_owned)
                .collect(),
        };
        let leaves = way.answer.as_ref().is_ok_and(|answer| answer.leaves_duct);
        let leaves = if leaves { ", leaves the duct" } else { "" };
        std::iter::once(way.name(shown) + leaves).chain(numbers).collect()
    });
    let on_clamp = shown.in_force("most on a clamp");
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
    comparison.end.end().unwrap_or(CableEnd::Downstream)
}

/// Force and movement of the end that is varied; of the other one its movement where it is free, and otherwise the force on it.
fn columns(report: &Report, end: CableEnd) -> Vec<Column> {
    // Soft hyphens: a phone is narrow.
    let name = |end: CableEnd| end.name().replace("stream", "\u{ad}stream");
    let shown = &report.shown;
    let force_on = |end| -> Column {
        let named = shown.in_force(&format!("force {}", name(end)));
        (named, (end, Limited::Force), Shown::force_number)
    };
    let moved = |end| -> Column {
        let named = shown.in_movement(&format!("moved {}", name(end)));
        (named, (end, Limited::Movement), Shown::movement_number)
    };
    let other = end.other();
    vec![
        force_on(end),
        moved(end),
        if other.held_in(&report.scene) == End::Free {
            moved(other)
        } else {
            force_on(other)
        },
    ]
}

/// Force against movement of the end that is varied, by all ways that have an answer, and its limits; `None` without any. Movements differ by
/// powers of ten. What has no place on such an axis is left out, as a free end, or stands at its left edge, as a fixed one.
fn chart(report: &Report, comparison: &Comparison) -> Option<Chart> {
    let shown = &report.shown;
    let end = end(comparison);
    let force = |way: &TradeOff| way.value(end, Limited::Force);
    let movement = |way: &TradeOff| way.value(end, Limited::Movement);
    let answers = |wanted: fn(&Way) -> bool| {
        let ways = comparison.ways.iter();
        let drawn = ways.filter(move |way| wanted(way) && !way.is_free_end());
        drawn
            .flat_map(|way| &way.answer)
            .filter(|answer| movement(answer) <= shown.most)
    };
    let limits = || {
        let verdicts = report.verdicts.iter();
        verdicts.filter(|verdict| verdict.end == comparison.end)
    };
    let limit = limits().filter(|verdict| verdict.quantity == Limited::Movement);
    let movements = answers(|_| true).map(movement).filter(|metres| *metres > 0.0);
    let movements = movements.chain(limit.map(|verdict| verdict.limit));
    let (least, most) = movements.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), metres| {
        (least.min(metres), most.max(metres))
    });
    if most == 0.0 {
        return None;
    }
    let (unit, edge) = (shown.units.movement, least / ROOM);
    let in_force = |newtons| shown.units.force.of_si(newtons);
    let points = |wanted: fn(&Way) -> bool| -> Vec<(f64, f64)> {
        let point = |way| (unit.of_si(movement(way).max(edge)), in_force(force(way)));
        answers(wanted).map(point).collect()
    };
    let along = Axis::logarithmic(shown.in_movement(&format!("movement of the {} end", end.name())));
    let mut chart = Chart::new(
        "Force against movement",
        along.range(unit.of_si(edge), unit.of_si(ROOM * most)),
        Axis::linear(shown.in_force("force on it")),
    );
    for verdict in limits() {
        let label = format!("limit {}", verdict.quantity.given_in(&shown.units, verdict.limit));
        chart = chart.refer(match verdict.quantity {
            Limited::Force => Reference::horizontal(in_force(verdict.limit), label),
            Limited::Movement => Reference::vertical(unit.of_si(verdict.limit), label),
        });
    }
    let springs = points(|way| !way.is_clamp());
    let (clamps, own) = (points(Way::is_clamp), points(|way| way.is_scene));
    let has = [&springs, &clamps, &own].map(|points| !points.is_empty());
    let series = [
        Series::line_points("springs … fixed end", springs).look(0),
        Series::points("with a clamp", clamps).look(3),
        Series::points("the scene’s end", own).look(OTHER).marker(5),
    ];
    let drawn = series.into_iter().zip(has).filter(|(_, has)| *has);
    has.contains(&true)
        .then(|| drawn.fold(chart, |chart, (series, _)| chart.with(series)))
}

fn caption(comparison: &Comparison, shown: &Shown) -> String {
    let free = comparison.ways.iter().find(|way| way.is_free_end());
    let free = free.and_then(|way| way.answer.as_ref().ok());
    let free = free.map_or(String::new(), |answer| {
        format!(
            " A free end, which carries nothing, moves {} and is not drawn.",
            shown
                .movement(answer.value(end(comparison), Limited::Movement))
                .replace("> ", "more than ")
        )
    });
    format!(
        "Largest force during a pass against largest movement after a pass: a softer end moves more and is pressed less. What does not move \
         stands at the left edge.{free}"
    )
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
