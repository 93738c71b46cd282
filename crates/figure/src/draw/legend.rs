//! Words around a plot: its title, over one or more lines, and the legend, rows of names below.

use super::canvas::{Canvas, Point, Rect, TEXT, check_room, text_width};
use super::mark;
use super::series::Shown;
use crate::error::FigureError;

const ROW: f64 = 23.0;
const SAMPLE: f64 = 38.0;
const GAP: f64 = 7.0;
const BETWEEN: f64 = 20.0;
const PADDING: f64 = 8.0;

const TITLE: f64 = 16.0;
const TITLE_LINE: f64 = 22.0;
const TITLE_PADDING: f64 = 10.0;

/// What an entry shows beside its name.
enum Sample<'a> {
    Series(&'a Shown<'a>),
    /// A class by its index.
    Class(usize),
}

/// Entries, laid out in rows.
pub struct Legend<'a> {
    /// Sample, name, and place from the legend's left and top \[px\].
    entries: Vec<(Sample<'a>, &'a String, Point)>,
    /// Height of all rows \[px\].
    pub height: f64,
}

impl<'a> Legend<'a> {
    /// Names of classes and of series, in rows of at most `width` \[px\].
    ///
    /// # Errors
    ///
    /// [`FigureError::NoRoom`] for a name wider than that.
    pub fn new(classes: &'a [String], series: &'a [Shown<'a>], width: f64) -> Result<Self, FigureError> {
        let classes = (0..).map(Sample::Class).zip(classes);
        let series = series.iter().map(|s| (Sample::Series(s), &s.series.name));
        let named = classes.chain(series).filter(|(_, name)| !name.is_empty());
        let (mut x, mut row) = (0.0, 0.0);
        let mut entries = Vec::new();
        for (sample, name) in named {
            let needed = SAMPLE + GAP + text_width(name, TEXT);
            check_room(name, needed, width)?;
            if x > 0.0 && x + needed > width {
                (x, row) = (0.0, row + 1.0);
            }
            entries.push((sample, name, (x, PADDING + ROW * (row + 0.5))));
            x += needed + BETWEEN;
        }
        let height = ROW * (row + 1.0) + 2.0 * PADDING;
        let height = if entries.is_empty() { 0.0 } else { height };
        Ok(Self { entries, height })
    }

    pub fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        for (sample, name, (x, y)) in &self.entries {
            let (x, y) = (left + x, top + y);
            match sample {
                Sample::Series(shown) => shown.draw_sample(canvas, (x, y), SAMPLE),
                Sample::Class(index) => {
                    let cell = Rect::around((x + 0.5 * SAMPLE, y), 11.0, 8.0);
                    mark::class_cell(canvas, *index, cell);
                }
            }
            canvas.text(name, (x + SAMPLE + GAP, y), "start");
        }
    }
}

/// A title broken into lines that fit.
pub struct Heading {
    lines: Vec<String>,
    width: f64,
}

impl Heading {
    /// # Errors
    ///
    /// [`FigureError::NoRoom`] for a word wider than `width` \[px\].
    pub fn new(text: &str, width: f64) -> Result<Self, FigureError> {
        let room = width - 2.0 * TITLE_PADDING;
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            check_room(word, text_width(word, TITLE), room)?;
            match lines.last_mut() {
                Some(line) if text_width(&format!("{line} {word}"), TITLE) <= room => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.into()),
            }
        }
        Ok(Self { lines, width })
    }

    /// Height of its lines \[px\], nothing for an empty title.
    pub fn height(&self) -> f64 {
        let height = TITLE_LINE * self.lines.len() as f64 + TITLE_PADDING;
        if self.lines.is_empty() { 0.0 } else { height }
    }

    pub fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        for (k, line) in self.lines.iter().enumerate() {
            let y = top + TITLE_PADDING + TITLE_LINE * (k as f64 + 0.5);
            canvas.bold(line, (left + 0.5 * self.width, y), TITLE);
        }
    }
}
