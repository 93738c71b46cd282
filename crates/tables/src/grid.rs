//! A text as rows of cells, each with its line.

use csv::{ReaderBuilder, Trim};

use crate::error::TableError;
use crate::options::Separator;

/// Lines by which the separator is recognised.
const SAMPLE: usize = 200;
/// Share of the lines that must have the same number of cells.
const AGREED: f64 = 0.6;

/// A row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Line of the file, from 1.
    pub line: u64,
    /// Its cells, without space around them.
    pub cells: Vec<String>,
}

impl Row {
    /// The cell at a place, empty beyond the last.
    pub fn cell(&self, place: usize) -> &str {
        self.cells.get(place).map_or("", String::as_str)
    }

    pub(crate) fn is_data(&self) -> bool {
        !self.cells.iter().all(String::is_empty) && !self.cell(0).starts_with('#')
    }
}

/// Rows that are neither blank nor comments, and what stands between their cells.
pub struct Grid {
    pub rows: Vec<Row>,
    /// `None` where cells were cells from the beginning.
    pub separator: Option<Separator>,
    /// Other sheets of the workbook.
    pub sheets: Vec<String>,
}

/// The rows of `text`.
pub fn read(file: &str, text: &str, separator: Option<Separator>) -> Result<Grid, TableError> {
    // Excel's own word for the separator.
    let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
    let word = first.trim_end().strip_prefix("sep=");
    let named = word.and_then(|sign| sign.chars().next());
    let body = if named.is_some() { rest } else { text };
    let separator = separator
        .or(named.map(Separator::Character))
        .unwrap_or_else(|| recognised(body));
    let mut rows = match separator {
        Separator::Character(sign) => separated(file, body, sign)?,
        Separator::Spaces => spaced(body),
    };
    for row in &mut rows {
        row.line += u64::from(named.is_some());
    }
    rows.retain(Row::is_data);
    Ok(Grid {
        rows,
        separator: Some(separator),
        sheets: Vec::new(),
    })
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
        let several = counts.iter().copied().filter(|&count| count > 1);
        let most = several.map(agreeing).max();
        if most.is_some_and(|most| most as f64 >= AGREED * counts.len() as f64) {
            return Separator::Character(sign);
        }
    }
    let cells = |line: &str| line.split_whitespace().count();
    let lines = || {
        let data = text
            .lines()
            .filter(|line| !line.starts_with('#') && cells(line) > 0);
        data.take(SAMPLE)
    };
    if !text.contains(',') && lines().count() > 0 && lines().all(|line| cells(line) > 1) {
        Separator::Spaces
    } else {
        Separator::Character(',')
    }
}

fn separated(file: &str, text: &str, sign: char) -> Result<Vec<Row>, TableError> {
    let row = |record: Result<csv::StringRecord, csv::Error>| {
        let record = record.map_err(|source| TableError::NotTable {
            file: file.to_owned(),
            line: source.position().map_or(0, csv::Position::line),
            source: source.into(),
        })?;
        let line = record
            .position()
            .map_or(0, |position| line(text.as_bytes(), position));
        let cells = record.iter().map(str::to_owned).collect();
        Ok(Row { line, cells })
    };
    reader(sign)
        .from_reader(text.as_bytes())
        .into_records()
        .map(row)
        .collect()
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
