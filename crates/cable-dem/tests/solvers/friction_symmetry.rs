//! What friction forces on every solver, whatever the numbers.

use std::rc::Rc;

use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint};
use proptest::prelude::*;

use super::harness::{Drive, Kind, Problem, Run};

/// A problem and the traffic over it.
#[derive(Clone)]
struct Scene {
    problem: Problem,
    traffic: Vec<usize>,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Problem { cable, mesh, drives } = &self.problem;
        let (speed, approach) = (drives[0].speed, drives[0].approach);
        write!(
            f,
            "{cable:?} {mesh:?} {:?}, {speed} m/s, width {}",
            self.traffic,
            approach / 10.0
        )
    }
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

/// Speeds from `slowest` to `fastest` \[m/s\].
fn any_scene(slowest: f64, fastest: f64) -> impl Strategy<Value = Scene> {
    (
        (5.0..12.0_f64, 1e6..2e7_f64, 0.15..0.4_f64),
        (any_law(), 5.0..80.0_f64),
        (any_end(), any_end()),
        prop::collection::vec((0.0..=1.0_f64, 1e4..1e7_f64), 0..2),
        (1e-6..1e-4_f64, 0.5..2.0_f64, slowest..fastest),
        prop::collection::vec(0..2_usize, 1..4),
    )
        .prop_map(
            |((length, stiffness, spacing), (law, limit), ends, clamps, (peak, width, speed), traffic)| {
                let friction = Friction::new(law, limit).expect("valid friction");
                let clamps = clamps.into_iter().map(|(share, stiffness)| Restraint {
                    position: share * length,
                    stiffness,
                });
                let cable = DuctedCable::new(length, stiffness, friction)
                    .and_then(|cable| cable.with_ends(ends.0, ends.1))
                    .and_then(|cable| cable.with_restraints(clamps.collect()))
                    .expect("a valid cable");
                let spacing = spacing * width;
                let drive = Drive::new(speed, 10.0 * width, move |xi| {
                    let t = xi / width;
                    // Not symmetric: steeper behind than ahead.
                    peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2)
                });
                Scene {
                    problem: Problem {
                        cable,
                        mesh: Mesh::new(length, spacing, 0.5 * spacing).expect("a valid mesh"),
                        drives: vec![drive.clone(), drive.back()],
                    },
                    traffic,
                }
            },
        )
}

impl Scene {
    /// Those that handle its law.
    fn kinds(&self) -> impl Iterator<Item = Kind> {
        Kind::for_law(self.problem.cable.friction().law())
    }

    fn run(&self, kind: Kind) -> Run {
        let mut run = Run::new(kind, &self.problem).expect("a valid problem");
        for &drive in &self.traffic {
            run.pass(drive).expect("an equilibrium");
        }
        run
    }

    /// The same with the duct's motion changed, both ways.
    fn with_motion(&self, change: impl Fn(f64, f64) -> f64 + 'static) -> Self {
        let change = Rc::new(change);
        let mut scene = self.clone();
        for drive in &mut scene.problem.drives {
            let (change, shape) = (Rc::clone(&change), Rc::clone(&drive.shape));
            drive.shape = Rc::new(move |xi| change(xi, shape(xi)));
        }
        scene
    }

    /// A scale for errors \[m\]: what friction at its limit can stretch the cable by, and the least motion of a duct.
    fn displacement(&self) -> f64 {
        let cable = &self.problem.cable;
        1e-6 + self.problem.largest_force() * cable.length() / cable.axial_stiffness()
    }

