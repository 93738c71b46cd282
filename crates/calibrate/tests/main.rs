//! The tests of the crate in one program: each costs its link.

mod closed_form;
mod common;
mod discrepancy;
mod learning;
mod nasty_values;
mod terms;
