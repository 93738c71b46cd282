//! Many passes at the cost of one: the homogenised law of cable creepage.
//!
//! Watched after each pass, friction between a cable and its duct varies slowly along the duct, away from the ends. Over a
//! few depths it is a constant, the *locked friction* f̄, and one pass adds a displacement that depends on f̄ alone, G(f̄). So
//! many passes are a nonlinear diffusion in the pass number n,
//!
//! a + ℓ ∂a/∂x = G(f̄),  a = ∂u/∂n,  f̄ = −EA ∂²u/∂x²,
//!
//! with u the cable's displacement and ℓ(f̄) the lag with which the advance follows friction along the duct. G falls with f̄
//! and crosses zero at f* < q: a saturated duct has f̄ = f* everywhere.
//!
//! - [`AdvanceLaw`]: G and ℓ of one vehicle, from single passes over a short cell ([`cable_dem::QuasiStatic`]).
//! - [`MixedLaw`]: several vehicles and both directions by their shares.
//! - [`PassLaw`]: a cable with its ends; [`PassLaw::run`] gives forces and movements after any listed passes, a thousand
//!   million as soon as ten, [`PassLaw::saturation`] the closed forms, [`PassLaw::concerns`] what speaks against the law.
//!
//! # Assumptions
//!
//! Quasi-static passes, friction with memory, uniform ground, duct and cable; friction that varies slowly along the duct and
//! from pass to pass, so that the order of the vehicles does not matter. The ends' layers, a few depths long, are taken in
//! their steady state from direct runs at each end. The first few passes are therefore rough; from about the tenth on
//! forces agree with the simulation of every pass within a per cent; near shakedown, within a few per cent of the saturated
//! force.
//!
//! SI units throughout; forces in the cable are positive in compression.
//!
//! ```
//! use boussinesq::HalfSpace;
//! use cable_dem::{DuctedCable, End, Friction, FrictionLaw};
//! use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
//! use pass_law::{PassLaw, Resolution};
//!
//! let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
//! let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
//! let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 500.0, 1e-8)?;
//!
//! let q = 0.25 * 108.8;
//! let friction = Friction::new(FrictionLaw::ElasticPlastic { shape_factor: 2e8 / q }, q)?;
//! let cable = DuctedCable::new(300.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
//!
//! let law = PassLaw::new(&cable, &[(motion, 1.0)], Resolution::new(1.2)?)?;
//! assert!(law.concerns().is_empty());
//! let evolution = law.run(&[100, 10_000, 10_000_000])?;
//! let force = evolution.records[2].downstream_force;
//! assert!((force / law.saturation().unwrap().downstream_force - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod advance;
mod applicability;
mod cell;
mod error;
mod evolution;
mod grid;
mod layer;
mod mix;
mod pass_law;
mod resolution;
mod saturation;
mod slow;
mod table;
mod tridiagonal;

pub use advance::{AdvanceLaw, LawStatistics};
pub use applicability::{Concern, concerns_before};
pub use error::LawError;
pub use evolution::{Evolution, EvolutionStatistics, MOST_PASSES, PassRecord};
pub use mix::MixedLaw;
pub use pass_law::{PassLaw, Preparation};
pub use resolution::Resolution;
pub use saturation::Saturation;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
