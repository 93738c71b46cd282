//! The plot's frame: axes with ticks and labels, and where a point lies in it.

use plotters::chart::{ChartBuilder, LabelAreaPosition};
use plotters::style::Color;

use crate::figure::FigureError;
use crate::figure::palette::{FINE_GRID, GRID, INK};
use crate::figure::scale::Scale;

use super::canvas::{Canvas, Rect, TEXT, UNITS, drawing, stroke, text_style, text_width};

/// Length of ticks; labels stand twice as far from the axis \[px\].
const TICK: f64 = 5.0;
/// Between a tick's label and that of the axis, and between the latter and the figure's edge \[px\].
const GAP: f64 = 10.0;
/// Room to the right of the plot for half a tick's label \[px\].
const RIGHT: f64 = 22.0;

/// Axes drawn, and the plot's place.
pub struct Frame {
    pub x: Scale,
    pub y: Scale,
    pub plot: Rect,
}

const FAR: f64 = 1e9;

/// Ticks that fit along a length \[px\].
pub fn ticks_across(length: f64) -> usize {
    (length / 90.0).max(2.0) as usize
}

/// The same from bottom to top.
pub fn ticks_up(length: f64) -> usize {
    (length / 50.0).max(2.0) as usize
}

/// Height that an x axis takes below the plot \[px\].
pub fn below() -> f64 {
    2.0 * TICK + TEXT + GAP + TEXT
}

impl Frame {
    /// Draws axes in `outer`, which ends where the legend begins; `right` \[px\] more are left free on the right.
    pub fn draw(
        canvas: &Canvas<'_>,
        outer: Rect,
        (x, y): (Scale, Scale),
        (x_label, y_label): (&str, &str),
        grid: bool,
        right: f64,
    ) -> Result<Self, FigureError> {
        let widest = y
            .ticks()
            .iter()
            .map(|tick| text_width(&tick.label, TEXT))
            .fold(0.0, f64::max);
        let left = 2.0 * TICK + widest + GAP + TEXT + GAP;
        let last = x
            .ticks()
            .last()
            .map_or(0.0, |tick| 0.5 * text_width(&tick.label, TEXT));
        let plot = Rect {
            left: outer.left + left,
            right: outer.right - right - RIGHT.max(last + 4.0),
            top: outer.top + 0.7 * TEXT,
            bottom: outer.bottom - below(),
        };
        fits(x_label, plot.width().min(outer.width()))?;
        fits(y_label, outer.height())?;
        if plot.width() < 50.0 || plot.height() < 50.0 {
            return Err(FigureError::NoRoom {
                text: x_label.into(),
                needed: 50.0,
                room: plot.width().min(plot.height()),
            });
        }
        labels_fit(&x, plot.width())?;

        let units = |length: f64| (length * UNITS).round() as i32;
        let area = canvas.root.clone().shrink(
            (units(outer.left + GAP - 4.0), units(plot.top)),
            (
                units(plot.right) - units(outer.left + GAP - 4.0),
                units(outer.bottom) - units(plot.top),
            ),
        );
        let mut chart = ChartBuilder::on(&area)
            .set_label_area_size(
                LabelAreaPosition::Left,
                units(plot.left) - units(outer.left + GAP - 4.0),
            )
            .set_label_area_size(LabelAreaPosition::Bottom, units(below()))
            .build_cartesian_2d(x.clone(), y.clone())
            .map_err(|error| drawing(&error))?;
        let mut mesh = chart.configure_mesh();
        if !grid {
            mesh.disable_mesh();
        }
        mesh.x_desc(x_label)
            .y_desc(y_label)
            .axis_style(stroke(INK, 1.2))
            .bold_line_style(stroke(GRID, 1.0))
            .light_line_style(FINE_GRID.mix(1.0).stroke_width((0.8 * UNITS) as u32))
            .label_style(text_style(TEXT, false))
            .axis_desc_style(text_style(TEXT, false))
            .set_all_tick_mark_size(units(TICK))
            .draw()
            .map_err(|error| drawing(&error))?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        let px = |unit: i32| f64::from(unit) / UNITS;
        let plot = Rect {
            left: px(across.start),
            right: px(across.end),
            top: px(down.start),
            bottom: px(down.end),
        };
        Ok(Self { x, y, plot })
    }

    /// Shares of the axes, in \[0, 1\] inside the plot, to px.
    pub fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            self.plot.left + x * self.plot.width(),
            self.plot.bottom - y * self.plot.height(),
        )
    }

    /// Shares of the axes of a point. Points beyond [`FAR`] frames are taken to stand there, so that lengths stay finite.
    pub fn shares(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x.share(x).clamp(-FAR, FAR), self.y.share(y).clamp(-FAR, FAR))
    }
}

/// The axis label has room.
fn fits(label: &str, room: f64) -> Result<(), FigureError> {
    let needed = text_width(label, TEXT);
    if needed > room {
        return Err(FigureError::NoRoom {
            text: label.into(),
            needed,
            room,
        });
    }
    Ok(())
}

/// Labels of neighbouring ticks do not touch.
fn labels_fit(scale: &Scale, length: f64) -> Result<(), FigureError> {
    for pair in scale.ticks().windows(2) {
        let room = (scale.share(pair[1].value) - scale.share(pair[0].value)) * length;
        let needed = 0.5 * (text_width(&pair[0].label, TEXT) + text_width(&pair[1].label, TEXT));
        if needed > room {
            return Err(FigureError::NoRoom {
                text: pair[1].label.clone(),
                needed,
                room,
            });
        }
    }
    Ok(())
}
