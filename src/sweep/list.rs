//! A list of ducts: one row a duct, columns named as scene keys.

use std::path::Path;

use creepage_tables::{Name, Names, Options, Table};

use super::error::SweepError;
use super::table::Format;
use crate::scene::Dimension;

/// The column that is carried over: it names a row and is no key of a scene.
pub const ID: &str = "id";
/// Keys whose text is never a number or a distribution.
pub const NAMES: [&str; 3] = ["title", "name", ID];
/// Largest list \[bytes\].
const LARGEST_FILE: u64 = 256 << 20;

/// The columns of the table of ducts in `file`, `.csv` or `.xlsx`, read as `options` say, each with a value a row; empty where the row has
/// none. Numbers have a decimal point, and the unit of their column if they have none.
///
/// # Errors
///
/// [`SweepError::Rows`] where there is no such table, [`SweepError::Unfit`] where the name ends otherwise.
pub fn read(file: &Path, options: &Options) -> Result<Vec<(String, Vec<String>)>, SweepError> {
    Format::of(file)?;
    // Above its names a table may say of what it is.
    let is_key = |name: &Name| name.bare == ID || name.text.contains('.') && !name.bare.contains(' ');
    let is_header = |names: &[Name]| names.iter().any(is_key);
    let names = Names {
        is_header: &is_header,
        unit: |word| {
            Dimension::ALL
                .iter()
                .find_map(|dimension| dimension.units().find(|unit| *unit == word))
        },
    };
    let mut table = Table::from_file(file, LARGEST_FILE, options, &names)?;
    let is_text = |name: &Name| {
        NAMES
            .iter()
            .any(|text| name.bare.rsplit('.').next() == Some(text))
    };
    let numbers: Vec<usize> = (0..table.names.len())
        .filter(|&column| !is_text(&table.names[column]))
        .collect();
    table.decide(&numbers)?;
    let column = |(index, name): (usize, &Name)| {
        let value = |row| table.written(row, index);
        let text = |row: &creepage_tables::Row| row.cell(index).to_owned();
        let rows = table.rows.iter();
        (
            name.bare.clone(),
            if is_text(name) {
                rows.map(text).collect()
            } else {
                rows.map(value).collect()
            },
        )
    };
    Ok(table.names.iter().enumerate().map(column).collect())
}
