//! Solver by solver on the full-scale experiment's cable: answers, faults, counts of work, and whatever the numbers.

mod common;
mod dynamic;
mod explicit;
mod explicit_faults;
mod nasty_values;
mod work;
