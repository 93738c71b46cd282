//! What to fit, and what of it is certain: measures in every combination of what is not known.

use super::chart::{ALONE, OTHER, axis, figure, over};
use super::content::Report;
use super::html::Html;
use crate::words::measures::{failures, interval, measures, recommendation, uncertain};
use creepage_run::Verdict;
use creepage_study::measures::{Combination, Comparison, FRICTION_KEY, Outcome};
use plain_figure::{Axis, Chart, Reference, Series};

pub fn certainty(html: &mut Html, report: &Report) {
    let (Some(comparison), reader) = (&report.compared, &report.reader) else {
        html.paragraph(
            "With limits (--limit-force, --limit-movement) “creepage report” compares measures here, in every combination of what is not known; of \
             a heated cable only where the scene says what that is ([uncertain]).",
        );
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
    let as_it_is = &comparison.measures[0];
    let worst = as_it_is.worst.as_ref().and_then(|worst| worst.verdicts.first());
    let Some(verdict) = worst else { return };
    let of_worst = OfWorst {
        report,
        comparison,
        verdict,
        middle: comparison.middle(),
        outcomes: &as_it_is.outcomes,
    };
    if of_worst.middle.contains_key(FRICTION_KEY) {
        let caption = "The scene as it is against friction, over all values of the other unknowns. Such curves are hills: neither end of an \
                       interval is the safe one.";
        figure(html, ALONE, [of_worst.hill()], caption);
    }
    let caption = "The same value from its lowest to its highest over each interval: the scene as it is, all other unknowns in their middle.";
    figure(html, ALONE, [of_worst.tornado()], caption);
}

/// What the scene as it is comes to in all combinations, at the limit of its worst, in units of the reader.
struct OfWorst<'a> {
    report: &'a Report,
    comparison: &'a Comparison,
    verdict: &'a Verdict,
    middle: Combination,
    outcomes: &'a [Outcome],
}

impl OfWorst<'_> {
    fn in_unit(&self, value: f64) -> f64 {
        self.report.reader.unit(self.verdict.quantity).of_si(value)
    }

    /// The value of a key, and what is limited there; also whether all other keys have their middle.
    fn points(&self, key: &str) -> Vec<(f64, f64, bool)> {
        let point = |outcome: &Outcome| {
            let is_same =
                |other: &&Verdict| (other.end, other.quantity) == (self.verdict.end, self.verdict.quantity);
            let value = outcome.verdicts.iter().find(is_same)?.largest;
            let is_middle = outcome.differs_only_in(key, &self.middle);
            Some((outcome.at[key], self.in_unit(value), is_middle))
        };
        let mut points: Vec<_> = self.outcomes.iter().filter_map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    /// Against friction, as a band over the other unknowns, with the scene's own place.
    fn hill(&self) -> Chart {
        let points = self.points(FRICTION_KEY);
        let is_band = self.comparison.uncertain.len() > 1;
        // Places at which all combinations are known.
        let groups = points.chunk_by(|a, b| a.0 == b.0);
        let groups: Vec<_> = groups.filter(|group| !is_band || group.len() > 1).collect();
        let border = |of: fn(f64, f64) -> f64| {
            let of_group = |group: &&[(f64, f64, bool)]| {
                let values = group.iter().map(|point| point.1);
                (group[0].0, values.reduce(of).unwrap_or_default())
            };
            groups.iter().map(of_group).collect::<Vec<_>>()
        };
        let name = self.verdict.quantity.at(self.verdict.end);
        let title = name[..1].to_uppercase() + &name[1..];
        let limit = Reference::horizontal(self.in_unit(self.verdict.limit), "limit");
        let mut chart = over(
            self.report,
            &title,
            Axis::linear("friction coefficient"),
            self.verdict.quantity,
        )
        .refer(limit);
        if is_band {
            let line = |name: &str, of| Series::line(name, border(of)).look(1);
            chart = chart.with(line("highest of the others", f64::max).solid());
            chart = chart.with(line("lowest of the others", f64::min).dashed());
        }
        let in_middle = points
            .iter()
            .filter(|point| point.2)
            .map(|point| (point.0, point.1));
        let own = self.report.run.largest(self.verdict.end, self.verdict.quantity);
        let own = [(self.report.scene.friction.dynamic_coefficient, self.in_unit(own))];
        chart
            .with(Series::line_points("the others in the middle", in_middle).look(0))
            .with(Series::points("the scene", own).look(OTHER).marker(5))
    }

    /// What each unknown alone does, the others in their middle: the widest bar on top.
    fn tornado(&self) -> Chart {
        let bar = |(name, key): (String, &str)| {
            let alone = self.points(key).into_iter().filter(|point| point.2);
            let range = alone.map(|point| (point.1, point.1));
            let (least, most) = range.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
            Some((name, least, most))
        };
        let unknowns = self.comparison.uncertain.iter();
        let mut bars: Vec<_> = unknowns
            .filter_map(|unknown| bar((interval(unknown), &unknown.key)))
            .collect();
        bars.sort_by(|a, b| (a.2 - a.1).total_cmp(&(b.2 - b.1)));
        let rows = Axis::linear("")
            .range(-0.6, bars.len() as f64 - 0.4)
            .ticks((0..bars.len()).map(|row| (row as f64, " ")));
        let limit = Reference::vertical(self.in_unit(self.verdict.limit), "limit");
        let chart = Chart::new(
            "What each unknown does alone",
            axis(self.report, self.verdict.quantity),
            rows,
        )
        .refer(limit);
        let all = bars.into_iter().enumerate().rev().enumerate();
        all.fold(chart, |chart, (look, (row, (name, least, most)))| {
            let points = [(least, row as f64), (most, row as f64)];
            chart.with(Series::line_points(name, points).look(look).solid())
        })
    }
}