    fn forces(&self, run: &Run) -> Vec<f64> {
        let Problem { cable, .. } = &self.problem;
        let ends = run.state.end_forces(cable).expect("the state's mesh");
        let inner = run.state.element_forces(cable).expect("the state's mesh");
        [ends.upstream]
            .into_iter()
            .chain(inner)
            .chain([ends.downstream])
            .collect()
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
    fn friction_stays_within_its_limit_and_only_heats(scene in any_scene(3.0, 40.0)) {
        for kind in scene.kinds() {
            let mut run = Run::new(kind, &scene.problem).expect("a valid problem");
            for &drive in &scene.traffic {
                let pass = run.pass(drive).expect("an equilibrium");
                prop_assert!(run.utilisation(&scene.problem) <= 1.0 + 1e-6, "{kind:?}");
                prop_assert!(pass.outcome.dissipated >= -scene.problem.negligible_work(), "{kind:?} {pass:?}");
                let Some(energy) = pass.energy else { continue };
                prop_assert!(energy.returned_share() < 1e-3, "{kind:?} {energy}");
                prop_assert!(energy.unbalanced_share() < 1e-2, "{kind:?} {energy}");
            }
        }
    }

    /// Between any two points the force changes by what friction at its limit and the clamps between them can carry, no more.
    #[test]
    fn between_two_points_friction_and_clamps_carry_the_difference(scene in any_scene(3.0, 40.0)) {
        let Problem { cable, mesh, .. } = &scene.problem;
        let limit = cable.friction().limit();
        for kind in scene.kinds() {
            let mut run = Run::new(kind, &scene.problem).expect("a valid problem");
            for &drive in &scene.traffic {
                run.pass(drive).expect("an equilibrium");
                let forces: Vec<f64> = run.state.element_forces(cable).expect("the state's mesh").collect();
                let clamps = run.state.restraint_forces(cable).expect("the state's mesh");
                for (i, j) in (0..forces.len()).flat_map(|i| (i + 1..forces.len()).map(move |j| (i, j))) {
                    // A clamp within an element pulls at both of its nodes; those between are i + 1 to j.
                    let (from, to) = (i as f64 * mesh.spacing(), (j + 1) as f64 * mesh.spacing());
                    let held: f64 = cable.restraints().iter().zip(&clamps)
                        .filter(|(clamp, _)| clamp.position >= from && clamp.position <= to)
                        .map(|(_, force)| force.abs())
                        .sum();
                    let carried = limit * (j - i) as f64 * mesh.spacing() + held;
                    let excess = (forces[j] - forces[i]).abs() - carried;
                    prop_assert!(excess <= 1e-6 * scene.problem.largest_force(), "{kind:?}: {excess} N, elements {i} to {j}");
                }
            }
        }
    }

    /// Duct backward, cable backward.
    #[test]
    fn the_answer_is_odd(scene in any_scene(3.0, 40.0)) {
        let negated = scene.with_motion(|_, displacement| -displacement);
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
            prop_assert!(forces <= 1e-6 * scene.problem.largest_force(), "{kind:?}: {forces} N");
        }
    }

    #[test]
    fn a_mirrored_scene_gives_the_mirrored_answer(scene in any_scene(3.0, 40.0)) {
        let mut mirrored = scene.clone();
        mirrored.problem.cable = scene.problem.cable.mirrored();
        for drive in &mut mirrored.traffic {
            *drive = 1 - *drive;
        }
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
            prop_assert!(forces <= 1e-6 * scene.problem.largest_force(), "{kind:?}: {forces} N");
        }
    }

    /// Who starts farther forward gets farther: no part of a cable whose every part starts farther forward is ever left behind.
    /// Each step is monotone in the duct's increment and in the sheath's anchor u + γ f, which is monotone again. With inertia the
    /// order holds up to waves.
    #[test]
    fn who_starts_farther_forward_gets_farther(
        scene in any_scene(0.5, 2.0),
        more in 1e-7..1e-4_f64,
        place in 0.0..=1.0_f64,
    ) {
        prop_assume!(scene.problem.cable.friction().law().has_memory());
        let mesh = &scene.problem.mesh;
        for kind in scene.kinds() {
            let one = scene.run(kind);
            let ahead = |node: usize| {
                let share = node as f64 / mesh.elements() as f64;
                more * (-(6.0 * (share - place)).powi(2)).exp()
            };
            let displacement = one.state.displacement().iter().enumerate().map(|(i, u)| u + ahead(i));
            let start = CableState::from_parts(mesh, displacement.collect(), one.state.friction().to_vec())
                .expect("a finite state");
            let mut other = Run::resumed(kind, &scene.problem, start).expect("a valid problem");
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
}
