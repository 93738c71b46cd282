//! Work is done where the cable moves only, and nothing slips unseen.

use cable_dem::{End, Friction, FrictionLaw, Mesh, Passage};
use ground_field::Direction;
use proptest::prelude::*;

use super::scenes::{APPROACH, Run, any_wheels, cable, wheeled};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(800))]

    /// Zones that slip begin, end and meet wherever wheels lead and follow: on coarse meshes within the same few nodes.
    #[test]
    fn friction_keeps_its_limit_outside_the_windows_too(
        wheels in any_wheels(-6e-5..6e-5),
        (exponent, limit) in (6.3..9.3_f64, 5.0..50.0_f64),
        law in prop_oneof![Just(FrictionLaw::Coulomb), Just(FrictionLaw::ElasticPlastic { shape_factor: 1e7 })],
        (spacing, steps) in (0.1..0.6_f64, 1..4_u32),
    ) {
        let friction = Friction::new(law, limit).expect("valid friction");
        let cable = cable(30.0, 10.0_f64.powf(exponent), friction, End::Free, End::Fixed);
        let mesh = Mesh::new(30.0, spacing, spacing / f64::from(steps)).expect("a valid mesh");
        let shape = |xi: f64| wheeled(&wheels, xi, |t| t / (1.0 + t * t).powi(2));
        let mut run = Run::new(cable.clone(), mesh);
        for direction in [Direction::Forward, Direction::Reverse, Direction::Forward] {
            let passage = Passage::from_shape(&cable, &mesh, direction, shape, APPROACH).expect("a valid passage");
            let mut largest = 0.0_f64;
            run.watch(&passage, |_, state| {
                largest = state.friction().iter().fold(largest, |most, friction| most.max(friction.abs()));
            });
            // What may stay unbalanced outside the windows.
            prop_assert!(largest <= 1.001_000_001 * limit, "{largest} of {limit} N/m");
        }
    }
}
