//! From data to SVG.

pub mod canvas;
mod cells;
mod frame;
mod legend;
mod mark;
mod reference;
mod series;

use crate::axis::Axis;
use crate::chart::{Cells, Chart};
use crate::error::FigureError;
use crate::panels::Panels;
use canvas::{Canvas, Rect};
use cells::Bar;
use frame::{BELOW, Frame, ticks};
use legend::{Heading, Legend};
use series::Shown;

/// Legends begin this far from the figure's left edge \[px\].
const INDENT: f64 = 24.0;
/// What the y axis takes of the width, about \[px\].
const LEFT: f64 = 90.0;

impl Chart {
    /// The chart as an SVG of 800 by 500 px.
    ///
    /// # Errors
    ///
    /// [`FigureError`] without data, where cells and axes do not fit together, with numbers that are not finite or have no
    /// place on a logarithmic axis, and where a text has no room.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        Panels::new("")
            .panel_size(800.0, 500.0)
            .with(self.clone())
            .to_svg()
    }
}

impl Panels {
    /// The figure as an SVG.
    ///
    /// # Errors
    ///
    /// As for [`Chart::to_svg`], and without any chart.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        if self.charts.is_empty() {
            return Err(FigureError::empty("figure", &self.title));
        }
        self.charts.iter().try_for_each(Chart::check)?;
        Axis::linear("").check("size of a chart", [self.size.0, self.size.1])?;
        let columns = self.columns.min(self.charts.len());
        let rows = self.charts.len().div_ceil(columns);
        let (width, height) = self.size;
        let whole = width * columns as f64;
        let heading = Heading::new(&self.title, whole)?;
        let top = heading.height();
        let titles = self.charts.iter().map(|chart| chart.title.as_str());
        let titles = std::iter::once(self.title.as_str()).chain(titles);
        let titles: Vec<&str> = titles.filter(|title| !title.is_empty()).collect();
        let mut canvas = Canvas::new(&titles.join("; "), (whole, top + height * rows as f64));
        heading.draw(&mut canvas, (0.0, 0.0));
        for (k, chart) in self.charts.iter().enumerate() {
            let (column, row) = ((k % columns) as f64, (k / columns) as f64);
            let centre = ((column + 0.5) * width, top + (row + 0.5) * height);
            let outer = Rect::around(centre, 0.5 * width, 0.5 * height);
            draw(chart, &mut canvas, outer)?;
        }
        Ok(canvas.finish())
    }
}

/// Draws a chart in its part of the figure.
fn draw(chart: &Chart, canvas: &mut Canvas, outer: Rect) -> Result<(), FigureError> {
    let shown = |(k, series)| Shown::new(series, k, chart.cells.is_some());
    let shown: Vec<Shown> = chart.series.iter().enumerate().map(shown).collect();
    let classes = match &chart.cells {
        Some(Cells::Classes(classes, _)) => classes.as_slice(),
        _ => &[],
    };
    let heading = Heading::new(&chart.title, outer.width())?;
    let legend = Legend::new(classes, &shown, outer.width() - 2.0 * INDENT)?;
    let inner = Rect {
        top: outer.top + heading.height(),
        bottom: outer.bottom - legend.height,
        ..outer
    };
    let up = ticks(inner.height() - BELOW, 50.0);
    let bar = match &chart.cells {
        Some(cells) => Bar::new(cells, up)?,
        None => None,
    };
    let right = bar.as_ref().map_or(0.0, Bar::width);
    let across = ticks(inner.width() - right - LEFT, 90.0);
    let scales = (
        chart.x.scale(chart.contents().flat_map(|(_, x, _)| x), across)?,
        chart.y.scale(chart.contents().flat_map(|(.., y)| y), up)?,
    );
    heading.draw(canvas, (outer.left, outer.top));
    let labels = (chart.x.label.as_str(), chart.y.label.as_str());
    let frame = Frame::draw(canvas, inner, scales, labels, chart.cells.is_none(), right)?;
    if let Some(cells) = &chart.cells {
        cells::draw(canvas, &frame, chart, cells, bar.as_ref());
    }
    for reference in &chart.references {
        reference::draw(canvas, &frame, reference);
    }
    for shown in &shown {
        shown.draw(canvas, &frame);
    }
    for reference in &chart.references {
        reference::draw_label(canvas, &frame, reference)?;
    }
    if let Some(bar) = bar {
        bar.draw(canvas, frame.plot)?;
    }
    legend.draw(canvas, (outer.left + INDENT, inner.bottom));
    Ok(())
}
