//! Calibration of scenes: readings made by another solver, on a finer mesh, give back their friction.

use creepage::calibration::{Deflection, Quantity, Unknown};
use creepage::readings::{Measured, Place};
use creepage::{
    CalibrateOptions, Calibrated, Error, Reading, Readings, Scene, Series, calibrate, calibrate_jointly,
};

use ground_field::Modulus;

use crate::scenes::{assert_near, forces, run, upper};

/// A fit of the friction coefficient alone.
fn friction_alone() -> CalibrateOptions<'static> {
    CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::DynamicCoefficient)],
        ..CalibrateOptions::default()
    }
}

fn fit(scene: &Scene, data: &Readings) -> Calibrated {
    calibrate(scene, data, &CalibrateOptions::default()).unwrap()
}

/// The fit's scene on a coarse mesh, where what comes back is not compared with the truth.
fn coarse() -> Scene {
    upper(&["solver.node_spacing=0.3", "solver.vehicle_step=0.2"])
}

/// Forces after so many passes of the coarse scene.
fn computed(passes: u64) -> Vec<f64> {
    let mut scene = coarse();
    scene.traffic.passes = passes;
    forces(&run(&scene))
}

fn noisy(forces: &[f64], sigma: f64, seed: u64) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(seed);
    let noise = forces
        .iter()
        .map(|force| force + sigma * testkit::gaussian(&mut random));
    noise.collect()
}

fn readings(forces: &[f64]) -> Readings {
    (1..)
        .zip(forces)
        .map(|(pass, &force)| Reading::force(pass, force))
        .collect()
}

/// Forces by the solver with inertia on a mesh twice as fine as the fit's first.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn friction_comes_back_from_another_solver() {
    let finer = "solver={ method = \"explicit\", node_spacing = 0.1, vehicle_step = 0.05 }";
    let truth = ["friction.shape_factor=2e6", "traffic.passes=40", finer];
    let series = forces(&run(&upper(&truth)));
    let answer = fit(&upper(&[]), &readings(&noisy(&series, 3.0, 1)));
    let [coefficient, shape] = &answer.parameters[..] else {
        panic!("{:?}", answer.parameters)
    };
    assert_eq!(
        (&*coefficient.name, &*shape.name),
        ("dynamic_coefficient", "shape_factor")
    );
    assert_near(coefficient.value, 0.25, 0.02, coefficient);
    assert_near(shape.value, 2e6, 0.1, shape);
    assert!(answer.parameters.iter().all(|parameter| parameter.identifiable));
    assert!(answer.evaluations <= 200, "{}", answer.evaluations);
    let rms = answer.residual_rms_n;
    assert!((2.0..4.0).contains(&rms), "{rms}");
    assert!(answer.r_squared.unwrap() > 0.999);
    for row in &answer.fit {
        assert!((row.value - row.fitted - row.residual).abs() < 1e-9);
        assert_eq!(row.force_n, Some(row.value));
    }
    assert!(answer.model_error.relative < 0.01);
}

/// An instrument that is overloaded writes a number that no cable can make: the fit is that without the row.
#[test]
fn an_overload_is_no_reading() {
    let clean = readings(&noisy(&computed(12), 3.0, 1));
    let mut list = clean.list.clone();
    list.insert(7, Reading::force(8, -9.9e37));
    let options = friction_alone();
    let fit = |readings: &Readings| calibrate(&coarse(), readings, &options).unwrap();
    let (without, with) = (fit(&clean), fit(&list.into_iter().collect()));
    assert_eq!(with.parameters, without.parameters);
    let told = &with.warnings[0];
    assert!(told.ends_with("left out: pass 8 (line 8)"), "{told}");
}

/// A cell whose forces are all beyond reach is no exception among those of another: something is wrong with it.
#[test]
fn a_cell_in_another_unit_is_no_overload() {
    let mut list = readings(&noisy(&computed(12), 3.0, 1)).list;
    let inside = |pass: u64| Reading {
        measured: Measured::Force(Place::At(20.0)),
        ..Reading::force(pass, 2e5 + 1e3 * pass as f64)
    };
    list.extend((1..=6).map(inside));
    let options = friction_alone();
    let answer = calibrate(&coarse(), &list.into_iter().collect(), &options).unwrap();
    let left_out = answer.warnings.iter().any(|text| text.contains("left out"));
    assert!(!left_out && answer.lack_of_fit.suspicious, "{answer:?}");
}

/// Readings of a run each are tested together: forces that stay where the model lets them grow do not follow it.
#[test]
fn readings_of_a_run_each_are_judged_together() {
    let fit = |force: &dyn Fn(usize) -> f64| {
        let row = |pass: usize| format!("run {pass},{pass},{}\n", force(pass));
        let rows: String = (1..=14).map(row).collect();
        let text = format!("run,pass,force_n\n{rows}");
        let readings = Readings::from_csv("runs.csv", text.as_bytes()).unwrap();
        calibrate(&coarse(), &readings, &friction_alone()).unwrap()
    };
    let noise = noisy(&[0.0; 15], 3.0, 4);
    let level = fit(&|pass| 230.0 + noise[pass]).lack_of_fit;
    assert!(level.suspicious && level.p_runs < 0.01, "{level:?}");
    let followed = computed(14);
    let lack = fit(&|pass| followed[pass - 1] + noise[pass]).lack_of_fit;
    assert!(!lack.suspicious && lack.p_noise.is_some(), "{lack:?}");
}

