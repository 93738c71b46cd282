//! Markers of points and marks in cells.

use plotters::style::RGBColor;

use crate::figure::FigureError;
use crate::figure::palette::{CLASSES, WHITE};

use super::canvas::{Canvas, Rect, stroke};

/// Half the size of a marker \[px\].
const RADIUS: f64 = 4.0;
const WIDTH: f64 = 1.7;
/// Marks are drawn in cells at least this large \[px\].
const SMALLEST_CELL: f64 = 7.0;

/// Draws the marker of the `index`-th series: circle, square, triangle, diamond, triangle on its tip, star, cross.
pub fn marker(
    canvas: &Canvas<'_>,
    index: usize,
    at: (f64, f64),
    colour: RGBColor,
) -> Result<(), FigureError> {
    let style = stroke(colour, WIDTH);
    let corners: &[(f64, f64)] = match index % 7 {
        0 => &CIRCLE,
        1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        2 => &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
        3 => &[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)],
        4 => &[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)],
        5 => return strokes(canvas, at, RADIUS, &[CROSS[0], CROSS[1], PLUS[0], PLUS[1]], style),
        _ => return strokes(canvas, at, RADIUS, &CROSS, style),
    };
    let place = |&(x, y): &(f64, f64)| (at.0 + RADIUS * x, at.1 + RADIUS * y);
    let mut outline: Vec<_> = corners.iter().map(place).collect();
    canvas.area(&outline, WHITE, 1.0)?;
    // Past the first corner, so that the outline's ends meet in a corner as well.
    outline.extend_from_within(0..2);
    canvas.line(&outline, style)
}

const CROSS: [[(f64, f64); 2]; 2] = [[(-0.9, -0.9), (0.9, 0.9)], [(-0.9, 0.9), (0.9, -0.9)]];
const PLUS: [[(f64, f64); 2]; 2] = [[(-1.2, 0.0), (1.2, 0.0)], [(0.0, -1.2), (0.0, 1.2)]];
const CIRCLE: [(f64, f64); 16] = [
    (1.0, 0.0),
    (0.924, 0.383),
    (0.707, 0.707),
    (0.383, 0.924),
    (0.0, 1.0),
    (-0.383, 0.924),
    (-0.707, 0.707),
    (-0.924, 0.383),
    (-1.0, 0.0),
    (-0.924, -0.383),
    (-0.707, -0.707),
    (-0.383, -0.924),
    (0.0, -1.0),
    (0.383, -0.924),
    (0.707, -0.707),
    (0.924, -0.383),
];

fn strokes(
    canvas: &Canvas<'_>,
    at: (f64, f64),
    radius: f64,
    lines: &[[(f64, f64); 2]],
    style: plotters::style::ShapeStyle,
) -> Result<(), FigureError> {
    lines.iter().try_for_each(|line| {
        let points = line.map(|(x, y)| (at.0 + radius * x, at.1 + radius * y));
        canvas.line(&points, style)
    })
}

/// Fills a cell with the colour and the mark of the `look`-th class.
pub fn class_cell(canvas: &Canvas<'_>, look: usize, cell: Rect) -> Result<(), FigureError> {
    let look = look % CLASSES.len();
    canvas.rectangle(cell, CLASSES[look], 1.0)?;
    let size = cell.width().min(cell.height());
    if size < SMALLEST_CELL {
        return Ok(());
    }
    let centre = (0.5 * (cell.left + cell.right), 0.5 * (cell.top + cell.bottom));
    let radius = (0.22 * size).min(6.0);
    let dark = stroke(RGBColor(0, 0, 0), 1.2);
    match look {
        1 => strokes(canvas, centre, radius, &CROSS, stroke(WHITE, 1.6)),
        2 => strokes(canvas, centre, radius, &CROSS[1..], dark),
        4 => {
            let dot = CIRCLE.map(|(x, y)| (centre.0 + 0.5 * radius * x, centre.1 + 0.5 * radius * y));
            canvas.area(&dot, RGBColor(0, 0, 0), 1.0)
        }
        5 => {
            let ring: Vec<_> = CIRCLE
                .iter()
                .chain(&CIRCLE[..2])
                .map(|(x, y)| (centre.0 + 0.8 * radius * x, centre.1 + 0.8 * radius * y))
                .collect();
            canvas.line(&ring, stroke(WHITE, 1.4))
        }
        _ => Ok(()),
    }
}
