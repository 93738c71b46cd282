//! The error bound of Odemark's approximation against its true error.

use boussinesq::Odemark;
use burmister::{LayeredHalfSpace, odemark_error_bound};
use ground_field::{Base, Displacement, GroundError, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// True errors of u_r and u_z, as shares of their peaks, over radii to 20 m.
fn true_error(profile: &SoilProfile, load: SurfaceLoad, depth: f64) -> Result<(f64, f64), GroundError> {
    let radii: Vec<f64> = (1..=400).map(|k| 0.05 * f64::from(k)).collect();
    let exact = LayeredHalfSpace::new(profile)?.displacements(load, &radii, depth)?;
    let near = Odemark::new(profile)?.displacements(load, &radii, depth)?;
    let share = |part: fn(&Displacement) -> f64| {
        let peak = exact.iter().map(|u| part(u).abs()).fold(0.0, f64::max);
        let gaps = exact.iter().zip(&near).map(|(a, b)| (part(a) - part(b)).abs());
        gaps.fold(0.0, f64::max) / peak
    };
    Ok((share(|u| u.radial), share(|u| u.vertical)))
}

fn ground() -> impl Strategy<Value = (SoilProfile, f64, f64)> {
    let layer = (-1.5..0.7_f64, 7.0..10.0_f64, 0.1..0.49_f64);
    let layers = prop::collection::vec(layer, 1..5);
    let contact = prop_oneof![Just(0.0), Just(0.15)];
    (
        layers,
        7.0..10.0_f64,
        prop::bool::weighted(0.2),
        0.3..2.0_f64,
        contact,
    )
        .prop_map(|(layers, base, rock, depth, contact)| {
            let layers: Vec<SoilLayer> = layers
                .into_iter()
                .map(|(h, e, nu)| {
                    let soil = Soil::new(10_f64.powf(e), nu).expect("soil");
                    SoilLayer::uniform(10_f64.powf(h), soil).expect("layer")
                })
                .collect();
            let deep = layers.iter().map(SoilLayer::thickness).sum::<f64>() > depth + 0.1;
            let base = if rock && deep {
                Base::Rigid
            } else {
                Base::HalfSpace(Soil::new(10_f64.powf(base), 0.4).expect("soil"))
            };
            (SoilProfile::new(layers, base).expect("profile"), depth, contact)
        })
}

/// Never below the truth, and close to it: on 400 random grounds.
#[test]
fn bounds_the_true_error_and_not_by_much() {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut ratios = Vec::new();
    for _ in 0..400 {
        let (profile, depth, contact) = ground().new_tree(&mut runner).expect("a ground").current();
        let load = SurfaceLoad::new(1e5, contact).expect("load");
        let (radial, vertical) = true_error(&profile, load, depth).expect("an exact answer");
        let bound = odemark_error_bound(&profile, load, depth).expect("a bound");
        assert!(
            bound.radial >= radial && bound.vertical >= vertical,
            "{bound:?} under {radial} or {vertical}: {profile:?} at {depth}"
        );
        ratios.push(bound.radial / radial);
    }
    ratios.sort_by(f64::total_cmp);
    let (middle, most) = (ratios[200], ratios[380]);
    assert!(middle < 2.0 && most < 4.0, "{middle} {most}");
}

/// One soil in layers is what Odemark has exactly, and so the bound is rounding.
#[test]
fn nothing_where_the_approximation_is_exact() {
    let soil = Soil::new(80e6, 0.35).expect("soil");
    let other = Soil::new(80e6, 0.350_000_01).expect("soil");
    let layer = SoilLayer::uniform(0.7, other).expect("layer");
    let profile = SoilProfile::new(vec![layer], Base::HalfSpace(soil)).expect("profile");
    let bound = odemark_error_bound(&profile, SurfaceLoad::point(1e5).expect("load"), 1.2).expect("a bound");
    assert!(bound.radial < 1e-6 && bound.vertical < 1e-6, "{bound:?}");
}

/// The cost is known beforehand: panels of 8 nodes, halved from 16/depth to 0.03/(depth + base depth).
#[test]
fn costs_a_hundred_wavenumbers() {
    let soil = |e| Soil::new(e, 0.35).expect("soil");
    let layer = SoilLayer::uniform(0.69, soil(2e9)).expect("layer");
    let profile = SoilProfile::new(vec![layer], Base::HalfSpace(soil(1e8))).expect("profile");
    let bound = odemark_error_bound(&profile, SurfaceLoad::point(1e5).expect("load"), 1.2).expect("a bound");
    assert!(bound.wavenumbers <= 96, "{bound:?}");
}

#[test]
fn what_cannot_be_told_is_an_error() {
    let soil = Soil::new(80e6, 0.35).expect("soil");
    let layer = SoilLayer::uniform(0.7, soil).expect("layer");
    let load = SurfaceLoad::point(1e5).expect("load");
    let rock = SoilProfile::new(vec![layer], Base::Rigid).expect("profile");
    for depth in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(odemark_error_bound(&rock, load, depth).is_err());
    }
    assert_eq!(
        odemark_error_bound(&rock, load, 0.7)
            .expect("rock at rest")
            .radial,
        0.0
    );
}
