//! A scene that a program changed: refused with the key, or computed to finite numbers, never a panic.

use creepage::Readings;
use creepage::calibration::{Quantity, Unknown};
use creepage::design::{DesignOptions, Limits, Place, design};
use creepage::report::{Report, ReportOptions};
use creepage::scene::{
    Arrangement, End, Following, GroundModel, Law, Layer, Restraint, RouteSection, Scene, SceneError,
    SolverMethod, TrafficVehicle, Wheel,
};
use creepage::{CalibrateOptions, Error};
use ground_field::{Direction, Modulus};
use proptest::prelude::*;

use crate::scenes::upper;

/// The edited scene is refused under this key, by everything that takes a scene.
#[track_caller]
fn assert_refused(key: &str, edit: impl FnOnce(&mut Scene)) {
    let mut scene = upper(&[]);
    edit(&mut scene);
    let named = |error: Error| match error {
        Error::Scene(SceneError::Wrong(wrong)) if wrong.location.is_none() => assert_eq!(wrong.key, key),
        other => panic!("{key}: {other}"),
    };
    named(scene.validate().expect_err(key).into());
    named(creepage::plan(&scene).expect_err(key));
    named(creepage::run(&scene).expect_err(key));
    named(creepage::profile(&scene).expect_err(key));
    named(creepage::profile_at(&scene, &[0.0]).expect_err(key));
}

fn clamp(position: f64, stiffness: f64, holds: Option<f64>) -> Restraint {
    Restraint {
        holds,
        ..Restraint::new(position, stiffness)
    }
}

fn wheel(load: f64, contact_radius: f64) -> Wheel {
    let (x, y) = (1.0, 0.5);
    Wheel {
        x,
        y,
        load,
        contact_radius,
    }
}

/// Fields of a scene, each with values that are refused under its own key.
macro_rules! assert_fields_refused {
    ($([$($field:tt)+] $($value:expr),+;)*) => {$(
        let key = stringify!($($field)+).replace([' ', ']'], "").replace('[', ".");
        for value in [$($value),+] {
            assert_refused(&key, |scene| scene.$($field)+ = value);
        }
    )*};
}

#[test]
fn every_part_of_a_scene_has_its_ranges() {
    assert_fields_refused! {
        [duct.length] f64::INFINITY;
        [duct.depth] -1.0, 0.0, f64::NAN, f64::INFINITY, 1e4;
        [duct.lateral_offset] f64::NAN;
        [duct.inner_diameter] Some(0.0);
        [duct.slope] 1.1, -1.1, f64::NAN;
        [ground.vertical_peak] Some(-1e-4), Some(0.0), Some(f64::NAN), Some(2.0);
        [ground.longitudinal_peak] Some(-1e-4), Some(0.0), Some(f64::NAN), Some(2.0);
        [ground.rigid_base_depth] Some(-1.0);
        [ground.layers] Vec::new();
        [ground.layers[0].young_modulus] Modulus::Uniform(1e20), Modulus::Uniform(0.0);
        [ground.layers[0].poisson_ratio] 0.51, -0.1;
        [cable.weight] 0.0, -1.0;
        [cable.axial_stiffness] -1.0, 0.0;
        [cable.normal_load_factor] Some(0.0);
        [friction.dynamic_coefficient] 50.0, -0.1, f64::NAN;
        [vehicles] Vec::new();
        [vehicles[0].share] -1.0, 0.0, f64::NAN, f64::INFINITY;
        [vehicles[0].speed] 1e9, 0.0;
        [vehicles[0].load] Some(1e30), Some(-1.0);
        [vehicles[0].lateral_offset] f64::NAN, 2e3;
        [traffic.passes] 0, u64::MAX;
        [solver.tolerance] f64::NAN, 0.0, -0.01, 0.6;
        [solver.node_spacing] Some(20.0), Some(0.0);
        [solver.vehicle_step] Some(0.0);
        [solver.time_step] Some(f64::INFINITY), Some(0.0);
        [solver.approach] Some(-1.0);
    }
    for spring in [-1.0, 0.0] {
        let end = End::Spring(spring);
        assert_refused("ends.downstream.spring", |scene| scene.ends.downstream = end);
    }
    for (key, clamp) in [
        ("position", clamp(31.0, 1e6, None)),
        ("position", clamp(-1.0, 1e6, None)),
        ("stiffness", clamp(1.0, 0.0, None)),
        ("stiffness", clamp(1.0, f64::NAN, None)),
        ("holds", clamp(1.0, 1e6, Some(0.0))),
    ] {
        assert_refused(&format!("restraints.0.{key}"), |scene| {
            scene.restraints = vec![clamp];
        });
    }
    for (key, load, contact_radius) in [("load", -7.0, 0.1), ("contact_radius", 1e4, -1.0)] {
        assert_refused(&format!("vehicles.0.wheels.0.{key}"), |scene| {
            let wheels = vec![wheel(load, contact_radius)];
            (scene.vehicles[0].load, scene.vehicles[0].wheels) = (None, wheels);
        });
    }
    // Shares are relative to each other.
    let mut scene = upper(&[]);
    scene.vehicles[0].share = 7.0;
    scene.validate().expect("a scene");
    assert_eq!(scene.shares(), [1.0]);
}

