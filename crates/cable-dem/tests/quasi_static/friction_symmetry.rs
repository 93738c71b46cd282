//! Laws that hold whatever the numbers: of the friction laws themselves, and of what follows from them.

use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, Restraint};
use ground_field::Direction;
use proptest::prelude::*;

use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, cable, coulomb, elastic_plastic, largest_difference,
    reference_cable, reference_motion, reference_motion_at_speed, sheathed,
};

fn any_law() -> impl Strategy<Value = FrictionLaw> {
    let shape_factor = (3.0..12.0_f64).prop_map(|exponent| 10.0_f64.powf(exponent));
    prop_oneof![
        Just(FrictionLaw::Coulomb),
        shape_factor
            .clone()
            .prop_map(|shape_factor| FrictionLaw::ElasticPlastic { shape_factor }),
        shape_factor.prop_map(|shape_factor| FrictionLaw::Sigmoid { shape_factor }),
    ]
}

fn any_friction() -> impl Strategy<Value = Friction> {
    (any_law(), prop_oneof![Just(0.0), 1e-3..1e3_f64])
        .prop_map(|(law, limit)| Friction::new(law, limit).expect("valid friction"))
}

fn any_slip() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        (-12.0..0.0_f64, any::<bool>())
            .prop_map(|(exponent, back)| 10.0_f64.powf(exponent) * if back { -1.0 } else { 1.0 }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn friction_is_odd_bounded_and_monotone(
        friction in any_friction(),
        share in -1.0..=1.0_f64,
        slip in any_slip(),
        more in 0.0..1e-3_f64,
    ) {
        let before = share * friction.limit();
        let after = friction.after_slip(before, slip);
        prop_assert!(after.abs() <= friction.limit());
        prop_assert_eq!(friction.after_slip(-before, -slip), -after);
        prop_assert!(friction.after_slip(before, slip + more) >= after);
    }

    /// Work done against friction is never less than what it has stored as shear: f²/(q b).
    #[test]
    fn closed_loops_of_slip_dissipate(
        friction in any_friction(),
        share in -1.0..=1.0_f64,
        slips in prop::collection::vec(any_slip(), 1..20),
    ) {
        let limit = friction.limit();
        let stored = |force: f64| match friction.law() {
            FrictionLaw::ElasticPlastic { .. } if limit > 0.0 => 0.5 * friction.compliance() * force * force,
            _ => 0.0,
        };
        let start = share * limit;
        let back = -slips.iter().sum::<f64>();
        let mut force = start;
        let (mut work, mut size) = (0.0, 0.0);
        for slip in slips.into_iter().chain([back]) {
            force = friction.after_slip(force, slip);
            work += force * slip;
            size += (force * slip).abs();
        }
        prop_assert!(work >= stored(force) - stored(start) - 1e-12 * (size + stored(start)));
    }

    /// However slip is divided into steps that do not turn back, friction with memory ends up the same.
    #[test]
    fn steps_of_one_sign_add_up(
        friction in any_friction(),
        share in -1.0..=1.0_f64,
        slip in 1e-9..1e-3_f64,
        parts in 1..20_u32,
    ) {
        prop_assume!(friction.law().has_memory());
        let start = share * friction.limit();
        let at_once = friction.after_slip(start, slip);
        let in_parts = (0..parts).fold(start, |f, _| friction.after_slip(f, slip / f64::from(parts)));
        prop_assert!((at_once - in_parts).abs() <= 1e-9 * friction.limit());
    }
}

/// A scene of passes by shapes; what changes under a symmetry or a scaling.
#[derive(Debug, Clone)]
struct Scene {
    length: f64,
    axial_stiffness: f64,
    friction: Friction,
    ends: (End, End),
    clamps: Vec<Restraint>,
    /// Displacement and length of the duct's motion.
    peak: f64,
    width: f64,
    spacing: f64,
    traffic: Vec<Direction>,
}

impl Scene {
    fn cable(&self) -> DuctedCable {
        cable(
            self.length,
            self.axial_stiffness,
            self.friction,
            self.ends.0,
            self.ends.1,
        )
        .with_restraints(self.clamps.clone())
        .expect("valid clamps")
    }

    fn mesh(&self) -> Mesh {
        Mesh::new(self.length, self.spacing, 0.5 * self.spacing).expect("a valid mesh")
    }

    fn passage(&self, direction: Direction) -> Passage {
        let shape = |xi: f64| {
            let t = xi / self.width;
            // Not symmetric: steeper behind than ahead.
            self.peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2)
        };
        Passage::from_shape(&self.cable(), &self.mesh(), direction, shape, 10.0 * self.width)
            .expect("a valid passage")
    }

    fn run(&self) -> Run {
        let mut run = Run::new(self.cable(), self.mesh());
        let passages = [Direction::Forward, Direction::Reverse].map(|direction| self.passage(direction));
        for &direction in &self.traffic {
            run.pass(&passages[usize::from(direction == Direction::Reverse)]);
        }
        run
    }

    fn forces(run: &Run) -> Vec<f64> {
        run.state
            .element_forces(run.solver.cable())
            .expect("the state's mesh")
            .collect()
    }
}

