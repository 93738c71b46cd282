//! Names, units and rows of a table, and what its cells hold.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use crate::column::{Kind, Layout, Name, is_same};
use crate::error::{Result, TableError};
use crate::number::{by_either_sign, number};
use crate::options::{Options, word};
use crate::rows::{self, Row};
use crate::{LONGEST, PREAMBLE, shortened, text};

/// A table: names of its columns and the rows below them.
#[derive(Debug)]
pub struct Table {
    /// The file's name.
    pub file: String,
    /// Line of the header.
    pub line: u64,
    /// Names of the columns.
    pub names: Vec<Name>,
    /// Rows of data.
    pub rows: Vec<Row>,
    layout: &'static Layout,
    /// What stands between cells, a space for any number of them; `None` in a workbook.
    separator: Option<char>,
    /// Other sheets of the workbook.
    sheets: Vec<String>,
}

impl Table {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// As for [`Table::read`]; [`TableError::Unreadable`].
    pub fn from_file(path: &Path, options: &Options, layout: &'static Layout) -> Result<Self> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        let read = File::open(path).and_then(|open| open.take(layout.most + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) => Self::read(&file, &bytes, options, layout),
            Err(source) => Err(TableError::Unreadable(file, source.into())),
        }
    }

    /// Reads a text or a workbook from `bytes`; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// [`TableError`] with the first thing that is wrong: a column that is missing, a row of another length.
    pub fn read(file: &str, bytes: &[u8], options: &Options, layout: &'static Layout) -> Result<Self> {
        if bytes.len() as u64 > layout.most {
            let most = format!("a table of at most {} bytes", layout.most);
            return Err(TableError::line(file, 0, "a file that is far larger", most));
        }
        let (rows, separator, sheets) = rows_of(file, bytes, options)?;
        let Some(first) = rows.first() else {
            return Err(TableError::line(file, 0, "no rows", layout.allowed));
        };
        let mut table = Self {
            file: file.to_owned(),
            line: first.line,
            names: Vec::new(),
            rows,
            layout,
            separator,
            sheets,
        };
        table.take_header(options)?;
        table.check_columns(options)?;
        table.find_decimal_signs(options.decimal);
        Ok(table)
    }

    /// Takes the names from the header, and the units from the row below if it holds them.
    fn take_header(&mut self, options: &Options) -> Result<()> {
        let (layout, is_toa5) = (self.layout, self.rows[0].cell(0) == "TOA5");
        let header = self.header(options)?;
        let mut names = layout.names(&self.rows[header.clone()], options);
        let is_unit = |cell: &String| (layout.unit)(unit_in(cell)).is_some();
        let below = self.rows.get(header.end).filter(|row| row.is_words());
        let units = below.filter(|row| row.cells.iter().any(is_unit));
        for (name, cell) in names.iter_mut().zip(units.iter().flat_map(|row| &row.cells)) {
            let unit = Some(unit_in(cell)).filter(|unit| !matches!(*unit, "" | "-"));
            name.unit = name.unit.take().or(unit.map(str::to_owned));
        }
        // The row of units is one of those that are skipped; a logger of Campbell's has one more.
        let few = usize::from(units.is_some());
        let recognised = if is_toa5 { 2 * few } else { few };
        let skipped = options.skip.map_or(recognised, |skip| few.max(skip as usize));
        (self.line, self.names) = (self.rows[header.start].line, names);
        self.rows.drain(..self.rows.len().min(header.end + skipped));
        Ok(())
    }

    /// The rows of the header: at the line that was said, else the first that is recognised, else
    /// the one with the most words; where cells are merged, with the row below. Where the first row
    /// holds numbers, [`Layout::unnamed`] is put above.
    fn header(&mut self, options: &Options) -> Result<Range<usize>> {
        let rows = &self.rows;
        let joined = |place: usize| {
            let is_joined = rows[place].is_merged && rows.get(place + 1).is_some_and(Row::is_words);
            place..place + 1 + usize::from(is_joined)
        };
        if let Some(line) = options.header_line {
            let wrong = || self.wrong(line, "nothing", "a line with the names of the columns");
            let place = rows.iter().position(|row| row.line == line);
            return place.map(joined).ok_or_else(wrong);
        }
        let places = 0..rows.len().min(PREAMBLE);
        let is_header = |header: &Range<usize>| {
            (self.layout.missing)(&self.layout.names(&rows[header.clone()], options)).is_none()
        };
        let alone = places.clone().map(|place| place..place + 1);
        if let Some(found) = alone.chain(places.clone().map(joined)).find(is_header) {
            return Ok(joined(found.start));
        }
        if !rows[0].is_numbers() {
            let place = places.max_by_key(|&place| rows[place].words());
            return Ok(joined(place.unwrap_or(0)));
        }
        let mut unnamed = rows[0].clone();
        let names = self.layout.unnamed.iter().take(unnamed.cells.len());
        unnamed.cells = names.map(|name| (*name).to_owned()).collect();
        self.rows.insert(0, unnamed);
        Ok(0..1)
    }

    /// Makes sure that the columns are there, and rows as long as the header.
    fn check_columns(&self, options: &Options) -> Result<()> {
        let is_missing = |name: &&String| !self.names.iter().any(|other| is_same(&other.text, name));
        let chosen = options.columns.iter().map(|(_, name)| name).find(is_missing);
        // Without kinds any column may be there.
        let needed = (self.layout.missing)(&self.names).filter(|_| !self.layout.kinds.is_empty());
        if let Some(column) = chosen.map(String::as_str).or(needed) {
            return Err(self.missing(column));
        }
        let width = self.names.len();
        for row in self.rows.iter().filter(|_| width > 0) {
            let is_long = row.cells.iter().skip(width).any(|cell| !cell.is_empty());
            if is_long || (row.cells.len() < width && self.separator.is_some()) {
                let found = format!("{} cells where the first row has {width}", row.cells.len());
                let allowed = "as many: a decimal comma in a file separated by commas makes two of one; put it in quotes, or separate by semicolons";
                return Err(self.wrong(row.line, found, allowed));
            }
        }
        Ok(())
    }

    /// Finds the decimal sign of each column: by a cell that can be read in one way only, else as in
    /// another column.
    fn find_decimal_signs(&mut self, said: Option<char>) {
        let said = said.or(self.separator.is_none().then_some('.'));
        for (column, name) in self.names.iter_mut().enumerate() {
            let is_number = (self.layout.is_number)(name);
            let certain = |row: &Row| match by_either_sign(row.cell(column)) {
                [Some(_), None] => Some('.'),
                [None, Some(_)] => Some(','),
                _ => None,
            };
            name.decimal = said.or_else(|| self.rows.iter().filter(|_| is_number).find_map(certain));
        }
        let any = self.names.iter().find_map(|name| name.decimal);
        for name in &mut self.names {
            name.decimal = name.decimal.or(any);
        }
    }

    /// What is wrong in a line of it.
    pub fn wrong(&self, line: u64, found: impl Into<String>, allowed: impl Into<String>) -> TableError {
        TableError::line(&self.file, line, found, allowed)
    }

    /// That a column is missing, and what there is.
    fn missing(&self, column: &str) -> TableError {
        let names = self.names.iter().map(|name| &*name.text);
        let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
        let listed = shortened(&names.join(" | "), LONGEST);
        let read_as = match (self.separator, &self.sheets[..]) {
            (Some(sign), _) => format!("separated by {}s", word(sign)),
            (None, []) => "a workbook".to_owned(),
            (None, sheets) => format!("a workbook; other sheets: {}", sheets.join(", ")),
        };
        let found = format!("no column {column} in \"{listed}\" (read as {read_as})");
        self.wrong(self.line, found, self.layout.allowed)
    }

    /// The columns of a kind: those that were chosen or that its own program writes, if any.
    pub fn of(&self, kind: Kind) -> Vec<usize> {
        let of_kind = |&column: &usize| self.names[column].kind == Some(kind);
        let all: Vec<usize> = (0..self.names.len()).filter(of_kind).collect();
        let is_own = |column: &usize| self.names[*column].is_own();
        let own: Vec<usize> = all.iter().copied().filter(is_own).collect();
        if own.is_empty() { all } else { own }
    }

    /// The only column of a kind, if there is one.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] if there are two.
    pub fn one(&self, kind: Kind) -> Result<Option<usize>> {
        let columns = self.of(kind);
        let Some(&second) = columns.get(1) else {
            return Ok(columns.first().copied());
        };
        let found = format!("a second column {}", self.names[second].text);
        let allowed = format!("one column of its kind: --column-{} chooses it", kind.name());
        Err(self.wrong(self.line, found, allowed))
    }

    /// The digits of the number in a cell, with a decimal point, and its unit, or that of the column
    /// `like` if it has none. `None` if there is no number.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for a number that can be read in two ways where no other cell decides.
    pub fn quantity<'t>(
        &'t self,
        row: &'t Row,
        column: usize,
        like: usize,
    ) -> Result<Option<(String, &'t str)>> {
        let (cell, name) = (row.cell(column), &self.names[column]);
        // Between commas a point stands before decimals.
        let is_point = self.separator == Some(',') && cell.contains('.');
        if let (None, false, [Some(a), Some(b)]) = (name.decimal, is_point, by_either_sign(cell))
            && a != b
        {
            let (cell, least, most) = (shortened(cell, LONGEST), a.min(b), a.max(b));
            let found = format!("{}: found \"{cell}\", {least} or {most}", name.text);
            let allowed =
                "either: --decimal comma or --decimal point says which sign stands before the decimals";
            return Err(self.wrong(row.line, found, allowed));
        }
        let of_column = self.names[like].unit.as_deref().unwrap_or_default();
        let number = number(cell, name.decimal.unwrap_or('.'));
        Ok(number.map(|(digits, unit)| (digits, if unit.is_empty() { of_column } else { unit })))
    }

    /// The value in SI in a cell, of the kind of the column `like` and in its unit.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for what is no such value, and as for [`Table::quantity`].
    pub fn value(&self, row: &Row, column: usize, like: usize) -> Result<f64> {
        let (digits, unit) = self.quantity(row, column, like)?.unwrap_or_default();
        let kind = self.names[like].kind.unwrap_or(Kind(""));
        let value = (self.layout.si)(kind, &digits, unit);
        value.map_err(|allowed| self.wrong_cell(row, column, allowed))
    }

    /// That the cell of `row` in `column` does not hold what is `allowed`.
    pub fn wrong_cell(&self, row: &Row, column: usize, allowed: impl Into<String>) -> TableError {
        let (name, cell) = (&self.names[column], shortened(row.cell(column), LONGEST));
        let found = format!("{}: found \"{cell}\"", name.text);
        let decimals = |sign| format!(", decimals after a {}", word(sign));
        let allowed = allowed.into() + &name.decimal.map_or_else(String::new, decimals);
        self.wrong(row.line, found, allowed)
    }
}

/// The rows of a file, what stands between cells of a text, and the other sheets of a workbook.
fn rows_of(file: &str, bytes: &[u8], options: &Options) -> Result<(Vec<Row>, Option<char>, Vec<String>)> {
    #[cfg(feature = "xlsx")]
    if bytes.starts_with(crate::workbook::MARK) {
        let (rows, sheets) = crate::workbook::read(file, bytes, options.sheet.as_deref())?;
        return Ok((rows, None, sheets));
    }
    let (rows, separator) = rows::read(&text::decoded(file, bytes, options.encoding)?, options.separator);
    Ok((rows, Some(separator), Vec::new()))
}

/// A unit in a row of them, without what may stand around it.
fn unit_in(cell: &str) -> &str {
    cell.trim_matches(|c| "~[]() ".contains(c))
}
