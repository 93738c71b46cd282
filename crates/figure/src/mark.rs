//! Markers of points.

use crate::drawing::{Drawing, Point, Stroke};
use crate::palette::{Colour, WHITE};

/// Half the size of a marker \[px\].
const RADIUS: f64 = 4.0;

/// Outlines and strokes around (0, 0), of about the size 1: square, triangle, diamond, triangle on its tip.
const OUTLINES: [&[Point]; 4] = [
    &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
    &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
    &[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)],
    &[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)],
];
const CROSS: [[Point; 2]; 2] = [[(-0.9, -0.9), (0.9, 0.9)], [(-0.9, 0.9), (0.9, -0.9)]];
const PLUS: [[Point; 2]; 2] = [[(-1.2, 0.0), (1.2, 0.0)], [(0.0, -1.2), (0.0, 1.2)]];

/// A shape of size 1, scaled and moved.
fn placed(shape: &[Point], at: Point, size: f64) -> Vec<Point> {
    let point = |(x, y): &Point| (at.0 + size * x, at.1 + size * y);
    shape.iter().map(point).collect()
}

fn strokes(drawing: &mut Drawing, at: Point, size: f64, lines: &[[Point; 2]], stroke: Stroke) {
    for line in lines {
        drawing.stroke(&placed(line, at, size), stroke);
    }
}

/// Draws the marker of the `index`-th series: circle, square, triangle, diamond, triangle on its tip, star, cross.
pub fn marker(drawing: &mut Drawing, index: usize, at: Point, colour: Colour) {
    let stroke = Stroke::solid(colour, 1.7);
    match index % 7 {
        0 => drawing.circle(at, RADIUS, WHITE, stroke),
        k @ 1..=4 => drawing.outlined(&placed(OUTLINES[k - 1], at, RADIUS), WHITE, stroke),
        5 => strokes(drawing, at, RADIUS, &[CROSS, PLUS].concat(), stroke),
        _ => strokes(drawing, at, RADIUS, &CROSS, stroke),
    }
}
