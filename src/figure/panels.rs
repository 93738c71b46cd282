//! Several charts and maps in one figure.

use super::draw::{self, Rect};
use super::{Chart, FigureError, Map};

/// A chart or a map.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Panel {
    /// A chart.
    Chart(Chart),
    /// A map.
    Map(Map),
}

impl From<Chart> for Panel {
    fn from(chart: Chart) -> Self {
        Self::Chart(chart)
    }
}

impl From<Map> for Panel {
    fn from(map: Map) -> Self {
        Self::Map(map)
    }
}

/// Charts and maps in rows, under a common title.
///
/// ```
/// use creepage::figure::{Axis, Chart, Panels, Series};
///
/// let chart = |name: &str| {
///     Chart::new(name, Axis::linear("x, m"), Axis::linear("u, µm"))
///         .with(Series::line(name, [(0.0, 0.0), (1.0, 2.0)]))
/// };
/// let svg = Panels::new("Displacement").with(chart("vertical")).with(chart("along the duct")).to_svg()?;
/// assert!(svg.contains("along the duct"));
/// # Ok::<(), creepage::figure::FigureError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Panels {
    title: String,
    columns: usize,
    panel_size: (f64, f64),
    parts: Vec<Panel>,
}

impl Panels {
    /// No panels yet, to be stacked in one column of 800 by 400 px each. The title may be empty.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            columns: 1,
            panel_size: (800.0, 400.0),
            parts: Vec::new(),
        }
    }

    /// Panels a row; at least one.
    #[must_use]
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Width and height of each panel \[px\], 200 to 5000.
    #[must_use]
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        let sane = |length: f64| {
            if length.is_nan() {
                400.0
            } else {
                length.clamp(200.0, 5000.0)
            }
        };
        self.panel_size = (sane(width), sane(height));
        self
    }

    /// Adds a chart or a map: row by row, from the left.
    #[must_use]
    pub fn with(mut self, panel: impl Into<Panel>) -> Self {
        self.parts.push(panel.into());
        self
    }

    /// The figure as an SVG.
    ///
    /// # Errors
    ///
    /// As for [`Chart::to_svg`] and [`Map::to_svg`], and without any panel.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        if self.parts.is_empty() {
            return Err(FigureError::Empty {
                what: format!("figure \"{}\"", self.title),
            });
        }
        for panel in &self.parts {
            match panel {
                Panel::Chart(chart) => chart.check()?,
                Panel::Map(map) => map.check()?,
            }
        }
        let columns = self.columns.min(self.parts.len());
        let rows = self.parts.len().div_ceil(columns);
        let (width, height) = self.panel_size;
        let whole = width * columns as f64;
        let title = draw::Heading::new(&self.title, whole)?;
        let top = title.height();
        draw::svg(&self.name(), (whole, top + height * rows as f64), |canvas| {
            title.draw(canvas, 0.0, 0.0)?;
            for (k, panel) in self.parts.iter().enumerate() {
                let (row, column) = ((k / columns) as f64, (k % columns) as f64);
                let outer = Rect {
                    left: column * width,
                    top: top + row * height,
                    right: (column + 1.0) * width,
                    bottom: top + (row + 1.0) * height,
                };
                match panel {
                    Panel::Chart(chart) => chart.draw(canvas, outer)?,
                    Panel::Map(map) => map.draw(canvas, outer)?,
                }
            }
            Ok(())
        })
    }

    /// What a reader who cannot see the figure is told it is.
    fn name(&self) -> String {
        let titles = self.parts.iter().map(|panel| match panel {
            Panel::Chart(chart) => chart.title.as_str(),
            Panel::Map(map) => map.title.as_str(),
        });
        let all = std::iter::once(self.title.as_str()).chain(titles);
        all.filter(|title| !title.is_empty())
            .collect::<Vec<_>>()
            .join("; ")
    }
}
