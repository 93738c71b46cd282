//! A map in its part of the figure.

use crate::figure::FigureError;
use crate::figure::axis::Axis;
use crate::figure::map::{Fill, Map};
use crate::figure::palette::{INK, continuous};
use crate::figure::scale::Scale;
use crate::figure::series::Series;

use super::canvas::{Anchor, Canvas, Rect, TEXT, stroke, text_style, text_width};
use super::chart::INDENT;
use super::frame::{Frame, below, ticks_across, ticks_up};
use super::heading::Heading;
use super::legend::Legend;
use super::{mark, series};

/// Colour bar: distance from the plot, width, and steps of colour.
const BAR_GAP: f64 = 18.0;
const BAR_WIDTH: f64 = 20.0;
const BAR_STEPS: u32 = 128;
const TICK: f64 = 5.0;

pub fn map(map: &Map, canvas: &Canvas<'_>, outer: Rect) -> Result<(), FigureError> {
    // The first colours of series are also those of classes: lines begin with black.
    let shown: Vec<Series> = map
        .lines
        .iter()
        .enumerate()
        .map(|(k, line)| line.at_place(k))
        .zip(&map.lines)
        .map(|(shown, line)| {
            if line.colour.is_none() {
                shown.colour(6)
            } else {
                shown
            }
        })
        .collect();
    let classes: Vec<(String, usize)> = match &map.fill {
        Fill::Classes(classes, _) => classes
            .iter()
            .enumerate()
            .map(|(k, class)| (class.name.clone(), class.look.unwrap_or(k)))
            .collect(),
        Fill::Values(..) => Vec::new(),
    };
    let heading = Heading::new(&map.title, outer.width())?;
    let legend = Legend::new(&shown, &classes, outer.width() - 2.0 * INDENT)?;
    let inner = Rect {
        top: outer.top + heading.height(),
        bottom: outer.bottom - legend.height(),
        ..outer
    };
    let up = ticks_up(inner.height() - below());
    let bar = match &map.fill {
        Fill::Values(axis, cells) => Some((axis, axis.scale(cells.iter().flatten().copied(), up)?)),
        Fill::Classes(..) => None,
    };
    let right = bar.as_ref().map_or(0.0, |(_, scale)| {
        BAR_GAP + BAR_WIDTH + bar_labels(scale) + 1.6 * TEXT
    });
    let (x, columns) = map.x.scale(ticks_across(inner.width() - right - 90.0))?;
    let (y, rows) = map.y.scale(up)?;
    heading.draw(canvas, outer.left, outer.top)?;
    let frame = Frame::draw(canvas, inner, (x, y), (&map.x.label, &map.y.label), false, right)?;
    if let (Some(names), height) = (map.y.named(), frame.plot.height()) {
        let room = height / names.len() as f64;
        if room < TEXT {
            return Err(FigureError::NoRoom {
                text: names[0].clone(),
                needed: TEXT,
                room,
            });
        }
    }
    for (k, row) in rows.windows(2).enumerate() {
        for (m, column) in columns.windows(2).enumerate() {
            let (left, bottom) = frame.at(frame.shares((column[0], row[0])));
            let (right, top) = frame.at(frame.shares((column[1], row[1])));
            let cell = Rect {
                left,
                top,
                right,
                bottom,
            };
            let index = k * (columns.len() - 1) + m;
            match (&map.fill, &bar) {
                (Fill::Classes(_, cells), _) => mark::class_cell(canvas, classes[cells[index]].1, cell)?,
                (Fill::Values(_, cells), Some((_, scale))) => {
                    if let Some(value) = cells[index] {
                        canvas.rectangle(cell, continuous(scale.share(value)), 1.0)?;
                    }
                }
                (Fill::Values(..), None) => {}
            }
        }
    }
    for line in &shown {
        series::draw(canvas, &frame, line, true)?;
    }
    if let Some((axis, scale)) = bar {
        draw_bar(canvas, frame.plot, axis, &scale)?;
    }
    legend.draw(canvas, outer.left + INDENT, inner.bottom)
}

fn bar_labels(scale: &Scale) -> f64 {
    let widths = scale.ticks().iter().map(|tick| text_width(&tick.label, TEXT));
    2.0 * TICK + widths.fold(0.0, f64::max)
}

/// The scale of colours, right of the plot.
fn draw_bar(canvas: &Canvas<'_>, plot: Rect, axis: &Axis, scale: &Scale) -> Result<(), FigureError> {
    let left = plot.right + BAR_GAP;
    let right = left + BAR_WIDTH;
    let at = |share: f64| plot.bottom - share * plot.height();
    for step in 0..BAR_STEPS {
        let share = |k: u32| f64::from(k) / f64::from(BAR_STEPS);
        let cell = Rect {
            left,
            right,
            bottom: at(share(step)),
            // Up to the end, under the cells to come: no seams.
            top: plot.top,
        };
        canvas.rectangle(cell, continuous(share(step) + 0.5 * share(1)), 1.0)?;
    }
    let outline = [
        (left, plot.bottom),
        (right, plot.bottom),
        (right, plot.top),
        (left, plot.top),
        (left, plot.bottom),
        (right, plot.bottom),
    ];
    canvas.line(&outline, stroke(INK, 1.0))?;
    for tick in scale.ticks() {
        let y = at(scale.share(tick.value));
        canvas.line(&[(right, y), (right + TICK, y)], stroke(INK, 1.2))?;
        canvas.text(
            &tick.label,
            (right + 2.0 * TICK, y),
            Anchor::Start,
            &text_style(TEXT, false),
        )?;
    }
    let needed = text_width(&axis.label, TEXT);
    if needed > plot.height() + 2.0 * TEXT {
        return Err(FigureError::NoRoom {
            text: axis.label.clone(),
            needed,
            room: plot.height(),
        });
    }
    let middle = (
        right + bar_labels(scale) + 0.9 * TEXT,
        0.5 * (plot.top + plot.bottom),
    );
    canvas.upward_text(&axis.label, middle, &text_style(TEXT, false))
}