fn any_end() -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (1e4..1e8_f64).prop_map(End::Spring)
    ]
}

fn any_scene() -> impl Strategy<Value = Scene> {
    (
        5.0..30.0_f64,
        1e6..2e7_f64,
        prop_oneof![
            (5.0..80.0_f64).prop_map(coulomb),
            (5.0..80.0_f64, 4.0..9.0_f64).prop_map(|(q, e)| elastic_plastic(10.0_f64.powf(e), q)),
        ],
        (any_end(), any_end()),
        prop::collection::vec((0.0..=1.0_f64, 1e4..1e8_f64), 0..2),
        (1e-6..1e-4_f64, 0.5..2.0_f64, 0.15..0.4_f64),
        prop::collection::vec(
            prop_oneof![Just(Direction::Forward), Just(Direction::Reverse)],
            1..5,
        ),
    )
        .prop_map(
            |(length, axial_stiffness, friction, ends, clamps, (peak, width, spacing), traffic)| Scene {
                length,
                axial_stiffness,
                friction,
                ends,
                clamps: clamps
                    .into_iter()
                    .map(|(share, stiffness)| Restraint {
                        position: share * length,
                        stiffness,
                    })
                    .collect(),
                peak,
                width,
                spacing: spacing * width,
                traffic,
            },
        )
}

/// `friction` with q and b multiplied.
fn rescaled(friction: Friction, limit: f64, shape_factor: f64) -> Friction {
    let law = match friction.law() {
        FrictionLaw::ElasticPlastic { shape_factor: b } => FrictionLaw::ElasticPlastic {
            shape_factor: b * shape_factor,
        },
        other => other,
    };
    Friction::new(law, friction.limit() * limit).expect("valid friction")
}

fn springs_times(scene: &mut Scene, factor: f64) {
    let times = |end: End| match end {
        End::Spring(stiffness) => End::Spring(stiffness * factor),
        other => other,
    };
    scene.ends = (times(scene.ends.0), times(scene.ends.1));
    for clamp in &mut scene.clamps {
        clamp.stiffness *= factor;
    }
}

