//! The tests of the crate in one program: each costs its link.

mod common;
mod laws;
mod nasty_values;
mod reference;
