//! From a scene to its answer: ground, motion of the duct, cable, passes, and how wrong they may be.

pub mod balance;
pub mod cable;
pub mod error;
pub mod law;
pub mod levels;
pub mod motion;
pub mod passes;
pub mod profile;
pub mod result;
pub mod road;
pub mod run;
pub mod saturation;
