//! What friction forces on every solver, whatever the numbers.

use cable_dem::{CableState, End, Friction, FrictionLaw};
use proptest::prelude::*;

use super::harness::{Kind, Problem, Run, largest};
use super::random_scenes::{Drawn, Scene};
use super::shared::clamp_springs;

fn any_scene() -> impl Strategy<Value = Scene> {
    Drawn::default().scenes()
}

/// For the solver that does not ask for the speed.
fn any_long_scene() -> impl Strategy<Value = Scene> {
    let drawn = Drawn {
        longest: 30.0,
        sigmoid: false,
        ..Drawn::default()
    };
    drawn.scenes()
}

impl Scene {
    /// The duct and the weight drag backward.
    fn negated(&self) -> Self {
        Self {
            peak: -self.peak,
            steepness: -self.steepness,
            ..self.clone()
        }
    }

    /// In a mirror across the duct's middle.
    fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        mirrored.steepness = -self.steepness;
        mirrored.ends = (self.ends.1, self.ends.0);
        for clamp in &mut mirrored.clamps {
            clamp.position = self.length - clamp.position;
        }
        for drive in &mut mirrored.traffic {
            *drive = 1 - *drive;
        }
        mirrored
    }

    /// With q and b multiplied.
    fn with_friction_times(mut self, limit: f64, shape_factor: f64) -> Self {
        let mut law = self.friction.law();
        if let FrictionLaw::ElasticPlastic { shape_factor: b } = &mut law {
            *b *= shape_factor;
        }
        self.friction = Friction::new(law, self.friction.limit() * limit).expect("valid friction");
        self
    }

    fn with_springs_times(mut self, factor: f64) -> Self {
        let times = |end: End| match end {
            End::Spring(stiffness) => End::Spring(stiffness * factor),
            other => other,
        };
        self.ends = (times(self.ends.0), times(self.ends.1));
        for clamp in &mut self.clamps {
            clamp.stiffness *= factor;
        }
        self
    }

    fn with_lengths_times(mut self, factor: f64) -> Self {
        self.length *= factor;
        self.width *= factor;
        self.mesh = (self.mesh.0 * factor, self.mesh.1 * factor);
        for clamp in &mut self.clamps {
            clamp.position *= factor;
        }
        self
    }
}

/// Displacements and forces along a cable from upstream to downstream.
fn answer(problem: &Problem, state: &CableState) -> [Vec<f64>; 2] {
    [state.displacement().to_vec(), problem.forces(state)]
}

/// Largest of `one` − factor · `other`, infinite for NaN.
fn largest_difference(one: &[f64], other: &[f64], factor: f64) -> f64 {
    largest(one.iter().zip(other).map(|(a, b)| a - factor * b))
}

