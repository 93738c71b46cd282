//! The table as an Excel workbook, and lists of ducts from one.

use std::io::{self, Write};

use rust_xlsxwriter::XlsxError;

use super::sink::{self, Column, Sink};
use crate::SceneFile;
use crate::output::Draft;
use crate::scene::Unit;
use crate::workbook::{self, Book, Cell};

/// Rows of a sheet below the names and the units of its columns.
pub const MOST_ROWS: usize = 1_048_574;

pub struct Xlsx {
    file: Draft,
    book: Book,
    /// The units in which columns are shown.
    units: Vec<Option<Unit>>,
    scene: SceneFile,
}

impl Xlsx {
    pub fn new(file: Draft, columns: &[Column], scene: &SceneFile) -> io::Result<Self> {
        let title = scene.scene().map_or(String::new(), |scene| scene.title);
        let mut book = Book::new(&title).map_err(other)?;
        let head = |column: &'_ Column| -> (String, &'static str) {
            match &column.shown {
                Some((name, unit)) => (name.clone(), unit.symbol()),
                None => (column.name.clone(), column.unit.unwrap_or_default()),
            }
        };
        let heads: Vec<(String, &str)> = columns.iter().map(head).collect();
        let heads: Vec<(&str, &str)> = heads.iter().map(|(name, unit)| (&**name, *unit)).collect();
        book.sheet("sweep", &heads).map_err(other)?;
        let unit = |column: &Column| column.shown.as_ref().map(|(_, unit)| *unit);
        Ok(Self {
            file,
            book,
            units: columns.iter().map(unit).collect(),
            scene: scene.clone(),
        })
    }
}

impl Sink for Xlsx {
    fn row(&mut self, cells: Vec<sink::Cell>) -> io::Result<()> {
        let cells = cells.into_iter().zip(&self.units).map(|(cell, unit)| match cell {
            sink::Cell::Absent => Cell::Absent,
            sink::Cell::Number(si) => Cell::Number(unit.map_or(si, |unit| unit.of_si(si))),
            sink::Cell::Count(count) => Cell::Number(count as f64),
            sink::Cell::Text(text) => Cell::Text(text),
        });
        self.book.row(cells, false).map_err(other)
    }

    fn finish(mut self: Box<Self>) -> io::Result<Draft> {
        workbook::scene(&mut self.book, &self.scene).map_err(other)?;
        let bytes = self.book.finish().map_err(other)?;
        self.file.write_all(&bytes)?;
        Ok(self.file)
    }
}

fn other(error: XlsxError) -> io::Error {
    io::Error::other(error)
}
