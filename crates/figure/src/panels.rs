//! Several charts in one figure.

use crate::axis::Axis;
use crate::chart::Chart;
use crate::drawing::{Drawing, Rect};
use crate::error::FigureError;
use crate::legend;

/// Charts in rows, under a common title.
///
/// ```
/// use plain_figure::{Axis, Chart, Panels, Series};
///
/// let chart = |name: &str| {
///     Chart::new(name, Axis::linear("x, m"), Axis::linear("u, µm"))
///         .with(Series::line(name, [(0.0, 0.0), (1.0, 2.0)]))
/// };
/// let svg = Panels::new("Displacement").with(chart("vertical")).with(chart("along the duct")).to_svg()?;
/// assert!(svg.contains("along the duct"));
/// # Ok::<(), plain_figure::FigureError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Panels {
    title: String,
    columns: usize,
    size: (f64, f64),
    charts: Vec<Chart>,
}

impl Panels {
    /// No charts yet, to be stacked in one column of 800 by 400 px each. The title may be empty.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            columns: 1,
            size: (800.0, 400.0),
            charts: Vec::new(),
        }
    }

    /// Charts a row; at least one.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Width and height of each chart \[px\].
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        self.size = (width, height);
        self
    }

    /// Adds a chart: row by row, from the left.
    pub fn with(mut self, chart: Chart) -> Self {
        self.charts.push(chart);
        self
    }

    /// The figure as an SVG.
    ///
    /// # Errors
    ///
    /// As for [`Chart::to_svg`], and without any chart.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        if self.charts.is_empty() {
            return Err(FigureError::Empty(format!("figure \"{}\"", self.title)));
        }
        self.charts.iter().try_for_each(Chart::check)?;
        Axis::linear("").check("size of a chart", [self.size.0, self.size.1])?;
        let columns = self.columns.min(self.charts.len());
        let rows = self.charts.len().div_ceil(columns);
        let (width, height) = self.size;
        let whole = width * columns as f64;
        let titles = self.charts.iter().map(|chart| chart.title.as_str());
        let titles = std::iter::once(self.title.as_str()).chain(titles);
        let titles: Vec<&str> = titles.filter(|title| !title.is_empty()).collect();
        let mut drawing = Drawing::new(&titles.join("; "), (whole, 0.0));
        let top = legend::title(&self.title, &mut drawing, (0.0, 0.0), whole)?;
        drawing.size.1 = top + height * rows as f64;
        for (k, chart) in self.charts.iter().enumerate() {
            let (column, row) = ((k % columns) as f64, (k / columns) as f64);
            let centre = ((column + 0.5) * width, top + (row + 0.5) * height);
            chart.draw(&mut drawing, Rect::around(centre, 0.5 * width, 0.5 * height))?;
        }
        Ok(drawing.to_svg())
    }
}

impl Chart {
    /// The chart as an SVG of 800 by 500 px.
    ///
    /// # Errors
    ///
    /// [`FigureError`] without data, where cells and axes do not fit together, with numbers that are not finite or have no
    /// place on a logarithmic axis, and where a text has no room.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        let panels = Panels::new("").panel_size(800.0, 500.0);
        panels.with(self.clone()).to_svg()
    }
}
