//! What a scene holds: plain data in SI.

pub use cable_dem::{End, FrictionLaw, Order, Restraint};
use ground_field::{SoilProfile, Vehicle};

use crate::either::{END, POINTS, PointKind};
use crate::key::keys;
use crate::kind::{List, Optional, Or, Word};
use crate::range::{
    APPROACH, DEPTH, DUCT_LENGTH, EXPANSION, INNER_DIAMETER, LATERAL_OFFSET, OFFSET, SLOPE, STEP, SWING,
    TIME_STEP, TOLERANCE,
};

/// Gives an enum its words: `WORDS`, `Display` and `FromStr`.
#[macro_export]
macro_rules! words {
    ($type:ident: $($variant:ident $word:literal),+) => {
        impl $type {
            /// Every value with its word.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$variant)),+];
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(match self {
                    $(Self::$variant => $word),+
                })
            }
        }

        impl std::str::FromStr for $type {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                let found = Self::WORDS.iter().find(|(word, _)| *word == text);
                let allowed = || [$($word),+].join(", ");
                found.map(|(_, value)| *value).ok_or_else(|| format!("found \"{text}\"; allowed: {}", allowed()))
            }
        }
    };
}

/// A cable in a duct under traffic, in SI.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Scene {
    /// Title; the file's name where the file gives none.
    pub title: String,
    /// Where the duct lies.
    pub duct: Duct,
    /// The ground around it.
    pub ground: Ground,
    /// The cable in it.
    pub cable: Cable,
    /// Friction between cable and duct.
    pub friction: Friction,
    /// What holds the cable's ends.
    pub ends: Ends,
    /// Clamps along the cable, as the file lists them.
    pub restraints: Vec<Restraint>,
    /// Vehicles, at least one; their shares sum to 1.
    pub vehicles: Vec<TrafficVehicle>,
    /// How many of them drive, in which order.
    pub traffic: Traffic,
    /// How warm the cable gets every day, where that is known.
    pub heat: Option<Heat>,
    /// How to compute.
    pub solver: Solver,
}

impl Scene {
    /// Largest friction per length of cable, q = μ_d N′ cos θ \[N/m\].
    pub fn friction_limit(&self) -> f64 {
        self.friction.dynamic_coefficient * self.cable.normal_load() * self.duct.cosine()
    }

    /// The heat of its days, if it makes any force.
    pub fn warming(&self) -> Option<&Heat> {
        let heat = self.heat.as_ref()?;
        let points = heat.profile.iter().flatten();
        let is_flat =
            heat.daily_swing.unwrap_or(0.0) == 0.0 && points.into_iter().all(|(_, kelvin)| *kelvin == 0.0);
        let without = heat.expansion == 0.0 || is_flat && heat.offset == 0.0;
        (!without).then_some(heat)
    }

    /// How far the duct's axis lies to the left of this vehicle's axis \[m\], seen in the direction of forward traffic.
    pub fn offset_from(&self, vehicle: &TrafficVehicle) -> f64 {
        self.duct.lateral_offset - vehicle.lateral_offset
    }

    /// Force of the cable's weight along the duct per length, p = −w sin θ \[N/m\], positive toward growing x.
    pub fn body_force(&self) -> f64 {
        -self.cable.weight * self.duct.sine()
    }
}

keys! {
    /// A straight duct at constant depth below a road that slopes as it does, from x = 0 to x = `length`; in SI.
    #[derive(Copy)]
    pub struct Duct {
        /// Length of the duct, from manhole to manhole.
        length: f64 = DUCT_LENGTH;
        /// Depth of the cable below the road surface.
        depth: f64 = DEPTH;
        /// How far the duct lies to the left of the first lane's axis, seen along forward traffic.
        lateral_offset: f64 = Or(LATERAL_OFFSET, 0.0), "0 m";
        /// How steeply the duct rises with x: tan θ.
        slope: f64 = Or(SLOPE, 0.0), "0";
        /// Inner diameter of the duct; needed for several cables in it.
        inner_diameter: Option<f64> = Optional(INNER_DIAMETER), "none";
    }
}

impl Duct {
    /// sin θ of the slope.
    pub fn sine(&self) -> f64 {
        self.slope / 1.0_f64.hypot(self.slope)
    }

    /// cos θ of the slope.
    pub fn cosine(&self) -> f64 {
        1.0 / 1.0_f64.hypot(self.slope)
    }
}

/// The ground and how to model it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Ground {
    /// Which model of the ground to use.
    pub model: GroundModel,
    /// Layers from the surface down. On a rigid base the last layer reaches down to it.
    pub profile: SoilProfile,
    /// Scales the computed displacements to a measured peak.
    pub scaling: Option<PeakScaling>,
}

/// Model of the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum GroundModel {
    /// The cheapest that is accurate enough.
    #[default]
    Auto,
    /// Homogeneous half-space, closed form.
    Boussinesq,
    /// Layers by Hankel transform.
    Burmister,
    /// Layers by axisymmetric finite elements.
    FiniteElements,
}

words!(GroundModel: Auto "auto", Boussinesq "boussinesq", Burmister "burmister", FiniteElements "fem");

/// A measured peak displacement of the duct that the ground model is scaled to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PeakScaling {
    /// `max|D_l|` of each vehicle \[m\], positive: each vehicle gets its own factor.
    Longitudinal(f64),
    /// `max|D_v|` of the first vehicle \[m\], positive: all vehicles get the factor of the first.
    Vertical(f64),
}

/// The cable.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Cable {
    /// Weight per length \[N/m\], positive.
    pub weight: f64,
    /// Axial stiffness EA \[N\], positive.
    pub axial_stiffness: f64,
    /// Normal force on the duct as a multiple of the weight, positive. For one of several cables it is that of its arrangement
    /// ([`Arrangement::normal_load_factor`]), which reading a scene sets.
    pub normal_load_factor: f64,
    /// Diameter \[m\], where it is known.
    pub diameter: Option<f64>,
    /// How it lies beside others in its duct.
    pub arrangement: Arrangement,
}

