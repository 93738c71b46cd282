//! A chart in its part of the figure.

use crate::figure::FigureError;
use crate::figure::chart::Chart;
use crate::figure::palette::{GREY, INK, PALETTE};
use crate::figure::series::{Along, Kind, Note, Reference, Series};

use super::canvas::{Anchor, Canvas, Rect, TEXT, stroke, text_width};
use super::frame::{Frame, below, ticks_across, ticks_up};
use super::heading::Heading;
use super::legend::Legend;
use super::series;

/// Legends begin this far from the figure's left edge \[px\].
pub const INDENT: f64 = 24.0;

pub fn chart(chart: &Chart, canvas: &Canvas<'_>, outer: Rect) -> Result<(), FigureError> {
    let shown: Vec<Series> = chart
        .series
        .iter()
        .enumerate()
        .map(|(k, series)| series.at_place(k))
        .collect();
    let heading = Heading::new(&chart.title, outer.width())?;
    let legend = Legend::new(&shown, &[], outer.width() - 2.0 * INDENT)?;
    let inner = Rect {
        top: outer.top + heading.height(),
        bottom: outer.bottom - legend.height(),
        ..outer
    };
    let scales = (
        chart
            .x
            .scale(chart.abscissae(), ticks_across(inner.width() - 90.0))?,
        chart
            .y
            .scale(chart.ordinates(), ticks_up(inner.height() - below()))?,
    );
    heading.draw(canvas, outer.left, outer.top)?;
    let frame = Frame::draw(canvas, inner, scales, (&chart.x.label, &chart.y.label), true, 0.0)?;
    for reference in &chart.references {
        draw_reference(canvas, &frame, reference)?;
    }
    for series in &shown {
        series::draw(canvas, &frame, series, false)?;
    }
    for reference in &chart.references {
        draw_label(canvas, &frame, reference, &shown)?;
    }
    for note in &chart.notes {
        draw_note(canvas, &frame, note)?;
    }
    legend.draw(canvas, outer.left + INDENT, inner.bottom)
}

/// Begin and end of a reference as shares of its axis, and whether any of it is in the plot.
fn shares(frame: &Frame, reference: &Reference) -> (f64, f64, bool) {
    let scale = match reference.along {
        Along::Horizontal => &frame.y,
        Along::Vertical => &frame.x,
    };
    let (from, to) = (scale.share(reference.from), scale.share(reference.to));
    (from.clamp(0.0, 1.0), to.clamp(0.0, 1.0), to >= 0.0 && from <= 1.0)
}

fn draw_reference(canvas: &Canvas<'_>, frame: &Frame, reference: &Reference) -> Result<(), FigureError> {
    let (from, to, seen) = shares(frame, reference);
    if !seen {
        return Ok(());
    }
    let corner = |along: f64, across: f64| match reference.along {
        Along::Horizontal => frame.at((along, across)),
        Along::Vertical => frame.at((across, along)),
    };
    let colour = reference.colour.map_or(GREY, |index| PALETTE[index]);
    if from == to {
        return canvas.dashed(
            &[corner(0.0, from), corner(1.0, from)],
            stroke(colour, 1.3),
            &[6.0, 4.0],
        );
    }
    let corners = [
        corner(0.0, from),
        corner(1.0, from),
        corner(1.0, to),
        corner(0.0, to),
    ];
    canvas.area(&corners, colour, 0.15)
}

/// The label stands on one of the two ends of the line or band, on one of its sides, where it hides least of the data.
fn draw_label(
    canvas: &Canvas<'_>,
    frame: &Frame,
    reference: &Reference,
    shown: &[Series],
) -> Result<(), FigureError> {
    let (from, to, seen) = shares(frame, reference);
    if !seen || reference.label.is_empty() {
        return Ok(());
    }
    let line = from == to;
    // A light colour does for a band, not for a text.
    let colour = if line {
        reference.colour.map_or(GREY, |index| PALETTE[index])
    } else {
        INK
    };
    let half = 0.5 * text_width(&reference.label, TEXT) + 6.0;
    let plot = frame.plot;
    let places = match reference.along {
        Along::Horizontal => {
            let (above, below) = (frame.at((0.0, to)).1, frame.at((0.0, from)).1);
            let inward = if line { 0.75 * TEXT } else { -0.75 * TEXT };
            let (left, right) = (plot.left + half, plot.right - half);
            let (above, below) = (above - inward, below + inward);
            [(right, above), (left, above), (right, below), (left, below)]
        }
        Along::Vertical => {
            let x = frame.at((0.5 * (from + to), 0.0)).0;
            let (top, bottom) = (plot.top + 0.9 * TEXT, plot.bottom - 0.9 * TEXT);
            [
                (x, top),
                (x, bottom),
                (x, top + 1.5 * TEXT),
                (x, bottom - 1.5 * TEXT),
            ]
        }
    };
    let hidden = places.map(|place| hidden_by(frame, text_place(plot, place, half), half, shown));
    let least = hidden.into_iter().min().unwrap_or(0);
    let best = places
        .into_iter()
        .zip(hidden)
        .find(|(_, hidden)| *hidden == least);
    text_inside(
        canvas,
        frame,
        &reference.label,
        best.map_or(places[0], |(place, _)| place),
        colour,
    )
}

/// How many points and pieces of lines a text of half-width `half` \[px\] at `centre` would hide.
fn hidden_by(frame: &Frame, centre: (f64, f64), half: f64, shown: &[Series]) -> usize {
    // The text as the unit square.
    let inside = |point: &(f64, f64)| {
        let (x, y) = frame.at(frame.shares(*point));
        (
            0.5 + (x - centre.0) / (2.0 * half),
            0.5 + (y - centre.1) / (1.5 * TEXT),
        )
    };
    let count = |series: &Series| {
        let places: Vec<_> = series.points.iter().map(inside).collect();
        let within = |share: f64| (0.0..=1.0).contains(&share);
        let points = places.iter().filter(|(x, y)| within(*x) && within(*y)).count();
        let lines = match series.kind {
            Kind::Points => 0,
            _ => places
                .windows(2)
                .filter(|pair| series::clip(pair[0], pair[1]).is_some())
                .count(),
        };
        points + lines
    };
    shown.iter().map(count).sum()
}

fn draw_note(canvas: &Canvas<'_>, frame: &Frame, note: &Note) -> Result<(), FigureError> {
    let (x, y) = frame.shares(note.at);
    let at = frame.at((x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)));
    text_inside(canvas, frame, &note.text, at, INK)
}

/// A text centred at `at`, moved as far as it takes to stay in the plot.
fn text_inside(
    canvas: &Canvas<'_>,
    frame: &Frame,
    text: &str,
    at: (f64, f64),
    colour: plotters::style::RGBColor,
) -> Result<(), FigureError> {
    let half = 0.5 * text_width(text, TEXT) + 4.0;
    let plot = frame.plot;
    if 2.0 * half > plot.width() {
        return Err(FigureError::NoRoom {
            text: text.into(),
            needed: 2.0 * half,
            room: plot.width(),
        });
    }
    canvas.text_on_white(text, text_place(plot, at, half), Anchor::Middle, colour)
}

/// `at`, moved so that a text of half-width `half` \[px\] stays in the plot.
fn text_place(plot: Rect, at: (f64, f64), half: f64) -> (f64, f64) {
    let x = at.0.min(plot.right - half).max(plot.left + half);
    (x, at.1.clamp(plot.top + 0.7 * TEXT, plot.bottom - 0.7 * TEXT))
}
