//! A list of ducts: one row a duct, columns named as scene keys.

use std::fs::File;
use std::io::{Error, ErrorKind};
use std::path::Path;

use super::error::SweepError;
use super::sink::Cells;
use super::table::Format;

/// The column that is carried over: it names a row and is no key of a scene.
pub const ID: &str = "id";

/// The columns of the table of ducts in `file`, `.csv` or `.xlsx`, each with a value a row; empty where the
/// row has none.
///
/// # Errors
///
/// [`SweepError::Rows`] where there is no such table, [`SweepError::Unfit`] where the name ends otherwise.
pub fn read(file: &Path) -> Result<Vec<(String, Vec<String>)>, SweepError> {
    let name = file.display().to_string();
    let unreadable = |source| SweepError::Rows(name.clone(), source);
    let (keys, rows) = match Format::of(file)? {
        Format::Csv => csv(file),
        #[cfg(feature = "xlsx")]
        Format::Xlsx => super::xlsx::read(file),
    }
    .map_err(unreadable)?;
    if keys.is_empty() {
        return Err(unreadable(Error::other("it is empty")));
    }
    let column = |(index, key): (usize, String)| {
        let values = rows.iter().map(|row| row[index].clone()).collect();
        (key, values)
    };
    Ok(keys.into_iter().enumerate().map(column).collect())
}

fn csv(file: &Path) -> std::io::Result<Cells> {
    let text = std::io::read_to_string(File::open(file)?).map_err(|error| match error.kind() {
        ErrorKind::InvalidData => Error::new(
            error.kind(),
            "its text is not UTF-8; spreadsheets save it as \"CSV UTF-8\"",
        ),
        _ => error,
    })?;
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
    let with_point = |cell: &str| separator.and_then(|mark| with_point(cell, mark));
    let cells = |record: &csv::StringRecord| -> Vec<String> {
        let cells = record.iter();
        cells
            .map(|cell| with_point(cell).unwrap_or_else(|| cell.to_owned()))
            .collect()
    };
    let keys = cells(reader.headers()?);
    let rows = reader
        .records()
        .map(|record| record.map(|record| cells(&record)).map_err(in_plain_words))
        .collect::<Result<_, _>>()?;
    Ok((keys, rows))
}

/// A number with a decimal comma as it is written in a scene; `None` for anything else. Beside semicolons a comma is always one, beside
/// tabs it may part thousands.
fn with_point(cell: &str, separator: u8) -> Option<String> {
    let (whole, rest) = cell.split_once(',')?;
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    let unsigned = whole.strip_prefix(['+', '-']).unwrap_or(whole);
    let is_number = !unsigned.is_empty() && unsigned.bytes().all(|byte| byte.is_ascii_digit()) && digits > 0;
    let point = format!("{whole}.{rest}");
    let goes_on = rest[digits..].contains([',', '.']);
    let is_one = is_number && !goes_on && (separator == b';' || digits != 3);
    is_one.then_some(point)
}

/// What is wrong with a row.
fn in_plain_words(error: csv::Error) -> Error {
    match error.kind() {
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            Error::other(format!(
                "line {line} has {len} cells and the header {expected_len}; a cell with a comma stands in double quotes"
            ))
        }
        _ => error.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::with_point;

    #[test]
    fn decimal_commas_become_points_where_they_are_ones() {
        for (cell, wanted) in [
            ("1,5 m", "1.5 m"),
            ("-0,25", "-0.25"),
            ("0,300", "0.300"),
            ("1,2e-6 1/K", "1.2e-6 1/K"),
        ] {
            assert_eq!(with_point(cell, b';').as_deref(), Some(wanted));
        }
        for cell in [
            "1.5 m",
            "free",
            "[1,2]",
            "1,2,3",
            "{ x = 1,5 }",
            "a,b",
            ",5",
            "5,",
        ] {
            assert_eq!(with_point(cell, b';'), None, "{cell}");
        }
        assert_eq!(with_point("1,200", b'\t'), None);
        assert_eq!(with_point("1,25", b'\t').as_deref(), Some("1.25"));
    }
}
