//! Jumps and days against the simulation of every pass.

mod days;
mod jumps;
