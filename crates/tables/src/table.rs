//! Names, units and rows of a table, and what its cells hold.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::TableError;
use crate::grid::{self, Grid, Row};
use crate::name::Name;
use crate::number::{Sign, is_no_value, number, sign};
use crate::options::{Decimal, Options, Separator};
use crate::{LONGEST, is_number, shortened, text};

/// Rows above the header at most: what a data logger says of itself.
const PREAMBLE: usize = 40;

/// How the names of a table are recognised.
pub struct Names<'n> {
    /// Whether these are the names of its columns.
    pub is_header: &'n dyn Fn(&[Name]) -> bool,
    /// The symbol of the unit that a word stands for, whatever its case.
    pub unit: fn(&str) -> Option<&'static str>,
}

/// A table: names of its columns and the rows below them.
#[derive(Debug)]
pub struct Table {
    /// The file's name.
    pub file: String,
    /// Line of the header.
    pub line: u64,
    /// Names of the columns; none where the first row holds numbers.
    pub names: Vec<Name>,
    /// Rows of data.
    pub rows: Vec<Row>,
    /// What stands between cells; `None` in a workbook.
    pub separator: Option<Separator>,
    /// The decimal sign of each column that was decided.
    decimals: Vec<Option<Decimal>>,
    option: Option<Decimal>,
    sheets: Vec<String>,
}

