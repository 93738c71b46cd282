//! The tests of the crate in one program: each costs its link.

mod common;
#[path = "laws.rs"]
mod laws;
#[path = "nasty_values.rs"]
mod nasty_values;
#[path = "reference.rs"]
mod reference;
