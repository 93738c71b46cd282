//! The tests of the crate in one program: each costs its link.

mod duct_motion;
mod nasty_values;
