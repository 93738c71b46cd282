//! The tests of the crate in one program: each costs its link.

#[path = "closed_form.rs"]
mod closed_form;
mod common;
#[path = "discrepancy.rs"]
mod discrepancy;
#[path = "learning.rs"]
mod learning;
#[path = "nasty_values.rs"]
mod nasty_values;
#[path = "terms.rs"]
mod terms;
