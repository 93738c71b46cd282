//! As much of a plot as the examples need: axes, curves, bands, as SVG.
#![allow(dead_code, reason = "every example uses its own part")]

use std::fmt::Write;

pub const WIDTH: f64 = 760.0;
pub const HEIGHT: f64 = 480.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 24.0;
const BOTTOM: f64 = 62.0;

/// One axis: its range, its ticks with labels, and its title.
pub struct Axis {
    pub from: f64,
    pub to: f64,
    pub logarithmic: bool,
    pub ticks: Vec<(f64, String)>,
    pub title: &'static str,
}

impl Axis {
    fn share(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value / self.from).ln() / (self.to / self.from).ln()
        } else {
            (value - self.from) / (self.to - self.from)
        }
    }
}

pub struct Plot {
    x: Axis,
    y: Axis,
    body: String,
}

impl Plot {
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            body: String::new(),
        }
    }

    pub fn place(&self, x: f64, y: f64) -> (f64, f64) {
        (
            LEFT + self.x.share(x) * (WIDTH - LEFT - RIGHT),
            HEIGHT - BOTTOM - self.y.share(y) * (HEIGHT - TOP - BOTTOM),
        )
    }

    pub fn band(&mut self, from: f64, to: f64, colour: &str) {
        let ((left, bottom), (right, top)) = (self.place(from, self.y.from), self.place(to, self.y.to));
        let _ = writeln!(
            self.body,
            r#"<rect x="{left:.1}" y="{top:.1}" width="{:.1}" height="{:.1}" fill="{colour}"/>"#,
            right - left,
            bottom - top
        );
    }

    pub fn curve(&mut self, points: &[(f64, f64)], colour: &str, dash: &str) {
        let path: Vec<String> = points
            .iter()
            .map(|&(x, y)| self.place(x, y))
            .map(|(x, y)| format!("{x:.1},{y:.1}"))
            .collect();
        let _ = writeln!(
            self.body,
            r#"<polyline points="{}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>"#,
            path.join(" ")
        );
    }

    pub fn dots(&mut self, points: &[(f64, f64)], colour: &str) {
        for &(x, y) in points {
            let (x, y) = self.place(x, y);
            let _ = writeln!(
                self.body,
                r#"<circle cx="{x:.1}" cy="{y:.1}" r="3.5" fill="white" stroke="{colour}" stroke-width="1.6"/>"#
            );
        }
    }

    pub fn text(&mut self, x: f64, y: f64, anchor: &str, colour: &str, text: &str) {
        let (x, y) = self.place(x, y);
        let _ = writeln!(
            self.body,
            r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" fill="{colour}">{text}</text>"#
        );
    }

    pub fn svg(&self) -> String {
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n"
        );
        let (left, right, top, bottom) = (LEFT, WIDTH - RIGHT, TOP, HEIGHT - BOTTOM);
        svg += &self.body;
        for (value, label) in &self.x.ticks {
            let (x, _) = self.place(*value, self.y.from);
            let _ = writeln!(
                svg,
                r##"<path d="M{x:.1},{bottom} v5" stroke="#333"/><text x="{x:.1}" y="{}" text-anchor="middle">{label}</text>"##,
                bottom + 20.0
            );
        }
        for (value, label) in &self.y.ticks {
            let (_, y) = self.place(self.x.from, *value);
            let _ = writeln!(
                svg,
                r##"<path d="M{left},{y:.1} h-5" stroke="#333"/><text x="{}" y="{:.1}" text-anchor="end">{label}</text>"##,
                left - 9.0,
                y + 4.5
            );
        }
        let (middle, half) = (0.5 * (left + right), 0.5 * (top + bottom));
        let _ = writeln!(
            svg,
            r##"<rect x="{left}" y="{top}" width="{}" height="{}" fill="none" stroke="#333"/>
<text x="{middle}" y="{}" text-anchor="middle">{}</text>
<text transform="translate(18 {half}) rotate(-90)" text-anchor="middle">{}</text>
</svg>"##,
            right - left,
            bottom - top,
            HEIGHT - 14.0,
            self.x.title,
            self.y.title
        );
        svg
    }
}
