//! The names of columns, and what they say of them.

use crate::options::Options;
use crate::rows::Row;

/// A kind of column: the word of its program for it and, between spaces, those of others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind(pub &'static str);

impl Kind {
    /// The word by which its program calls it.
    pub fn name(self) -> &'static str {
        self.0.split(' ').next().unwrap_or_default()
    }
}

/// What the columns of a table may be.
#[derive(Debug)]
pub struct Layout {
    /// The kinds of its columns; of those whose words a name has, the first counts.
    pub kinds: &'static [Kind],
    /// The kind to which [`Options::unit`] belongs.
    pub measured: Option<Kind>,
    /// The column that is missing among these, if they are not the names of its columns.
    pub missing: fn(&[Name]) -> Option<&'static str>,
    /// Whether a column of this name holds numbers.
    pub is_number: fn(&Name) -> bool,
    /// Names of columns where the first row holds numbers.
    pub unnamed: &'static [&'static str],
    /// The symbol of the unit that a word stands for, whatever its case.
    pub unit: fn(&str) -> Option<&'static str>,
    /// The value in SI of a cell's digits and unit in a column of a kind, both empty if it is no
    /// number; or what is allowed there.
    pub si: fn(Kind, &str, &str) -> Result<f64, String>,
    /// Largest file \[bytes\].
    pub most: u64,
    /// What a table has to have, as errors say it.
    pub allowed: &'static str,
}

/// A column's name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Name {
    /// As the file has it.
    pub text: String,
    /// Without its unit, if this stands in brackets or after a slash.
    pub bare: String,
    /// Its words in small letters.
    pub words: Vec<String>,
    /// Its unit: in brackets, after a slash, as its last word, or in a row of units below.
    pub unit: Option<String>,
    /// What the column holds: by the name's words, unless [`Options::columns`] name one of this kind.
    pub kind: Option<Kind>,
    /// Whether the options say so.
    pub chosen: bool,
    /// What stands before the decimals of its numbers, as far as it is known.
    pub(crate) decimal: Option<char>,
}

impl Name {
    /// Whether one of its words is among these.
    pub fn has(&self, kind: Kind) -> bool {
        let is_own = |word| self.words.iter().any(|own| own == word);
        kind.0.split(' ').any(is_own)
    }

    /// Whether it was chosen, or is the word of its program for its kind and nothing else.
    pub fn is_own(&self) -> bool {
        self.chosen || self.kind.is_some_and(|kind| self.words.join("_") == kind.name())
    }
}

impl Layout {
    /// The names in a header of one or more rows.
    pub(crate) fn names(&self, rows: &[Row], options: &Options) -> Vec<Name> {
        let cells = |column| rows.iter().map(move |row| row.cell(column));
        let text = |column| cells(column).collect::<Vec<_>>().join(" ");
        let columns = 0..rows.first().map_or(0, |row| row.cells.len());
        let mut names: Vec<Name> = columns.map(|column| self.name(&text(column), options)).collect();
        // Excel writes columns that were used once.
        while names.pop_if(|name| name.text.is_empty()).is_some() {}
        names
    }

    /// The name in a cell of the header.
    pub fn name(&self, text: &str, options: &Options) -> Name {
        let text = text.trim_start_matches('~').trim();
        let (bare, mut unit) = self.bracketed(text);
        let words = bare.split(|c: char| !c.is_alphanumeric());
        let mut words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        if let (None, [_, .., last]) = (&unit, &words[..])
            && let Some(known) = (self.unit)(last)
        {
            words.pop();
            words.pop_if(|word| *word == "in");
            unit = Some(known.to_owned());
        }
        let words = words.iter().map(|word| word.to_lowercase()).collect();
        let mut name = Name {
            text: text.to_owned(),
            words,
            unit,
            bare,
            ..Name::default()
        };
        let columns = options.columns.iter();
        let said = |kind: Kind| columns.clone().filter(move |(said, _)| said == kind.name());
        let is_chosen = |kind: &&Kind| said(**kind).any(|(_, column)| is_same(column, text));
        let chosen = self.kinds.iter().find(is_chosen);
        let by_words = self.kinds.iter().find(|kind| name.has(**kind));
        let is_open = |kind: &&Kind| said(**kind).next().is_none();
        name.chosen = chosen.is_some();
        name.kind = chosen.or(by_words.filter(is_open)).copied();
        if name.kind.is_some() && name.kind == self.measured && options.unit.is_some() {
            name.unit.clone_from(&options.unit);
        }
        name
    }

    /// The name without the unit that stands in brackets or after a slash, and that unit.
    fn bracketed(&self, text: &str) -> (String, Option<String>) {
        for (open, close) in [('[', ']'), ('(', ')')] {
            if let Some((before, rest)) = text.split_once(open)
                && let Some((inside, after)) = rest.split_once(close)
            {
                let bare = format!("{} {}", before.trim(), after.trim());
                return (bare.trim().to_owned(), Some(inside.trim().to_owned()));
            }
        }
        match text.rsplit_once('/') {
            Some((before, after)) if (self.unit)(after.trim()).is_some() => {
                (before.trim().to_owned(), Some(after.trim().to_owned()))
            }
            _ => (text.to_owned(), None),
        }
    }
}

/// Whether two names are the same, whatever their case.
pub fn is_same(one: &str, other: &str) -> bool {
    one.trim().to_lowercase() == other.trim().to_lowercase()
}
