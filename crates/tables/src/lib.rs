#![doc = include_str!("../README.md")]

mod column;
mod error;
mod number;
mod options;
mod rows;
mod table;
mod text;
#[cfg(feature = "xlsx")]
mod workbook;

pub use column::{Kind, Layout, Name};
pub use error::TableError;
pub use number::is_no_value;
pub use options::Options;
pub use rows::Row;
pub use table::Table;

/// Longest text that a message repeats \[characters\].
const LONGEST: usize = 80;
/// Rows above the header at most: what a data logger says of itself.
const PREAMBLE: usize = 40;

/// The text, or of one longer than so many characters the beginning and its length.
pub fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
        None => text.to_owned(),
    }
}
