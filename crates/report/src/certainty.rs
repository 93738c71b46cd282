//! What to fit, and what of it is certain: measures in every combination of what is not known.

use super::chart::{ALONE, OTHER, figure};
use super::content::Report;
use super::html::Html;
use crate::words::measures::{failures, key_name, key_value, measures, recommendation, uncertain};
use creepage_run::Limited;
use creepage_study::measures::{Comparison, Extreme, Outcome, Unknown};
use plain_figure::{Axis, Chart, Reference, Series};

pub fn certainty(html: &mut Html, report: &Report) {
    let (Some(comparison), reader) = (&report.compared, &report.reader) else {
        return;
    };
    html.paragraph(&recommendation(comparison, reader));
    html.paragraph(&format!(
        "Not known: {}. Each measure is computed in every combination of lowest, middle and highest, friction at five places, then closer around \
         the worst. Force, movement and time are those of the worst combination.",
        uncertain(comparison)
    ));
    html.raw("<div class=\"passes names\">");
    html.table(&measures(comparison, reader));
    html.raw("</div>");
    html.list(&failures(comparison));
    let as_it_is = comparison
        .measures
        .first()
        .and_then(|measure| Some((measure, measure.worst.as_ref()?)));
    let Some((measure, worst)) = as_it_is else { return };
    let charts = [
        hill(report, comparison, worst, &measure.outcomes),
        tornado(report, comparison, worst, &measure.outcomes),
    ];
    for (chart, caption) in charts.into_iter().flatten() {
        figure(html, ALONE, [chart], &caption);
    }
}

/// The value that the worst combination of the scene as it is has at its limit, in another combination, in units of the reader.
fn value(report: &Report, worst: &Extreme, outcome: &Outcome) -> Option<f64> {
    let same = outcome
        .verdicts
        .iter()
        .find(|verdict| (verdict.end, verdict.quantity) == (worst.end, worst.quantity));
    same.map(|verdict| report.reader.unit(worst.quantity).of_si(verdict.largest))
}

/// The axis of that value.
fn amount(report: &Report, worst: &Extreme) -> Axis {
    let name = match worst.quantity {
        Limited::Force => "force",
        Limited::Movement => "movement",
    };
    Axis::linear(report.reader.head(name, worst.quantity))
}

/// What it is, as a title.
fn capitalised(worst: &Extreme) -> String {
    let name = worst.quantity.at(worst.end);
    let (initial, rest) = name.split_at(1);
    initial.to_uppercase() + rest
}

/// That value against friction, as a band over the other unknowns, with the scene's own place.
fn hill(
    report: &Report,
    comparison: &Comparison,
    worst: &Extreme,
    outcomes: &[Outcome],
) -> Option<(Chart, String)> {
    let place = comparison.friction()?;
    let middle: Vec<f64> = comparison.uncertain.iter().map(Unknown::middle).collect();
    let is_middle = |outcome: &Outcome| {
        (0..middle.len()).all(|other| other == place || outcome.at[other] == middle[other])
    };
    let mut points: Vec<(f64, f64, bool)> = outcomes
        .iter()
        .filter_map(|outcome| {
            Some((
                outcome.at[place],
                value(report, worst, outcome)?,
                is_middle(outcome),
            ))
        })
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Places at which all combinations are known.
    let groups = points
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|group| middle.len() == 1 || group.len() > 1);
    let groups: Vec<_> = groups.collect();
    let over = |of: fn(f64, f64) -> f64| {
        let each = groups.iter().map(move |group| {
            (
                group[0].0,
                group.iter().map(|point| point.1).reduce(of).unwrap_or_default(),
            )
        });
        each.collect::<Vec<_>>()
    };
    let own = report.run.largest(worst.end, worst.quantity);
    let unit = report.reader.unit(worst.quantity);
    let in_middle = points
        .iter()
        .filter(|point| point.2)
        .map(|point| (point.0, point.1));
    let mut chart = Chart::new(
        capitalised(worst),
        Axis::linear("friction coefficient"),
        amount(report, worst),
    )
    .refer(Reference::horizontal(unit.of_si(worst.limit), "limit"));
    if middle.len() > 1 {
        chart = chart.with(
            Series::line("highest of the others", over(f64::max))
                .look(1)
                .solid(),
        );
        chart = chart.with(
            Series::line("lowest of the others", over(f64::min))
                .look(1)
                .dashed(),
        );
    }
    chart = chart.with(Series::line_points("the others in the middle", in_middle).look(0));
    let friction = report.scene.friction.dynamic_coefficient;
    chart = chart.with(
        Series::points("the scene", [(friction, unit.of_si(own))])
            .look(OTHER)
            .marker(5),
    );
    Some((
        chart,
        "The scene as it is against friction, over all values of the other unknowns. Such curves are hills: neither end of an interval is the safe one."
            .to_owned(),
    ))
}

/// What each unknown alone does to that value, the others in their middle: the widest bar on top.
fn tornado(
    report: &Report,
    comparison: &Comparison,
    worst: &Extreme,
    outcomes: &[Outcome],
) -> Option<(Chart, String)> {
    let unknowns = &comparison.uncertain;
    let middle: Vec<f64> = unknowns.iter().map(Unknown::middle).collect();
    let mut bars: Vec<(String, f64, f64)> = (0..unknowns.len())
        .filter_map(|own| {
            let alone = |outcome: &&Outcome| {
                (0..middle.len()).all(|other| other == own || outcome.at[other] == middle[other])
            };
            let values = outcomes
                .iter()
                .filter(alone)
                .filter_map(|outcome| value(report, worst, outcome));
            let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(least, most), value| {
                (least.min(value), most.max(value))
            });
            let [low, high] =
                [unknowns[own].low, unknowns[own].high].map(|value| key_value(&unknowns[own].key, value));
            let name = format!("{} {low} to {high}", key_name(&unknowns[own].key));
            (least <= most).then_some((name, least, most))
        })
        .collect();
    bars.sort_by(|a, b| (a.2 - a.1).total_cmp(&(b.2 - b.1)));
    let limit = report.reader.unit(worst.quantity).of_si(worst.limit);
    let rows = Axis::linear("")
        .range(-0.6, bars.len() as f64 - 0.4)
        .ticks((0..bars.len()).map(|row| (row as f64, " ")));
    let chart = Chart::new("What each unknown does alone", amount(report, worst), rows);
    let mut chart = chart.refer(Reference::vertical(limit, "limit"));
    for (row, (name, least, most)) in bars.iter().enumerate().rev() {
        let points = [(*least, row as f64), (*most, row as f64)];
        chart = chart.with(
            Series::line_points(name, points)
                .look(bars.len() - 1 - row)
                .solid(),
        );
    }
    let caption = "The same value from its lowest to its highest over each interval: the scene as it is, all other unknowns in their middle.";
    (!bars.is_empty()).then_some((chart, caption.to_owned()))
}
