//! The Hankel transform and the finite elements have nothing in common but the problem: they must agree on any ground.

use burmister::{DEFAULT_ACCURACY, LayeredHalfSpace};
use layered_fem::LayeredFem;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

use super::common::{FEM_ACCURACY, any_base, any_layers, depth_in, distance, line, load, profile, radii};

fn config() -> ProptestConfig {
    let file = "tests/ground_models/agreement.proptest-regressions";
    ProptestConfig {
        cases: 12,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(file))),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn transform_and_finite_elements_agree(
        layers in any_layers(), base in any_base(), share in 0.0..1.0_f64,
        contact in prop_oneof![Just(0.0), 0.1..0.2_f64],
    ) {
        let depth = depth_in(&layers, base, share);
        prop_assume!(depth.is_some());
        let depth = depth.unwrap_or_default();
        let ground = profile(&layers, base);
        let transform = LayeredHalfSpace::new(&ground).expect("transform");
        let elements = LayeredFem::new(&ground, FEM_ACCURACY).expect("elements");
        let wheel = load(5e4, contact);
        let exact = line(&transform, wheel, &radii(), depth);
        let error = distance(&exact, &line(&elements, wheel, &radii(), depth));
        let asked = FEM_ACCURACY + DEFAULT_ACCURACY;
        prop_assert!(error[0] <= asked && error[1] <= asked, "depth {depth}: {error:?}");
        // The error that the elements state for themselves is no smaller than the true one.
        let stated = elements.error_estimate(wheel, depth).expect("estimate");
        let floor = 1e-4;
        prop_assert!(error[0] <= stated.radial + floor && error[1] <= stated.vertical + floor,
            "depth {depth}: {error:?} where {stated:?} is stated");
    }
}
