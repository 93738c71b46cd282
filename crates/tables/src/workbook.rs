//! A sheet of an Excel workbook as rows of cells.

use std::io::Cursor;

use calamine::{Data, Reader, Xlsx, XlsxError};

use crate::PREAMBLE;
use crate::error::{Result, TableError};
use crate::rows::Row;

/// How a workbook begins: it is a ZIP archive.
pub const MARK: &[u8] = b"PK\x03\x04";

/// The rows of the sheet that is `named`, or of the first that has any, and the other sheets.
pub fn read(file: &str, bytes: &[u8], named: Option<&str>) -> Result<(Vec<Row>, Vec<String>)> {
    let wrong = |source: XlsxError| TableError::Unreadable(file.to_owned(), source.into());
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(wrong)?;
    let mut sheets = book.sheet_names();
    if let Some(name) = named.filter(|name| !sheets.iter().any(|sheet| sheet == name)) {
        let found = format!("no sheet \"{name}\"");
        return Err(TableError::line(file, 0, found, sheets.join(", ")));
    }
    for place in 0..sheets.len() {
        if named.is_some_and(|name| sheets[place] != name) {
            continue;
        }
        let rows = rows(&mut book, &sheets[place]).map_err(wrong)?;
        if !rows.is_empty() {
            sheets.remove(place);
            return Ok((rows, sheets));
        }
    }
    Ok((Vec::new(), sheets))
}

/// The rows of data; near the top a text over several columns stands in each of them.
fn rows(book: &mut Xlsx<Cursor<&[u8]>>, sheet: &str) -> std::result::Result<Vec<Row>, XlsxError> {
    let merged = book.merge_cells_by_sheet_name(sheet)?;
    let range = book.worksheet_range(sheet)?;
    let (top, left) = range.start().unwrap_or_default();
    // Excel shows numbers of days for dates, and #N/A and the like.
    let text = |cell: &Data| cell.to_string().trim().to_owned();
    let row = |(line, cells): (u32, &[Data])| Row {
        line: u64::from(line) + 1,
        cells: cells.iter().map(text).collect(),
        is_merged: false,
    };
    let mut rows: Vec<Row> = (top..).zip(range.rows()).map(row).collect();
    for region in merged {
        let [first, last] = [region.start.1, region.end.1].map(|column| column.saturating_sub(left) as usize);
        let place = region.start.0.checked_sub(top).map(|place| place as usize);
        if let Some(row) = rows.iter_mut().take(PREAMBLE).nth(place.unwrap_or(PREAMBLE)) {
            let whole = row.cell(first).to_owned();
            let cells = row.cells.iter_mut().take(last + 1).skip(first);
            cells.for_each(|cell| cell.clone_from(&whole));
            row.is_merged = true;
        }
    }
    rows.retain(Row::is_data);
    Ok(rows)
}
