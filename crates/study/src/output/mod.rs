//! Files that are written, and what keeps them from destroying others.
//!
//! A file is written beside its place under a name that nobody can guess, forced to the disk, and put
//! in its place as a whole: what was there before stays until then, also when the disk is full or the
//! process is stopped. The permissions of what is replaced are kept, and its owner where that is
//! allowed. A symbolic link stays one, and what it points to is replaced. What is no file of a disk,
//! such as `/dev/stdout`, `/dev/null` or a named pipe, is written as it is.
//!
//! A file that the same command reads is never replaced, nor is a file written twice: files are
//! compared by their identity, not by their names. An older file is replaced only if its name ends as
//! the output's does, any other by force alone.
//!
//! Limits: another name of the replaced file (a hard link) keeps the old content.

mod error;
mod files;
mod place;
mod target;
mod temporary;

pub use error::OutputError;
pub use files::Files;
pub use target::Output;
#[cfg(unix)]
pub use temporary::remove_all;
