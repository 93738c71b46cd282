//! The days of a plan whose cable is heated.

mod day_simulator;
mod days_on_meshes;
mod locked_law;
mod record;

pub use days_on_meshes::solve;
