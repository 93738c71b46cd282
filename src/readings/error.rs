//! What is wrong with a file of readings, and where.

use std::borrow::Cow;

/// What is wrong with a data file, and where.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataError {
    /// The file of this name cannot be read, and why.
    #[error("{0}: cannot be read")]
    Unreadable(String, #[source] std::io::Error),
    /// The file is far larger than any readings.
    #[error("{file}: found more than {allowed} bytes; allowed: a table of at most {allowed} bytes")]
    TooLarge {
        /// The file.
        file: String,
        /// Largest size allowed \[bytes\].
        allowed: u64,
    },
    /// The bytes are no text.
    #[error("{file}: found bytes that are no text{}; allowed: a table as text (UTF-8, UTF-16, Latin-1; --encoding chooses) or an Excel workbook (.xlsx)",
        .named.map_or_else(String::new, |named| format!(" in {named}")))]
    NoText {
        /// The file.
        file: String,
        /// The encoding that was asked for.
        named: Option<&'static str>,
    },
    /// The file is no table.
    #[error("{file}:{line}: not a table")]
    Table {
        /// The file.
        file: String,
        /// The line, 0 where it is not known.
        line: u64,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A line does not hold what it should: a column, a number, a sigma where others have one.
    #[error("{file}:{line}: {found}; allowed: {allowed}")]
    Line {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: Cow<'static, str>,
    },
    /// There is nothing in the file of this name.
    #[error("{0}: no readings; allowed: a table with the columns pass,force_n[,sigma_n]")]
    Empty(String),
    /// Fewer readings than parameters.
    #[error(
        "{file}: {readings} readings, the last on line {line}; needed for {parameters} parameters: {needed}"
    )]
    TooFew {
        /// The file.
        file: String,
        /// Number of readings.
        readings: usize,
        /// Line of the last.
        line: u64,
        /// Parameters to be fitted.
        parameters: usize,
        /// Fewest readings.
        needed: usize,
    },
}