#[test]
fn what_several_keys_say_has_to_fit() {
    let modulus = Modulus::Uniform(1e9);
    let layer = |thickness, young_modulus| Layer {
        thickness,
        young_modulus,
        poisson_ratio: 0.4,
    };
    let graded = |top| Modulus::Linear { top, bottom: 1e9 };
    // Layers with the depth of the rock.
    let [known, last] = [Some(1.0), None].map(|thickness| layer(thickness, modulus));
    for (key, layers, rock) in [
        ("0.thickness", vec![layer(Some(1e5), modulus), last], None),
        ("0.thickness", vec![last; 2], None),
        ("0.thickness", vec![layer(Some(0.0), modulus), last], None),
        ("1.thickness", vec![known; 2], None),
        ("0.young_modulus.top", vec![layer(None, graded(1.0))], Some(1.0)),
        ("0.young_modulus.top", vec![layer(None, graded(0.0))], Some(1.0)),
        ("0.young_modulus", vec![layer(None, graded(1e8))], None),
    ] {
        assert_refused(&format!("ground.layers.{key}"), |scene| {
            (scene.ground.layers, scene.ground.rigid_base_depth) = (layers, rock);
        });
    }
    let two = vec![layer(Some(1.0), Modulus::Uniform(2e9)), last];
    assert_refused("ground.rigid_base_depth", |scene| {
        (scene.ground.layers, scene.ground.rigid_base_depth) = (two.clone(), Some(0.9));
    });
    assert_refused("ground.model", |scene| {
        scene.ground.layers.clone_from(&two);
        scene.ground.model = GroundModel::Boussinesq;
    });
    assert_refused("friction.shape_factor", |scene| {
        (scene.friction.law, scene.friction.shape_factor) = (Law::Sigmoid, Some(0.0));
    });
    assert_refused("vehicles.0", |scene| scene.vehicles[0].load = None);
    assert_refused("vehicles.0.load", |scene| {
        (scene.vehicles[0].load, scene.ground.vertical_peak) = (Some(0.0), Some(1e-4));
    });
    // Several vehicles.
    let of = |vehicles: &[&str], names: &[&str]| {
        let mut scene = upper(&[]);
        let vehicles = vehicles.iter().map(|name| TrafficVehicle::point(name, 1e5, 10.0));
        scene.vehicles = vehicles.collect();
        scene.traffic.sequence = names.iter().map(ToString::to_string).collect();
        scene
    };
    let sequence = |names: &[&str]| of(&["a", "b"], names);
    assert_refused("vehicles.1.name", |scene| *scene = of(&["a", "a"], &[]));
    assert_refused("traffic.sequence.1", |scene| *scene = sequence(&["a", "c"]));
    assert_refused("traffic.sequence", |scene| {
        *scene = sequence(&["a"]);
        scene.traffic.order = Following::Random;
    });
    assert_refused("vehicles.0.share", |scene| {
        *scene = sequence(&[]);
        scene.vehicles[0].share = 0.0;
    });
    let scene = sequence(&["a", "b", "a"]);
    scene.validate().expect("a scene");
    assert_eq!(scene.shares(), [2.0 / 3.0, 1.0 / 3.0]);
}

