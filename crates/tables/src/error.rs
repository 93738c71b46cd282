//! What is wrong with a table, and where.

use std::error::Error;

pub type Result<T> = std::result::Result<T, TableError>;

/// What is wrong with a table, and where.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file of this name cannot be read, or is no workbook though it looks like one, and why.
    #[error("{0}: cannot be read")]
    Unreadable(String, #[source] Box<dyn Error + Send + Sync>),
    /// A line does not hold what it should, or the file as a whole.
    #[error("{file}{}: {found}; allowed: {allowed}", if *line > 0 { format!(":{line}") } else { String::new() })]
    Line {
        /// The file.
        file: String,
        /// The line, 0 if it is not known.
        line: u64,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
}

impl TableError {
    /// What was found in a line of a file, and what is allowed.
    pub fn line(file: &str, line: u64, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::Line {
            file: file.to_owned(),
            line,
            found: found.into(),
            allowed: allowed.into(),
        }
    }
}
