//! Several charts in one figure.

use crate::chart::Chart;

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
    pub(crate) title: String,
    pub(crate) columns: usize,
    pub(crate) size: (f64, f64),
    pub(crate) charts: Vec<Chart>,
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
}
