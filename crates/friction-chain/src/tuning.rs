//! Numbers that were found by experiment, with what they cost or lose.
//!
//! Times are those of nine cables of 30 to 1000 m under one to five wheels, relative to the value that stands here.

/// Linear solves after which the active set counts as cycling. With 4 it takes 1.0 to 1.9 times as long, with 6 or 12 as long.
pub(crate) const MAX_ITERATIONS: usize = 8;

/// A bisection of n nodes counts as n²/8 nodes of a linear solve; timed it was 10 solves at 50 nodes and 50 at 300. Only the counts of
/// work depend on it.
pub(crate) const NODES_OF_BISECTION: usize = 8;