/// Both cables over one ground, and readings of each by runs of their scenes as `truth` changes them.
fn both_cables(truth: impl Fn(&mut Scene)) -> [(Scene, Readings); 2] {
    [("upper", 1), ("lower", 2)].map(|(cable, seed)| {
        let scene = Scene::from_file(format!("examples/scenes/full-scale-{cable}.toml")).unwrap();
        let mut true_scene = scene.clone();
        truth(&mut true_scene);
        let data = readings(&noisy(&forces(&run(&true_scene)), 4.0, seed));
        (scene, data)
    })
}

/// A softer ground that both cables share and the friction of each, with a measured deflection; and their laws too, with none.
#[test]
#[ignore = "half a minute: see CONTRIBUTING.md for the command"]
fn three_and_five_parameters_of_two_series() {
    let both = [("dynamic_coefficient_1", 0.25), ("dynamic_coefficient_2", 0.27)];
    let laws = [("shape_factor_1", 2e6), ("shape_factor_2", 2e6)];
    let cables = both_cables(|scene| {
        scene.ground.layers[0].young_modulus = Modulus::Uniform(720e6);
        (scene.friction.shape_factor, scene.traffic.passes) = (Some(2e6), 60);
        (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.1), Some(0.05));
    });
    let truths = [&both[..], &laws, &[("ground_stiffness", 0.9)]].concat();
    fitted_jointly(&cables, None, &truths);

    let value = 1.25 * creepage::profile_at(&upper(&[]), &[0.0]).unwrap().vertical_m[0];
    let cables = both_cables(|scene| {
        (scene.traffic.passes, scene.ground.vertical_peak) = (100, Some(value));
    });
    let truths = [&both[..], &[("ground_stiffness", 0.8)]].concat();
    let answer = fitted_jointly(&cables, Some(value), &truths);
    for (parameter, (_, truth)) in answer.parameters.iter().zip(truths) {
        let error = parameter.standard_error.unwrap();
        assert!(parameter.identifiable && error < 0.03 * truth, "{parameter:?}");
    }
    assert_eq!((answer.fit.len(), answer.fit[199].series), (200, 2));
}

/// Fits these parameters of both together, each within three standard errors of the truth.
fn fitted_jointly(
    cables: &[(Scene, Readings)],
    deflection: Option<f64>,
    truths: &[(&str, f64)],
) -> Calibrated {
    let of_both = |quantity| [0, 1].map(|series| Unknown::of(quantity, series));
    let mut unknowns = of_both(Quantity::DynamicCoefficient).to_vec();
    if deflection.is_none() {
        unknowns.extend(of_both(Quantity::ShapeFactor));
        unknowns.push(Unknown::shared(Quantity::GroundStiffness));
    }
    let measured = |value| Deflection {
        value,
        sigma: 0.1 * value,
    };
    let options = CalibrateOptions {
        unknowns,
        deflection: deflection.map(measured),
        ..CalibrateOptions::default()
    };
    let series = cables.iter().map(|(scene, readings)| Series { scene, readings });
    let answer = calibrate_jointly(&series.collect::<Vec<_>>(), &options).unwrap();
    let names = answer.parameters.iter().map(|parameter| &*parameter.name);
    assert!(names.eq(truths.iter().map(|truth| truth.0)));
    for (parameter, (_, truth)) in answer.parameters.iter().zip(truths) {
        let error = parameter.standard_error.unwrap();
        assert!((parameter.value - truth).abs() < 3.0 * error, "{parameter:?}");
    }
    // Both scenes in each; on the finest mesh a run takes thirty times as long as on the coarsest.
    assert!(answer.evaluations <= 320, "{}", answer.evaluations);
    answer
}

/// What is told of a cable without a load cell or too few readings stands in messages.rs.
#[test]
fn a_law_without_a_shape_has_no_shape_to_fit() {
    let options = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::ShapeFactor)],
        ..CalibrateOptions::default()
    };
    let data = readings(&[100.0, 130.0, 150.0]);
    let error = calibrate(&upper(&["friction.law=coulomb"]), &data, &options).unwrap_err();
    let key = "friction.law";
    assert!(error.is_bad_input() && matches!(error, Error::Unfit { key: named, .. } if named == key));
}

/// With Coulomb's law there is only the coefficient to fit; the load cell may be at the upstream end.
#[test]
fn coulomb_and_an_upstream_load_cell() {
    let ends = ["ends.upstream=fixed", "ends.downstream=free"];
    let mut scene = upper(&[&["friction.law=coulomb", "traffic.passes=30"][..], &ends].concat());
    let forces: Vec<f64> = run(&scene)
        .passes
        .iter()
        .map(|pass| pass.upstream_force_n)
        .collect();
    scene.friction.dynamic_coefficient = 0.4;
    let answer = fit(&scene, &readings(&noisy(&forces, 1.0, 4)));
    assert_eq!(
        (answer.parameters.len(), &answer.method.load_cell[..]),
        (1, &["upstream".to_owned()][..])
    );
    assert_near(answer.parameters[0].value, 0.25, 0.02, &answer.parameters);
}
