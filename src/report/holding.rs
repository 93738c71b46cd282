//! Ways to hold the cable: force against movement.

use super::chart::{ALONE, OTHER, figure};
use super::content::Report;
use super::html::Html;
use super::measures::{Comparison, Way};
use crate::design::TradeOff;
use crate::figure::{Axis, Chart, Reference, Series};
use crate::scene::End;
use crate::shown::{exact_percent, percent, words_if};
use crate::words::{Reader, Table, narrow_name};
use crate::{CableEnd, Limited};

/// Room of the chart to the left of the least movement and to the right of the largest, as a factor.
const ROOM: f64 = 2.0;

pub fn holding(html: &mut Html, report: &Report) {
    let (Some(comparison), reader) = (&report.measures, &report.reader) else {
        return;
    };
    let own = comparison.own_stiffness.map_or(String::new(), |own| {
        format!(
            " Stiffnesses are from a tenth to ten times that of the whole cable, EA/L = {}, beside that of the scene’s end.",
            reader.stiffness(own)
        )
    });
    let heat = words_if(report.run.heat.is_some(), ", all of them also in heat");
    html.paragraph(&format!(
        "The same traffic with the {} end held in other ways, and with a clamp in addition to what the scene has.{own} Of all passes, forces \
         are the largest during a pass, movements of free ends the largest after a pass{heat}. The row “as in the scene” is the run of this page; each other row is a run of its own with a \
         tolerance of {}. The command “creepage design” finds the stiffness for given limits.",
        comparison.end.name(),
        exact_percent(comparison.tolerance)
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    if let Some(chart) = chart(report, comparison) {
        figure(html, ALONE, [chart], &caption(comparison, reader));
    }
    html.table(&table(report, comparison));
    let failures = comparison.ways.iter().filter_map(|way| {
        let error = way.answer.as_ref().err()?;
        Some(format!("Failed: {}: {error}", way.name(reader)))
    });
    html.list(&failures.collect::<Vec<_>>());
}

/// Of each way force and movement of the end that is varied; of the other one its movement where it is free, and otherwise the force on it.
fn table(report: &Report, comparison: &Comparison) -> Table {
    let (reader, end, other) = (&report.reader, comparison.end, comparison.end.other());
    let of_other = match other.held_in(&report.scene) {
        End::Free => Limited::Movement,
        _ => Limited::Force,
    };
    let columns = [(end, Limited::Force), (end, Limited::Movement), (other, of_other)];
    let name = |(end, quantity): (CableEnd, Limited)| {
        let what = match quantity {
            Limited::Force => "force",
            Limited::Movement => "moved",
        };
        reader.head(&format!("{what} {}", narrow_name(end)), quantity)
    };
    let on_clamp = reader.head("most on a clamp", Limited::Force);
    let names = columns
        .map(name)
        .into_iter()
        .chain([on_clamp, "error".to_owned()]);
    let values = |answer: &TradeOff| {
        let clamps = answer.clamps.iter().map(|clamp| clamp.force_n);
        let clamp = clamps.reduce(f64::max);
        let clamp = clamp.map_or("–".into(), |force| reader.number(Limited::Force, force));
        // Where no end is pressed there is no error of the force.
        let is_pressed = answer.force_n != 0.0;
        let error = if is_pressed {
            percent(answer.error_estimate)
        } else {
            "–".into()
        };
        let value = |(end, quantity)| reader.number(quantity, answer.value(end, quantity));
        columns.map(value).into_iter().chain([clamp, error]).collect()
    };
    let row = |way: &Way| {
        let values: Vec<String> = match &way.answer {
            Ok(answer) => values(answer),
            Err(_) => ["failed", "–", "–", "–", "–"].map(str::to_owned).into(),
        };
        let leaves = way.answer.as_ref().is_ok_and(|answer| answer.leaves_duct);
        let name = way.name(reader) + words_if(leaves, ", leaves the duct");
        std::iter::once(name).chain(values).collect()
    };
    Table {
        head: std::iter::once("held by".to_owned()).chain(names).collect(),
        rows: comparison.ways.iter().map(row).collect(),
        words: 1,
    }
}

/// Force against movement of the end that is varied, by all ways that have an answer, and its limits; `None` without any. Movements differ by
/// powers of ten. What has no place on such an axis is left out, as a free end, or stands at its left edge, as a fixed one.
fn chart(report: &Report, comparison: &Comparison) -> Option<Chart> {
    let (reader, end) = (&report.reader, comparison.end);
    let drawn: Vec<(&Way, f64, f64)> = comparison
        .ways
        .iter()
        .filter(|way| !way.is_free_end())
        .filter_map(|way| Some((way, way.answer.as_ref().ok()?)))
        .map(|(way, answer)| {
            (
                way,
                answer.value(end, Limited::Movement),
                answer.value(end, Limited::Force),
            )
        })
        .filter(|(_, movement, _)| *movement <= reader.most)
        .collect();
    let limits = || report.verdicts.iter().filter(|verdict| verdict.end == end.into());
    let limit = limits().filter(|verdict| verdict.quantity == Limited::Movement);
    let movements = drawn
        .iter()
        .map(|(_, movement, _)| *movement)
        .chain(limit.map(|verdict| verdict.limit));
    let positive = movements.filter(|metres| *metres > 0.0);
    let (least, most) = positive.fold((f64::INFINITY, 0.0_f64), |(least, most), metres| {
        (least.min(metres), most.max(metres))
    });
    if most == 0.0 {
        return None;
    }
    let [in_force, in_movement] = [Limited::Force, Limited::Movement].map(|quantity| reader.unit(quantity));
    let edge = least / ROOM;
    let moved = format!("movement of the {} end", end.name());
    let along = Axis::logarithmic(reader.head(&moved, Limited::Movement));
    let mut chart = Chart::new(
        "Force against movement",
        along.range(in_movement.of_si(edge), in_movement.of_si(ROOM * most)),
        Axis::linear(reader.head("force on it", Limited::Force)),
    );
    for verdict in limits() {
        let label = format!(
            "limit {}",
            verdict.quantity.given_in(&reader.units, verdict.limit)
        );
        chart = chart.refer(match verdict.quantity {
            Limited::Force => Reference::horizontal(in_force.of_si(verdict.limit), label),
            Limited::Movement => Reference::vertical(in_movement.of_si(verdict.limit), label),
        });
    }
    let points = |wanted: &dyn Fn(&Way) -> bool| -> Vec<(f64, f64)> {
        let wanted = drawn.iter().filter(|(way, ..)| wanted(way));
        wanted
            .map(|(_, movement, force)| (in_movement.of_si(movement.max(edge)), in_force.of_si(*force)))
            .collect()
    };
    let springs = points(&|way| !way.is_clamp());
    let (clamps, own) = (points(&Way::is_clamp), points(&|way| way.is_scene));
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

fn caption(comparison: &Comparison, reader: &Reader) -> String {
    let free = comparison.ways.iter().find(|way| way.is_free_end());
    let free = free.and_then(|way| way.answer.as_ref().ok());
    let free = free.map_or(String::new(), |answer| {
        let moved = reader.movement(answer.value(comparison.end, Limited::Movement));
        let moved = moved.replace("> ", "more than ");
        format!(" A free end, which carries nothing, moves {moved} and is not drawn.")
    });
    format!(
        "Largest force during a pass against largest movement after a pass: a softer end moves more and is pressed less. What does not move \
         stands at the left edge.{free}"
    )
}
