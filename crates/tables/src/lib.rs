#![doc = include_str!("../README.md")]

mod error;
mod grid;
mod name;
mod number;
mod options;
mod table;
mod text;
#[cfg(feature = "xlsx")]
mod workbook;

pub use error::TableError;
pub use grid::Row;
pub use name::Name;
pub use number::is_number;
pub use options::{Decimal, Encoding, Options, Separator};
pub use table::{Cell, Names, Table};

/// Longest text that a message repeats \[characters\].
const LONGEST: usize = 80;

/// The text, or of one longer than so many characters the beginning and its length.
pub fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
        None => text.to_owned(),
    }
}
