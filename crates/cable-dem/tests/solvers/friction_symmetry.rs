//! What friction forces on every solver, whatever the numbers.

use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint};
use proptest::prelude::*;

use super::harness::{Drive, Kind, Problem, Run};

/// A cable, the duct's motion, and the traffic over it: 0 forward, 1 back. What changes under a symmetry or a scaling.
#[derive(Debug, Clone)]
struct Scene {
    length: f64,
    axial_stiffness: f64,
    friction: Friction,
    ends: (End, End),
    clamps: Vec<Restraint>,
    /// Displacement and length of the duct's motion, and what it is pushed forward beside.
    peak: f64,
    width: f64,
    pushed: f64,
    speed: f64,
    spacing: f64,
    traffic: Vec<usize>,
}

fn any_law() -> impl Strategy<Value = FrictionLaw> {
    let shape_factor = || (4.0..8.5_f64).prop_map(|exponent| 10.0_f64.powf(exponent));
    prop_oneof![
        Just(FrictionLaw::Coulomb),
        shape_factor().prop_map(|shape_factor| FrictionLaw::ElasticPlastic { shape_factor }),
        shape_factor().prop_map(|shape_factor| FrictionLaw::Sigmoid { shape_factor }),
    ]
}

fn any_end() -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (1e4..1e7_f64).prop_map(End::Spring)
    ]
}

/// Speeds from `slowest` to `fastest` \[m/s\], cables up to `longest` \[m\].
fn any_scene(slowest: f64, fastest: f64, longest: f64) -> impl Strategy<Value = Scene> {
    (
        (5.0..longest, 1e6..2e7_f64, 0.15..0.4_f64),
        (any_law(), 5.0..80.0_f64),
        (any_end(), any_end()),
        prop::collection::vec((0.0..=1.0_f64, 1e4..1e7_f64), 0..2),
        (1e-6..1e-4_f64, 0.5..2.0_f64, slowest..fastest),
        prop::collection::vec(0..2_usize, 1..4),
    )
        .prop_map(
            |(
                (length, axial_stiffness, spacing),
                (law, limit),
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
                    ends,
                    clamps: clamps.into_iter().map(clamp).collect(),
                    peak,
                    width,
                    pushed: 0.0,
                    speed,
                    spacing: spacing * width,
                    traffic,
                }
            },
        )
}

impl Scene {
    fn problem(&self) -> Problem {
        let Self {
            peak, width, pushed, ..
        } = *self;
        let drive = Drive::new(self.speed, 10.0 * width, move |xi| {
            let (t, front) = (xi / width, 0.5 * pushed * (1.0 - (xi / 0.8).tanh()));
            // Not symmetric: steeper behind than ahead.
            peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2) + front
        });
        let cable = DuctedCable::new(self.length, self.axial_stiffness, self.friction)
            .and_then(|cable| cable.with_ends(self.ends.0, self.ends.1))
            .and_then(|cable| cable.with_restraints(self.clamps.clone()));
        Problem {
            cable: cable.expect("a valid cable"),
            mesh: Mesh::new(self.length, self.spacing, 0.5 * self.spacing).expect("a valid mesh"),
            drives: vec![drive.clone(), drive.back()],
        }
    }

    /// Those that handle its law.
    fn kinds(&self) -> impl Iterator<Item = Kind> {
        Kind::for_law(self.friction.law())
    }

    fn run(&self, kind: Kind) -> Run {
        let mut run = Run::new(kind, &self.problem()).expect("a valid problem");
        for &drive in &self.traffic {
            run.pass(drive).expect("an equilibrium");
        }
        run
    }

    /// A scale for errors \[m\]: what friction at its limit can stretch the cable by, and the least motion of a duct.
    fn displacement(&self) -> f64 {
        1e-6 + self.friction.limit() * self.length * self.length / self.axial_stiffness
    }

    fn forces(&self, run: &Run) -> Vec<f64> {
        let cable = self.problem().cable;
        let ends = run.state.end_forces(&cable).expect("the state's mesh");
        let inner = run.state.element_forces(&cable).expect("the state's mesh");
        [ends.upstream]
            .into_iter()
            .chain(inner)
            .chain([ends.downstream])
            .collect()
    }

    /// The same with q and b multiplied.
    fn with_friction_times(mut self, limit: f64, shape_factor: f64) -> Self {
        let law = match self.friction.law() {
            FrictionLaw::ElasticPlastic { shape_factor: b } => FrictionLaw::ElasticPlastic {
                shape_factor: b * shape_factor,
            },
            other => other,
        };
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

    /// Asserts that the quasi-static forces and displacements of `scaled` are its own times two factors. As these are powers of two, every
    /// number in the computation scales without rounding.
    fn assert_scaled(&self, scaled: &Self, force: f64, displacement: f64) {
        let [own, other] = [self, scaled].map(|scene| scene.run(Kind::QuasiStatic));
        let is = |own: Vec<f64>, other: &[f64], factor: f64| {
            let size = own
                .iter()
                .fold(f64::MIN_POSITIVE, |most: f64, v| most.max((factor * v).abs()));
            let apart = largest_difference(other.iter(), own.into_iter().map(|value| factor * value));
            assert!(apart <= 1e-9 * size, "{apart} of {size}");
        };
        is(self.forces(&own), &scaled.forces(&other), force);
        is(
            own.state.displacement().to_vec(),
            other.state.displacement(),
            displacement,
        );
    }
}

