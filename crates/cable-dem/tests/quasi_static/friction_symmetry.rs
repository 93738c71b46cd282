//! What friction laws keep whatever the numbers.

use cable_dem::{Friction, FrictionLaw};
use proptest::prelude::*;

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
