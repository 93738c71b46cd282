//! Where the law does not apply, or hardly.
//!
//! The law rests on friction that stays where it was locked, on friction that varies slowly along the duct, and on an
//! advance that a short piece of duct can show. Before anything is computed, [`concerns_before`] looks at the cable and the
//! duct; [`PassLaw::concerns`] adds what only the computed advance can tell.

use cable_dem::DuctedCable;

use crate::{PassLaw, Resolution};

/// A duct shorter than this many depths consists of its ends' layers.
const SHORTEST: f64 = 12.0;
/// Below this share of the duct's largest displacement a pass hardly advances the cable.
const SMALL_ADVANCE: f64 = 0.01;
/// Below this share of q locked friction is small beside the ends' layers: forces were found 5 to 30 % off, and within 5 %
/// above it.
const NEAR_SHAKEDOWN: f64 = 0.12;
/// Above this share of q the vehicle's effect reaches along the whole duct.
const NEAR_LIMIT: f64 = 0.85;

/// A reason to simulate every pass instead.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Concern {
    /// Friction without memory locks nothing in; there is no law.
    NoMemory,
    /// The duct is not much longer than the layers at its ends.
    ShortDuct {
        /// Length of the duct \[m\].
        length: f64,
        /// Length from which on the law holds \[m\].
        needed: f64,
    },
    /// The cable follows its duct elastically, and creepage shakes down: at once, or after a few passes that the law does not
    /// resolve.
    ShakesDown {
        /// |G(0)| \[m\].
        advance: f64,
        /// Largest longitudinal displacement of the duct \[m\].
        peak: f64,
    },
    /// The cable is so near to following its duct that what it locks in is small beside what the first passes leave at its ends,
    /// which the law takes as if it had always been there.
    NearShakedown {
        /// |f*|/q.
        share: f64,
    },
    /// Opposing traffic cancels: the cable stays, but for what the order of the vehicles and the ends do.
    Balanced,
    /// Saturated friction is so near its limit that a vehicle's effect reaches along the whole duct.
    NearLimit {
        /// |f*|/q.
        share: f64,
    },
    /// There are clamps; layers around them are left out of account.
    Clamps,
}

impl Concern {
    /// Whether the law must not be used at all; otherwise its answer is rough.
    pub fn is_fatal(self) -> bool {
        matches!(self, Self::NoMemory | Self::ShortDuct { .. })
    }
}

impl std::fmt::Display for Concern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoMemory => write!(f, "friction without memory locks nothing in"),
            Self::ShortDuct { length, needed } => {
                write!(
                    f,
                    "a duct of {length} m is mostly ends; the law needs about {needed:.0} m"
                )
            }
            Self::ShakesDown { advance, peak } => write!(
                f,
                "the cable follows its duct: it advances by {advance:.1e} m a pass where the duct moves by {peak:.1e} m"
            ),
            Self::NearShakedown { share } => {
                write!(f, "near shakedown: saturated friction is {share:.2} of its limit")
            }
            Self::Balanced => write!(f, "opposing traffic cancels"),
            Self::NearLimit { share } => {
                write!(f, "saturated friction is {share:.2} of its limit")
            }
            Self::Clamps => write!(f, "what clamps change in the friction around them is left out"),
        }
    }
}

/// Concerns that need no computation.
pub fn concerns_before(cable: &DuctedCable, resolution: Resolution) -> Vec<Concern> {
    let mut concerns = Vec::new();
    if !cable.friction().law().has_memory() {
        concerns.push(Concern::NoMemory);
    }
    let needed = SHORTEST * resolution.depth();
    if cable.length() < needed {
        concerns.push(Concern::ShortDuct {
            length: cable.length(),
            needed,
        });
    }
    if !cable.restraints().is_empty() {
        concerns.push(Concern::Clamps);
    }
    concerns
}

impl PassLaw {
    /// Everything that speaks against this law; empty where it applies.
    pub fn concerns(&self) -> Vec<Concern> {
        let mut concerns = concerns_before(self.cable(), self.resolution);
        let law = self.law();
        let (advance, peak) = (law.free_advance().abs(), law.peak_longitudinal());
        let alone = law
            .parts()
            .iter()
            .map(|(_, law)| law.free_advance().abs())
            .fold(0.0, f64::max);
        let largest = law
            .parts()
            .iter()
            .map(|(_, law)| law.saturation().abs() / law.friction_limit())
            .fold(0.0, f64::max);
        if alone < SMALL_ADVANCE * peak {
            concerns.push(Concern::ShakesDown { advance, peak });
        } else if largest < NEAR_SHAKEDOWN {
            concerns.push(Concern::NearShakedown { share: largest });
        } else if advance < SMALL_ADVANCE * alone {
            concerns.push(Concern::Balanced);
        }
        let share = law.saturation().abs() / law.friction_limit();
        if share > NEAR_LIMIT {
            concerns.push(Concern::NearLimit { share });
        }
        concerns
    }
}
