//! The tests of the crate in one program: each costs its link.

#[path = "half_space/main.rs"]
mod half_space;
#[path = "nasty_values.rs"]
mod nasty_values;
#[path = "properties.rs"]
mod properties;
#[path = "work.rs"]
mod work;