fn largest_difference<'a>(one: impl Iterator<Item = &'a f64>, other: impl Iterator<Item = f64>) -> f64 {
    one.zip(other).fold(0.0, |worst: f64, (a, b)| {
        if (a - b).is_nan() {
            f64::INFINITY
        } else {
            worst.max((a - b).abs())
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn friction_stays_within_its_limit_and_only_heats(scene in any_scene(3.0, 40.0, 12.0)) {
        let problem = scene.problem();
        for kind in scene.kinds() {
            let mut run = Run::new(kind, &problem).expect("a valid problem");
            for &drive in &scene.traffic {
                let pass = run.pass(drive).expect("an equilibrium");
                prop_assert!(run.utilisation(&problem) <= 1.0 + 1e-6, "{kind:?}");
                prop_assert!(pass.outcome.dissipated >= -problem.negligible_work(), "{kind:?} {pass:?}");
                let Some(energy) = pass.energy else { continue };
                prop_assert!(energy.returned_share() < 1e-3, "{kind:?} {energy:?}");
                prop_assert!(energy.unbalanced_share() < 1e-2, "{kind:?} {energy:?}");
            }
        }
    }

    /// Between any two points the force changes by what friction at its limit and the clamps between them can carry, no more.
    #[test]
    fn between_two_points_friction_and_clamps_carry_the_difference(scene in any_scene(3.0, 40.0, 12.0)) {
        let problem = scene.problem();
        let Problem { cable, mesh, .. } = &problem;
        let limit = cable.friction().limit();
        for kind in scene.kinds() {
            let mut run = Run::new(kind, &problem).expect("a valid problem");
            for &drive in &scene.traffic {
                run.pass(drive).expect("an equilibrium");
                let forces: Vec<f64> = run.state.element_forces(cable).expect("the state's mesh").collect();
                // A clamp within an element pulls at both of its nodes, by the lever rule.
                let mut springs = vec![0.0; mesh.nodes()];
                for clamp in cable.restraints() {
                    let place = clamp.position / mesh.spacing();
                    let left = (place as usize).min(mesh.elements() - 1);
                    for (node, share) in [(left, 1.0 - (place - left as f64)), (left + 1, place - left as f64)] {
                        springs[node] += share * clamp.stiffness * run.state.displacement()[node];
                    }
                }
                for (i, j) in (0..forces.len()).flat_map(|i| (i + 1..forces.len()).map(move |j| (i, j))) {
                    let held: f64 = springs[i + 1..=j].iter().sum();
                    let carried = limit * (j - i) as f64 * mesh.spacing() + held.abs();
                    let excess = (forces[j] - forces[i]).abs() - carried;
                    prop_assert!(excess <= 1e-6 * problem.largest_force(), "{kind:?}: {excess} N, elements {i} to {j}");
                }
            }
        }
    }

    /// Duct backward, cable backward.
    #[test]
    fn the_answer_is_odd(scene in any_scene(3.0, 40.0, 12.0)) {
        let negated = Scene { peak: -scene.peak, ..scene.clone() };
        let problem = scene.problem();
        for kind in scene.kinds() {
            let (one, other) = (scene.run(kind), negated.run(kind));
            let moved = largest_difference(
                one.state.displacement().iter(),
                other.state.displacement().iter().map(|u| -u),
            );
            prop_assert!(moved <= 1e-6 * scene.displacement(), "{kind:?}: {moved} m");
            let forces = largest_difference(
                scene.forces(&one).iter(),
                scene.forces(&other).into_iter().map(|f| -f),
            );
            prop_assert!(forces <= 1e-6 * problem.largest_force(), "{kind:?}: {forces} N");
        }
    }

    #[test]
    fn a_mirrored_scene_gives_the_mirrored_answer(scene in any_scene(3.0, 40.0, 12.0)) {
        let mut mirrored = scene.clone();
        mirrored.ends = (scene.ends.1, scene.ends.0);
        for clamp in &mut mirrored.clamps {
            clamp.position = scene.length - clamp.position;
        }
        for drive in &mut mirrored.traffic {
            *drive = 1 - *drive;
        }
        let problem = scene.problem();
        for kind in scene.kinds() {
            let (one, other) = (scene.run(kind), mirrored.run(kind));
            let moved = largest_difference(
                one.state.displacement().iter(),
                other.state.displacement().iter().rev().map(|u| -u),
            );
            prop_assert!(moved <= 1e-6 * scene.displacement(), "{kind:?}: {moved} m");
            let forces = largest_difference(
                scene.forces(&one).iter(),
                mirrored.forces(&other).into_iter().rev(),
            );
            prop_assert!(forces <= 1e-6 * problem.largest_force(), "{kind:?}: {forces} N");
        }
    }

    /// Who starts farther forward gets farther: no part of a cable whose every part starts farther forward is ever left behind.
    /// Each step is monotone in the duct's increment and in the sheath's anchor u + γ f, which is monotone again. With inertia the
    /// order holds up to waves.
    #[test]
    fn who_starts_farther_forward_gets_farther(
        scene in any_scene(0.5, 2.0, 12.0),
        more in 1e-7..1e-4_f64,
        place in 0.0..=1.0_f64,
    ) {
        prop_assume!(scene.friction.law().has_memory());
        let problem = scene.problem();
        let mesh = &problem.mesh;
        for kind in scene.kinds() {
            let one = scene.run(kind);
            let ahead = |node: usize| {
                let share = node as f64 / mesh.elements() as f64;
                more * (-(6.0 * (share - place)).powi(2)).exp()
            };
            let displacement = one.state.displacement().iter().enumerate().map(|(i, u)| u + ahead(i));
            let start = CableState::from_parts(mesh, displacement.collect(), one.state.friction().to_vec())
                .expect("a finite state");
            let mut other = Run::resumed(kind, &problem, start).expect("a valid problem");
            let mut one = one;
            for &drive in &scene.traffic {
                one.pass(drive).expect("an equilibrium");
                other.pass(drive).expect("an equilibrium");
                let back = one.state.displacement().iter().zip(other.state.displacement()).fold(
                    0.0,
                    |worst: f64, (one, other)| if (one - other).is_nan() { f64::INFINITY } else { worst.max(one - other) },
                );
                let share = if kind.has_inertia() { 1e-3 } else { 1e-4 };
                prop_assert!(back <= share * scene.displacement(), "{kind:?}: {back} m of {}", scene.displacement());
            }
        }
    }

    /// A duct that moves farther forward at every step never leaves any part of the cable farther back. So it is until the duct returns to
    /// rest, which takes it farther back too.
    #[test]
    fn who_is_pushed_farther_gets_farther(scene in any_scene(3.0, 40.0, 30.0), more in 1e-7..1e-4_f64) {
        prop_assume!(scene.friction.law().has_memory());
        let pushed = Scene { pushed: more, ..scene.clone() };
        let [one, other] = [&scene, &pushed].map(|scene| {
            let mut run = Run::new(Kind::QuasiStatic, &scene.problem()).expect("a valid problem");
            run.pass(0).expect("an equilibrium").pushed.expect("the cable at the end of the pass")
        });
        for (one, other) in one.displacement().iter().zip(other.displacement()) {
            prop_assert!(one - other <= 1e-4 * scene.displacement(), "{one} m, {other} m");
        }
    }

    /// (D, q) × s, b/s: displacements and forces × s.
    #[test]
    fn displacement_and_friction_scale_together(scene in any_scene(3.0, 40.0, 30.0), exponent in -4..5_i32) {
        prop_assume!(scene.friction.law().has_memory());
        let s = 2.0_f64.powi(exponent);
        let scaled = Scene { peak: s * scene.peak, ..scene.clone() };
        scene.assert_scaled(&scaled.with_friction_times(s, 1.0 / s), s, s);
    }

    /// (EA, q, springs) × s: forces × s, displacements the same.
    #[test]
    fn stiffness_and_friction_scale_together(scene in any_scene(3.0, 40.0, 30.0), exponent in -4..5_i32) {
        prop_assume!(scene.friction.law().has_memory());
        let s = 2.0_f64.powi(exponent);
        let scaled = Scene { axial_stiffness: s * scene.axial_stiffness, ..scene.clone() };
        scene.assert_scaled(&scaled.with_friction_times(s, 1.0).with_springs_times(s), s, 1.0);
    }

    /// All lengths × s, EA × s², springs × s: forces × s, displacements the same.
    #[test]
    fn lengths_scale(scene in any_scene(3.0, 40.0, 30.0), exponent in -2..3_i32) {
        prop_assume!(scene.friction.law().has_memory());
        let s = 2.0_f64.powi(exponent);
        let mut scaled = scene.clone().with_springs_times(s);
        for length in [&mut scaled.length, &mut scaled.width, &mut scaled.spacing] {
            *length *= s;
        }
        scaled.axial_stiffness *= s * s;
        for clamp in &mut scaled.clamps {
            clamp.position *= s;
        }
        scene.assert_scaled(&scaled, s, 1.0);
    }
}
