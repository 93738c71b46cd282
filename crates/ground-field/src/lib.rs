#![doc = include_str!("../README.md")]

mod displacement;
mod error;
mod field;
mod load;
mod motion;
mod peaks;
mod profile;
mod soil;
mod vehicle;

pub use displacement::Displacement;
pub use error::{GroundError, check_place, checked};
pub use field::GroundField;
pub use load::SurfaceLoad;
pub use motion::{DuctLine, DuctMotion};
pub use profile::RadialProfile;
pub use soil::{Base, Modulus, Soil, SoilLayer, SoilProfile};
pub use vehicle::{Direction, Vehicle, Wheel};
