//! What the reader is told of a file; the rest it recognises.

use std::str::FromStr;

use encoding_rs::Encoding as Standard;

/// How to read a table. What is `None` is recognised.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// What stands between cells.
    pub separator: Option<Separator>,
    /// What stands before the decimals.
    pub decimal: Option<Decimal>,
    /// How characters are written as bytes.
    pub encoding: Option<Encoding>,
    /// Line of the header, from 1; of a workbook the row of its sheet.
    pub header_line: Option<u64>,
    /// Rows below the header that hold no data, one of units among them.
    pub skip: Option<u64>,
    /// Sheet of a workbook; the first that holds anything if omitted.
    pub sheet: Option<String>,
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
    pub fn name(self) -> &'static str {
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
pub struct Encoding(pub(crate) &'static Standard);

impl FromStr for Encoding {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let label = match &*text.to_ascii_lowercase() {
            "latin-1" => "latin1",
            "cp932" => "shift_jis",
            _ => text,
        };
        match Standard::for_label(label.as_bytes()) {
            Some(standard) => Ok(Self(standard)),
            None => Err(format!(
                "found `{text}`; allowed: utf-8, utf-16, latin-1, shift_jis, or another name of the Encoding Standard"
            )),
        }
    }
}
