//! The table as an Excel workbook, and lists of ducts from one.

use std::io::{self, Write};
use std::path::Path;

use calamine::{Data, Reader};
use rust_xlsxwriter::XlsxError;

use super::sink::{self, Cells, Column, Sink};
use crate::SceneFile;
use crate::output::Draft;
use crate::scene::{Dimension, Unit};
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

/// The columns of the first sheet and its rows, each cell as it would be typed. A second row that holds nothing but units gives them to
/// the numbers below.
pub fn read(file: &Path) -> io::Result<Cells> {
    let wrong = |error: calamine::XlsxError| io::Error::other(error);
    let mut book: calamine::Xlsx<_> = calamine::open_workbook(file).map_err(wrong)?;
    let sheet = book
        .worksheet_range_at(0)
        .ok_or_else(|| io::Error::other("no sheet"))?
        .map_err(wrong)?;
    let mut rows = sheet.rows().map(|row| row.iter().map(typed).collect::<Vec<_>>());
    let keys: Vec<String> = rows.next().unwrap_or_default();
    let mut rows: Vec<Vec<String>> = rows
        .filter(|row| row.iter().any(|cell| !cell.is_empty()))
        .collect();
    let are_units = |row: &Vec<String>| row.iter().all(|cell| cell.is_empty() || is_unit(cell));
    if rows.first().is_some_and(are_units) {
        let units = rows.remove(0);
        for (cell, unit) in rows.iter_mut().flat_map(|row| row.iter_mut().zip(&units)) {
            if cell.parse::<f64>().is_ok() && !unit.is_empty() {
                *cell = format!("{cell} {unit}");
            }
        }
    }
    Ok((keys, rows))
}

fn is_unit(text: &str) -> bool {
    Dimension::ALL
        .iter()
        .any(|dimension| Unit::of(*dimension, text).is_some())
}

fn typed(cell: &Data) -> String {
    match cell {
        Data::DateTime(time) => time.as_f64().to_string(),
        // Excel shows #N/A and the like.
        other => other.to_string().trim().to_owned(),
    }
}
