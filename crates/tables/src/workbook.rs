//! A sheet of an Excel workbook as rows of cells.

use std::io::Cursor;

use calamine::{Data, Reader, Xlsx};

use crate::error::TableError;
use crate::grid::{Grid, Row};

/// How a workbook begins: it is a ZIP archive.
const MARK: &[u8] = b"PK\x03\x04";

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(MARK)
}

/// The rows of the sheet that is `named`, or of the first that has any; their lines are those of the sheet.
pub fn read(file: &str, bytes: &[u8], named: Option<&str>) -> Result<Grid, TableError> {
    let wrong = |source: calamine::XlsxError| TableError::NotTable {
        file: file.to_owned(),
        line: 0,
        source: source.into(),
    };
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(wrong)?;
    let sheets = book.sheet_names();
    if let Some(name) = named.filter(|name| !sheets.iter().any(|sheet| sheet == name)) {
        return Err(TableError::Line {
            file: file.to_owned(),
            line: 0,
            found: format!("no sheet \"{name}\""),
            allowed: sheets.join(", ").into(),
        });
    }
    for name in sheets
        .iter()
        .filter(|sheet| named.is_none_or(|name| *sheet == name))
    {
        let sheet = book.worksheet_range(name).map_err(wrong)?;
        let first = u64::from(sheet.start().map_or(0, |(row, _)| row));
        let rows = (first + 1..).zip(sheet.rows()).map(|(line, cells)| Row {
            line,
            cells: cells.iter().map(text).collect(),
        });
        let rows: Vec<Row> = rows.filter(Row::is_data).collect();
        if !rows.is_empty() {
            let others = sheets.iter().filter(|other| *other != name).cloned();
            return Ok(Grid {
                rows,
                separator: None,
                sheets: others.collect(),
            });
        }
    }
    Err(TableError::Empty(file.to_owned()))
}

fn text(cell: &Data) -> String {
    match cell {
        Data::DateTime(time) => time.as_f64().to_string(),
        // Excel shows #N/A and the like.
        other => other.to_string().trim().to_owned(),
    }
}
