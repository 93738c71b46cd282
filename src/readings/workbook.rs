//! The first sheet of an Excel workbook as rows of cells.

use std::io::Cursor;

use calamine::{Data, Reader, Xlsx};

use super::error::DataError;
use super::grid::{Grid, Row};

/// How a workbook begins: it is a ZIP archive.
const MARK: &[u8] = b"PK\x03\x04";

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(MARK)
}

/// The rows of the first sheet that has any; their lines are those of the sheet.
pub fn read(file: &str, bytes: &[u8]) -> Result<Grid, DataError> {
    let wrong = |source: calamine::XlsxError| DataError::Table {
        file: file.to_owned(),
        line: 0,
        source: source.into(),
    };
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(wrong)?;
    for name in book.sheet_names() {
        let sheet = book.worksheet_range(&name).map_err(wrong)?;
        let first = u64::from(sheet.start().map_or(0, |(row, _)| row));
        let rows: Vec<Row> = (first + 1..)
            .zip(sheet.rows())
            .map(|(line, cells)| Row {
                line,
                cells: cells.iter().map(text).collect(),
            })
            .filter(|row| !row.cells.iter().all(String::is_empty) && !row.cell(0).starts_with('#'))
            .collect();
        if !rows.is_empty() {
            let separator = None;
            return Ok(Grid { rows, separator });
        }
    }
    Err(DataError::Empty(file.to_owned()))
}

fn text(cell: &Data) -> String {
    match cell {
        Data::DateTime(time) => time.as_f64().to_string(),
        // Excel shows #N/A and the like.
        other => other.to_string().trim().to_owned(),
    }
}
