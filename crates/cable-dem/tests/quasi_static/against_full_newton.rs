//! Random scenes against the whole-chain Newton method of [`super::full_newton`].

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, Mesh, Passage, Restraint};
use ground_field::{Direction, DuctLine, DuctMotion, SurfaceLoad, Vehicle, Wheel};
use proptest::prelude::*;

use super::full_newton::{FullChain, even_positions};
use super::scenes::{Run, any_end, cable, elastic_plastic, largest_difference};

#[derive(Debug, Clone)]
struct Scene {
    cable: DuctedCable,
    mesh: Mesh,
    depth: f64,
    wheels: Vec<Wheel>,
    /// Largest displacement of the duct \[m\].
    peak: f64,
    passes: Vec<Direction>,
}

fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

fn scene() -> impl Strategy<Value = Scene> {
    let steps_per_node = prop_oneof![Just(0.5), Just(1.0), Just(2.0), Just(3.0)];
    let place = (5.0..60.0_f64, 0.6..2.5_f64, 3.0..12.0_f64, steps_per_node);
    let stuff = (
        log_uniform(1e5, 1e8),
        (log_uniform(1.0, 300.0), log_uniform(1e3, 1e9)),
        (any_end(1e3..1e9), any_end(1e3..1e9)),
        prop::collection::vec((0.0..=1.0_f64, log_uniform(1e3, 1e9)), 0..3),
    );
    let wheel = (-3.0..3.0_f64, -1.0..1.0_f64, 0.1..1.0_f64).prop_map(|(x, y, load)| {
        let load = SurfaceLoad::point(1e5 * load).expect("a valid load");
        Wheel { x, y, load }
    });
    let direction = prop_oneof![Just(Direction::Forward), Just(Direction::Reverse)];
    let vehicle = (
        prop::collection::vec(wheel, 1..4),
        log_uniform(1e-6, 300e-6),
        prop::collection::vec(direction, 1..4),
    );
    (place, stuff, vehicle).prop_map(
        |(
            (length, depth, nodes_per_depth, steps_per_node),
            (axial_stiffness, (limit, shape_factor), ends, clamps),
            (wheels, peak, passes),
        )| {
            let clamp = |(share, stiffness)| Restraint::new(share * length, stiffness);
            let friction = elastic_plastic(shape_factor, limit);
            let cable = cable(length, axial_stiffness, friction, ends.0, ends.1)
                .with_restraints(clamps.into_iter().map(clamp).collect());
            let spacing = (depth / nodes_per_depth).min(0.5 * length);
            let mesh = Mesh::new(length, spacing, spacing / steps_per_node * (1.0 + 1e-9));
            Scene {
                cable: cable.expect("valid clamps"),
                mesh: mesh.expect("a valid mesh"),
                depth,
                wheels,
                peak,
                passes,
            }
        },
    )
}

impl Scene {
    /// The duct's motion to `reach` \[m\] from the vehicle.
    fn motion(&self, direction: Direction, reach: f64) -> DuctMotion {
        let vehicle = Vehicle::new("random", self.wheels.clone(), 10.0, direction).expect("a valid vehicle");
        let ground = HalfSpace::new(testkit::soil(800e6, 0.4));
        let line = DuctLine::new(self.depth, 0.0).expect("a valid line");
        let motion = DuctMotion::new(&ground, &vehicle, line, reach, 1e-8).expect("a smooth field");
        let peak = motion.peak_longitudinal();
        motion.scaled(self.peak / peak).expect("a finite factor")
    }

    /// Asserts that after vehicles that come from and leave to `depths` beyond the duct all is as the oracle has it: end and element forces as
    /// shares of q L; displacements of the largest of the duct's peak, the stretch under q L and the elastic slip of the sheath; friction,
    /// averaged over the cable, of q.
    fn assert_agrees(&self, depths: f64) {
        let Self { cable, mesh, .. } = self;
        let approach = depths * self.depth;
        let mut run = Run::new(cable.clone(), *mesh);
        let mut oracle = FullChain::new(cable, mesh);
        for &direction in &self.passes {
            let motion = self.motion(direction, cable.length() + approach + 1.0);
            // The shape itself: also in steps too long to say anything of the duct.
            let shape = |xi: f64| direction.sign() * motion.longitudinal(direction.sign() * xi);
            let passage =
                Passage::from_shape(cable, mesh, direction, shape, approach).expect("a valid passage");
            run.pass(&passage);
            let positions = even_positions(mesh, direction, approach);
            assert!(passage.steps() <= positions.len());
            oracle.pass(&positions, |xi| motion.longitudinal(xi));
        }
        let (friction, length) = (cable.friction(), cable.length());
        let limit = friction.limit();
        // With as many nodes slipping forward as backward nothing but friction leaves a range of positions in equilibrium.
        let ends = [cable.upstream(), cable.downstream()].map(|end| end.stiffness().unwrap_or(f64::INFINITY));
        let clamps = cable.restraints().iter().map(|clamp| clamp.stiffness);
        let springs: f64 = ends.into_iter().chain(clamps).sum();
        let is_adrift = springs == 0.0;

        let force = largest_difference(&run.forces(), &oracle.forces()) / (limit * length);
        let pairs = run.state.friction().iter().zip(&oracle.friction);
        let rubbed: f64 = pairs.map(|(one, other)| (one - other).abs()).sum();
        let rubbed = rubbed / (limit * mesh.nodes() as f64);
        let stretch = limit * length * length / cable.axial_stiffness();
        // Weak springs that alone hold it move before they bear a share of the friction.
        let given = 0.02 * limit * length / springs;
        let given = if is_adrift { 0.0 } else { given };
        let size = [stretch, 2.0 / friction.law().shape_factor(), given];
        let size = size.into_iter().fold(self.peak, f64::max);
        let mean = |u: &[f64]| u.iter().sum::<f64>() / u.len() as f64;
        let found = run.state.displacement();
        let drift = mean(found) - mean(&oracle.displacement);
        let drift = if is_adrift { drift } else { 0.0 };
        let displacement: Vec<f64> = oracle.displacement.iter().map(|u| u + drift).collect();
        let moved = largest_difference(found, &displacement) / size;
        // Where in its range of positions a cable adrift lies decides how the return to rest shears a stiff sheath.
        let sheared = if is_adrift { 1e-2 } else { 1e-3 };
        assert!(
            force < 1e-3 && moved < 1e-3 && rubbed < sheared,
            "{force:.1e}, {moved:.1e}, {rubbed:.1e}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Outside its windows the solver leaves up to a thousandth of the friction limit unbalanced at a node while the vehicle
    /// passes. Were that so at every node and with one sign, the force would be off by a thousandth of q L, and
    /// displacements by what this stretches the cable or shears the sheath. In 1400 scenes it was 9e-5 of q L at
    /// most, but for one cable adrift with 5e-4, for which the solver's allowance set to 1e-4 is enough.
    ///
    /// Far beyond the duct the crate's strides grow, the oracle's do not. In 300 scenes followed for 60 depths the strides changed
    /// no force by more than 1.3e-5 of q L.
    #[test]
    fn random_scenes_agree(scene in scene(), depths in prop_oneof![Just(10.0), Just(30.0)]) {
        scene.assert_agrees(depths);
    }
}
