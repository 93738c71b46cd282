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

/// The text, or of a long one the beginning and its length.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 80;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
        None => text.to_owned(),
    }
}
