//! A text as rows of cells, each with its line.

use csv::{ReaderBuilder, StringRecord};

use crate::number::number;

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
    pub(crate) is_merged: bool,
}

impl Row {
    /// The cell at a place, empty beyond the last.
    pub fn cell(&self, place: usize) -> &str {
        self.cells.get(place).map_or("", String::as_str)
    }

    /// Whether it holds words alone.
    pub(crate) fn is_words(&self) -> bool {
        let is_number = |cell: &String| cell.starts_with(|c: char| c.is_ascii_digit());
        !self.cells.iter().any(is_number)
    }

    /// How many of its cells are words.
    pub(crate) fn words(&self) -> usize {
        let is_word = |cell: &&String| cell.starts_with(char::is_alphabetic);
        self.cells.iter().filter(is_word).count()
    }

    /// Whether its first two cells are bare numbers in some notation.
    pub(crate) fn is_numbers(&self) -> bool {
        let bare = |cell: &str, sign| matches!(number(cell, sign), Some((_, "")));
        (0..2).all(|place| bare(self.cell(place), '.') || bare(self.cell(place), ','))
    }

    /// Neither blank nor a comment.
    pub(crate) fn is_data(&self) -> bool {
        !self.cells.iter().all(String::is_empty) && !self.cell(0).starts_with('#')
    }
}

/// The rows of data in `text`, and what stands between their cells: the sign that is `named`, or the
/// one of Excel's own first line, `sep=;`, or the one that the lines agree on.
pub fn read(text: &str, named: Option<char>) -> (Vec<Row>, char) {
    let text = text.replace("\r\n", "\n").replace('\r', "\n") + "\n";
    let first = text.lines().next().unwrap_or_default();
    let excel = first.strip_prefix("sep=").and_then(|sign| sign.chars().next());
    // A blank line in its place keeps the numbers of the others.
    let body = &text[if excel.is_some() { first.len() } else { 0 }..];
    let sign = named.or(excel).unwrap_or_else(|| recognised(body));
    (separated(body, sign), sign)
}

/// The sign that cuts most lines into the same number of cells; commas last, for they may stand
/// before decimals. Spaces if they cut every line of a text without commas.
fn recognised(text: &str) -> char {
    let sample: String = text.split_inclusive('\n').take(SAMPLE).collect();
    let counts = |sign| separated(&sample, sign).into_iter().map(|row| row.cells.len());
    let agrees = |sign: &char| {
        let counts: Vec<usize> = counts(*sign).collect();
        let agreeing = |&count: &usize| counts.iter().filter(|&&other| other == count).count();
        let most = counts.iter().filter(|&&count| count > 1).map(agreeing).max();
        most.is_some_and(|most| most as f64 >= AGREED * counts.len() as f64)
    };
    let is_spaced = || !text.contains(',') && counts(' ').all(|count| count > 1);
    let sign = ['\t', ';', '|', ','].into_iter().find(agrees);
    sign.unwrap_or_else(|| if is_spaced() { ' ' } else { ',' })
}

/// The rows of data in a text whose lines all end; any number of spaces stands between two cells.
fn separated(text: &str, sign: char) -> Vec<Row> {
    let spaced = (sign == ' ').then(|| text.replace('\t', " "));
    let text = spaced.as_deref().unwrap_or(text);
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .delimiter(u8::try_from(sign).unwrap_or(b','))
        .from_reader(text.as_bytes());
    let (mut rows, mut record) = (Vec::new(), StringRecord::new());
    // Rows of any length in a text: this cannot fail.
    while reader.read_record(&mut record).unwrap_or(false) {
        let breaks: usize = record.iter().map(|cell| cell.matches('\n').count()).sum();
        let cells = record.iter().map(|cell| cell.trim().to_owned());
        let (behind, last) = (reader.position(), record.iter().next_back());
        // A quote that is never closed holds the end of its line, too.
        let is_open = behind.byte() == text.len() as u64 && last.is_some_and(|cell| cell.ends_with('\n'));
        let lines = breaks as u64 + u64::from(!is_open);
        rows.push(Row {
            line: behind.line().saturating_sub(lines),
            cells: cells.filter(|cell| sign != ' ' || !cell.is_empty()).collect(),
            is_merged: false,
        });
    }
    rows.retain(Row::is_data);
    rows
}
