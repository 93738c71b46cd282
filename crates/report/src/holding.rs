//! Ways to hold the cable: force against movement.

use super::chart::{ALONE, OTHER, figure};
use super::content::Report;
use super::html::Html;
use super::measures::{Comparison, Way};
use crate::words::{Reader, Table, narrow_name};
use creepage_plan::shown::{exact_percent, percent, words_if};
use creepage_run::Limited;
use creepage_scene::{CableEnd, End};
use creepage_study::design::TradeOff;
use plain_figure::{Axis, Chart, Reference, Series};

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
    let on_clamp = reader.head("largest on a clamp", Limited::Force);
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

/// Force against movement of the end that is varied, by all ways that have an answer, and its limits; `None` where nothing moves. Movements
/// differ by powers of ten. What has no place on such an axis is left out, as a free end, or stands at its left edge, as a fixed one.
fn chart(report: &Report, comparison: &Comparison) -> Option<Chart> {
    let (reader, end) = (&report.reader, comparison.end);
    let in_unit = |quantity, value| reader.unit(quantity).of_si(value);
    let drawn = |(way, answer): (&'_ Way, &TradeOff)| {
        let [movement, force] =
            [Limited::Movement, Limited::Force].map(|quantity| answer.value(end, quantity));
        let is_drawn = !way.is_free_end() && movement <= reader.most;
        let (movement, force) = (
            in_unit(Limited::Movement, movement),
            in_unit(Limited::Force, force),
        );
        is_drawn.then_some((way.is_clamp(), way.is_scene, movement, force))
    };
    let answers = comparison.ways.iter();
    let answers = answers.filter_map(|way| Some((way, way.answer.as_ref().ok()?)));
    let drawn: Vec<(bool, bool, f64, f64)> = answers.filter_map(drawn).collect();
    let limits = report.verdicts.iter().filter(|verdict| verdict.end == end.into());
    let limits: Vec<(Limited, f64, String)> = limits
        .map(|verdict| {
            let (quantity, limit) = (verdict.quantity, verdict.limit);
            let label = format!("limit {}", quantity.given_in(&reader.units, limit));
            (quantity, in_unit(quantity, limit), label)
        })
        .collect();
    let of_limits = limits
        .iter()
        .filter(|(quantity, ..)| *quantity == Limited::Movement);
    let movements = drawn
        .iter()
        .map(|way| way.2)
        .chain(of_limits.map(|limit| limit.1));
    let positive: Vec<f64> = movements.filter(|movement| *movement > 0.0).collect();
    let most = positive.iter().copied().reduce(f64::max)?;
    let edge = positive.iter().copied().fold(most, f64::min) / ROOM;
    let moved = format!("movement of the {} end", end.name());
    let along = Axis::logarithmic(reader.head(&moved, Limited::Movement));
    let force = Axis::linear(reader.head("force on this end", Limited::Force));
    let mut chart = Chart::new("Force against movement", along.range(edge, ROOM * most), force);
    for (quantity, limit, label) in limits {
        chart = chart.refer(match quantity {
            Limited::Force => Reference::horizontal(limit, label),
            Limited::Movement => Reference::vertical(limit, label),
        });
    }
    let points = |wanted: fn(bool, bool) -> bool| -> Vec<(f64, f64)> {
        let wanted = drawn
            .iter()
            .filter(|(is_clamp, is_scene, ..)| wanted(*is_clamp, *is_scene));
        wanted
            .map(|(.., movement, force)| (movement.max(edge), *force))
            .collect()
    };
    let series = [
        (points(|is_clamp, _| !is_clamp), "springs, from soft to fixed", 0),
        (points(|is_clamp, _| is_clamp), "with a clamp", 3),
        (points(|_, is_scene| is_scene), "the scene’s end", OTHER),
    ];
    for (points, name, look) in series.into_iter().filter(|(points, ..)| !points.is_empty()) {
        chart = chart.with(match look {
            0 => Series::line_points(name, points).look(look),
            OTHER => Series::points(name, points).look(look).marker(5),
            _ => Series::points(name, points).look(look),
        });
    }
    Some(chart).filter(|_| !drawn.is_empty())
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
