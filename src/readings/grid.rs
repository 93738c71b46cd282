//! A text as rows of cells, each with its line.

use csv::{ReaderBuilder, StringRecord, Trim};

use super::error::DataError;
use super::options::Separator;

/// Lines by which the separator is recognised.
const SAMPLE: usize = 200;
/// Share of the lines that must have the same number of cells.
const AGREED: f64 = 0.6;

/// A row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Line of the file, from 1.
    pub line: u64,
    pub cells: Vec<String>,
}

impl Row {
    /// The cell at a place, empty beyond the last.
    pub fn cell(&self, place: usize) -> &str {
        self.cells.get(place).map_or("", String::as_str)
    }
}

/// Rows that are neither blank nor comments, and what stands between their cells.
pub struct Grid {
    pub rows: Vec<Row>,
    /// `None` where cells were cells from the beginning.
    pub separator: Option<Separator>,
}

impl Grid {
    pub fn of(file: &str, text: &str, separator: Option<Separator>) -> Result<Self, DataError> {
        // Excel's own word for the separator.
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        let told = first
            .trim_end()
            .strip_prefix("sep=")
            .and_then(|sign| sign.chars().next());
        let body = if told.is_some() { rest } else { text };
        let separator = separator
            .or(told.map(Separator::Character))
            .unwrap_or_else(|| recognised(body));
        let mut rows = match separator {
            Separator::Character(sign) => separated(file, body, sign)?,
            Separator::Spaces => spaced(body),
        };
        for row in &mut rows {
            row.line += u64::from(told.is_some());
        }
        rows.retain(|row| !row.cells.iter().all(String::is_empty) && !row.cells[0].starts_with('#'));
        let separator = Some(separator);
        Ok(Self { rows, separator })
    }
}

fn reader(sign: char) -> ReaderBuilder {
    let mut builder = ReaderBuilder::new();
    builder
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .delimiter(u8::try_from(sign).unwrap_or(b','));
    builder
}

/// The sign that cuts most lines into the same number of cells; commas last, for they may stand before decimals.
fn recognised(text: &str) -> Separator {
    for sign in ['\t', ';', '|', ','] {
        let records = reader(sign).from_reader(text.as_bytes()).into_records();
        let counts: Vec<usize> = records
            .take(SAMPLE)
            .flatten()
            .filter(|record| !record.iter().all(str::is_empty))
            .map(|record| record.len())
            .collect();
        let agreeing = |count: usize| counts.iter().filter(|&&other| other == count).count();
        let most = counts
            .iter()
            .copied()
            .filter(|&count| count > 1)
            .map(agreeing)
            .max();
        if most.is_some_and(|most| most as f64 >= AGREED * counts.len() as f64) {
            return Separator::Character(sign);
        }
    }
    let cells = |line: &str| line.split_whitespace().count();
    let lines = || {
        text.lines()
            .filter(|line| !line.starts_with('#') && cells(line) > 0)
            .take(SAMPLE)
    };
    if !text.contains(',') && lines().count() > 0 && lines().all(|line| cells(line) > 1) {
        Separator::Spaces
    } else {
        Separator::Character(',')
    }
}

fn separated(file: &str, text: &str, sign: char) -> Result<Vec<Row>, DataError> {
    let mut rows = Vec::new();
    for record in reader(sign).from_reader(text.as_bytes()).records() {
        let record: StringRecord = record.map_err(|source| DataError::Table {
            file: file.to_owned(),
            line: source.position().map_or(0, csv::Position::line),
            source: source.into(),
        })?;
        rows.push(Row {
            line: record
                .position()
                .map_or(0, |position| line(text.as_bytes(), position)),
            cells: record.iter().map(str::to_owned).collect(),
        });
    }
    Ok(rows)
}

fn spaced(text: &str) -> Vec<Row> {
    let row = |(line, text): (u64, &str)| Row {
        line,
        cells: text.split_whitespace().map(str::to_owned).collect(),
    };
    (1..).zip(text.lines()).map(row).collect()
}

/// The line of the record at `position`, which csv counts from the end of the record before: past comments and blank lines.
fn line(bytes: &[u8], position: &csv::Position) -> u64 {
    let rest = usize::try_from(position.byte())
        .ok()
        .and_then(|start| bytes.get(start..));
    let skipped = rest
        .unwrap_or_default()
        .split(|&byte| byte == b'\n')
        .take_while(|line| line.starts_with(b"#") || line.trim_ascii().is_empty())
        .count();
    position.line() + skipped as u64
}
