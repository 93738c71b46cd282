//! Markers of points and marks in cells.

use std::f64::consts::TAU;

use super::canvas::{Canvas, Point, Rect, Stroke};
use crate::palette::{BLACK, CLASSES, Colour, WHITE};

/// Half the size of a marker \[px\].
const RADIUS: f64 = 4.0;
/// Marks are drawn in cells at least this large \[px\].
const SMALLEST_CELL: f64 = 7.0;

/// Corners and strokes around (0, 0), of about the size 1.
const SQUARE: [Point; 4] = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
const TRIANGLE: [Point; 3] = [(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)];
const ON_ITS_TIP: [Point; 3] = [(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)];
const DIAMOND: [Point; 4] = [(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)];
const CROSS: [[Point; 2]; 2] = [[(-0.9, -0.9), (0.9, 0.9)], [(-0.9, 0.9), (0.9, -0.9)]];
const PLUS: [[Point; 2]; 2] = [[(-1.2, 0.0), (1.2, 0.0)], [(0.0, -1.2), (0.0, 1.2)]];

/// A circle of radius 1.
fn circle() -> [Point; 16] {
    std::array::from_fn(|k| {
        let (sine, cosine) = (TAU * k as f64 / 16.0).sin_cos();
        (cosine, sine)
    })
}

/// A shape of size 1, scaled and moved.
fn placed<const N: usize>(shape: &[Point; N], at: Point, size: f64) -> [Point; N] {
    shape.map(|(x, y)| (at.0 + size * x, at.1 + size * y))
}

fn strokes(canvas: &mut Canvas, at: Point, size: f64, lines: &[[Point; 2]], stroke: Stroke) {
    for line in lines {
        canvas.line(&placed(line, at, size), stroke);
    }
}

/// Draws the marker of the `index`-th series: circle, square, triangle, diamond, triangle on its tip, star, cross.
pub fn marker(canvas: &mut Canvas, index: usize, at: Point, colour: Colour) {
    let stroke = Stroke::solid(colour, 1.7);
    match index % 7 {
        0 => canvas.outlined(&placed(&circle(), at, RADIUS), WHITE, stroke),
        1 => canvas.outlined(&placed(&SQUARE, at, RADIUS), WHITE, stroke),
        2 => canvas.outlined(&placed(&TRIANGLE, at, RADIUS), WHITE, stroke),
        3 => canvas.outlined(&placed(&DIAMOND, at, RADIUS), WHITE, stroke),
        4 => canvas.outlined(&placed(&ON_ITS_TIP, at, RADIUS), WHITE, stroke),
        5 => strokes(canvas, at, RADIUS, &[CROSS, PLUS].concat(), stroke),
        _ => strokes(canvas, at, RADIUS, &CROSS, stroke),
    }
}

/// Fills a cell with the colour and the mark of the `look`-th class.
pub fn class_cell(canvas: &mut Canvas, look: usize, cell: Rect) {
    let look = look % CLASSES.len();
    canvas.rectangle(cell, CLASSES[look], 1.0);
    let size = cell.width().min(cell.height());
    if size < SMALLEST_CELL {
        return;
    }
    let centre = cell.centre();
    let radius = (0.22 * size).min(6.0);
    match look {
        1 => strokes(canvas, centre, radius, &CROSS, Stroke::solid(WHITE, 1.6)),
        2 => strokes(canvas, centre, radius, &CROSS[1..], Stroke::solid(BLACK, 1.2)),
        4 => canvas.area(&placed(&circle(), centre, 0.5 * radius), BLACK, 1.0),
        5 => {
            let ring = placed(&circle(), centre, 0.8 * radius);
            canvas.outlined(&ring, CLASSES[look], Stroke::solid(WHITE, 1.4));
        }
        _ => {}
    }
}
