//! A text as rows of cells, each with its line.

use csv::{ReaderBuilder, Trim};

use crate::error::TableError;

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
    /// Whether cells of it reach over several columns or rows of a workbook.
    pub(crate) merged: bool,
}

impl Row {
    /// The cell at a place, empty beyond the last.
    pub fn cell(&self, place: usize) -> &str {
        self.cells.get(place).map_or("", String::as_str)
    }

    /// Whether it holds words alone.
    pub(crate) fn is_words(&self) -> bool {
        !self
            .cells
            .iter()
            .any(|cell| cell.starts_with(|c: char| c.is_ascii_digit()))
    }

    /// Neither blank nor a comment.
    pub(crate) fn is_data(&self) -> bool {
        !self.cells.iter().all(String::is_empty) && !self.cell(0).starts_with('#')
    }
}

/// Rows that are neither blank nor comments, and what stands between their cells.
pub struct Grid {
    pub rows: Vec<Row>,
    /// `None` where cells were cells from the beginning.
    pub separator: Option<char>,
    /// Other sheets of the workbook.
    pub sheets: Vec<String>,
}

/// The rows of `text`.
pub fn read(file: &str, text: &str, separator: Option<char>) -> Result<Grid, TableError> {
    // Excel's own word for the separator.
    let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
    let word = first.trim_end().strip_prefix("sep=");
    let named = word.and_then(|sign| sign.chars().next());
    let body = if named.is_some() { rest } else { text };
    let separator = separator.or(named).unwrap_or_else(|| recognised(body));
    let mut rows = if separator == ' ' {
        let cells = |line: &str| line.split_whitespace().map(str::to_owned).collect();
        (1..).zip(body.lines().map(cells)).collect()
    } else {
        separated(file, body, separator)?
    };
    let row = |(line, cells)| Row {
        line: line + u64::from(named.is_some()),
        cells,
        merged: false,
    };
    let rows = rows.drain(..).map(row).filter(Row::is_data).collect();
    Ok(Grid {
        rows,
        separator: Some(separator),
        sheets: Vec::new(),
    })
}

fn reader(sign: char) -> ReaderBuilder {
    let mut builder = ReaderBuilder::new();
    let sign = u8::try_from(sign).unwrap_or(b',');
    builder
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .delimiter(sign);
    builder
}

/// The sign that cuts most lines into the same number of cells; commas last, for they may stand before decimals.
fn recognised(text: &str) -> char {
    let agrees = |sign: &char| {
        let records = reader(*sign)
            .from_reader(text.as_bytes())
            .into_records()
            .take(SAMPLE)
            .flatten();
        let counts: Vec<usize> = records
            .filter(|record| !record.iter().all(str::is_empty))
            .map(|record| record.len())
            .collect();
        let agreeing = |&count: &usize| counts.iter().filter(|&&other| other == count).count();
        let most = counts.iter().filter(|&&count| count > 1).map(agreeing).max();
        most.is_some_and(|most| most as f64 >= AGREED * counts.len() as f64)
    };
    let is_cut = || {
        let cells = |line: &str| line.split_whitespace().count();
        let mut lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && cells(line) > 0)
            .take(SAMPLE)
            .peekable();
        !text.contains(',') && lines.peek().is_some() && lines.all(|line| cells(line) > 1)
    };
    let sign = ['\t', ';', '|', ','].into_iter().find(agrees);
    sign.unwrap_or_else(|| if is_cut() { ' ' } else { ',' })
}

/// The cells of each record with its line.
fn separated(file: &str, text: &str, sign: char) -> Result<Vec<(u64, Vec<String>)>, TableError> {
    let row = |record: Result<csv::StringRecord, csv::Error>| {
        let record = record.map_err(|source| TableError::NotTable {
            file: file.to_owned(),
            line: source.position().map_or(0, csv::Position::line),
            source: source.into(),
        })?;
        let line = record
            .position()
            .map_or(0, |position| line(text.as_bytes(), position));
        Ok((line, record.iter().map(str::to_owned).collect()))
    };
    reader(sign)
        .from_reader(text.as_bytes())
        .into_records()
        .map(row)
        .collect()
}

/// The line of the record at `position`, which csv counts from the end of the record before: past comments and blank lines.
fn line(bytes: &[u8], position: &csv::Position) -> u64 {
    let start = usize::try_from(position.byte()).ok();
    let rest = start.and_then(|start| bytes.get(start..)).unwrap_or_default();
    let is_skipped = |line: &&[u8]| line.starts_with(b"#") || line.trim_ascii().is_empty();
    position.line() + rest.split(|&byte| byte == b'\n').take_while(is_skipped).count() as u64
}
