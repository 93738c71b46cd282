#![doc = include_str!("../README.md")]

mod arrangement;
mod cable;
mod cable_end;
mod data;
mod document;
mod either;
mod error;
mod file;
mod ground;
mod histogram;
mod key;
mod keys;
mod kind;
mod location;
mod names;
mod nearest;
mod overrides;
mod preset;
pub mod presets;
mod quantity;
mod range;
mod rivals;
mod rules;
#[cfg(feature = "schema")]
mod schema;
mod shown;
mod traffic;
mod units;
mod unusual;
mod value;

pub use cable_end::CableEnd;
pub use data::{
    Arrangement, Cable, DAYS_PER_YEAR, Duct, End, Ends, Friction, FrictionLaw, Ground, GroundModel, Heat,
    Order, PeakScaling, Restraint, Scene, Solver, SolverMethod, Traffic, TrafficVehicle,
};
pub use error::{SceneError, Wrong, WrongKind, did_you_mean};
pub use file::{SceneFile, Typed, TypedValue};
pub use location::Location;
pub use names::{KeyMeaning, key_meanings, nearest_key, si_unit};
pub use nearest::nearest;
pub use quantity::{QuantityError, leading_number};
pub use range::{PER_DAY, Quantity, YEARS};
#[cfg(feature = "schema")]
pub use schema::schema;
pub use shown::{four_digits, quoted, shortened};
pub use units::{Dimension, Unit};
pub use unusual::unusual;
