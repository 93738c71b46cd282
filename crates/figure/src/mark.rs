//! Markers of points.

use crate::drawing::{Drawing, Point, Stroke};
use crate::palette::{Colour, WHITE};

/// Half the size of a marker \[px\].
const RADIUS: f64 = 4.0;

/// Outlines around (0, 0), of about the size 1: square, triangle, diamond, triangle on its tip.
const OUTLINES: [&[Point]; 4] = [
    &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
    &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
    &[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)],
    &[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)],
];

/// Draws the marker of the `index`-th series: circle, square, triangle, diamond, triangle on its tip.
pub fn marker(drawing: &mut Drawing, index: usize, at: Point, colour: Colour) {
    let stroke = Stroke::solid(colour, 1.7);
    let placed = |(x, y): &Point| (at.0 + RADIUS * x, at.1 + RADIUS * y);
    match index % (1 + OUTLINES.len()) {
        0 => drawing.circle(at, RADIUS, WHITE, stroke),
        k => {
            let outline: Vec<Point> = OUTLINES[k - 1].iter().map(placed).collect();
            drawing.outlined(&outline, WHITE, stroke);
        }
    }
}
