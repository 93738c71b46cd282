//! The tests of the crate in one program: each costs its link.

#[path = "duct_motion.rs"]
mod duct_motion;
#[path = "nasty_values.rs"]
mod nasty_values;
