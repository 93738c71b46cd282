//! Coloured cells, and the bar that shows the colours of values.

use super::canvas::{Canvas, Rect, Stroke, TEXT, check_room, text_width};
use super::frame::{AXIS, Frame, TICK, widest_label};
use super::mark;
use crate::axis::Axis;
use crate::chart::{Cells, Chart};
use crate::error::FigureError;
use crate::palette::{INK, continuous};
use crate::scale::Scale;

/// Distance of the bar from the plot, and its width \[px\].
const GAP: f64 = 18.0;
const WIDTH: f64 = 20.0;
const STEPS: u32 = 128;

/// The scale of values and their colours.
pub struct Bar<'a> {
    axis: &'a Axis,
    scale: Scale,
}

impl<'a> Bar<'a> {
    /// The bar with about this many `ticks`; classes have none.
    pub fn new(cells: &'a Cells, ticks: usize) -> Result<Option<Self>, FigureError> {
        let Cells::Values(axis, cells) = cells else {
            return Ok(None);
        };
        let scale = axis.scale(cells.iter().flatten().copied(), ticks)?;
        Ok(Some(Self { axis, scale }))
    }

    /// Width of the bar with its labels and its distance from the plot \[px\].
    pub fn width(&self) -> f64 {
        GAP + WIDTH + 2.0 * TICK + widest_label(&self.scale) + 1.6 * TEXT
    }

    pub fn draw(&self, canvas: &mut Canvas, plot: Rect) -> Result<(), FigureError> {
        let label = &self.axis.label;
        check_room(label, text_width(label, TEXT), plot.height() + 2.0 * TEXT)?;
        let (left, right) = (plot.right + GAP, plot.right + GAP + WIDTH);
        let bar = Rect { left, right, ..plot };
        let at = |share: f64| plot.bottom - share * plot.height();
        for step in 0..STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            // Up to the end, under the cells to come: no seams.
            let bottom = at(share);
            let colour = continuous(share + 0.5 / f64::from(STEPS));
            canvas.rectangle(Rect { bottom, ..bar }, colour, 1.0);
        }
        let mut outline = bar.corners().to_vec();
        outline.push(outline[0]);
        canvas.line(&outline, Stroke::solid(INK, 1.0));
        for (value, label) in &self.scale.ticks {
            let y = at(self.scale.share(*value));
            canvas.line(&[(right, y), (right + TICK, y)], AXIS);
            canvas.text(label, (right + 2.0 * TICK, y), "start");
        }
        let middle = right + 2.0 * TICK + widest_label(&self.scale) + 0.9 * TEXT;
        canvas.upward(label, (middle, plot.centre().1));
        Ok(())
    }
}

/// Fills the cells of `chart`; values by the colours of their `bar`.
pub fn draw(canvas: &mut Canvas, frame: &Frame, chart: &Chart, cells: &Cells, bar: Option<&Bar>) {
    let (columns, rows) = (chart.x.borders(), chart.y.borders());
    let columns = || columns.windows(2);
    let places = rows.windows(2).flat_map(|y| columns().map(move |x| (x, y)));
    for (index, (x, y)) in places.enumerate() {
        let ((left, bottom), (right, top)) = (frame.at((x[0], y[0])), frame.at((x[1], y[1])));
        let cell = Rect {
            left,
            top,
            right,
            bottom,
        };
        match cells {
            Cells::Classes(_, cells) => mark::class_cell(canvas, cells[index], cell),
            Cells::Values(_, cells) => {
                if let (Some(value), Some(bar)) = (cells[index], bar) {
                    canvas.rectangle(cell, continuous(bar.scale.share(value)), 1.0);
                }
            }
        }
    }
}
