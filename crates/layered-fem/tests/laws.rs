//! Laws of elasticity and habits of a well-behaved field, on grounds drawn at random and chosen ones.

use ground_field::{
    Base, Displacement, GroundError, GroundField, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad,
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

/// The line under `load`; `None` where the model says that the accuracy is out of its reach, which it may on a ground
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
    a.iter().zip(b).fold(0.0, |worst, (u, v)| {
        worst
            .max((u.radial - v.radial).abs() / peak[0])
            .max((u.vertical - v.vertical).abs() / peak[1])
    })
}

fn a_layer() -> impl Strategy<Value = (f64, f64, f64, f64)> {
    // Thickness and moduli spread over decades; the last number is the ratio of the modulus at the bottom to the top.
    (-2.0..0.5, 6.7..10.3, 0.0..0.5, -0.5..0.5)
        .prop_map(|(h, e, nu, k): (f64, f64, f64, f64)| (10f64.powf(h), 10f64.powf(e), nu, 10f64.powf(k)))
}

fn build(layers: &[(f64, f64, f64, f64)], base: Option<(f64, f64)>) -> SoilProfile {
    let layers = layers
        .iter()
        .map(|&(h, e, nu, k)| {
            SoilLayer::new(
                h,
                Modulus::Linear {
                    top: e,
                    bottom: e * k,
                },
                nu,
            )
            .unwrap()
        })
        .collect();
    let base = base.map_or(Base::Rigid, |(e, nu)| Base::HalfSpace(Soil::new(e, nu).unwrap()));
    SoilProfile::new(layers, base).unwrap()
}

/// The same ground with layer `which` cut at `share` of its thickness.
fn split(layers: &[(f64, f64, f64, f64)], which: usize, share: f64) -> Vec<(f64, f64, f64, f64)> {
    let mut out = layers.to_vec();
    let (h, e, nu, k) = out[which];
    let cut = e * (1.0 + (k - 1.0) * share);
    out[which] = (h * share, e, nu, cut / e);
    out.insert(which + 1, (h * (1.0 - share), cut, nu, e * k / cut));
    out
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn splitting_a_layer_changes_nothing(
        layers in prop::collection::vec(a_layer(), 1..4),
        rock in any::<bool>(),
        base in (7.0..8.7_f64, 0.0..0.5_f64),
        which in any::<prop::sample::Index>(),
        share in 0.1..0.9_f64,
        contact_radius in prop::sample::select(vec![0.0, 0.15]),
    ) {
        let base = (!rock).then(|| (10f64.powf(base.0), base.1));
        let cut = split(&layers, which.index(layers.len()), share);
        let depth: f64 = layers.iter().map(|layer| layer.0).sum();
        let z = if rock { (0.6 * depth).min(1.2) } else { 1.2 };
        prop_assume!(z > 0.5);
        let load = SurfaceLoad::new(1e5, contact_radius).unwrap();
        let lines = [&layers, &cut].map(|layers| line(&build(layers, base), load, z));
        prop_assume!(lines.iter().all(Option::is_some));
        let [whole, cut] = lines.map(Option::unwrap_or_default);
        let found = distance(&whole, &cut);
        prop_assert!(found < 2.0 * ACCURACY, "{found:.1e}");
    }

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

    #[test]
    fn disc_is_the_superposition_of_point_loads(a in 0.05..0.4_f64, r in 0.0..3.0_f64, depth in 0.6..2.0_f64) {
        let ground = LayeredFem::new(&task3(), ACCURACY).unwrap();
        let n = 24;
        let mut sum = Displacement::ZERO;
        for i in 0..n {
            // Rings of equal area, and directions.
            let ring = a * ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
            for k in 0..n {
                let angle = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(n);
                let (x, y) = (r - ring * angle.cos(), ring * angle.sin());
                let away = x.hypot(y);
                let u = ground.displacement(unit_load(), away, depth).unwrap();
                let along = if away > 0.0 { x / away } else { 0.0 };
                sum += Displacement { radial: u.radial * along, vertical: u.vertical } * f64::from(n * n).recip();
            }
        }
        let disc = SurfaceLoad::new(1.0, a).unwrap();
        let found = ground.displacement(disc, r, depth).unwrap();
        let peak = peaks(&ground.displacements(disc, &radii(), depth).unwrap());
        prop_assert!((found.radial - sum.radial).abs() < 2.0 * ACCURACY * peak[0]);
        prop_assert!((found.vertical - sum.vertical).abs() < 2.0 * ACCURACY * peak[1]);
    }
}

