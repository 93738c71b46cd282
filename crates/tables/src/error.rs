//! What is wrong with a table, and where.

pub type Result<T> = std::result::Result<T, TableError>;

/// What is wrong with a table, and where. The first text of each is the name of the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be read, and why.
    #[error("{0}: cannot be read")]
    Unreadable(String, #[source] std::io::Error),
    /// The file is far larger than any table of its kind.
    #[error("{file}: found more than {allowed} bytes; allowed: a table of at most {allowed} bytes")]
    TooLarge {
        /// The file.
        file: String,
        /// Largest size allowed \[bytes\].
        allowed: u64,
    },
    /// The bytes are no text, in the encoding that was asked for if any.
    #[error("{0}: found bytes that are no text{named}; allowed: a table as text (UTF-8, UTF-16, Latin-1, Shift_JIS; `encoding` chooses) or an Excel workbook (.xlsx)",
        named = .1.map_or_else(String::new, |named| format!(" in {named}")))]
    NoText(String, Option<&'static str>),
    /// The file looks like a workbook and is none.
    #[error("{0}:0: not a table")]
    NotTable(String, #[source] Box<dyn std::error::Error + Send + Sync>),
    /// A line does not hold what it should.
    #[error("{file}:{line}: {found}; allowed: {allowed}")]
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
    /// There is nothing in the file.
    #[error("{0}: no rows; allowed: a table with names of its columns")]
    Empty(String),
}
