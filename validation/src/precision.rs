//! A work-precision chart: error against cost, one panel a scene and one curve a method.

use creepage::figure::{Axis, Chart, Panels, Reference, Series};

use crate::Failure;

/// Look of what is right, in every figure.
const BLACK: usize = 6;

/// One point of a chart.
pub struct Point {
    pub panel: usize,
    pub series: usize,
    /// What was asked or set.
    pub knob: f64,
    pub error: f64,
    pub seconds: f64,
    /// Work that knows no machine; `None` if none is counted.
    pub count: Option<f64>,
}

/// What is drawn: the title, the label and range of the cost, and that of the error.
pub struct Figure<'a> {
    pub title: &'a str,
    pub cost: (&'a str, (f64, f64)),
    pub error: (&'a str, (f64, f64)),
}

impl Figure<'_> {
    /// Panels with their names and the error of their truth itself, and the curves of `series` in each; no point lies below the axis.
    pub fn draw(
        &self,
        panels: &[(String, f64)],
        series: &[String],
        points: &[Point],
        cost: impl Fn(&Point) -> Option<f64>,
    ) -> Result<String, Failure> {
        let mut figure = Panels::new(self.title).columns(2);
        let (range, floor) = (self.cost.1, self.error.1.0);
        for (panel, (name, own_error)) in panels.iter().enumerate() {
            let mut chart = Chart::new(
                name,
                Axis::logarithmic(self.cost.0).range(range.0, range.1),
                Axis::logarithmic(self.error.0).range(floor, self.error.1.1),
            )
            .refer(Reference::horizontal(1e-2, "1 %"))
            .refer(Reference::horizontal(1e-3, "0.1 %"));
            if *own_error > floor {
                let line = [(range.0, *own_error), (range.1, *own_error)];
                let line = Series::line("error of the truth itself", line);
                chart = chart.with(line.look(BLACK).dotted());
            }
            for (look, name) in series.iter().enumerate() {
                let of_curve = |point: &&Point| (point.panel, point.series) == (panel, look);
                let mine = points.iter().filter(of_curve);
                let mine = mine.filter_map(|point| Some((cost(point)?, point.error.max(floor))));
                let mine: Vec<(f64, f64)> = mine.filter(|(_, error)| error.is_finite()).collect();
                if !mine.is_empty() {
                    chart = chart.with(Series::line_points(name, mine).look(look));
                }
            }
            figure = figure.with(chart);
        }
        Ok(figure.to_svg()?)
    }
}
