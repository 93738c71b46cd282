//! Laws on random grounds, in addition to the oracle of `random_grounds`: moduli over four decades, layers of 2 mm to 10 m, ν from 0 to 0.5, half-space or rock below.

use std::f64::consts::PI;

use burmister::LayeredHalfSpace;
use ground_field::{Base, Displacement, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use testkit::gauss_legendre::rings;

const ACCURACY: f64 = 1e-8;

fn logarithmic(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from.ln()..to.ln()).prop_map(f64::exp)
}

fn soil() -> impl Strategy<Value = Soil> {
    let ratio = prop_oneof![4 => 0.0..0.5, 1 => Just(0.5)];
    (logarithmic(1e6, 1e10), ratio).prop_map(|(modulus, ratio)| Soil::new(modulus, ratio).expect("soil"))
}

fn layers() -> impl Strategy<Value = Vec<(f64, Soil)>> {
    prop::collection::vec((logarithmic(0.002, 10.0), soil()), 1..6)
}

fn base() -> impl Strategy<Value = Base> {
    prop_oneof![3 => soil().prop_map(Base::HalfSpace), 1 => Just(Base::Rigid)]
}

fn ground(layers: &[(f64, Soil)], base: Base) -> LayeredHalfSpace {
    let layers = layers
        .iter()
        .map(|&(thickness, soil)| SoilLayer::uniform(thickness, soil).expect("layer"))
        .collect();
    let profile = SoilProfile::new(layers, base).expect("profile");
    LayeredHalfSpace::new(&profile).expect("ground")
}

fn load(contact: f64) -> SurfaceLoad {
    SurfaceLoad::new(5e4, contact).expect("load")
}

fn largest(values: &[Displacement], of: impl Fn(&Displacement) -> f64) -> f64 {
    values.iter().map(|value| of(value).abs()).fold(0.0, f64::max)
}

/// Both fields at all radii, equal to `share` of the peak.
fn same(one: &[Displacement], other: &[Displacement], share: f64) -> Result<(), TestCaseError> {
    let peak_r = largest(one, |v| v.radial);
    let peak_z = largest(one, |v| v.vertical);
    for (a, b) in one.iter().zip(other) {
        prop_assert!((a.radial - b.radial).abs() <= share * peak_r, "{a:?} {b:?}");
        prop_assert!((a.vertical - b.vertical).abs() <= share * peak_z, "{a:?} {b:?}");
    }
    Ok(())
}

/// Radii that include the neighbourhood of both peaks.
fn radii(depth: f64) -> Vec<f64> {
    (0..30)
        .map(|k| 0.05 * depth * 1.35_f64.powi(k))
        .chain([0.0])
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/laws.proptest-regressions"))), ..ProptestConfig::default() })]

    /// One layer is Boussinesq, whatever its thickness. The base is stiffer by 1e-13, so that nothing is joined and the
    /// integrals are really done.
    #[test]
    fn one_layer_is_boussinesq(soil in soil(), thickness in logarithmic(0.002, 10.0), depth in logarithmic(0.05, 20.0)) {
        let nearly = Soil::new(soil.young_modulus() * (1.0 + 1e-13), soil.poisson_ratio()).expect("soil");
        let layered = ground(&[(thickness, soil)], Base::HalfSpace(nearly));
        let radii = radii(depth);
        let values = layered.displacements(load(0.0), &radii, depth).expect("layered");
        let exact: Vec<Displacement> = radii.iter().map(|&r| testkit::johnson(soil, 5e4, r, depth)).collect();
        same(&exact, &values, ACCURACY)?;
    }

    /// Maxwell and Betti on the surface: the work of one disc on the settlement under another is mutual.
    #[test]
    fn two_discs_do_the_same_work_on_each_other(
        layers in layers(), base in base(), one in 0.05..0.15_f64, two in 0.05..0.15_f64, gap in 1.0..3.0_f64,
    ) {
        let ground = ground(&layers, base);
        let distance = one + two + gap;
        let work = |source: f64, target: f64| {
            let mut distances = Vec::new();
            let mut weights = Vec::new();
            for j in 0..32 {
                let cosine = (PI * (f64::from(j) + 0.5) / 32.0).cos();
                for (share, weight) in rings(8) {
                    let ring = target * share;
                    distances.push((distance * distance + ring * ring - 2.0 * distance * ring * cosine).sqrt());
                    weights.push(weight / 32.0);
                }
            }
            let values = ground.displacements(load(source), &distances, 0.0).expect("surface");
            let mean: f64 = values.iter().zip(weights).map(|(v, w)| v.vertical * w).sum();
            mean
        };
        // A squeezed incompressible layer rises around the disc and hardly sinks under it.
        let near: Vec<f64> = (0..40).map(|k| 0.005 * f64::from(k)).collect();
        let settlement = |contact| ground.displacements(load(contact), &near, 0.0).expect("peak");
        let peak = largest(&settlement(one), |v| v.vertical).max(largest(&settlement(two), |v| v.vertical));
        // A stiff sheet on a soft layer bends in waves of a few tenths of a metre: the rule resolves them to 1e-12.
        let difference = (work(one, two) - work(two, one)).abs();
        prop_assert!(difference <= 2.0 * ACCURACY * peak, "{difference:e} {peak:e}");
    }

    /// A coarse answer is as good as it says, many radii at once are what each is alone, and all is linear in the force.
    #[test]
    fn what_is_asked_is_met(layers in layers(), base in base(), depth in logarithmic(0.02, 5.0), digits in 1..9_i32) {
        let ground = ground(&layers, base);
        let radii = radii(depth);
        let coarse = 10.0_f64.powi(-digits);
        let fine = ground.clone().with_accuracy(1e-9).expect("accuracy").displacements(load(0.1), &radii, depth).expect("fine");
        let ground = ground.with_accuracy(coarse).expect("accuracy");
        let together = ground.displacements(load(0.1), &radii, depth).expect("together");
        same(&fine, &together, coarse + 1e-9)?;
        let alone: Vec<Displacement> = radii.iter()
            .map(|&r| ground.displacement(SurfaceLoad::new(1e5, 0.1).expect("load"), r, depth).expect("alone") * 0.5)
            .collect();
        same(&fine, &alone, coarse + 1e-9)?;
    }
}
