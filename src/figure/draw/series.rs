//! A series inside its frame.

use crate::figure::FigureError;
use crate::figure::palette::{DASHES, PALETTE, WHITE};
use crate::figure::series::{Kind, Series};

use super::canvas::{Canvas, stroke};
use super::frame::Frame;
use super::mark;

/// Width of lines \[px\].
pub const LINE_WIDTH: f64 = 2.2;
/// Opacity of filled areas.
pub const SHADE: f64 = 0.25;

/// Draws `series`, with its looks set, cut off at the frame; with a white `halo` its lines show on any ground.
pub fn draw(canvas: &Canvas<'_>, frame: &Frame, series: &Series, halo: bool) -> Result<(), FigureError> {
    let colour = PALETTE[series.colour.unwrap_or(0)];
    let mut points: Vec<_> = series.points.iter().map(|point| frame.shares(*point)).collect();
    if series.kind == Kind::Step {
        points = stairs(&points);
    }
    if series.kind == Kind::Area {
        let zero = if frame.y.is_logarithmic() {
            0.0
        } else {
            frame.y.share(0.0).clamp(0.0, 1.0)
        };
        for line in inside(&points) {
            let mut outline: Vec<_> = line.iter().map(|point| frame.at(*point)).collect();
            outline.push(frame.at((line[line.len() - 1].0, zero)));
            outline.push(frame.at((line[0].0, zero)));
            canvas.area(&outline, colour, SHADE)?;
        }
    }
    if series.kind != Kind::Points {
        let dash = DASHES[series.dash.unwrap_or(0)];
        for line in inside(&points) {
            let line: Vec<_> = line.iter().map(|point| frame.at(*point)).collect();
            if halo {
                canvas.line(&line, stroke(WHITE, 2.5 * LINE_WIDTH))?;
            }
            canvas.dashed(&line, stroke(colour, LINE_WIDTH), dash)?;
        }
    }
    if matches!(series.kind, Kind::Points | Kind::LinePoints) {
        for point in points {
            let shown = |share: f64| (-1e-9..=1.0 + 1e-9).contains(&share);
            if shown(point.0) && shown(point.1) {
                mark::marker(canvas, series.marker.unwrap_or(0), frame.at(point), colour)?;
            }
        }
    }
    Ok(())
}

/// Each value kept until the next point.
fn stairs(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut path: Vec<_> = points.first().copied().into_iter().collect();
    for pair in points.windows(2) {
        path.extend([(pair[1].0, pair[0].1), pair[1]]);
    }
    path
}

/// The parts of a line inside the unit square.
fn inside(points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in points.windows(2) {
        let Some((from, to)) = clip(pair[0], pair[1]) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// The part of a segment inside the unit square (Y.-D. Liang, B. A. Barsky, ACM Transactions on Graphics 3, 1984).
pub fn clip(from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (slope, room) in [
        (-dx, from.0),
        (dx, 1.0 - from.0),
        (-dy, from.1),
        (dy, 1.0 - from.1),
    ] {
        if slope == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if slope < 0.0 {
            enter = enter.max(room / slope);
        } else {
            leave = leave.min(room / slope);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    // Ends inside stay as they are, to the last digit. A segment that only touches the frame is none.
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter < leave).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_frame() {
        let parts = inside(&[(-1.0, 0.5), (0.5, 0.5), (0.5, 2.0), (0.75, 2.0), (0.75, 0.0)]);
        assert_eq!(
            parts,
            [
                vec![(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)],
                vec![(0.75, 1.0), (0.75, 0.0)]
            ]
        );
        assert!(inside(&[(-1.0, 0.5), (0.5, 2.5)]).is_empty());
        // A point on the frame itself.
        assert_eq!(
            inside(&[(-0.1, 0.2), (0.0, 0.3), (1.0, 0.3), (1.1, 0.3)]),
            [vec![(0.0, 0.3), (1.0, 0.3)]]
        );
    }
}
