//! The tests of the crate in one program: each costs its link.

#[path = "answers_and_errors.rs"]
mod answers_and_errors;
mod common;
#[path = "laws.rs"]
mod laws;
#[path = "nasty_values.rs"]
mod nasty_values;
#[path = "published_failures.rs"]
mod published_failures;
#[path = "reference.rs"]
mod reference;
