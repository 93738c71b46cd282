//! A list of ducts: one row a duct, columns named as scene keys.

use std::fs::File;
use std::path::Path;

use super::error::SweepError;
use super::sink::Cells;
use super::table::Format;

/// The column that is carried over: it names a row and is no key of a scene.
pub const ID: &str = "id";

/// The columns of the table in `file`, `.csv`, `.parquet` or `.xlsx`, each with a value a row; empty where the row has none.
pub fn read(file: &Path) -> Result<Vec<(String, Vec<String>)>, SweepError> {
    let name = file.display().to_string();
    let unreadable = |source| SweepError::Rows(name.clone(), source);
    let (keys, rows) = match Format::of(file)? {
        Format::Csv => csv(file),
        #[cfg(feature = "parquet")]
        Format::Parquet => super::parquet::read(file),
        #[cfg(feature = "xlsx")]
        Format::Xlsx => super::xlsx::read(file),
    }
    .map_err(unreadable)?;
    let column = |(index, key): (usize, String)| {
        let values = rows.iter().map(|row| row[index].clone()).collect();
        (key, values)
    };
    Ok(keys.into_iter().enumerate().map(column).collect())
}

fn csv(file: &Path) -> std::io::Result<Cells> {
    let text = std::io::read_to_string(File::open(file)?)?;
    let text = text.trim_start_matches('\u{feff}');
    let head = text
        .lines()
        .find(|line| !line.starts_with('#'))
        .unwrap_or_default();
    // Spreadsheets of countries with a decimal comma write semicolons.
    let separator = [b';', b'\t']
        .into_iter()
        .find(|&mark| head.as_bytes().contains(&mark));
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator.unwrap_or(b','))
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<String>>();
    let keys = cells(reader.headers()?);
    let rows = reader
        .records()
        .map(|record| Ok(cells(&record?)))
        .collect::<Result<_, csv::Error>>()?;
    Ok((keys, rows))
}