/// How a cable lies in its duct, alone or as one of three.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Arrangement {
    /// Alone.
    #[default]
    Single,
    /// On two others.
    TrefoilUpper,
    /// Under a third one, beside another.
    TrefoilLower,
    /// At the side of three in a row on the bottom of the duct.
    CradledOuter,
    /// Between two others on the bottom of the duct.
    CradledMiddle,
}

words!(
    Arrangement: Single "single", TrefoilUpper "trefoil-upper", TrefoilLower "trefoil-lower", CradledOuter "cradled-outer", CradledMiddle "cradled-middle"
);

impl Cable {
    /// Normal force between cable and duct per length N' in a level duct \[N/m\].
    pub fn normal_load(&self) -> f64 {
        self.normal_load_factor * self.weight
    }
}

/// Friction between cable and duct.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Friction {
    /// How friction follows slip.
    pub law: FrictionLaw,
    /// Dynamic friction coefficient `μ_d`, in \[0, 10\].
    pub dynamic_coefficient: f64,
}

keys! {
    /// What holds the cable's two ends.
    #[derive(Copy)]
    pub struct Ends {
        /// What holds the end at x = 0, where forward vehicles come in.
        upstream: End = END;
        /// What holds the end at x = length.
        downstream: End = END;
    }
}

/// A vehicle and how often it drives.
#[derive(Debug, Clone, PartialEq)]
pub struct TrafficVehicle {
    /// The vehicle: wheels, speed, direction and a name that no other has.
    pub vehicle: Vehicle,
    /// Its share of the passes; all shares sum to 1. With [`Order::Sequence`], its share of the sequence, which may be 0.
    pub share: f64,
    /// Its lane: how far its axis lies to the left of the line from which [`Duct::lateral_offset`] is measured \[m\], seen in the direction of
    /// forward traffic.
    pub lateral_offset: f64,
}

/// How many vehicles drive, in which order.
#[derive(Debug, Clone, PartialEq)]
pub struct Traffic {
    /// Number of passes, all vehicles together, at least 1.
    pub passes: u64,
    /// Vehicles a day, positive, where they are known: passes then have a time.
    pub per_day: Option<f64>,
    /// Which vehicle drives when.
    pub order: Order,
}

/// Days of a year, on average.
pub const DAYS_PER_YEAR: f64 = 365.25;

impl Traffic {
    /// The time after this pass \[years of 365.25 days\], where the vehicles a day are known.
    pub fn years_after(&self, pass: u64) -> Option<f64> {
        self.per_day
            .map(|per_day| pass as f64 / (DAYS_PER_YEAR * per_day))
    }
}

keys! {
    /// Heat of the cable: how much it expands, and how warm it is over a day that repeats; in SI. It has a swing or a profile.
    pub struct Heat {
        /// Thermal expansion of the cable per length and degree.
        expansion: f64 = EXPANSION;
        /// From the day's lowest to its highest mean temperature of the cable, a cosine over the day.
        daily_swing: Option<f64> = Optional(SWING), "`profile` instead";
        /// The day's lowest temperature above that at laying; added to a profile.
        offset: f64 = Or(OFFSET, 0.0), "0 K";
        /// Temperatures at times of the day, joined by straight lines, every day the same.
        profile: Option<Vec<(f64, f64)>> = Optional(List(PointKind, 2, POINTS)), "`daily_swing` instead";
    }
}

keys! {
    /// How to compute, in SI. What is `None` is chosen to suit the scene.
    #[derive(Copy)]
    pub struct Solver {
        /// How the passes are computed.
        method: SolverMethod = Or(METHOD, SolverMethod::Auto), "\"auto\"";
        /// Error allowed, as a share of the forces and of the movement of the ends.
        tolerance: f64 = Or(TOLERANCE, 0.01), "0.01";
        /// Distance between points of the cable that are computed.
        node_spacing: Option<f64> = Optional(STEP), "chosen";
        /// Advance of the vehicle from one computed place to the next.
        vehicle_step: Option<f64> = Optional(STEP), "chosen";
        /// Time step of the method `explicit`.
        time_step: Option<f64> = Optional(TIME_STEP), "chosen";
        /// How far beyond the duct's ends vehicles are followed.
        approach: Option<f64> = Optional(APPROACH), "as far as it matters";
    }
}

const METHOD: Word<SolverMethod> = Word {
    gone: Some((
        "dynamic",
        "inertia is computed by \"explicit\", and below 200 km/h it changes next to nothing",
    )),
    ..Word::of(SolverMethod::WORDS)
};

impl Default for Solver {
    /// All is chosen to suit the scene, for forces within 1 %.
    fn default() -> Self {
        Self {
            method: SolverMethod::Auto,
            tolerance: 0.01,
            node_spacing: None,
            vehicle_step: None,
            time_step: None,
            approach: None,
        }
    }
}

/// How the passes are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SolverMethod {
    /// The cheapest that is accurate enough.
    #[default]
    Auto,
    /// Implicit, without inertia.
    QuasiStatic,
    /// Explicit time steps, with inertia.
    Explicit,
    /// Without inertia too, but few passes are simulated, with jumps between them.
    PassLaw,
}

words!(SolverMethod: Auto "auto", QuasiStatic "quasi-static", Explicit "explicit", PassLaw "pass-law");

impl SolverMethod {
    /// Whether a time step has a meaning with this method.
    pub fn has_time_steps(self) -> bool {
        !matches!(self, Self::QuasiStatic | Self::PassLaw)
    }
}
