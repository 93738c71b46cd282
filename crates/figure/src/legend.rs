//! Words around a plot: its title, over one or more lines, and the legend, rows of names below.

use crate::drawing::{Anchor, Drawing, Point, Rect, TEXT, TITLE, check_room};
use crate::error::FigureError;
use crate::palette::class_colour;
use crate::series::Series;

const ROW: f64 = 23.0;
const SAMPLE: f64 = 38.0;
const GAP: f64 = 7.0;
const BETWEEN: f64 = 20.0;
const PADDING: f64 = 8.0;

const TITLE_LINE: f64 = 22.0;
const TITLE_PADDING: f64 = 10.0;

/// What an entry shows with its name.
enum Sample<'a> {
    Series(&'a Series),
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
    pub fn new(classes: &'a [String], series: &'a [Series], width: f64) -> Result<Self, FigureError> {
        let classes = (0..).map(Sample::Class).zip(classes);
        let series = series.iter().map(|s| (Sample::Series(s), &s.name));
        let named = classes.chain(series).filter(|(_, name)| !name.is_empty());
        let (mut x, mut row) = (0.0, 0.0);
        let mut entries = Vec::new();
        for (sample, name) in named {
            let needed = SAMPLE + GAP + Drawing::text_width(name);
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

    pub fn draw(&self, drawing: &mut Drawing, (left, top): Point) {
        for (sample, name, (x, y)) in &self.entries {
            let (x, y) = (left + x, top + y);
            match sample {
                Sample::Series(series) => series.draw_sample(drawing, (x, y), SAMPLE),
                Sample::Class(index) => {
                    let cell = Rect::around((x + 0.5 * SAMPLE, y), 11.0, 8.0);
                    drawing.rectangle(cell, class_colour(*index), 1.0);
                }
            }
            drawing.text(name, (x + SAMPLE + GAP, y), Anchor::Start);
        }
    }
}

/// Draws a title, broken into lines of at most `width` \[px\], at the `top` of what begins at `left`, and gives its height \[px\]:
/// nothing for an empty one.
///
/// # Errors
///
/// [`FigureError::NoRoom`] for a word wider than `width`.
pub fn title(text: &str, drawing: &mut Drawing, (left, top): Point, width: f64) -> Result<f64, FigureError> {
    let room = width - 2.0 * TITLE_PADDING;
    let wide = |text: &str| TITLE / TEXT * Drawing::text_width(text);
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        check_room(word, wide(word), room)?;
        match lines.last_mut() {
            Some(line) if wide(&format!("{line} {word}")) <= room => *line = format!("{line} {word}"),
            _ => lines.push(word.into()),
        }
    }
    let mut y = top + TITLE_PADDING;
    for line in &lines {
        drawing.title(line, (left + 0.5 * width, y + 0.5 * TITLE_LINE));
        y += TITLE_LINE;
    }
    Ok(if lines.is_empty() { 0.0 } else { y - top })
}
