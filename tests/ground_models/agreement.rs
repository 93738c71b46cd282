//! The Hankel transform and the finite elements have nothing in common but the problem: they must agree on any ground.

use burmister::{DEFAULT_ACCURACY, LayeredHalfSpace};
use layered_fem::LayeredFem;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

use super::common::{
    FEM_ACCURACY, any_base, any_layers, depth_in, distance, line, load, peaks, profile, radii, soil,
};

fn config(cases: u32) -> ProptestConfig {
    let file = "tests/ground_models/agreement.proptest-regressions";
    ProptestConfig {
        cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(file))),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config(12))]

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

    /// Cut in two, a layer is the layer, for both models.
    #[test]
    fn a_layer_in_two_parts_is_the_layer(
        layers in any_layers(), base in any_base(), share in 0.0..1.0_f64,
        which in any::<prop::sample::Index>(), at in 0.1..0.9_f64,
    ) {
        let depth = depth_in(&layers, base, share);
        prop_assume!(depth.is_some());
        let depth = depth.unwrap_or_default();
        let which = which.index(layers.len());
        let (thickness, one) = layers[which];
        let mut cut = layers.clone();
        // Stiffer by 1e-13, so that the two cannot be recognised as one and joined.
        let nearly = soil(one.young_modulus() * (1.0 + 1e-13), one.poisson_ratio());
        cut[which] = (at * thickness, one);
        cut.insert(which + 1, ((1.0 - at) * thickness, nearly));
        let (whole, cut) = (profile(&layers, base), profile(&cut, base));
        let wheel = load(5e4, 0.15);
        let transforms = [&whole, &cut].map(|ground| {
            line(&LayeredHalfSpace::new(ground).expect("transform"), wheel, &radii(), depth)
        });
        let error = distance(&transforms[0], &transforms[1]);
        // Two errors of the promised size, against a peak over these radii instead of all.
        let asked = 3.0 * DEFAULT_ACCURACY;
        prop_assert!(error[0] <= asked && error[1] <= asked, "depth {depth}: {error:?}");
        prop_assert!(peaks(&transforms[0])[1] > 0.0);
        let elements = line(&LayeredFem::new(&cut, FEM_ACCURACY).expect("elements"), wheel, &radii(), depth);
        let error = distance(&transforms[0], &elements);
        let asked = FEM_ACCURACY + DEFAULT_ACCURACY;
        prop_assert!(error[0] <= asked && error[1] <= asked, "elements, depth {depth}: {error:?}");
    }
}
