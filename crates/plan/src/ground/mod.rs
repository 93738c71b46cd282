//! From a scene to the motion of its duct: which model of the ground, how far along the road, under
//! which vehicle.

mod known;
mod model;
mod motion;
pub mod road;

pub use known::KnownGrounds;
pub use model::Ground;
pub use motion::{length_scale, load_ratio, peak};
