//! Numbers that were found by experiment, with what they cost or lose.

/// Linear solves after which the active set counts as cycling. With 8, six cables of 20 to 100 m with a soft sheath take 1.0 to 1.2 times
/// as long, and one of 10 m on 170 nodes 3.5 times: a tenth of its steps need 9 to 16. With 40 they take as long, two under Coulomb's law,
/// where it does cycle, up to 1.2 times.
pub(crate) const MAX_ITERATIONS: usize = 16;

/// A bisection of n nodes counts as n²/8 nodes of a linear solve; timed it was 10 solves at 50 nodes and 50 at 300. Only the counts of
/// work depend on it.
pub(crate) const NODES_OF_BISECTION: usize = 8;
