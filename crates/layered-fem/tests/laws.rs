//! Laws of elasticity and habits of a well-behaved field, on grounds drawn at random and chosen ones.

use ground_field::{
    Base, Displacement, GroundError, GroundField, Modulus, SoilLayer, SoilProfile, SurfaceLoad,
};
use layered_fem::LayeredFem;
use proptest::prelude::*;

use super::common::{layer, on_soil, task3};

const ACCURACY: f64 = 5e-3;

fn unit_load() -> SurfaceLoad {
    SurfaceLoad::point(1.0).unwrap()
}

/// Under a point load on a half-space.
fn half_space(e: f64, nu: f64, radii: &[f64], z: f64) -> Vec<Displacement> {
    let soil = testkit::soil(e, nu);
    radii.iter().map(|&r| testkit::johnson(soil, 1.0, r, z)).collect()
}

fn radii() -> Vec<f64> {
    (0..=60).map(|k| 0.15 * f64::from(k)).collect()
}

/// The line under `load`; `None` if the model says that the accuracy is out of its reach, which it may on a ground
/// drawn at random (the largest `u_r` at a depth can be tiny).
fn line(profile: &SoilProfile, load: SurfaceLoad, depth: f64) -> Option<Vec<Displacement>> {
    let ground = LayeredFem::new(profile, ACCURACY).unwrap();
    match ground.displacements(load, &radii(), depth) {
        Err(GroundError::Accuracy { .. }) => None,
        answer => Some(answer.unwrap()),
    }
}

fn peaks(line: &[Displacement]) -> [f64; 2] {
    line.iter().fold([0.0, 0.0], |peak, u| {
        [peak[0].max(u.radial.abs()), peak[1].max(u.vertical.abs())]
    })
}

/// Largest difference of two lines, as a share of the first's peaks.
fn distance(a: &[Displacement], b: &[Displacement]) -> f64 {
    let peak = peaks(a);
    let apart = |(u, v): (&Displacement, &Displacement)| {
        let difference = *u - *v;
        (difference.radial.abs() / peak[0]).max(difference.vertical.abs() / peak[1])
    };
    a.iter().zip(b).map(apart).fold(0.0, f64::max)
}

fn a_layer() -> impl Strategy<Value = (f64, f64, f64, f64)> {
    // Thickness and moduli spread over decades; the last number is the ratio of the modulus at the bottom to the top.
    (-2.0..0.5, 6.7..10.3, 0.0..0.5, -0.5..0.5)
        .prop_map(|(h, e, nu, k): (f64, f64, f64, f64)| (10f64.powf(h), 10f64.powf(e), nu, 10f64.powf(k)))
}

fn build(layers: &[(f64, f64, f64, f64)], base: Option<(f64, f64)>) -> SoilProfile {
    let layer = |&(h, top, nu, k): &(f64, f64, f64, f64)| {
        let bottom = top * k;
        SoilLayer::new(h, Modulus::Linear { top, bottom }, nu).unwrap()
    };
    let base = base.map_or(Base::Rigid, |(e, nu)| Base::HalfSpace(testkit::soil(e, nu)));
    SoilProfile::new(layers.iter().map(layer).collect(), base).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn softer_ground_moves_more_in_proportion(
        layers in prop::collection::vec(a_layer(), 1..4),
        factor in 0.1..10.0_f64,
    ) {
        let softer: Vec<_> = layers.iter().map(|&(h, e, nu, k)| (h, e / factor, nu, k)).collect();
        let lines = [(&layers, 5e7), (&softer, 5e7 / factor)]
            .map(|(layers, base)| line(&build(layers, Some((base, 0.35))), SurfaceLoad::point(1e5).unwrap(), 1.2));
        prop_assume!(lines.iter().all(Option::is_some));
        let [stiff, soft] = lines.map(Option::unwrap_or_default);
        let scaled: Vec<_> = stiff.iter().map(|&u| u * factor).collect();
        prop_assert!(distance(&soft, &scaled) < 1e-6);
    }

}

#[test]
fn nothing_locks_near_incompressibility() {
    let error = |nu: f64| {
        let ground = LayeredFem::new(&on_soil(vec![], 80.0, nu), ACCURACY).unwrap();
        let found = ground.displacements(unit_load(), &radii(), 1.2).unwrap();
        distance(&half_space(80e6, nu, &radii(), 1.2), &found)
    };
    let compressible = error(0.3);
    for nu in [0.49, 0.499, 0.4999, 0.5] {
        let found = error(nu);
        assert!(found < 2.0 * compressible, "ν = {nu}: {found:.1e}");
    }
}

