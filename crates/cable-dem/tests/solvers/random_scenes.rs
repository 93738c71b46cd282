//! Random cables under a vehicle that comes and goes.

use std::ops::Range;

use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint};
use proptest::prelude::*;

use super::harness::{Drive, Kind, Problem, Run};

/// A cable, the duct's motion, and the traffic over it: 0 forward, 1 back. What changes under a symmetry or a scaling.
#[derive(Debug, Clone)]
pub struct Scene {
    pub length: f64,
    pub axial_stiffness: f64,
    pub friction: Friction,
    /// Weight along the duct, of the friction limit.
    pub steepness: f64,
    pub ends: (End, End),
    pub clamps: Vec<Restraint>,
    /// Displacement and length of the duct's motion, and the part that pushes it forward.
    pub peak: f64,
    pub width: f64,
    pub pushed: f64,
    pub speed: f64,
    /// Node spacing and vehicle step.
    pub mesh: (f64, f64),
    pub traffic: Vec<usize>,
}

/// What scenes are drawn from; all else is the same for all of them.
pub struct Drawn {
    pub longest: f64,
    pub axial_stiffness: Range<f64>,
    /// Logarithm of the shape factor, of laws with memory and of the sigmoid if any.
    pub shape_factor: Range<f64>,
    pub sigmoid: bool,
    pub peak: Range<f64>,
    pub width: Range<f64>,
    pub speed: Range<f64>,
}

impl Default for Drawn {
    fn default() -> Self {
        Self {
            longest: 12.0,
            axial_stiffness: 1e6..2e7,
            shape_factor: 4.0..8.5,
            sigmoid: true,
            peak: 1e-6..1e-4,
            width: 0.5..2.0,
            speed: 3.0..40.0,
        }
    }
}

fn any_end() -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (1e4..1e7_f64).prop_map(End::Spring)
    ]
}

fn any_law(exponents: Range<f64>, sigmoid: bool) -> impl Strategy<Value = FrictionLaw> {
    (0..if sigmoid { 3 } else { 2 }, exponents).prop_map(|(law, exponent)| {
        let shape_factor = 10.0_f64.powf(exponent);
        match law {
            0 => FrictionLaw::Coulomb,
            1 => FrictionLaw::ElasticPlastic { shape_factor },
            _ => FrictionLaw::Sigmoid { shape_factor },
        }
    })
}

impl Drawn {
    pub fn scenes(self) -> impl Strategy<Value = Scene> {
        let steepness = prop_oneof![Just(0.0), -0.9..0.9_f64];
        (
            (5.0..self.longest, self.axial_stiffness, 0.15..0.4_f64),
            (any_law(self.shape_factor, self.sigmoid), 5.0..80.0_f64, steepness),
            (any_end(), any_end()),
            prop::collection::vec((0.0..=1.0_f64, 1e4..1e7_f64), 0..2),
            (self.peak, self.width, self.speed),
            prop::collection::vec(0..2_usize, 1..4),
        )
            .prop_map(
                |(
                    (length, axial_stiffness, spacing),
                    (law, limit, steepness),
                    ends,
                    clamps,
                    (peak, width, speed),
                    traffic,
                )| {
                    let clamp = |(share, stiffness)| Restraint::new(share * length, stiffness);
                    Scene {
                        length,
                        axial_stiffness,
                        friction: Friction::new(law, limit).expect("valid friction"),
                        // Without memory nothing rests on a slope.
                        steepness: if law.has_memory() { steepness } else { 0.0 },
                        ends,
                        clamps: clamps.into_iter().map(clamp).collect(),
                        peak,
                        width,
                        pushed: 0.0,
                        speed,
                        mesh: (spacing * width, 0.5 * spacing * width),
                        traffic,
                    }
                },
            )
    }
}

impl Scene {
    pub fn problem(&self) -> Problem {
        let scene = self.clone();
        let drive = Drive::new(self.speed, 10.0 * self.width, move |xi| {
            let (t, front) = (xi / scene.width, 0.5 * scene.pushed * (1.0 - (xi / 0.8).tanh()));
            // Not symmetric: steeper behind than ahead.
            scene.peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2) + front
        });
        let cable = DuctedCable::new(self.length, self.axial_stiffness, self.friction)
            .and_then(|cable| cable.with_ends(self.ends.0, self.ends.1))
            .and_then(|cable| cable.with_restraints(self.clamps.clone()))
            .and_then(|cable| cable.with_body_force(self.steepness * self.friction.limit()));
        Problem {
            cable: cable.expect("a valid cable"),
            mesh: Mesh::new(self.length, self.mesh.0, self.mesh.1).expect("a valid mesh"),
            drives: vec![drive.clone(), drive.back()],
        }
    }

    /// After all of its traffic.
    pub fn run(&self, kind: Kind) -> Run {
        let mut run = Run::new(kind, &self.problem()).expect("a valid problem");
        for &drive in &self.traffic {
            run.pass(drive).expect("an equilibrium");
        }
        run
    }

    /// Those that handle its law.
    pub fn kinds(&self) -> impl Iterator<Item = Kind> {
        Kind::for_law(self.friction.law())
    }

    /// A scale for errors \[m\]: what friction at its limit can stretch the cable by, and the least motion of a duct.
    pub fn displacement(&self) -> f64 {
        1e-6 + self.friction.limit() * self.length * self.length / self.axial_stiffness
    }
}
