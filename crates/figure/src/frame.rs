//! The plot's frame: axes with ticks and labels, and where a point lies in it.

use crate::drawing::{Anchor, Drawing, Point, Rect, Stroke, TEXT, check_room};
use crate::error::FigureError;
use crate::palette::{GRID, INK};
use crate::scale::Scale;

/// Length of ticks; labels stand twice as far from the axis \[px\].
pub const TICK: f64 = 5.0;
/// Between a tick's label and that of the axis, and between the latter and the figure's edge \[px\].
const GAP: f64 = 10.0;
/// Room to the right of the plot for half a tick's label \[px\].
const RIGHT: f64 = 22.0;
/// Height that an x axis takes below the plot \[px\].
pub const BELOW: f64 = 2.0 * TICK + TEXT + GAP + TEXT;
/// The smallest plot \[px\].
const SMALLEST: f64 = 50.0;
/// Axes and ticks.
pub const AXIS: Stroke = Stroke::solid(INK, 1.2);

/// Points farther out than this many frames are drawn there: no program that shows an SVG needs more digits than it has.
const FAR: f64 = 1e3;

/// The scales of both axes, and the plot's place.
pub struct Frame {
    pub x: Scale,
    pub y: Scale,
    pub plot: Rect,
}

/// How many labelled ticks, `each` so long, fit into a length \[px\]; at least two.
pub fn ticks(length: f64, each: f64) -> usize {
    (length / each).max(2.0) as usize
}

/// Width of the widest label of an axis \[px\].
pub fn widest_label(scale: &Scale) -> f64 {
    let widths = scale.ticks.iter().map(|(_, label)| Drawing::text_width(label));
    widths.fold(0.0, f64::max)
}

impl Frame {
    /// Draws axes in `outer`, which ends where the legend begins; `right` \[px\] more are left free on the right.
    pub fn draw(
        drawing: &mut Drawing,
        outer: Rect,
        (x, y): (Scale, Scale),
        (x_label, y_label): (&str, &str),
        grid: bool,
        right: f64,
    ) -> Result<Self, FigureError> {
        let last = x.ticks.last();
        let last = last.map_or(0.0, |tick| 0.5 * Drawing::text_width(&tick.1));
        let plot = Rect {
            left: outer.left + GAP + TEXT + GAP + widest_label(&y) + 2.0 * TICK,
            right: outer.right - right - RIGHT.max(last + 4.0),
            top: outer.top + 0.7 * TEXT,
            bottom: outer.bottom - BELOW,
        };
        check_room(x_label, Drawing::text_width(x_label), plot.width())?;
        check_room(y_label, Drawing::text_width(y_label), outer.height())?;
        check_room(x_label, SMALLEST, plot.width().min(plot.height()))?;
        labels_fit(&x, plot.width(), Drawing::text_width)?;
        labels_fit(&y, plot.height(), |_| TEXT)?;

        let frame = Self { x, y, plot };
        if grid {
            frame.draw_grid(drawing);
        }
        let corner = (plot.left, plot.bottom);
        drawing.stroke(&[(plot.left, plot.top), corner, (plot.right, plot.bottom)], AXIS);
        for (value, label) in &frame.x.ticks {
            let (x, y) = (frame.x(*value), plot.bottom);
            drawing.stroke(&[(x, y), (x, y + TICK)], AXIS);
            drawing.text(label, (x, y + 2.0 * TICK + 0.5 * TEXT), Anchor::Middle);
        }
        for (value, label) in &frame.y.ticks {
            let (x, y) = (plot.left, frame.y(*value));
            drawing.stroke(&[(x, y), (x - TICK, y)], AXIS);
            drawing.text(label, (x - 2.0 * TICK, y), Anchor::End);
        }
        let centre = plot.centre();
        drawing.text(x_label, (centre.0, outer.bottom - 0.75 * TEXT), Anchor::Middle);
        drawing.upward(y_label, (outer.left + GAP + 0.5 * TEXT, centre.1));
        Ok(frame)
    }

    /// Lines at the ticks.
    fn draw_grid(&self, drawing: &mut Drawing) {
        let (plot, stroke) = (self.plot, Stroke::solid(GRID, 1.0));
        for x in self.x.ticks.iter().map(|tick| self.x(tick.0)) {
            drawing.stroke(&[(x, plot.bottom), (x, plot.top)], stroke);
        }
        for y in self.y.ticks.iter().map(|tick| self.y(tick.0)) {
            drawing.stroke(&[(plot.left, y), (plot.right, y)], stroke);
        }
    }

    /// Where an abscissa lies \[px\].
    pub fn x(&self, value: f64) -> f64 {
        self.plot.left + self.x.share(value).clamp(-FAR, FAR) * self.plot.width()
    }

    /// Where an ordinate lies \[px\].
    pub fn y(&self, value: f64) -> f64 {
        self.plot.bottom - self.y.share(value).clamp(-FAR, FAR) * self.plot.height()
    }

    /// Where a point of the data lies.
    pub fn at(&self, (x, y): (f64, f64)) -> Point {
        (self.x(x), self.y(y))
    }
}

/// Labels of neighbouring ticks on an axis of `length` \[px\] do not touch.
fn labels_fit(scale: &Scale, length: f64, size: impl Fn(&str) -> f64) -> Result<(), FigureError> {
    for pair in scale.ticks.windows(2) {
        let room = (scale.share(pair[1].0) - scale.share(pair[0].0)) * length;
        let needed = 0.5 * (size(&pair[0].1) + size(&pair[1].1));
        check_room(&pair[1].1, needed, room)?;
    }
    Ok(())
}
