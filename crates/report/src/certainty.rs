//! What to fit, and what of it is certain: measures in every combination of what is not known.

use super::chart::{ALONE, OTHER, axis, figure, over};
use super::content::Report;
use super::html::Html;
use crate::words::measures::{failures, interval, measures, recommendation, uncertain};
use crate::words::range;
use creepage_run::Verdict;
use creepage_scene::Uncertain;
use creepage_study::measures::{Comparison, FRICTION_KEY, Nearest, Outcome};
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
    let Some(worst) = &comparison.measures[0].worst else {
        return;
    };
    let of_worst = OfWorst {
        report,
        comparison,
        worst,
    };
    if comparison.middle().contains_key(FRICTION_KEY) {
        let caption = "The scene as it is against friction, over all values of the other unknowns. Such curves are hills: neither end of an \
                       interval is the safe one.";
        figure(html, ALONE, [of_worst.hill()], caption);
    }
    let caption = "The same value from its lowest to its highest over each interval: the scene as it is, all other unknowns in their middle.";
    figure(html, ALONE, [of_worst.tornado()], caption);
}

/// What is not known, what is limited there, and whether all else has its middle.
type Point = (f64, f64, bool);

/// What the scene as it is comes to in all combinations, at the limit of its worst, in units of the reader.
struct OfWorst<'a> {
    report: &'a Report,
    comparison: &'a Comparison,
    worst: &'a Nearest,
}

impl OfWorst<'_> {
    fn in_unit(&self, value: f64) -> f64 {
        self.report.reader.unit(self.worst.quantity).of_si(value)
    }

    /// All combinations by the value of a key, ascending.
    fn points(&self, key: &str) -> Vec<Point> {
        let middle = self.comparison.middle();
        let point = |outcome: &Outcome| {
            let is_same =
                |other: &&Verdict| (other.end, other.quantity) == (self.worst.end, self.worst.quantity);
            let value = outcome.verdicts.iter().find(is_same)?.largest;
            let is_middle = outcome.differs_only_in(key, &middle);
            Some((outcome.at[key], self.in_unit(value), is_middle))
        };
        let outcomes = self.comparison.measures[0].outcomes.iter();
        let mut points: Vec<Point> = outcomes.filter_map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    /// Against friction, as a band over the other unknowns, with the scene's own place.
    fn hill(&self) -> Chart {
        let points = self.points(FRICTION_KEY);
        // Friction at which several combinations are known, and the least and the largest value there.
        let groups = points.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        let band = groups.map(|group| {
            let [least, most] = range(group.iter().map(|point| point.1));
            ((group[0].0, least), (group[0].0, most))
        });
        let (least, most): (Vec<_>, Vec<_>) = band.unzip();
        let name = self.worst.quantity.at(self.worst.end);
        let title = name[..1].to_uppercase() + &name[1..];
        let friction = Axis::linear("friction coefficient");
        let limit = Reference::horizontal(self.in_unit(self.worst.limit), "limit");
        let mut chart = over(self.report, &title, friction, self.worst.quantity).refer(limit);
        if !least.is_empty() {
            chart = chart.with(Series::line("highest of the others", most).look(1).solid());
            chart = chart.with(Series::line("lowest of the others", least).look(1).dashed());
        }
        let in_middle = points.iter().filter(|point| point.2);
        let in_middle = in_middle.map(|point| (point.0, point.1));
        let own = self.report.run.largest(self.worst.end, self.worst.quantity);
        let own = [(self.report.scene.friction.dynamic_coefficient, self.in_unit(own))];
        chart
            .with(Series::line_points("the others in the middle", in_middle).look(0))
            .with(Series::points("the scene", own).look(OTHER).marker(3))
    }

    /// What each unknown alone does, the others in their middle: the widest bar on top.
    fn tornado(&self) -> Chart {
        let bar = |unknown: &Uncertain| {
            let mut alone = self.points(&unknown.key);
            alone.retain(|point| point.2);
            (interval(unknown), range(alone.iter().map(|point| point.1)))
        };
        let mut bars: Vec<_> = self.comparison.uncertain.iter().map(bar).collect();
        bars.sort_by(|(_, [a, b]), (_, [c, d])| (b - a).total_cmp(&(d - c)));
        let rows = Axis::linear("")
            .range(-0.6, bars.len() as f64 - 0.4)
            .ticks((0..bars.len()).map(|row| (row as f64, " ")));
        let value = axis(self.report, self.worst.quantity);
        let limit = Reference::vertical(self.in_unit(self.worst.limit), "limit");
        let chart = Chart::new("What each unknown does alone", value, rows).refer(limit);
        let all = bars.into_iter().enumerate().rev().enumerate();
        all.fold(chart, |chart, (look, (row, (name, [least, most])))| {
            let points = [(least, row as f64), (most, row as f64)];
            chart.with(Series::line_points(name, points).look(look).solid())
        })
    }
}
