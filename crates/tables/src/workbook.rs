//! A sheet of an Excel workbook as rows of cells.

use std::io::Cursor;

use calamine::{Data, Reader, Xlsx, XlsxError};

use crate::PREAMBLE;
use crate::error::TableError;
use crate::grid::{Grid, Row};

/// How a workbook begins: it is a ZIP archive.
const MARK: &[u8] = b"PK\x03\x04";

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(MARK)
}

/// The rows of the sheet that is `named`, or of the first that has any; their lines are those of the sheet.
pub fn read(file: &str, bytes: &[u8], named: Option<&str>) -> Result<Grid, TableError> {
    let wrong = |source: XlsxError| TableError::NotTable {
        file: file.to_owned(),
        line: 0,
        source: source.into(),
    };
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(wrong)?;
    let sheets = book.sheet_names();
    let is_wanted = |sheet: &&String| named.is_none_or(|name| *sheet == name);
    if let (Some(name), false) = (named, sheets.iter().any(|sheet| is_wanted(&sheet))) {
        return Err(TableError::Line {
            file: file.to_owned(),
            line: 0,
            found: format!("no sheet \"{name}\""),
            allowed: sheets.join(", "),
        });
    }
    for name in sheets.iter().filter(is_wanted) {
        let rows = rows(&mut book, name).map_err(wrong)?;
        if !rows.is_empty() {
            let sheets = sheets.iter().filter(|other| *other != name).cloned().collect();
            return Ok(Grid {
                rows,
                separator: None,
                sheets,
            });
        }
    }
    Err(TableError::Empty(file.to_owned()))
}

/// The rows with anything in them; near the top a text over several columns stands in each of them.
fn rows(book: &mut Xlsx<Cursor<&[u8]>>, sheet: &str) -> Result<Vec<Row>, XlsxError> {
    let mut merged = book.merge_cells_by_sheet_name(sheet)?;
    let range = book.worksheet_range(sheet)?;
    let (top, left) = range.start().unwrap_or_default();
    merged.retain(|region| region.start.0 < top.saturating_add(PREAMBLE as u32));
    let row = |(line, cells): (u32, &[Data])| {
        let mut cells: Vec<String> = cells.iter().map(text).collect();
        let begun = || merged.iter().filter(|region| region.start.0 == line);
        for region in begun() {
            let place = |column: u32| column.saturating_sub(left) as usize;
            let (first, last) = (place(region.start.1), place(region.end.1));
            let whole = cells.get(first).cloned().unwrap_or_default();
            cells
                .iter_mut()
                .take(last + 1)
                .skip(first)
                .for_each(|cell| cell.clone_from(&whole));
        }
        Row {
            line: u64::from(line) + 1,
            cells,
            merged: begun().next().is_some(),
        }
    };
    Ok((top..).zip(range.rows()).map(row).filter(Row::is_data).collect())
}

fn text(cell: &Data) -> String {
    match cell {
        Data::DateTime(time) => time.as_f64().to_string(),
        // Excel shows #N/A and the like.
        other => other.to_string().trim().to_owned(),
    }
}