/// Asserts that forces and displacements are those of `run` times two factors. As these are powers of two, every number in
/// the computation scales without rounding.
fn assert_scaled(run: &Run, scaled: &Run, force: f64, displacement: f64) {
    let size = |values: &[f64]| values.iter().fold(f64::MIN_POSITIVE, |m: f64, v| m.max(v.abs()));
    let forces: Vec<f64> = Scene::forces(run).iter().map(|f| force * f).collect();
    let found = Scene::forces(scaled);
    assert!(largest_difference(&forces, &found) <= 1e-9 * size(&forces));
    let moved: Vec<f64> = run
        .state
        .displacement()
        .iter()
        .map(|u| displacement * u)
        .collect();
    assert!(largest_difference(&moved, scaled.state.displacement()) <= 1e-9 * size(&moved));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_mirrored_scene_gives_the_mirrored_answer(scene in any_scene()) {
        let mut mirrored = scene.clone();
        mirrored.ends = (scene.ends.1, scene.ends.0);
        for clamp in &mut mirrored.clamps {
            clamp.position = scene.length - clamp.position;
        }
        for direction in &mut mirrored.traffic {
            *direction = match direction {
                Direction::Forward => Direction::Reverse,
                Direction::Reverse => Direction::Forward,
            };
        }
        let (one, other) = (scene.run(), mirrored.run());
        let ends = one.state.end_forces(&scene.cable()).expect("the state's mesh");
        let seen = other.state.end_forces(&mirrored.cable()).expect("the state's mesh");
        let size = scene.friction.limit() * scene.length;
        prop_assert!((ends.upstream - seen.downstream).abs() < 1e-6 * size);
        prop_assert!((ends.downstream - seen.upstream).abs() < 1e-6 * size);
        let flipped: Vec<f64> = other.state.displacement().iter().rev().map(|u| -u).collect();
        let moved = largest_difference(one.state.displacement(), &flipped);
        prop_assert!(moved < 1e-6 * (scene.peak + size * scene.length / scene.axial_stiffness));
    }

    /// (D, q) × s, b/s: displacements and forces × s.
    #[test]
    fn displacement_and_friction_scale_together(scene in any_scene(), exponent in -4..5_i32) {
        let s = 2.0_f64.powi(exponent);
        let mut scaled = scene.clone();
        scaled.peak *= s;
        scaled.friction = rescaled(scene.friction, s, 1.0 / s);
        assert_scaled(&scene.run(), &scaled.run(), s, s);
    }

    /// (EA, q, springs) × s: forces × s, displacements the same.
    #[test]
    fn stiffness_and_friction_scale_together(scene in any_scene(), exponent in -4..5_i32) {
        let s = 2.0_f64.powi(exponent);
        let mut scaled = scene.clone();
        scaled.axial_stiffness *= s;
        scaled.friction = rescaled(scene.friction, s, 1.0);
        springs_times(&mut scaled, s);
        assert_scaled(&scene.run(), &scaled.run(), s, 1.0);
    }

    /// All lengths × s, EA × s², springs × s: forces × s, displacements the same.
    #[test]
    fn lengths_scale(scene in any_scene(), exponent in -2..3_i32) {
        let s = 2.0_f64.powi(exponent);
        let mut scaled = scene.clone();
        scaled.length *= s;
        scaled.width *= s;
        scaled.spacing *= s;
        scaled.axial_stiffness *= s * s;
        springs_times(&mut scaled, s);
        for clamp in &mut scaled.clamps {
            clamp.position *= s;
        }
        assert_scaled(&scene.run(), &scaled.run(), s, 1.0);
    }

    #[test]
    fn a_run_resumed_from_its_state_goes_on_as_if_uninterrupted(scene in any_scene()) {
        let mut straight = scene.run();
        let mut resumed = Run::new(scene.cable(), scene.mesh());
        resumed.state = straight.state.clone();
        for direction in [Direction::Reverse, Direction::Forward] {
            let passage = scene.passage(direction);
            straight.pass(&passage);
            resumed.pass(&passage);
        }
        let difference = largest_difference(&Scene::forces(&straight), &Scene::forces(&resumed));
        // A fresh solver starts its iterations elsewhere, and may draw its windows otherwise.
        let size = scene.friction.limit() * scene.length;
        prop_assert!(difference < 2e-4 * size, "{difference} of {size} N");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A duct that moves farther forward at every step never leaves any part of the cable farther back: each step is
    /// monotone in the duct's increment and in the sheath's anchor u + γ f, which is monotone again. So it is until the duct returns
    /// to rest, which takes it farther back too.
    #[test]
    fn who_is_pushed_farther_gets_farther(scene in any_scene(), more in 1e-7..1e-4_f64) {
        let (cable, mesh) = (scene.cable(), scene.mesh());
        let approach = 10.0 * scene.width;
        let pass = |more: f64| {
            let shape = |xi: f64| {
                let t = xi / scene.width;
                let front = 0.5 * more * (1.0 - (xi / 0.8).tanh());
                scene.peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2) + front
            };
            let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, approach).expect("a valid passage");
            Run::new(cable.clone(), mesh).pass_and_last(&passage).1
        };
        let (one, other) = (pass(0.0), pass(more));
        let scale = 1e-6 + scene.friction.limit() * scene.length * scene.length / scene.axial_stiffness;
        for (one, other) in one.displacement().iter().zip(other.displacement()) {
            prop_assert!(one - other <= 1e-4 * scale, "{one} m, {other} m, of {scale} m");
        }
    }
}

#[test]
fn speed_changes_nothing() {
    let mesh = Mesh::new(15.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [sheathed(LIMITS[0]), coulomb(LIMITS[0])] {
        let run_at = |speed: f64| -> CableState {
            let cable = reference_cable(15.0, friction);
            let motion = reference_motion_at_speed(speed);
            let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
            let mut run = Run::new(cable, mesh);
            run.passes(3, &passage);
            run.state
        };
        let slow = run_at(1.0);
        assert!(slow.displacement()[0] > 0.0);
        for speed in [5.56, 11.1, 30.0] {
            assert_eq!(run_at(speed), slow);
        }
    }
}

/// Each state after a forward pass is the mirror image of the one after the next reverse pass, once both directions have
/// wiped out how it began.
#[test]
fn equal_opposing_traffic_between_fixed_ends_creeps_nowhere_on_average() {
    let motion = reference_motion();
    let mesh = Mesh::new(20.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [sheathed(LIMITS[0]), coulomb(LIMITS[0])] {
        let cable = cable(20.0, AXIAL_STIFFNESS, friction, End::Fixed, End::Fixed);
        let forward = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let reverse = Passage::from_shape(
            &cable,
            &mesh,
            Direction::Reverse,
            |xi| motion.longitudinal(xi),
            APPROACH,
        )
        .expect("a valid passage");
        let mean = |run: &Run| run.state.displacement().iter().sum::<f64>() / mesh.nodes() as f64;

        let mut one_way = Run::new(cable.clone(), mesh);
        one_way.passes(80, &forward);
        let mut both = Run::new(cable, mesh);
        let mut creep = 0.0;
        for _ in 0..40 {
            both.pass(&forward);
            creep = mean(&both);
            both.pass(&reverse);
            creep += mean(&both);
        }
        assert!(
            creep.abs() < 1e-3 * mean(&one_way),
            "{creep} m of {} m",
            mean(&one_way)
        );
    }
}
