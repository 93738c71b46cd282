//! A list of ducts: one row a duct, columns named as scene keys.

use std::path::Path;

use creepage_tables::{Layout, Name, Options, Row, Table};

use super::distribution::{ID, TEXTS};
use super::error::SweepError;
use super::grid::{Columns, Sweep};
use super::samples::Samples;
use super::table;
use creepage_scene::{Dimension, SceneFile};

type Result<T> = std::result::Result<T, SweepError>;

const LAYOUT: Layout = Layout {
    kinds: &[],
    measured: None,
    // Above its names a table may say of what it is.
    missing: |names| {
        let is_key = |name: &Name| {
            let is_word = name.text.starts_with(char::is_alphabetic) && !name.bare.contains(' ');
            name.bare == ID || is_word && name.text.contains('.')
        };
        (!names.iter().any(is_key)).then_some("named as a key")
    },
    is_number: |name| !TEXTS.contains(&name.bare.rsplit('.').next().unwrap_or("")),
    unnamed: &[],
    unit: |word| {
        let units = Dimension::ALL.iter().flat_map(|dimension| dimension.units());
        units.into_iter().find(|unit| *unit == word)
    },
    si: |_, _, _| Err("text".into()),
    most: 256 << 20,
    allowed: "columns named as keys of a scene, such as `duct.length [m]`, and `id`",
};

impl Sweep {
    /// The ducts of a table, `.csv` or `.xlsx`, read as `options` say, as [`Sweep::of_table`] takes
    /// them.
    ///
    /// # Errors
    ///
    /// As for [`read`] and [`Sweep::of_table`].
    pub fn of_rows(file: SceneFile, table: &Path, options: &Options, samples: Samples) -> Result<Self> {
        table::ending(table)?;
        let table = Table::from_file(table, options, &LAYOUT)?;
        let sweep = Self::of_table(file, columns(&table)?, samples);
        sweep.map_err(|error| error.in_table(&table.file, table.line))
    }
}

/// The columns of the table of ducts in `file`, `.csv` or `.xlsx`, read as `options` say, each with
/// a value a row; empty if the row has none. Numbers have a decimal point, and the unit of their
/// column if they have none.
///
/// # Errors
///
/// [`SweepError::Rows`] if there is no such table, [`SweepError::Invalid`] if the name ends
/// otherwise.
pub fn read(file: &Path, options: &Options) -> Result<Columns> {
    table::ending(file)?;
    columns(&Table::from_file(file, options, &LAYOUT)?)
}

fn columns(table: &Table) -> Result<Columns> {
    let value = |row: &Row, column: usize| -> Result<String> {
        let is_number = (LAYOUT.is_number)(&table.names[column]);
        let number = is_number.then(|| table.quantity(row, column, column));
        Ok(match number.transpose()?.flatten() {
            Some((digits, unit)) => format!("{digits} {unit}").trim_end().to_owned(),
            None => row.cell(column).to_owned(),
        })
    };
    let named = |(column, name): (usize, &Name)| {
        let values = table.rows.iter().map(|row| value(row, column));
        Ok((name.bare.clone(), values.collect::<Result<_>>()?))
    };
    table.names.iter().enumerate().map(named).collect()
}
