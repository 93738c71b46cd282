//! The legend: rows of names below the plot.

use crate::figure::FigureError;
use crate::figure::palette::{DASHES, PALETTE};
use crate::figure::series::{Kind, Series};

use super::canvas::{Anchor, Canvas, Rect, TEXT, stroke, text_style, text_width};
use super::mark;
use super::series::{LINE_WIDTH, SHADE};

const ROW: f64 = 23.0;
const SAMPLE: f64 = 38.0;
const GAP: f64 = 7.0;
const BETWEEN: f64 = 20.0;
const PADDING: f64 = 8.0;

/// What an entry shows beside its name.
#[derive(Debug, Clone)]
enum Sample {
    Series(Box<Series>),
    Class(usize),
}

/// Entries, laid out in rows.
pub struct Legend {
    /// Sample, name, and place from the legend's left and top \[px\].
    entries: Vec<(Sample, String, (f64, f64))>,
    rows: usize,
}

impl Legend {
    /// Names of `series` (with their looks) and of classes by look, in rows of at most `width` \[px\].
    ///
    /// # Errors
    ///
    /// [`FigureError::NoRoom`] for a name wider than that.
    pub fn new(series: &[Series], classes: &[(String, usize)], width: f64) -> Result<Self, FigureError> {
        let classes = classes
            .iter()
            .map(|(name, look)| (Sample::Class(*look), name.clone()));
        let series = series
            .iter()
            .filter(|series| !series.name.is_empty())
            .map(|series| (Sample::Series(Box::new(series.clone())), series.name.clone()));
        let (mut x, mut row) = (0.0, 0);
        let mut entries = Vec::new();
        for (sample, name) in classes.chain(series) {
            let needed = SAMPLE + GAP + text_width(&name, TEXT);
            if needed > width {
                return Err(FigureError::NoRoom {
                    text: name,
                    needed,
                    room: width,
                });
            }
            if x > 0.0 && x + needed > width {
                (x, row) = (0.0, row + 1);
            }
            entries.push((sample, name, (x, PADDING + ROW * (f64::from(row) + 0.5))));
            x += needed + BETWEEN;
        }
        Ok(Self {
            rows: if entries.is_empty() { 0 } else { row as usize + 1 },
            entries,
        })
    }

    /// Height of all rows \[px\].
    pub fn height(&self) -> f64 {
        if self.rows == 0 {
            0.0
        } else {
            ROW * self.rows as f64 + 2.0 * PADDING
        }
    }

    pub fn draw(&self, canvas: &Canvas<'_>, left: f64, top: f64) -> Result<(), FigureError> {
        for (sample, name, (x, y)) in &self.entries {
            let (x, y) = (left + x, top + y);
            match sample {
                Sample::Series(series) => draw_sample(canvas, series, x, y)?,
                Sample::Class(look) => {
                    let cell = Rect {
                        left: x + 0.5 * (SAMPLE - 22.0),
                        right: x + 0.5 * (SAMPLE + 22.0),
                        top: y - 8.0,
                        bottom: y + 8.0,
                    };
                    mark::class_cell(canvas, *look, cell)?;
                }
            }
            canvas.text(
                name,
                (x + SAMPLE + GAP, y),
                Anchor::Start,
                &text_style(TEXT, false),
            )?;
        }
        Ok(())
    }
}

fn draw_sample(canvas: &Canvas<'_>, series: &Series, x: f64, y: f64) -> Result<(), FigureError> {
    let colour = PALETTE[series.colour.unwrap_or(0)];
    let dash = DASHES[series.dash.unwrap_or(0)];
    if series.kind == Kind::Area {
        let ground = Rect {
            left: x,
            right: x + SAMPLE,
            top: y,
            bottom: y + 8.0,
        };
        canvas.rectangle(ground, colour, SHADE)?;
    }
    if series.kind != Kind::Points {
        canvas.dashed(&[(x, y), (x + SAMPLE, y)], stroke(colour, LINE_WIDTH), dash)?;
    }
    if matches!(series.kind, Kind::Points | Kind::LinePoints) {
        mark::marker(canvas, series.marker.unwrap_or(0), (x + 0.5 * SAMPLE, y), colour)?;
    }
    Ok(())
}
