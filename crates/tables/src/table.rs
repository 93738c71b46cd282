//! Names, units and rows of a table, and what its cells hold.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::TableError;
use crate::grid::{self, Grid, Row};
use crate::name::{Kind, Name, Names, is_same};
use crate::number::{Number, both, is_no_value, is_number, number};
use crate::options::{Options, in_words};
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
    /// What stands between cells, a space for any number of them; `None` in a workbook.
    pub separator: Option<char>,
    /// What is said of the decimal sign, and that of each column that was decided.
    decimal: Option<char>,
    decimals: Vec<Option<char>>,
    sheets: Vec<String>,
}

impl Table {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// As for [`Table::read`]; [`TableError::Unreadable`].
    pub fn from_file(path: &Path, options: &Options, names: &Names) -> Result<Self, TableError> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        let read = File::open(path).and_then(|open| open.take(names.most + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) => Self::read(&file, &bytes, options, names),
            Err(source) => Err(TableError::Unreadable(file, source)),
        }
    }

    /// Reads a text or a workbook from `bytes`; `file` stands for it in errors. Where no row is recognised as the header, the names are those
    /// of the row with the most words, or [`Names::unnamed`] where the first row holds numbers.
    ///
    /// # Errors
    ///
    /// [`TableError`] with the first thing that is wrong, and its line.
    pub fn read(file: &str, bytes: &[u8], options: &Options, names: &Names) -> Result<Self, TableError> {
        if bytes.len() as u64 > names.most {
            let (file, allowed) = (file.to_owned(), names.most);
            return Err(TableError::TooLarge { file, allowed });
        }
        let grid = grid(file, bytes, options)?;
        let Some(first) = grid.rows.first() else {
            return Err(TableError::Empty(file.to_owned()));
        };
        let (line, is_toa5) = (first.line, first.cell(0) == "TOA5");
        let mut table = Self {
            file: file.to_owned(),
            line,
            names: Vec::new(),
            rows: grid.rows,
            separator: grid.separator,
            decimal: options.decimal.or(grid.separator.is_none().then_some('.')),
            decimals: Vec::new(),
            sheets: grid.sheets,
        };
        let has_units = table.take_header(options, names)? && table.take_units(names);
        // The row of units is one of those that are skipped.
        let said = options.skip.map(|skip| skip.saturating_sub(u64::from(has_units)));
        let skipped = said.unwrap_or(u64::from(has_units && is_toa5)) as usize;
        table.rows.drain(..skipped.min(table.rows.len()));
        let is_there = |name: &str| table.names.iter().any(|other| is_same(&other.text, name));
        match options.columns.iter().find(|(_, name)| !is_there(name)) {
            Some((_, name)) => Err(table.missing(name, names.allowed)),
            None => Ok(table),
        }
    }

    /// Takes the names from the line that was said, else from the first row that is recognised, else from that with the most words. Where
    /// cells of it are merged, the row below says more. Whether there are names: not where the first row holds numbers.
    fn take_header(&mut self, options: &Options, names: &Names) -> Result<bool, TableError> {
        let rows = &self.rows;
        let below = |place: usize| {
            let row = rows.get(place + 1).filter(|row| row.is_words());
            row.filter(|_| rows[place].merged)
        };
        let read = |place: usize, below: Option<&Row>| {
            let lower = |column| below.map_or("", |below| below.cell(column));
            let cell = |column| format!("{} {}", rows[place].cell(column), lower(column));
            let columns = 0..rows[place].cells.len();
            let mut found: Vec<Name> = columns.map(|column| names.name(&cell(column), options)).collect();
            // Excel writes columns that were used once.
            while found.pop_if(|name| name.text.is_empty()).is_some() {}
            found
        };
        let places = || 0..rows.len().min(PREAMBLE);
        let recognised = || {
            let alone = places().find(|&place| (names.is_header)(&read(place, None)));
            alone.or_else(|| places().find(|&place| (names.is_header)(&read(place, below(place)))))
        };
        let likely = || {
            let is_word = |cell: &&String| cell.starts_with(char::is_alphabetic);
            let words = |place: usize| rows[place].cells.iter().filter(is_word).count();
            let numbers = rows[0].cells.iter().take(2).filter(|cell| is_number(cell));
            let place = places().max_by_key(|&place| (words(place), place));
            place.filter(|_| numbers.count() < 2)
        };
        let place = match options.header_line {
            None => recognised().or_else(likely),
            Some(line) => {
                let nothing = || self.wrong(line, "nothing", "a line with the names of the columns");
                let place = rows.iter().position(|row| row.line == line);
                Some(place.ok_or_else(nothing)?)
            }
        };
        let Some(place) = place else {
            let unnamed = names.unnamed.iter().take(rows[0].cells.len());
            self.names = unnamed.map(|name| names.name(name, options)).collect();
            return Ok(false);
        };
        let found = read(place, below(place));
        let end = place + 1 + usize::from(below(place).is_some());
        (self.line, self.names) = (rows[place].line, found);
        self.rows.drain(..end);
        Ok(true)
    }

    /// Takes the units from the first row, if that is what it holds: no number, and a unit at least.
    fn take_units(&mut self, names: &Names) -> bool {
        let bare = |cell: &String| cell.trim_matches(|c| "~[]() ".contains(c)).to_owned();
        let row = self.rows.first().filter(|row| row.is_words());
        let units: Vec<String> = row
            .into_iter()
            .flat_map(|row| row.cells.iter().map(bare))
            .collect();
        let has_units = units.iter().any(|cell| (names.unit)(cell).is_some());
        if has_units {
            self.rows.remove(0);
            for (name, unit) in self
                .names
                .iter_mut()
                .zip(units)
                .filter(|(_, unit)| !unit.is_empty() && unit != "-")
            {
                name.unit.get_or_insert(unit);
            }
        }
        has_units
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

    /// The columns of a kind: those that were chosen or that its own program writes, if any.
    pub fn of(&self, kind: Kind) -> Vec<usize> {
        let columns = |is: fn(&Name) -> bool| {
            let names = self.names.iter().enumerate();
            names
                .filter(|(_, name)| name.kind == Some(kind) && is(name))
                .map(|(column, _)| column)
                .collect()
        };
        let own: Vec<usize> = columns(Name::is_own);
        if own.is_empty() { columns(|_| true) } else { own }
    }

    /// The only column of a kind, if there is one.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] where there are two.
    pub fn one(&self, kind: Kind) -> Result<Option<usize>, TableError> {
        let columns = self.of(kind);
        match columns.get(1) {
            None => Ok(columns.first().copied()),
            Some(&second) => {
                let found = format!("a second column {}", self.name(second));
                let allowed = format!("one column of its kind: --column-{} chooses it", kind.name());
                Err(self.wrong(self.line, found, allowed))
            }
        }
    }

    /// That a column is missing, what there is, and what may be the cause.
    pub fn missing(&self, column: &str, allowed: &str) -> TableError {
        let names = self.names.iter().map(|name| &*name.text);
        let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
        let read_as = self.separator.map_or_else(|| "a workbook".into(), in_words);
        // One name that another separator would cut.
        let cuts = |sign: &char| matches!(names[..], [only] if only.contains(*sign));
        let other = [';', '\t', ',', ' '].into_iter().find(cuts);
        let looks = other.map(|sign| format!("; it looks separated by {}", in_words(sign)));
        let sheets = format!("; other sheets: {}", self.sheets.join(", "));
        let sheets = if self.sheets.is_empty() { "" } else { &sheets };
        let cause = looks.unwrap_or_default();
        let names = shortened(&names.join(" | "), LONGEST);
        let found =
            format!("no column {column} in \"{names}\" (read as separated by {read_as}{cause}{sheets})");
        self.wrong(self.line, found, allowed)
    }

    /// Makes sure that rows are as long as the header, and finds the decimal signs of these `columns`: by a cell of the column that can be read
    /// in one way only, else by one of the others.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] at a row with more or fewer cells than the header, or a number that can be read in two ways where no other cell
    /// decides.
    pub fn decide(&mut self, columns: &[usize]) -> Result<(), TableError> {
        let width = self.names.len();
        let fits = |row: &Row| {
            let beyond = row.cells.iter().skip(width).any(|cell| !cell.is_empty());
            !beyond && (row.cells.len() >= width || self.separator.is_none())
        };
        if let Some(row) = self.rows.iter().find(|row| width > 0 && !fits(row)) {
            let found = format!("{} cells where the first row has {width}", row.cells.len());
            let allowed = "as many: a decimal comma in a file separated by commas makes two of one; put it in quotes, or separate by semicolons";
            return Err(self.wrong(row.line, found, allowed));
        }
        let certain = |&column: &usize| {
            self.rows.iter().find_map(|row| match both(row.cell(column)) {
                [Some(_), None] => Some('.'),
                [None, Some(_)] => Some(','),
                _ => None,
            })
        };
        let own: Vec<Option<char>> = columns
            .iter()
            .map(|column| self.decimal.or_else(|| certain(column)))
            .collect();
        let any = own.iter().flatten().next().copied();
        let mut decimals = vec![None; width];
        for (&column, own) in columns.iter().zip(own) {
            decimals[column] = own.or(any);
            for row in self.rows.iter().filter(|_| decimals[column].is_none()) {
                let cell = row.cell(column);
                // Between commas a point stands before decimals.
                let is_point = self.separator == Some(',') && cell.contains('.');
                let [Some(a), Some(b)] = both(cell) else { continue };
                if a != b && !is_point {
                    let (name, cell) = (self.name(column), shortened(cell, LONGEST));
                    let found = format!("{name}: found \"{cell}\", {} or {}", a.min(b), a.max(b));
                    let allowed = "either: --decimal comma or --decimal point says which sign stands before the decimals";
                    return Err(self.wrong(row.line, found, allowed));
                }
            }
        }
        self.decimals = decimals;
        Ok(())
    }

    fn name(&self, column: usize) -> &str {
        self.names.get(column).map_or("", |name| &name.text)
    }

    fn decimal(&self, column: usize) -> char {
        let decided = self.decimals.get(column).copied().flatten();
        decided.or(self.decimal).unwrap_or('.')
    }

    /// The number in the cell of `row` in `column`; `None` where nothing or a word for no value stands there.
    ///
    /// # Errors
    ///
    /// [`TableError::Line`] for any other text.
    pub fn number<'r>(&self, row: &'r Row, column: usize) -> Result<Option<Number<'r>>, TableError> {
        let cell = row.cell(column);
        if cell.is_empty() || is_no_value(cell) {
            return Ok(None);
        }
        let number = number(cell, self.decimal(column));
        number
            .map(Some)
            .ok_or_else(|| self.wrong_cell(row, column, "a finite number"))
    }

    /// The digits of the number in the cell of `row` in `column`, with a decimal point, and its unit, or that of the column if it has none.
    pub fn quantity<'t>(&'t self, row: &'t Row, column: usize) -> Option<(String, &'t str)> {
        let number = number(row.cell(column), self.decimal(column))?;
        let of_column = self.names.get(column).and_then(|name| name.unit.as_deref());
        let unit = if number.unit.is_empty() {
            of_column.unwrap_or("")
        } else {
            number.unit
        };
        Some((number.digits, unit))
    }

    /// The same as one text, or what else the cell holds.
    pub fn written(&self, row: &Row, column: usize) -> String {
        let quantity = self
            .quantity(row, column)
            .map(|(digits, unit)| format!("{digits} {unit}"));
        quantity.map_or_else(|| row.cell(column).to_owned(), |text| text.trim_end().to_owned())
    }

    /// That the cell of `row` in `column` does not hold what is `allowed`.
    pub fn wrong_cell(&self, row: &Row, column: usize, allowed: impl Into<String>) -> TableError {
        let cell = shortened(row.cell(column), LONGEST);
        let decimal = self.decimal(column);
        let is = |text: &str, decimal| number(text, decimal).is_some();
        let ends = cell.split_once(['-', '–']);
        let cause = match decimal {
            _ if ends.is_some_and(|(from, to)| is(from, decimal) && is(to, decimal)) => {
                ", a range in place of one number"
            }
            '.' if cell.contains(',') && is(&cell, ',') => {
                ", a decimal comma where other numbers have a point"
            }
            ',' if cell.contains('.') && is(&cell, '.') => {
                ", a decimal point where other numbers have a comma"
            }
            _ => "",
        };
        let found = format!("{}: found \"{cell}\"{cause}", self.name(column));
        self.wrong(row.line, found, allowed)
    }
}

fn grid(file: &str, bytes: &[u8], options: &Options) -> Result<Grid, TableError> {
    #[cfg(feature = "xlsx")]
    if crate::workbook::is_workbook(bytes) {
        return crate::workbook::read(file, bytes, options.sheet.as_deref());
    }
    let text = text::decoded(bytes, options.encoding).ok_or_else(|| TableError::NoText {
        file: file.to_owned(),
        named: options.encoding.map(encoding_rs::Encoding::name),
    })?;
    grid::read(file, &text, options.separator)
}
