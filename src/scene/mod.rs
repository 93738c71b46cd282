//! The scene: everything a run needs to know, read from one TOML file.
//!
//! A scene says what lies where ([`Duct`], [`Ground`], [`Cable`]), what holds the cable ([`Friction`], [`Ends`],
//! [`Restraint`]), who drives above it ([`TrafficVehicle`], [`Traffic`]), how warm it gets ([`Heat`]) and, if wanted, how to compute ([`Solver`]). It
//! is plain data in SI: units are converted here, once, and nowhere else.
//!
//! # Rules of the file
//!
//! - A quantity is a string with its unit, `"1.2 m"`, or a bare number in SI. The units are those of
//!   [`Dimension::units`]. A dimensionless value is a bare number; `tolerance` may also be a percentage, `"1 %"`.
//! - Young's modulus of a layer may grow with depth: `young_modulus = { top = "60 MPa", bottom = "200 MPa" }`, linear
//!   from the layer's top to its bottom.
//! - Every section but `[[restraints]]`, `[heat]` and `[solver]` is required. A key that is not known is an error, as is a value
//!   out of its range: the first one found is reported with file, line, key, what was found and what is allowed
//!   ([`SceneError`]).
//!
//! # Presets
//!
//! `preset = "t-25"` in a vehicle, the cable, the friction or the ground stands for values with a known source
//! ([`crate::presets`]); keys given next to it override its values.
//!
//! # Overrides
//!
//! `KEY=VALUE` sets one key on top of the file: `friction.dynamic_coefficient=0.3`, `vehicles.0.speed=30 km/h`,
//! `ends.downstream={ spring = "3 MN/m" }`. The value is TOML; what is not valid TOML is taken as a string, so that
//! quotes can be left out. An empty value removes the key. Where two keys exclude each other, the one that was set later
//! wins over the file: `friction.law=coulomb` drops the file's `shape_factor`.
//!
//! # Example
//!
//! ```
//! use creepage::scene::{End, Scene};
//!
//! let text = std::fs::read_to_string("examples/scenes/full-scale-upper.toml")?;
//! let scene = Scene::from_toml("full-scale-upper.toml", &text)?;
//! assert_eq!(scene.duct.length, 30.0);
//! assert_eq!(scene.ends.downstream, End::Fixed);
//!
//! let error = Scene::from_toml("my.toml", &text.replace("1.2 m", "1.2 kN")).unwrap_err();
//! assert!(error.to_string().contains("found \"1.2 kN\""));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrangement;
mod cable_end;
mod check;
mod counted;
mod data;
mod document;
mod error;
mod file;
mod ground;
mod heat;
mod histogram;
mod key;
mod keys;
mod location;
mod nearest;
mod overrides;
mod preset;
mod quantity;
mod range;
mod read;
mod slips;
mod syntax;
mod table;
mod traffic;
mod typed;
mod units;
mod unusual;
mod value;
mod write;

pub use cable_end::CableEnd;
pub(crate) use data::DAYS_PER_YEAR;
#[cfg(feature = "calibrate")]
pub(crate) use data::words;
pub use data::{
    Arrangement, Cable, Duct, End, Ends, Friction, FrictionLaw, Ground, GroundModel, Heat, Order,
    PeakScaling, Restraint, Scene, Solver, SolverMethod, Traffic, TrafficVehicle, UnknownWord, Warming,
};
#[cfg(feature = "sweep")]
pub(crate) use error::did_you_mean;
pub use error::{SceneError, Wrong, WrongKind};
pub use file::SceneFile;
#[cfg(feature = "sweep")]
pub(crate) use key::nearest_key;
pub use key::{KeyMeaning, key_meanings};
#[cfg(feature = "sweep")]
pub(crate) use keys::si_unit;
pub use location::Location;
#[cfg(feature = "cli")]
pub(crate) use nearest::nearest;
pub use quantity::QuantityError;
#[cfg(feature = "sweep")]
pub(crate) use quantity::leading_number;
#[cfg(feature = "cli")]
pub(crate) use range::{PER_DAY, Range, YEARS};
pub use slips::UnitSlip;
pub use typed::{Typed, TypedValue};
pub use units::{Dimension, Unit};
pub(crate) use unusual::unusual;
pub(crate) use write::quoted;
