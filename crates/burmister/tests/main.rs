//! The tests of the crate in one program: each costs its link.

mod answers_and_errors;
mod common;
mod laws;
mod nasty_values;
mod published_failures;
mod reference;
