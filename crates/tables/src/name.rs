//! The names of columns, and what they say of them.

use crate::options::Options;

/// A kind of column: the word by which its program calls it, and after it those of others, between spaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind(pub &'static str);

impl Kind {
    /// The word by which its program calls it.
    pub fn name(self) -> &'static str {
        self.0.split(' ').next().unwrap_or_default()
    }
}

/// What the names of a table may be.
#[derive(Debug)]
pub struct Names {
    /// The kinds of its columns; of those whose words a name has, the first counts.
    pub kinds: &'static [Kind],
    /// The kind to which [`Options::unit`] belongs.
    pub measured: Option<Kind>,
    /// Whether these are the names of its columns.
    pub is_header: fn(&[Name]) -> bool,
    /// Names of columns where the first row holds numbers.
    pub unnamed: &'static [&'static str],
    /// The symbol of the unit that a word stands for, whatever its case.
    pub unit: fn(&str) -> Option<&'static str>,
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
    /// Its unit: in brackets, after a slash, or as its last word. A row of units below the header adds those of other columns.
    pub unit: Option<String>,
    /// What the column holds: by the name's words, or because [`Options::columns`] say so, of no other column then.
    pub kind: Option<Kind>,
    /// Whether the options say so.
    pub chosen: bool,
}

impl Name {
    /// Whether one of its words is among these.
    pub fn has(&self, kind: Kind) -> bool {
        kind.0
            .split(' ')
            .any(|word| self.words.iter().any(|own| own == word))
    }

    /// Whether it was chosen, or is the word of its program for its kind and nothing else.
    pub fn is_own(&self) -> bool {
        self.chosen || self.kind.is_some_and(|kind| self.words.join("_") == kind.name())
    }
}

impl Names {
    /// The name in a cell of the header.
    pub fn name(&self, text: &str, options: &Options) -> Name {
        let text = text.trim_start_matches('~').trim();
        let (bare, mut unit) = self.bracketed(text);
        let mut words: Vec<&str> = bare
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .collect();
        if let (None, [_, .., last]) = (&unit, &words[..])
            && let Some(known) = (self.unit)(last)
        {
            words.truncate(words.len() - 1);
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
        let of = |kind: Kind| {
            options
                .columns
                .iter()
                .filter(move |(other, _)| other == kind.name())
        };
        let chosen = self
            .kinds
            .iter()
            .find(|kind| of(**kind).any(|(_, column)| is_same(column, text)));
        let by_words = self.kinds.iter().find(|kind| name.has(**kind));
        name.chosen = chosen.is_some();
        name.kind = chosen
            .or(by_words.filter(|kind| of(**kind).next().is_none()))
            .copied();
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