/// Everything else that takes a scene, with one that has no vehicles.
#[test]
fn designs_fits_and_reports_refuse_an_edited_scene_too() {
    let mut scene = upper(&[]);
    scene.vehicles.clear();
    let limits = DesignOptions::new(Place::Downstream, Limits::both(Some(1e3), None));
    let table = b"pass,force_n\n1,100\n2,150\n3,180\n";
    let readings = Readings::from_csv("a.csv", table).expect("readings");
    let mut options = CalibrateOptions::default();
    let fit = creepage::calibrate(&scene, &readings, &options);
    let report = Report::new(&scene, &ReportOptions::default());
    assert!(design(&scene, &limits).is_err_and(|error| error.is_bad_input()));
    assert!(fit.is_err_and(|error| error.is_bad_input()));
    assert!(report.is_err_and(|error| error.is_bad_input()));
    // Nor is there a fit of nothing.
    assert!(creepage::calibrate_jointly(&[], &options).is_err());
    options.unknowns = vec![Unknown::of(Quantity::DynamicCoefficient, 9)];
    assert!(creepage::calibrate(&upper(&[]), &readings, &options).is_err());
}

#[test]
fn a_position_of_the_profile_is_a_number() {
    for xi in [f64::NAN, f64::INFINITY, -1e300] {
        assert!(creepage::profile_at(&upper(&[]), &[0.0, xi]).is_err(), "{xi}");
    }
}

/// Numbers as programs get them wrong, and right ones.
fn numbers() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(&testkit::NASTY[..]),
        prop::sample::select(vec![0.3, 1.0, 2.0, 100.0]),
        any::<f64>(),
        0.01..20.0,
    ]
}

/// Changes one number of the scene.
fn edit(scene: &mut Scene, field: usize, value: f64, whole: u64) {
    let straight = RouteSection::default();
    let layer = &mut scene.ground.layers[0];
    match field {
        0 => scene.duct.length = value,
        1 => scene.duct.depth = value,
        2 => scene.duct.lateral_offset = value,
        3 => scene.ground.vertical_peak = Some(value),
        4 => scene.ground.longitudinal_peak = Some(1e-5 * value),
        5 => layer.young_modulus = Modulus::Uniform(1e8 * value),
        6 => layer.poisson_ratio = value,
        7 => scene.cable.weight = value,
        8 => scene.cable.axial_stiffness = 1e6 * value,
        9 => scene.cable.normal_load_factor = Some(value),
        10 => scene.friction.dynamic_coefficient = value,
        11 => (scene.friction.law, scene.friction.shape_factor) = (Law::ElasticPlastic, Some(1e7 * value)),
        12 => (scene.friction.law, scene.friction.shape_factor) = (Law::Sigmoid, Some(1e7 * value)),
        13 => scene.ends.upstream = End::Spring(1e6 * value),
        14 => scene.ends.downstream = End::Spring(value),
        15 => scene.restraints.push(Restraint::new(value, 1e6)),
        16 => scene.restraints.push(Restraint::new(3.0, value)),
        17 => scene.vehicles[0].share = value,
        18 => scene.vehicles.clear(),
        19 => {
            let wheels = vec![wheel(1e5, value)];
            (scene.vehicles[0].load, scene.vehicles[0].wheels) = (None, wheels);
            scene.vehicles[0].direction = Direction::Reverse;
        }
        20 => scene.vehicles[0].load = Some(1e5 * value),
        21 => scene.vehicles[0].speed = value,
        22 => scene.traffic.passes = whole,
        23 => scene.traffic.sequence = vec![scene.vehicles[0].name.clone(), whole.to_string()],
        24 => scene.ground.rigid_base_depth = Some(value),
        25 => scene.solver.tolerance = value,
        26 => scene.solver.node_spacing = Some(value),
        27 => scene.solver.vehicle_step = Some(value),
        28 => scene.solver.time_step = Some(1e-4 * value),
        29 => scene.solver.approach = Some(value),
        30 => scene.solver.method = SolverMethod::PassLaw,
        31 => scene.duct.slope = value,
        32 => scene.duct.inner_diameter = Some(value),
        33 => scene.cable.diameter = Some(0.067),
        34 => scene.cable.arrangement = Arrangement::CradledMiddle,
        35 => scene.restraints.push(clamp(3.0, 1e6, Some(value))),
        36 | 37 => {
            let [slope, bend_radius] = if field == 36 {
                [0.01 * value, 10.0]
            } else {
                [0.0, value]
            };
            let bend = RouteSection {
                slope,
                bend_radius: Some(bend_radius),
                ..straight
            };
            let length = (field == 37).then_some(value);
            let first = length.map(|_| RouteSection { length, ..straight });
            scene.route = first.into_iter().chain([bend]).collect();
        }
        38 => {
            let dynamic_coefficient = Some(value);
            scene.route = vec![RouteSection {
                dynamic_coefficient,
                ..straight
            }];
        }
        _ => {
            let duct = &mut scene.duct;
            (duct.length, duct.depth) = (value, value);
            (duct.lateral_offset, duct.slope) = (value, value);
        }
    }
}

