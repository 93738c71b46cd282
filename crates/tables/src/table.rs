//! Names, units and rows of a table, and what its cells hold.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::column::{Kind, Layout, Name, is_same};
use crate::error::TableError;
use crate::number::{both, number};
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
    pub fn from_file(path: &Path, options: &Options, layout: &'static Layout) -> Result<Self, TableError> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        let read = File::open(path).and_then(|open| open.take(layout.most + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) => Self::read(file, &bytes, options, layout),
            Err(source) => Err(TableError::Unreadable(file, source)),
        }
    }

    /// Reads a text or a workbook from `bytes`; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// [`TableError`] with the first thing that is wrong, and its line: a column that is missing, a row that is not as long as the header.
    pub fn read(
        file: String,
        bytes: &[u8],
        options: &Options,
        layout: &'static Layout,
    ) -> Result<Self, TableError> {
        let mut table = Self {
            file,
            line: 0,
            names: Vec::new(),
            rows: Vec::new(),
            layout,
            separator: None,
            sheets: Vec::new(),
        };
        table.take_rows(bytes, options)?;
        table.take_header(options)?;
        table.check_columns(options)?;
        table.find_decimal_signs(options.decimal);
        Ok(table)
    }

    fn take_rows(&mut self, bytes: &[u8], options: &Options) -> Result<(), TableError> {
        let (file, allowed) = (self.file.clone(), self.layout.most);
        if bytes.len() as u64 > allowed {
            return Err(TableError::TooLarge { file, allowed });
        }
        #[cfg(feature = "xlsx")]
        if bytes.starts_with(crate::workbook::MARK) {
            (self.rows, self.sheets) = crate::workbook::read(&file, bytes, options.sheet.as_deref())?;
            return Ok(());
        }
        let Some(text) = text::decoded(bytes, options.encoding) else {
            return Err(TableError::NoText(
                file,
                options.encoding.map(encoding_rs::Encoding::name),
            ));
        };
        let (rows, separator) = rows::read(&text, options.separator);
        (self.rows, self.separator) = (rows, Some(separator));
        if self.rows.is_empty() {
            Err(TableError::Empty(file))
        } else {
            Ok(())
        }
    }

    /// Takes the names from the line that was said, else from the first row that is recognised, else from that with the most words; where the
    /// first row holds numbers, they are [`Layout::unnamed`]. The row below says more where cells are merged, or where it holds the units.
    fn take_header(&mut self, options: &Options) -> Result<(), TableError> {
        let (rows, layout) = (&self.rows, self.layout);
        let names = |rows: &[Row]| layout.names(rows, options);
        // The place behind a header that begins at `place`.
        let end = |place: usize| {
            let is_joined = rows[place].is_merged && rows.get(place + 1).is_some_and(Row::is_words);
            place + 1 + usize::from(is_joined)
        };
        let is_header = |rows: &[Row]| (layout.missing)(&names(rows)).is_none();
        let places = || 0..rows.len().min(PREAMBLE);
        let place = if let Some(line) = options.header_line {
            let nothing = || self.wrong(line, "nothing", "a line with the names of the columns");
            rows.iter()
                .position(|row| row.line == line)
                .ok_or_else(nothing)
                .map(Some)?
        } else {
            let alone = places().find(|&place| is_header(&rows[place..=place]));
            let found = alone.or_else(|| places().find(|&place| is_header(&rows[place..end(place)])));
            found.or_else(|| {
                places()
                    .filter(|_| !rows[0].is_numbers())
                    .max_by_key(|&place| rows[place].words())
            })
        };
        let is_toa5 = rows[0].cell(0) == "TOA5";
        let (first, mut data, mut names) = match place {
            Some(place) => (place, end(place), names(&rows[place..end(place)])),
            None => (
                0,
                0,
                layout
                    .unnamed
                    .iter()
                    .take(rows[0].cells.len())
                    .map(|name| layout.name(name, options))
                    .collect(),
            ),
        };
        let is_unit = |cell: &String| (layout.unit)(unit_in(cell)).is_some();
        let units = rows
            .get(data)
            .filter(|row| row.is_words() && row.cells.iter().any(is_unit));
        for (name, unit) in names.iter_mut().zip(units.iter().flat_map(|row| &row.cells)) {
            let unit = Some(unit_in(unit)).filter(|unit| !matches!(*unit, "" | "-"));
            name.unit = name.unit.take().or(unit.map(str::to_owned));
        }
        // The row of units is one of those that are skipped; a logger of Campbell's has one more.
        let few = usize::from(units.is_some());
        data += options
            .skip
            .map_or(few * (1 + usize::from(is_toa5)), |skip| few.max(skip as usize));
        (self.line, self.names) = (rows[first].line, names);
        self.rows.drain(..data.min(self.rows.len()));
        Ok(())
    }

    /// Makes sure that the columns are there, and rows as long as the header.
    fn check_columns(&self, options: &Options) -> Result<(), TableError> {
        let is_missing = |name: &&String| !self.names.iter().any(|other| is_same(&other.text, name));
        let chosen = options.columns.iter().map(|(_, name)| name).find(is_missing);
        if let Some(column) = chosen.map(String::as_str).or((self.layout.missing)(&self.names)) {
            return Err(self.missing(column));
        }
        let width = self.names.len();
        for row in &self.rows {
            let is_long = row.cells.iter().skip(width).any(|cell| !cell.is_empty());
            if is_long || (row.cells.len() < width && self.separator.is_some()) {
                let found = format!("{} cells where the first row has {width}", row.cells.len());
                let allowed = "as many: a decimal comma in a file separated by commas makes two of one; put it in quotes, or separate by semicolons";
                return Err(self.wrong(row.line, found, allowed));
            }
        }
        Ok(())
    }

    /// Finds what stands before the decimals of each column: by a cell that can be read in one way only, else as in another column.
    fn find_decimal_signs(&mut self, said: Option<char>) {
        let said = said.or(self.separator.is_none().then_some('.'));
        let certain = |row: &Row, column| match both(row.cell(column)) {
            [Some(_), None] => Some('.'),
            [None, Some(_)] => Some(','),
            _ => None,
        };
        for (column, name) in self
            .names
            .iter_mut()
            .enumerate()
            .filter(|(_, name)| (self.layout.is_number)(name))
        {
            name.decimal = said.or_else(|| self.rows.iter().find_map(|row| certain(row, column)));
        }
        let any = said.or_else(|| self.names.iter().find_map(|name| name.decimal));
        self.names
            .iter_mut()
            .for_each(|name| name.decimal = name.decimal.or(any));
    }

    /// What is wrong in a line of it.
    pub fn wrong(&self, line: u64, found: impl Into<String>, allowed: impl Into<String>) -> TableError {
        let (file, found, allowed) = (self.file.clone(), found.into(), allowed.into());
        TableError::Line {
            file,
            line,
            found,
            allowed,
        }
    }

    /// That a column is missing, what there is, and what may be the cause.
    fn missing(&self, column: &str) -> TableError {
        let names = self.names.iter().map(|name| &*name.text);
        let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
        let mut found = format!(
            "no column {column} in \"{}\" (read as ",
            shortened(&names.join(" | "), LONGEST)
        );
        match self.separator {
            None => found += "a workbook",
            Some(sign) => found += &format!("separated by {}s", word(sign)),
        }
        // One name that another separator would cut.
        let cuts = |sign: &char| matches!(names[..], [only] if only.contains(*sign));
        if let Some(sign) = [';', '\t', ',', ' '].into_iter().find(cuts) {
            found += &format!("; it looks separated by {}s", word(sign));
        }
        if !self.sheets.is_empty() {
            found += &format!("; other sheets: {}", self.sheets.join(", "));
        }
        self.wrong(self.line, found + ")", self.layout.allowed)
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
    /// [`TableError::Line`] where there are two.
    pub fn one(&self, kind: Kind) -> Result<Option<usize>, TableError> {
        let columns = self.of(kind);
        let Some(&second) = columns.get(1) else {
            return Ok(columns.first().copied());
        };
        let found = format!("a second column {}", self.names[second].text);
        let allowed = format!("one column of its kind: --column-{} chooses it", kind.name());
        Err(self.wrong(self.line, found, allowed))
    }

    /// The digits of the number in the cell of `row` in `column`, with a decimal point, and its unit, or that of the column `like` if it has none.
    /// `None` where there is no number.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for a number that can be read in two ways where no other cell decides.
    pub fn quantity<'t>(
        &'t self,
        row: &'t Row,
        column: usize,
        like: usize,
    ) -> Result<Option<(String, &'t str)>, TableError> {
        let (cell, name) = (row.cell(column), &self.names[column]);
        // Between commas a point stands before decimals.
        let is_open = name.decimal.is_none() && !(self.separator == Some(',') && cell.contains('.'));
        if let ([Some(a), Some(b)], true) = (both(cell), is_open)
            && a != b
        {
            let found = format!(
                "{}: found \"{}\", {} or {}",
                name.text,
                shortened(cell, LONGEST),
                a.min(b),
                a.max(b)
            );
            let allowed =
                "either: --decimal comma or --decimal point says which sign stands before the decimals";
            return Err(self.wrong(row.line, found, allowed));
        }
        let of_column = self.names[like].unit.as_deref().unwrap_or_default();
        let number = number(cell, name.decimal.unwrap_or('.'));
        Ok(number.map(|(digits, unit)| (digits, if unit.is_empty() { of_column } else { unit })))
    }

    /// The value in SI in the cell of `row` in `column`, of the kind of the column `like` and in its unit.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for what is no such value, and as for [`Table::quantity`].
    pub fn value(&self, row: &Row, column: usize, like: usize) -> Result<f64, TableError> {
        let (digits, unit) = self.quantity(row, column, like)?.unwrap_or_default();
        let kind = self.names[like].kind.unwrap_or(Kind(""));
        let value = (self.layout.si)(kind, &digits, unit);
        value.map_err(|allowed| self.wrong_cell(row, column, allowed))
    }

    /// That the cell of `row` in `column` does not hold what is `allowed`.
    pub fn wrong_cell(&self, row: &Row, column: usize, allowed: impl Into<String>) -> TableError {
        let name = &self.names[column];
        let (cell, decimal) = (row.cell(column), name.decimal.unwrap_or('.'));
        let other = if decimal == '.' { ',' } else { '.' };
        let is = |text: &str, decimal| number(text, decimal).is_some();
        let is_range = cell
            .split_once(['-', '–'])
            .is_some_and(|(from, to)| is(from, decimal) && is(to, decimal));
        let cause = match (is_range, cell.contains(other) && is(cell, other)) {
            (true, _) => ", a range in place of one number".to_owned(),
            (_, true) => format!(
                ", a decimal {} where other numbers have a {}",
                word(other),
                word(decimal)
            ),
            _ => String::new(),
        };
        // The unit that the bare name lacks.
        let unit = name
            .unit
            .as_deref()
            .filter(|_| name.bare != name.text && matches!(number(cell, decimal), Some((_, ""))));
        let cell = shortened(cell, LONGEST) + &unit.map_or_else(String::new, |unit| format!(" {unit}"));
        self.wrong(
            row.line,
            format!("{}: found \"{cell}\"{cause}", name.bare),
            allowed,
        )
    }
}

/// A unit in a row of them, without what may stand around it.
fn unit_in(cell: &str) -> &str {
    cell.trim_matches(|c| "~[]() ".contains(c))
}
