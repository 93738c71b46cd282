//! What the reader is told of a file; the rest it recognises.

use std::str::FromStr;

use encoding_rs::Encoding as Table;

use crate::scene::words;

/// How to read a table of readings. What is `None` or empty is recognised.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// What stands between cells.
    pub separator: Option<Separator>,
    /// What stands before the decimals.
    pub decimal: Option<Decimal>,
    /// How characters are written as bytes.
    pub encoding: Option<Encoding>,
    /// Columns by their names in the header.
    pub columns: ColumnNames,
    /// Unit of the forces, such as `kN`, whatever the header says.
    pub unit: Option<String>,
    /// How a further run begins.
    pub run_start: Option<RunStart>,
    /// Whether the cell counts tension as positive.
    pub tension_positive: bool,
}

/// Names of columns. A force or a movement may say its end: `upstream=NAME`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ColumnNames {
    /// Number of the pass.
    pub pass: Option<String>,
    /// Vehicles counted since the row before.
    pub vehicles: Option<String>,
    /// Forces, one a load cell.
    pub force: Vec<String>,
    /// Name of the run.
    pub run: Option<String>,
    /// Movements of the cable, one a transducer.
    pub movement: Vec<String>,
    /// Where along the duct the row was measured.
    pub position: Option<String>,
}

/// What stands between cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// A character.
    Character(char),
    /// Spaces, any number of them.
    Spaces,
}

impl Separator {
    /// In words.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Character('\t') => "tabs",
            Self::Character(';') => "semicolons",
            Self::Character(',') => "commas",
            Self::Character('|') => "|",
            Self::Character(_) => "a character of its own",
            Self::Spaces => "spaces",
        }
    }
}

impl FromStr for Separator {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "tab" | "\\t" | "\t" => Ok(Self::Character('\t')),
            "semicolon" | ";" => Ok(Self::Character(';')),
            "comma" | "," => Ok(Self::Character(',')),
            "|" => Ok(Self::Character('|')),
            "space" | " " => Ok(Self::Spaces),
            _ => Err(format!(
                "found `{text}`; allowed: comma, semicolon, tab, space, or one of , ; |"
            )),
        }
    }
}

/// What stands before the decimals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decimal {
    /// 94.1
    Point,
    /// 94,1
    Comma,
}

impl FromStr for Decimal {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "point" | "." => Ok(Self::Point),
            "comma" | "," => Ok(Self::Comma),
            _ => Err(format!("found `{text}`; allowed: point, comma, or one of . ,")),
        }
    }
}

/// How characters are written as bytes: the names of the WHATWG's Encoding Standard, and `utf-16` for either order of bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Encoding(pub(super) &'static Table);

impl FromStr for Encoding {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let label = if text.eq_ignore_ascii_case("latin-1") {
            "latin1"
        } else {
            text
        };
        match Table::for_label(label.as_bytes()) {
            Some(table) => Ok(Self(table)),
            None => Err(format!(
                "found `{text}`; allowed: utf-8, utf-16, latin-1, shift_jis, or another name of the Encoding Standard"
            )),
        }
    }
}

/// How a further run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunStart {
    /// With a cable at rest that no vehicle has passed.
    Rest,
    /// As the run before left the cable.
    Continue,
}

words!(RunStart: Rest "rest", Continue "continue");
