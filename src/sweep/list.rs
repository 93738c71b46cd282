//! A list of ducts: one row a duct, columns named as scene keys.

use std::path::Path;

use creepage_tables::{Name, Names, Options, Row, Table};

use super::error::SweepError;
use super::table::Format;
use crate::scene::Dimension;

/// The column that is carried over: it names a row and is no key of a scene.
pub const ID: &str = "id";
/// Keys whose text is never a number or a distribution.
pub const TEXTS: [&str; 3] = ["title", "name", ID];

const NAMES: Names = Names {
    kinds: &[],
    measured: None,
    // Above its names a table may say of what it is.
    is_header: |names| {
        let is_key = |name: &Name| name.bare == ID || name.text.contains('.') && !name.bare.contains(' ');
        names.iter().any(is_key)
    },
    unnamed: &[],
    unit: |word| {
        Dimension::ALL
            .iter()
            .flat_map(|dimension| dimension.units())
            .find(|unit| *unit == word)
    },
    most: 256 << 20,
    allowed: "columns named as keys of a scene",
};

/// The columns of the table of ducts in `file`, `.csv` or `.xlsx`, read as `options` say, each with a value a row; empty where the row has
/// none. Numbers have a decimal point, and the unit of their column if they have none.
///
/// # Errors
///
/// [`SweepError::Rows`] where there is no such table, [`SweepError::Unfit`] where the name ends otherwise.
pub fn read(file: &Path, options: &Options) -> Result<Vec<(String, Vec<String>)>, SweepError> {
    Format::of(file)?;
    let mut table = Table::from_file(file, options, &NAMES)?;
    let columns = 0..table.names.len();
    let (texts, numbers): (Vec<usize>, Vec<usize>) = columns
        .clone()
        .partition(|&column| TEXTS.contains(&table.names[column].bare.rsplit('.').next().unwrap_or("")));
    table.decide(&numbers)?;
    let value = |row: &Row, column| {
        if texts.contains(&column) {
            row.cell(column).to_owned()
        } else {
            table.written(row, column)
        }
    };
    let values = |column: usize| table.rows.iter().map(|row| value(row, column)).collect();
    Ok(columns
        .map(|column| (table.names[column].bare.clone(), values(column)))
        .collect())
}
