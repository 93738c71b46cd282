//! Cells coloured by class or by value, and the bar that shows the colours of values.

use crate::axis::Axis;
use crate::drawing::{Anchor, Drawing, Rect, Stroke, TEXT, check_room};
use crate::error::FigureError;
use crate::frame::{AXIS, Frame, TICK, widest_label};
use crate::palette::{INK, class_colour, continuous};
use crate::scale::Scale;

/// Distance of the bar from the plot, and its width \[px\].
const GAP: f64 = 18.0;
const WIDTH: f64 = 20.0;
const STEPS: u32 = 128;

/// A class or a value for each cell, row by row from the lowest, each row along x.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cells {
    /// Names of the classes, and the index of each cell's.
    Classes(Vec<String>, Vec<usize>),
    /// Values on the scale of the axis; a cell without value stays white.
    Values(Axis, Vec<Option<f64>>),
}

impl Cells {
    /// Whether they fill the `grid` of so many cells in the chart named `chart`, with classes and values that exist.
    pub fn check(&self, chart: &str, grid: usize) -> Result<(), FigureError> {
        let (found, has_data, has_classes) = match self {
            Self::Classes(classes, cells) => {
                let known = cells.iter().all(|class| *class < classes.len());
                (cells.len(), !cells.is_empty(), known)
            }
            Self::Values(axis, cells) => {
                axis.check(&axis.label, cells.iter().flatten().copied())?;
                (cells.len(), cells.iter().any(Option::is_some), true)
            }
        };
        match (has_data, found == grid && has_classes) {
            (false, _) => Err(FigureError::Empty(format!("chart \"{chart}\""))),
            (_, false) => Err(FigureError::BadCells(chart.to_owned())),
            _ => Ok(()),
        }
    }

    /// Fills the cells of a map over these axes; values by the colours of their `bar`.
    pub fn draw(&self, drawing: &mut Drawing, frame: &Frame, (x, y): (&Axis, &Axis), bar: Option<&Bar>) {
        let (columns, rows) = (x.borders(), y.borders());
        let columns = || columns.windows(2);
        let places = rows.windows(2).flat_map(|y| columns().map(move |x| (x, y)));
        for (index, (x, y)) in places.enumerate() {
            let ((left, bottom), (right, top)) = (frame.at((x[0], y[0])), frame.at((x[1], y[1])));
            let cell = Rect::between((left, top), (right, bottom));
            match self {
                Self::Classes(_, cells) => drawing.rectangle(cell, class_colour(cells[index]), 1.0),
                Self::Values(_, cells) => {
                    if let (Some(value), Some(bar)) = (cells[index], bar) {
                        drawing.rectangle(cell, continuous(bar.scale.share(value)), 1.0);
                    }
                }
            }
        }
    }
}

/// The scale of values and their colours.
pub struct Bar<'a> {
    axis: &'a Axis,
    scale: Scale,
}

impl<'a> Bar<'a> {
    /// The bar with about this many `ticks`; classes have none.
    pub fn new(cells: Option<&'a Cells>, ticks: usize) -> Result<Option<Self>, FigureError> {
        let Some(Cells::Values(axis, cells)) = cells else {
            return Ok(None);
        };
        let scale = axis.scale(cells.iter().flatten().copied(), ticks)?;
        Ok(Some(Self { axis, scale }))
    }

    /// Width of the bar with its labels and its distance from the plot \[px\].
    pub fn width(&self) -> f64 {
        GAP + WIDTH + 2.0 * TICK + widest_label(&self.scale) + 1.6 * TEXT
    }

    pub fn draw(&self, drawing: &mut Drawing, plot: Rect) -> Result<(), FigureError> {
        let label = &self.axis.label;
        check_room(label, Drawing::text_width(label), plot.height() + 2.0 * TEXT)?;
        let (left, right) = (plot.right + GAP, plot.right + GAP + WIDTH);
        let bar = Rect { left, right, ..plot };
        let at = |share: f64| plot.bottom - share * plot.height();
        for step in 0..STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            // Up to the end, under the cells to come: no seams.
            let bottom = at(share);
            let colour = continuous(share + 0.5 / f64::from(STEPS));
            drawing.rectangle(Rect { bottom, ..bar }, colour, 1.0);
        }
        let [a, b, c, d] = bar.corners();
        drawing.stroke(&[a, b, c, d, a], Stroke::solid(INK, 1.0));
        for (value, label) in &self.scale.ticks {
            let y = at(self.scale.share(*value));
            drawing.stroke(&[(right, y), (right + TICK, y)], AXIS);
            drawing.text(label, (right + 2.0 * TICK, y), Anchor::Start);
        }
        let middle = right + 2.0 * TICK + widest_label(&self.scale) + 0.9 * TEXT;
        drawing.upward(label, (middle, plot.centre().1));
        Ok(())
    }
}
