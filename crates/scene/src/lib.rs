#![doc = include_str!("../README.md")]

mod arrangement;
mod cable;
mod cable_end;
mod check;
mod content;
mod document;
mod error;
mod file;
mod ground;
mod heat;
mod histogram;
mod key;
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
mod scene;
#[cfg(feature = "schema")]
mod schema;
mod shown;
mod solver;
mod stored;
mod traffic;
mod units;
mod unusual;
mod vehicle;
mod words;

pub use arrangement::Arrangement;
pub use cable::{Cable, Friction, Law};
pub use cable_dem::{End, FrictionLaw, Order, Restraint};
pub use cable_end::CableEnd;
pub use error::{SceneError, Wrong, WrongKind, did_you_mean};
pub use file::{SceneFile, Typed, TypedValue};
pub use ground::{Ground, GroundModel, Layer, PeakScaling};
pub use heat::Heat;
pub use histogram::Histogram;
pub use location::Location;
pub use names::{KeyMeaning, key_meanings, nearest_key, si_unit};
pub use nearest::nearest;
pub use quantity::{QuantityError, leading_number};
pub use range::{PER_DAY, Quantity, YEARS};
pub use scene::{Duct, Ends, Scene};
#[cfg(feature = "schema")]
pub use schema::schema;
pub use shown::{four_digits, quoted, shortened};
pub use solver::{Solver, SolverMethod};
pub use traffic::{DAYS_PER_YEAR, Following, Traffic};
pub use units::{Dimension, Unit};
pub use unusual::unusual;
pub use vehicle::{TrafficVehicle, Wheel};
