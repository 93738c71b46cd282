//! A title over one or more lines.

use super::canvas::{Canvas, Point, check_room, text_width};
use crate::error::FigureError;

const SIZE: f64 = 16.0;
const LINE: f64 = 22.0;
const PADDING: f64 = 10.0;

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
        let room = width - 2.0 * PADDING;
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            check_room(word, text_width(word, SIZE), room)?;
            match lines.last_mut() {
                Some(line) if text_width(&format!("{line} {word}"), SIZE) <= room => {
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
        let height = LINE * self.lines.len() as f64 + PADDING;
        if self.lines.is_empty() { 0.0 } else { height }
    }

    pub fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        for (k, line) in self.lines.iter().enumerate() {
            let y = top + PADDING + LINE * (k as f64 + 0.5);
            canvas.bold(line, (left + 0.5 * self.width, y), SIZE);
        }
    }
}
