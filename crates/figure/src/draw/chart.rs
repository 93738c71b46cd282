//! A chart in its part of the figure.

use super::canvas::{Canvas, Rect};
use super::cells::{self, Bar};
use super::frame::{BELOW, Frame, ticks};
use super::heading::Heading;
use super::legend::Legend;
use super::reference;
use super::series::Shown;
use crate::cells::Cells;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::palette::INK;

/// Legends begin this far from the figure's left edge \[px\].
const INDENT: f64 = 24.0;
/// What the y axis takes of the width, about \[px\].
const LEFT: f64 = 90.0;

pub fn draw(chart: &Chart, canvas: &mut Canvas, outer: Rect) -> Result<(), FigureError> {
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
        reference::draw_label(canvas, &frame, reference, &chart.series)?;
    }
    for (at, text) in &chart.notes {
        reference::draw_text(canvas, frame.plot, text, frame.at(*at), INK)?;
    }
    if let Some(bar) = bar {
        bar.draw(canvas, frame.plot)?;
    }
    legend.draw(canvas, (outer.left + INDENT, inner.bottom));
    Ok(())
}
