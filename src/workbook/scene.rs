//! The scene as a sheet.

use rust_xlsxwriter::XlsxError;

use super::sheet::{Book, Cell};
use crate::SceneFile;

/// Adds a sheet with every key of the scene as it was typed.
pub fn scene(book: &mut Book, file: &SceneFile) -> Result<(), XlsxError> {
    book.sheet("scene", &[("key", ""), ("value", ""), ("from", "")])?;
    book.widths(&[40.0, 30.0, 40.0])?;
    for typed in file.typed() {
        let value = typed.text.parse().map_or(Cell::Text(typed.text), Cell::Number);
        book.row([Cell::Text(typed.key), value, Cell::Text(typed.source)], false)?;
    }
    Ok(())
}