/// Work that a test can do: two passes over a cable that is not long relative to its duct's depth, on a mesh that is no finer than usual.
fn small(scene: &Scene) -> bool {
    let finest = scene.duct.depth / 12.0;
    let usual = |step: Option<f64>| step.is_none_or(|step| step >= finest);
    let road = scene.duct.length + 2.0 * scene.solver.approach.unwrap_or(15.0);
    scene.traffic.passes <= 2
        && scene.solver.tolerance >= 0.01
        && scene.solver.method == SolverMethod::Auto
        && usual(scene.solver.node_spacing)
        && usual(scene.solver.vehicle_step)
        && road <= 60.0 * scene.duct.depth
        && scene.friction.law().has_memory()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_edit_of_a_scene_panics(
        edits in prop::collection::vec((0usize..40, numbers(), prop::sample::select(vec![0, 1, 2, u64::MAX])), 1..4),
    ) {
        let mut scene = upper(&["traffic.passes=2", "solver.tolerance=0.1"]);
        for (field, value, whole) in edits {
            if field != 18 && scene.vehicles.is_empty() {
                continue;
            }
            edit(&mut scene, field, value, whole);
        }
        let valid = scene.validate().is_ok();
        if let Ok(plan) = creepage::plan(&scene) {
            prop_assert!(valid);
            let report = plan.report();
            prop_assert!(report.node_spacing_m.is_finite() && report.estimated_seconds.is_finite());
        }
        if let Ok(profile) = creepage::profile(&scene) {
            prop_assert!(valid);
            let [along, down] = [&profile.longitudinal_m, &profile.vertical_m];
            let all = [&profile.positions_m, along, down, &profile.longitudinal_velocity_m_per_s];
            prop_assert!(all.into_iter().flatten().all(|value| value.is_finite()));
        }
        if (!valid || small(&scene)) && let Ok(run) = creepage::run(&scene) {
            prop_assert!(valid);
            prop_assert_eq!(run.passes.len() as u64, scene.traffic.passes);
            for pass in run.passes {
                prop_assert!(pass.downstream_force_n.is_finite() && pass.upstream_force_n.is_finite());
                prop_assert!(pass.downstream_displacement_m.is_finite() && pass.max_compression_n.is_finite());
            }
        }
    }
}
