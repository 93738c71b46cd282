//! Solver by solver on the full-scale experiment's cable: answers, faults, counts of work, and whatever the numbers.

mod common;
mod explicit;
mod explicit_faults;
mod inertia;
#[path = "../shared/mirrored.rs"]
mod mirrored;
mod nasty_values;
mod sigmoid;
mod work;