/// How far any part of `other` is behind `one` \[m\], infinite for NaN.
fn left_behind(one: &CableState, other: &CableState) -> f64 {
    let pairs = one.displacement().iter().zip(other.displacement());
    // NaN is not below zero.
    largest(pairs.map(|(one, other)| if one - other < 0.0 { 0.0 } else { one - other }))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    /// Friction stays within its limit and only heats; between any two points the force changes by the weight between them and by what
    /// friction at its limit and the clamps can carry, no more.
    #[test]
    fn friction_carries_no_more_than_its_limit(scene in any_scene()) {
        let problem = scene.problem();
        let Problem { cable, mesh, .. } = &problem;
        let limit = cable.friction().limit();
        for kind in scene.kinds() {
            let mut run = Run::new(kind, &problem).expect("a valid problem");
            for &drive in &scene.traffic {
                let pass = run.pass(drive).expect("an equilibrium");
                prop_assert!(run.utilisation(&problem) <= 1.0 + 1e-6, "{kind:?}");
                prop_assert!(pass.outcome.dissipated >= -problem.negligible_work(), "{kind:?} {pass:?}");
                if let Some(energy) = pass.energy {
                    prop_assert!(energy.returned_share() < 1e-3, "{kind:?} {energy:?}");
                    prop_assert!(energy.unbalanced_share() < 1e-2, "{kind:?} {energy:?}");
                }

                let forces: Vec<f64> = run.state.element_forces(cable).expect("the state's mesh").collect();
                let mut springs = vec![0.0; mesh.nodes()];
                for (node, stiffness) in clamp_springs(cable, mesh) {
                    springs[node] += stiffness * run.state.displacement()[node];
                }
                for (i, j) in (0..forces.len()).flat_map(|i| (i + 1..forces.len()).map(move |j| (i, j))) {
                    let held: f64 = springs[i + 1..=j].iter().sum();
                    let distance = (j - i) as f64 * mesh.spacing();
                    let carried = limit * distance + held.abs();
                    let excess = (forces[j] - forces[i] - scene.steepness * limit * distance).abs() - carried;
                    prop_assert!(excess <= 1e-6 * problem.largest_force(), "{kind:?}: {excess} N, elements {i} to {j}");
                }
            }
        }
    }

    /// Duct backward, cable backward; and the mirrored scene has the mirrored answer.
    #[test]
    fn the_answer_is_odd_and_has_a_mirror_image(scene in any_scene()) {
        let (problem, negated, mirrored) = (scene.problem(), scene.negated(), scene.mirrored());
        for kind in scene.kinds() {
            let own = answer(&problem, &scene.run(kind).state);
            let opposite = answer(&negated.problem(), &negated.run(kind).state);
            let mut image = answer(&mirrored.problem(), &mirrored.run(kind).state);
            for values in &mut image {
                values.reverse();
            }
            // In a mirror compression stays compression.
            for ([displacements, forces], sign) in [(opposite, -1.0), (image, 1.0)] {
                let moved = largest_difference(&own[0], &displacements, -1.0);
                prop_assert!(moved <= 1e-6 * scene.displacement(), "{kind:?}: {moved} m");
                let apart = largest_difference(&own[1], &forces, sign);
                prop_assert!(apart <= 1e-6 * problem.largest_force(), "{kind:?}: {apart} N");
            }
        }
    }

    /// Who starts farther forward gets farther: no part of a cable whose every part starts farther forward is ever left behind.
    /// Each step is monotone in the duct's increment and in the sheath's anchor u + γ f, which is monotone again. With inertia the
    /// order holds up to waves.
    #[test]
    fn who_starts_farther_forward_gets_farther(
        scene in Drawn { longest: 8.0, width: 0.5..1.2, speed: 1.0..2.0, sigmoid: false, ..Drawn::default() }.scenes(),
        more in 1e-7..1e-4_f64,
        place in 0.0..=1.0_f64,
    ) {
        let problem = scene.problem();
        let mesh = &problem.mesh;
        for kind in scene.kinds() {
            let mut one = scene.run(kind);
            let ahead = |node: usize| {
                let share = node as f64 / mesh.elements() as f64;
                more * (-(6.0 * (share - place)).powi(2)).exp()
            };
            let displacement = one.state.displacement().iter().enumerate().map(|(i, u)| u + ahead(i));
            let start = CableState::from_parts(mesh, displacement.collect(), one.state.friction().to_vec())
                .expect("a finite state");
            let mut other = Run::resumed(kind, &problem, start).expect("a valid problem");
            let share = if kind.has_inertia() { 1e-3 } else { 1e-4 };
            for &drive in &scene.traffic {
                one.pass(drive).expect("an equilibrium");
                other.pass(drive).expect("an equilibrium");
                let back = left_behind(&one.state, &other.state);
                prop_assert!(back <= share * scene.displacement(), "{kind:?}: {back} m of {}", scene.displacement());
            }
        }
    }

    /// A duct that moves farther forward at every step never leaves any part of the cable farther back. So it is until the duct returns to
    /// rest, which takes it farther back too.
    #[test]
    fn who_is_pushed_farther_gets_farther(scene in any_long_scene(), more in 1e-7..1e-4_f64) {
        let pushed = Scene { pushed: more, ..scene.clone() };
        let [one, other] = [&scene, &pushed].map(|scene| {
            let mut run = Run::new(Kind::QuasiStatic, &scene.problem()).expect("a valid problem");
            run.pass(0).expect("an equilibrium").pushed.expect("the cable at the end of the pass")
        });
        prop_assert!(left_behind(&one, &other) <= 1e-4 * scene.displacement());
    }

    /// Multiplied by s: displacements and forces with (D, q) and 1/b; forces alone with (EA, q, springs), and with (lengths, √EA, springs).
    /// As s is a power of two, every number in the computation scales without rounding.
    #[test]
    fn forces_and_lengths_scale(scene in any_long_scene(), exponent in -4..5_i32, of_lengths in -2..3_i32) {
        let (s, l) = (2.0_f64.powi(exponent), 2.0_f64.powi(of_lengths));
        let own = answer(&scene.problem(), &scene.run(Kind::QuasiStatic).state);
        let softer = Scene { peak: s * scene.peak, ..scene.clone() }.with_friction_times(s, 1.0 / s);
        let stiffer = Scene { axial_stiffness: s * scene.axial_stiffness, ..scene.clone() };
        let longer = Scene { axial_stiffness: l * l * scene.axial_stiffness, ..scene.clone() };
        for (scaled, factors) in [
            (softer, [s, s]),
            (stiffer.with_friction_times(s, 1.0).with_springs_times(s), [1.0, s]),
            (longer.with_lengths_times(l).with_springs_times(l), [1.0, l]),
        ] {
            let found = answer(&scaled.problem(), &scaled.run(Kind::QuasiStatic).state);
            for ((found, own), factor) in found.iter().zip(&own).zip(factors) {
                let size = factor * largest(own.iter().copied()).max(f64::MIN_POSITIVE);
                let apart = largest_difference(found, own, factor);
                prop_assert!(apart <= 1e-9 * size, "{apart} of {size}");
            }
        }
    }
}
