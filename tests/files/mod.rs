//! What the commands do to files: an output takes its place as a whole or not at all, and nothing else is touched. And what they
//! show of texts that are not to be trusted.

#![cfg(unix)]

mod common;
mod links;
#[cfg(target_os = "linux")]
mod places;
mod signals;
mod stopped;
mod texts;
mod whole;
