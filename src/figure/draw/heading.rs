//! A title over one or more lines.

use crate::figure::FigureError;

use super::canvas::{Anchor, Canvas, text_style, text_width};

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
            let needed = text_width(word, SIZE);
            if needed > room {
                return Err(FigureError::NoRoom {
                    text: word.into(),
                    needed,
                    room,
                });
            }
            match lines.last_mut() {
                Some(line) if text_width(line, SIZE) + text_width(" ", SIZE) + needed <= room => {
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
        if self.lines.is_empty() {
            0.0
        } else {
            LINE * self.lines.len() as f64 + PADDING
        }
    }

    pub fn draw(&self, canvas: &Canvas<'_>, left: f64, top: f64) -> Result<(), FigureError> {
        let style = text_style(SIZE, true);
        for (k, line) in self.lines.iter().enumerate() {
            let at = (left + 0.5 * self.width, top + PADDING + LINE * (k as f64 + 0.5));
            canvas.text(line, at, Anchor::Middle, &style)?;
        }
        Ok(())
    }
}