/// What a cell holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell<'c> {
    /// Nothing.
    Blank,
    /// A word that stands for no value.
    NoValue(&'c str),
    /// A finite number, and the unit behind it.
    Number(f64, &'c str),
}

impl Table {
    /// Reads the file at `path`, which has at most so many bytes.
    ///
    /// # Errors
    ///
    /// As for [`Table::read`]; [`TableError::Unreadable`], [`TableError::TooLarge`].
    pub fn from_file(
        path: &Path,
        most: u64,
        options: &Options,
        names: &Names<'_>,
    ) -> Result<Self, TableError> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        match File::open(path).and_then(|open| open.take(most + 1).read_to_end(&mut bytes)) {
            Err(source) => Err(TableError::Unreadable(file, source)),
            Ok(length) if length as u64 > most => Err(TableError::TooLarge { file, allowed: most }),
            Ok(_) => Self::read(&file, &bytes, options, names),
        }
    }

    /// Reads a text or a workbook from `bytes`; `file` stands for it in errors. Where no row is recognised as the header, the names are those
    /// of the row with the most words, or none where the first row holds numbers.
    ///
    /// # Errors
    ///
    /// [`TableError`] with the first thing that is wrong, and its line.
    pub fn read(file: &str, bytes: &[u8], options: &Options, names: &Names<'_>) -> Result<Self, TableError> {
        let Grid {
            mut rows,
            separator,
            sheets,
        } = grid(file, bytes, options)?;
        let of = |row: &Row| -> Vec<Name> {
            let cells = row.cells.iter();
            let mut names: Vec<Name> = cells.map(|cell| Name::of(cell, names.unit)).collect();
            // Excel writes columns that were used once.
            let width = names
                .iter()
                .rposition(|name| !name.text.is_empty())
                .map_or(0, |last| last + 1);
            names.truncate(width);
            names
        };
        let begins_a_word = |cell: &&String| cell.starts_with(char::is_alphabetic);
        let words = |row: &Row| row.cells.iter().filter(begins_a_word).count();
        let preamble = || rows.iter().take(PREAMBLE).enumerate();
        let (Some(first), toa5) = (
            rows.first(),
            rows.first().is_some_and(|row| row.cell(0) == "TOA5"),
        ) else {
            return Err(TableError::Empty(file.to_owned()));
        };
        let header = if let Some(line) = options.header_line {
            let found = rows.iter().position(|row| row.line == line);
            Some(found.ok_or_else(|| TableError::Line {
                file: file.to_owned(),
                line,
                found: "nothing".into(),
                allowed: "a line with the names of the columns".into(),
            })?)
        } else {
            let found = preamble().find(|(_, row)| (names.is_header)(&of(row)));
            let numeric = first.cells.len() > 1 && first.cells.iter().take(2).all(|cell| is_number(cell));
            let likely = || preamble().max_by_key(|(place, row)| (words(row), *place));
            let found = found.or_else(|| if numeric { None } else { likely() });
            found.map(|(place, _)| place)
        };
        let mut table = Self {
            file: file.to_owned(),
            line: header.map_or(first.line, |place| rows[place].line),
            names: header.map_or_else(Vec::new, |place| of(&rows[place])),
            separator,
            decimals: Vec::new(),
            option: options.decimal.or(separator.is_none().then_some(Decimal::Point)),
            rows: rows.split_off(header.map_or(0, |place| place + 1)),
            sheets,
        };
        let has_units = header.is_some() && table.take_units(names.unit);
        // The row of units is one of those that are skipped.
        let skipped = options.skip.map_or(u64::from(has_units && toa5), |skip| {
            skip.saturating_sub(u64::from(has_units))
        });
        table.rows.drain(..(skipped as usize).min(table.rows.len()));
        Ok(table)
    }

    /// Takes the units from the first row, if that is what it holds: no number, and a unit at least.
    fn take_units(&mut self, unit: impl Fn(&str) -> Option<&'static str>) -> bool {
        let Some(row) = self.rows.first() else {
            return false;
        };
        let bare = |cell: &str| cell.trim_matches(|c| "[]()".contains(c)).trim().to_owned();
        let units: Vec<String> = row.cells.iter().map(|cell| bare(cell)).collect();
        let begins_a_number = |cell: &String| cell.starts_with(|c: char| c.is_ascii_digit());
        if row.cells.iter().any(begins_a_number) || !units.iter().any(|cell| unit(cell).is_some()) {
            return false;
        }
        for (name, cell) in self.names.iter_mut().zip(units) {
            if name.unit.is_none() && !cell.is_empty() && cell != "-" {
                name.unit = Some(cell);
            }
        }
        self.rows.remove(0);
        true
    }

    /// Every row has as many cells as the header, or as the first where there is none; empty ones at the end do not count.
    fn check_widths(&self) -> Result<(), TableError> {
        let width = match (&self.names[..], self.rows.first()) {
            ([], Some(first)) => first.cells.len(),
            (names, _) => names.len(),
        };
        let fits = |row: &&Row| {
            let beyond = row.cells.iter().skip(width).any(|cell| !cell.is_empty());
            !beyond && (row.cells.len() >= width || self.separator.is_none())
        };
        match self.rows.iter().find(|row| !fits(row)) {
            Some(row) => Err(self.wrong(
                row.line,
                format!("{} cells where the first row has {width}", row.cells.len()),
                "as many: a decimal comma in a file separated by commas makes two of one; put it in quotes, or separate by semicolons",
            )),
            None => Ok(()),
        }
    }

    /// What is wrong in a line of it.
    pub fn wrong(
        &self,
        line: u64,
        found: String,
        allowed: impl Into<std::borrow::Cow<'static, str>>,
    ) -> TableError {
        TableError::Line {
            file: self.file.clone(),
            line,
            found,
            allowed: allowed.into(),
        }
    }

    /// The column of this name, whatever its case.
    pub fn named(&self, name: &str) -> Option<usize> {
        let name = name.trim().to_lowercase();
        self.names
            .iter()
            .position(|other| other.text.trim().to_lowercase() == name)
    }

    /// That a column is missing, what there is, and what may be the cause.
    pub fn missing(&self, column: &str, allowed: impl Into<std::borrow::Cow<'static, str>>) -> TableError {
        let names = self
            .names
            .iter()
            .map(|name| &*name.text)
            .filter(|name| !name.is_empty());
        let names: Vec<&str> = names.collect();
        let separated = self.separator.map_or("a workbook", Separator::name);
        // One name that another separator would cut.
        let other = [';', '\t', ',', ' ']
            .into_iter()
            .find(|sign| names.len() == 1 && names[0].contains(*sign));
        let cause = other.map_or_else(String::new, |sign| {
            let separator = if sign == ' ' {
                Separator::Spaces
            } else {
                Separator::Character(sign)
            };
            format!("; it looks separated by {}", separator.name())
        });
        let sheets = match &self.sheets[..] {
            [] => String::new(),
            sheets => format!("; other sheets: {}", sheets.join(", ")),
        };
        let names = shortened(&names.join(" | "), LONGEST);
        let found =
            format!("no column {column} in \"{names}\" (read as separated by {separated}{cause}{sheets})");
        self.wrong(self.line, found, allowed)
    }

    /// Finds the decimal signs of these `columns`: by a cell of the column that can be read in one way only, else by one of the others.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] at a row with more or fewer cells than the header, or a number that can be read in two ways where no other cell
    /// decides.
    pub fn decide(&mut self, columns: &[usize]) -> Result<(), TableError> {
        self.check_widths()?;
        self.decimals
            .resize(columns.iter().map(|column| column + 1).max().unwrap_or(0), None);
        // Between commas a point stands before decimals.
        let between_commas = self.separator == Some(Separator::Character(','));
        let certain = |column: usize| {
            let mut signs = self.rows.iter().map(|row| sign(row.cell(column)));
            signs.find_map(|sign| match sign {
                Sign::Certain(decimal) => Some(decimal),
                _ => None,
            })
        };
        let own: Vec<Option<Decimal>> = columns.iter().map(|&column| certain(column)).collect();
        let any = own.iter().flatten().next().copied();
        for (&column, own) in columns.iter().zip(&own) {
            let decided = self.option.or(*own).or(any);
            let is_doubtful = |row: &&Row| {
                let cell = row.cell(column);
                sign(cell) == Sign::Doubtful && !(between_commas && cell.contains('.'))
            };
            if let (None, Some(row)) = (decided, self.rows.iter().find(is_doubtful)) {
                let cell = row.cell(column);
                let read = |decimal| number(cell, decimal).map_or(f64::NAN, |number| number.value);
                let (a, b) = (read(Decimal::Point), read(Decimal::Comma));
                let name = self.names.get(column).map_or("", |name| &name.text);
                return Err(self.wrong(
                    row.line,
                    format!(
                        "{name}: found \"{}\", {} or {}",
                        shortened(cell, LONGEST),
                        a.min(b),
                        a.max(b)
                    ),
                    "either: --decimal comma or --decimal point says which sign stands before the decimals",
                ));
            }
            self.decimals[column] = decided;
        }
        Ok(())
    }

    fn decimal(&self, column: usize) -> Decimal {
        let decided = self.decimals.get(column).copied().flatten();
        decided.or(self.option).unwrap_or(Decimal::Point)
    }

    /// What the cell of `row` in `column` holds.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for a text that is neither a number nor a word for none.
    pub fn cell<'r>(&self, row: &'r Row, column: usize) -> Result<Cell<'r>, TableError> {
        let cell = row.cell(column);
        if cell.is_empty() {
            return Ok(Cell::Blank);
        }
        if is_no_value(cell) {
            return Ok(Cell::NoValue(cell));
        }
        let found = number(cell, self.decimal(column));
        let found = found.ok_or_else(|| self.wrong_cell(row, column, "a finite number"))?;
        Ok(Cell::Number(found.value, found.unit))
    }

    /// The cell of `row` in `column` as a program writes it: a number with a decimal point, and with the unit of the column if it has none.
    pub fn written(&self, row: &Row, column: usize) -> String {
        let cell = row.cell(column);
        match number(cell, self.decimal(column)) {
            Some(number) => {
                let unit = self.names.get(column).and_then(|name| name.unit.as_deref());
                let unit = if number.unit.is_empty() {
                    unit.unwrap_or("")
                } else {
                    number.unit
                };
                format!("{} {unit}", number.digits).trim_end().to_owned()
            }
            None => cell.to_owned(),
        }
    }

    /// That the cell of `row` in `column` does not hold what is `allowed`.
    pub fn wrong_cell(
        &self,
        row: &Row,
        column: usize,
        allowed: impl Into<std::borrow::Cow<'static, str>>,
    ) -> TableError {
        let cell = shortened(row.cell(column), LONGEST);
        let is = |decimal| number(&cell, decimal).is_some();
        let cause = match self.decimal(column) {
            Decimal::Point if cell.contains(',') && is(Decimal::Comma) => {
                ", a decimal comma where other numbers have a point"
            }
            Decimal::Comma if cell.contains('.') && is(Decimal::Point) => {
                ", a decimal point where other numbers have a comma"
            }
            _ => "",
        };
        let name = self.names.get(column).map_or("", |name| &name.text);
        self.wrong(row.line, format!("{name}: found \"{cell}\"{cause}"), allowed)
    }
}

fn grid(file: &str, bytes: &[u8], options: &Options) -> Result<Grid, TableError> {
    #[cfg(feature = "xlsx")]
    if crate::workbook::is_workbook(bytes) {
        return crate::workbook::read(file, bytes, options.sheet.as_deref());
    }
    let text = text::decoded(bytes, options.encoding).ok_or_else(|| TableError::NoText {
        file: file.to_owned(),
        named: options.encoding.map(|encoding| encoding.0.name()),
    })?;
    grid::read(file, &text, options.separator)
}
