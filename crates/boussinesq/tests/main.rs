//! The tests of the crate in one program: each costs its link.

#[path = "half_space/main.rs"]
mod half_space;
mod nasty_values;
mod properties;
mod work;
