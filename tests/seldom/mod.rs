//! Traffic in which some vehicles come seldom, or in a long sequence: jumps against every pass simulated.

mod extremes;
mod mixes;
mod random_order;
mod scenes;
mod shares;
