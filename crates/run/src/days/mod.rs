//! The days of a plan whose cable is heated.

mod heated_days;
mod locked_law;
mod on_meshes;

pub use on_meshes::solve;