#[test]
fn one_layer_is_boussinesq() {
    let ground = LayeredFem::new(&on_soil(vec![layer(0.7, 80.0, 0.35)], 80.0, 0.35), ACCURACY).unwrap();
    for depth in [0.3, 0.6, 0.7, 1.2, 2.0, 5.0, 40.0] {
        let found = ground.displacements(unit_load(), &radii(), depth).unwrap();
        let error = distance(&half_space(80e6, 0.35, &radii(), depth), &found);
        assert!(error < ACCURACY, "depth {depth}: {error:.1e}");
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
        assert!(
            found < 2.0 * compressible,
            "ν = {nu}: {found:.1e} against {compressible:.1e}"
        );
    }
}

#[test]
fn reciprocity_of_two_discs() {
    // The mean settlement of disc B under disc A is that of A under B; measured at the surface, where they act.
    let ground = LayeredFem::new(&task3(), 0.1).unwrap();
    let mean = |loaded: f64, watched: f64| {
        let n = 400;
        let places: Vec<f64> = (0..n)
            .map(|k| watched * ((f64::from(k) + 0.5) / f64::from(n)).sqrt())
            .collect();
        let line = ground
            .displacements(SurfaceLoad::new(1.0, loaded).unwrap(), &places, 0.0)
            .unwrap();
        line.iter().map(|u| u.vertical).sum::<f64>() / f64::from(n)
    };
    let (one, other) = (mean(0.1, 0.5), mean(0.5, 0.1));
    assert!((one / other - 1.0).abs() < 5e-3, "{one} {other}");
}

#[test]
fn answers_far_away_and_deep_are_the_closed_form() {
    let ground = LayeredFem::new(&task3(), ACCURACY).unwrap();
    for (r, z) in [(1e4, 1.2), (1e7, 0.0), (3.0, 1e5)] {
        let u = ground.displacement(unit_load(), r, z).unwrap();
        let exact = half_space(800e6, 0.4, &[r], z)[0];
        assert!(
            (u.radial / exact.radial - 1.0).abs() < 1e-9 && (u.vertical / exact.vertical - 1.0).abs() < 1e-9
        );
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
        for offset in [0.0, 0.013, 0.037, 0.071] {
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
    for (r, z) in [
        (f64::NAN, 1.0),
        (1.0, f64::NAN),
        (-1.0, 1.0),
        (1.0, -1.0),
        (f64::INFINITY, 1.0),
    ] {
        assert!(matches!(
            ground.displacement(load, r, z),
            Err(GroundError::InvalidParameter { .. })
        ));
    }
    assert!(matches!(
        ground.displacement(load, 0.0, 0.0),
        Err(GroundError::Singular { .. })
    ));
    assert!(ground.displacements(load, &[1.0, f64::NAN], 1.0).is_err());
    assert!(matches!(
        LayeredFem::new(&task3(), f64::NAN),
        Err(GroundError::InvalidParameter { .. })
    ));
    assert!(matches!(
        LayeredFem::with_max_unknowns(&task3(), 1e-3, 100),
        Err(GroundError::Model { .. })
    ));
}

#[test]
fn accuracy_out_of_reach_is_an_error_with_the_estimate() {
    let ground = LayeredFem::with_max_unknowns(&task3(), 1e-5, 100_000);
    let answer = ground.and_then(|ground| ground.displacement(SurfaceLoad::point(1e5).unwrap(), 0.8, 0.6));
    assert!(matches!(answer, Err(GroundError::Accuracy { reached, .. }) if reached > 1e-5));
}

/// One factorisation on each of two meshes, and one solution for each of three contact radii, serve every load and depth.
///
/// Work at the default accuracy on the paper's road: the mesh has (2n+1)(2m+1) nodes for n and m intervals that grow with the
/// distance to the load, about 60 each; the Cholesky factor of such a plane mesh fills in by less than a factor of
/// ten over the stiffness, whose lower triangle has 16 entries an unknown. A finer mesh than that means that the estimate has become worse.
#[test]
fn the_work_stays_within_bounds() {
    let ground = LayeredFem::new(&task3(), ACCURACY).unwrap();
    for (force, depth) in [1e3, 1e5]
        .into_iter()
        .flat_map(|force| [0.6, 1.2, 1.7].map(|depth| (force, depth)))
    {
        for contact_radius in [0.0, 0.1, 0.15] {
            let load = SurfaceLoad::new(force, contact_radius).unwrap();
            ground.displacements(load, &radii(), depth).unwrap();
        }
    }
    let statistics = ground.statistics();
    assert_eq!((statistics.factorisations, statistics.solves), (2, 6));
    assert!(statistics.unknowns <= 25_000, "{statistics:?}");
    let fill = statistics.unknowns..=160 * statistics.unknowns;
    assert!(fill.contains(&statistics.factor_entries), "{statistics:?}");
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