#[test]
fn answers_far_away_and_deep_are_the_closed_form() {
    let ground = LayeredFem::new(&task3(), ACCURACY).unwrap();
    for (r, z) in [(1e4, 1.2), (1e7, 0.0), (3.0, 1e5)] {
        let u = ground.displacement(unit_load(), r, z).unwrap();
        assert!(distance(&half_space(800e6, 0.4, &[r], z), &[u]) < 1e-9);
    }
    let rock = SoilProfile::new(vec![layer(3.0, 100.0, 0.3)], Base::Rigid).unwrap();
    let rock = LayeredFem::new(&rock, ACCURACY).unwrap();
    let load = SurfaceLoad::point(1e5).unwrap();
    assert_eq!(rock.displacement(load, 0.5, 3.0).unwrap(), Displacement::ZERO);
    assert_eq!(rock.displacement(load, 1e6, 1.0).unwrap(), Displacement::ZERO);
}

/// Largest error of the second difference of `u_r` at `spacing`, as a share of its largest value.
fn second_difference_error(found: &[f64], exact: &[f64]) -> f64 {
    let second = |u: &[f64]| -> Vec<f64> { u.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2]).collect() };
    let (found, exact) = (second(found), second(exact));
    let peak = exact.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    found
        .iter()
        .zip(&exact)
        .fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
        / peak
}

#[test]
fn second_differences_of_the_radial_displacement_are_smooth() {
    let text = include_str!("data/computed_task3_z1200_200pts.csv");
    let row = testkit::layered::table(text, ("task3", 1.2)).remove(0);
    let (profile, load) = testkit::layered::system("task3");
    let ground = LayeredFem::new(&profile, ACCURACY).unwrap();
    let radial = |line: &[Displacement]| line.iter().map(|u| u.radial).collect::<Vec<f64>>();
    let found = radial(&ground.displacements(load, &row.radii(), 1.2).unwrap());
    let exact: Vec<f64> = row.points.iter().map(|point| point.1.radial).collect();
    let error = second_difference_error(&found, &exact);
    assert!(error < 0.02, "layered: {error:.1e}");

    let ground = LayeredFem::new(&on_soil(vec![], 80.0, 0.35), ACCURACY).unwrap();
    for depth in [0.6, 0.77, 1.2, 2.0] {
        for offset in [0.0, 0.037] {
            let places: Vec<f64> = (0..100).map(|k| 0.1 * f64::from(k) + offset).collect();
            let found = radial(&ground.displacements(unit_load(), &places, depth).unwrap());
            let exact = radial(&half_space(80e6, 0.35, &places, depth));
            let error = second_difference_error(&found, &exact);
            assert!(error < 0.03, "depth {depth}, offset {offset}: {error:.1e}");
        }
    }
}

#[test]
fn hostile_input_is_an_error_and_never_a_panic() {
    let load = SurfaceLoad::point(1e5).unwrap();
    let ground = LayeredFem::new(&task3(), ACCURACY).unwrap();
    let is_invalid = |error| matches!(error, GroundError::InvalidParameter { .. });
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    for (r, z) in [(nan, 1.0), (1.0, nan), (-1.0, 1.0), (1.0, -1.0), (infinite, 1.0)] {
        assert!(ground.displacement(load, r, z).is_err_and(is_invalid));
    }
    let on_the_load = ground.displacement(load, 0.0, 0.0).err();
    assert!(matches!(on_the_load, Some(GroundError::Singular { .. })));
    assert!(ground.displacements(load, &[1.0, nan], 1.0).is_err());
    assert!(LayeredFem::new(&task3(), nan).is_err_and(is_invalid));
    let small = LayeredFem::with_max_unknowns(&task3(), 1e-3, 100).err();
    assert!(matches!(small, Some(GroundError::Model { .. })));
}

#[test]
fn accuracy_out_of_reach_is_an_error_with_the_estimate() {
    let ground = LayeredFem::with_max_unknowns(&task3(), 1e-5, 100_000);
    let answer = ground.and_then(|ground| ground.displacement(SurfaceLoad::point(1e5).unwrap(), 0.8, 0.6));
    assert!(matches!(answer, Err(GroundError::Accuracy { reached, .. }) if reached > 1e-5));
}

/// A stiff layer that hardly changes its volume is answered: rounding is far below the accuracy asked.
#[test]
fn nearly_incompressible_stiff_layers_are_answered() {
    let ground = on_soil(vec![layer(0.3, 1e5, 0.5)], 100.0, 0.5);
    let load = SurfaceLoad::new(1e5, 0.15).unwrap();
    let fem = LayeredFem::new(&ground, ACCURACY).unwrap();
    let u = fem.displacements(load, &radii(), 1.2).unwrap();
    assert!(u.iter().all(|u| u.is_finite()));
    assert!(fem.error_estimate(load, 1.2).unwrap().largest() <= ACCURACY);
}
