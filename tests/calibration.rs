//! Calibration of scenes: readings made by another solver, on a finer mesh, give back their friction.

use std::sync::OnceLock;

use creepage::calibration::{Deflection, Quantity, Unknown};
use creepage::readings::{Measured, Place};
use creepage::scene::{Law, SolverMethod};
use creepage::{
    CalibrateOptions, Calibrated, Error, Reading, Readings, Scene, Series, calibrate, calibrate_jointly,
};

use crate::scenes::{assert_near, forces as forces_of, run, upper};

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

/// Forces after passes of the upper phase, by the solver with inertia on a mesh twice as fine as the fit's first.
fn forces(dynamic_coefficient: f64, shape_factor: f64, passes: u64) -> Vec<f64> {
    forces_by(SolverMethod::Explicit, dynamic_coefficient, shape_factor, passes)
}

fn forces_by(method: SolverMethod, dynamic_coefficient: f64, shape_factor: f64, passes: u64) -> Vec<f64> {
    let mut scene = upper(&[]);
    scene.friction.dynamic_coefficient = dynamic_coefficient;
    (scene.friction.law, scene.friction.shape_factor) = (Law::ElasticPlastic, Some(shape_factor));
    scene.traffic.passes = passes;
    scene.solver.method = method;
    scene.solver.node_spacing = Some(0.1);
    scene.solver.vehicle_step = Some(0.05);
    forces_of(&run(&scene))
}

/// The series that most tests share.
fn series() -> &'static [f64] {
    static FORCES: OnceLock<Vec<f64>> = OnceLock::new();
    FORCES.get_or_init(|| forces(0.25, 2e6, 40))
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

fn value(answer: &Calibrated, name: &str) -> f64 {
    let mut parameters = answer.parameters.iter();
    parameters.find(|parameter| parameter.name == name).unwrap().value
}

#[test]
fn friction_comes_back_from_another_solver() {
    let answer = fit(&upper(&[]), &readings(&noisy(series(), 3.0, 1)));
    assert_near(
        value(&answer, "dynamic_coefficient"),
        0.25,
        0.02,
        &answer.parameters,
    );
    assert_near(value(&answer, "shape_factor"), 2e6, 0.1, &answer.parameters);
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

/// No friction makes the force that was read: a fit goes where the model comes nearest, and says that this is not near.
#[test]
fn a_force_out_of_reach_is_met_as_nearly_as_can_be() {
    let mut scene = Scene::from_file("examples/scenes/full-scale-lower.toml").unwrap();
    scene.ground.vertical_peak = Some(90e-6);
    let read = Reading {
        sigma: Some(45.0),
        ..Reading::force(200, 900.0)
    };
    let options = friction_alone();
    let answer = calibrate(&scene, &[read].into_iter().collect(), &options).unwrap();
    scene.solver.node_spacing = Some(answer.method.node_spacing_m[0]);
    let force = |k: u8| {
        scene.friction.dynamic_coefficient = 0.05 * f64::from(k);
        run(&scene).passes[199].downstream_force_n
    };
    let most = (4..=10).map(force).fold(0.0, f64::max);
    let fitted = answer.fit[0].fitted;
    assert!((most - 0.5..900.0).contains(&fitted), "{fitted} {most}");
    assert!(answer.lack_of_fit.suspicious && !answer.parameters[0].identifiable);
}

/// From 1e9 1/m on, forces differ from Coulomb's by less than any load cell shows. With so steep a law the solver with inertia takes far
/// more steps.
#[test]
fn a_steep_law_is_called_not_identifiable() {
    let forces = forces_by(SolverMethod::QuasiStatic, 0.25, 1e9, 25);
    let answer = fit(&upper(&[]), &readings(&noisy(&forces, 3.0, 1)));
    let shape = &answer.parameters[1];
    assert!(!shape.identifiable, "{shape:?}");
    let [lower, open] = shape.interval_95;
    let is_low = lower.is_some_and(|lower| (1e6..1e9).contains(&lower));
    assert!(open.is_none() && is_low, "{shape:?}");
    let told = |warning: &String| warning.contains("shape_factor is not identifiable");
    assert!(answer.warnings.iter().any(told), "{:?}", answer.warnings);
    assert!(answer.evaluations <= 200, "{}", answer.evaluations);
}

/// An instrument that is overloaded writes a number that no cable can make: the fit is that without the row.
#[test]
fn an_overload_is_no_reading() {
    let clean = readings(&noisy(series(), 3.0, 1)[..12]);
    let mut list = clean.list.clone();
    list.insert(7, Reading::force(8, -9.9e37));
    let options = friction_alone();
    let fit = |readings: &Readings| calibrate(&upper(&[]), readings, &options).unwrap();
    let (without, with) = (fit(&clean), fit(&list.into_iter().collect()));
    assert_eq!(with.parameters, without.parameters);
    assert!(
        with.warnings[0].ends_with("left out: pass 8 (line 8)"),
        "{:?}",
        with.warnings
    );
}

/// A cell whose forces are all beyond reach is no exception among those of another: something is wrong with it.
#[test]
fn a_cell_in_another_unit_is_no_overload() {
    let mut list = readings(&noisy(series(), 3.0, 1)[..12]).list;
    let inside = |pass: u64| Reading {
        measured: Measured::Force(Place::At(20.0)),
        ..Reading::force(pass, 2e5 + 1e3 * pass as f64)
    };
    list.extend((1..=6).map(inside));
    let options = friction_alone();
    let answer = calibrate(&upper(&[]), &list.into_iter().collect(), &options).unwrap();
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
        calibrate(&upper(&[]), &readings, &friction_alone()).unwrap()
    };
    let noise = noisy(&[0.0; 15], 3.0, 4);
    let level = fit(&|pass| 230.0 + noise[pass]).lack_of_fit;
    assert!(level.suspicious && level.p_runs < 0.01, "{level:?}");
    let followed = forces(0.25, 7352941.0, 14);
    let lack = fit(&|pass| followed[pass - 1] + noise[pass]).lack_of_fit;
    assert!(!lack.suspicious && lack.p_noise.is_some(), "{lack:?}");
}

/// Both cables over one ground, and readings of each by runs of their scenes as `truth` changes them.
fn both_cables(truth: impl Fn(&mut Scene)) -> [(Scene, Readings); 2] {
    [("upper", 1), ("lower", 2)].map(|(cable, seed)| {
        let scene = Scene::from_file(format!("examples/scenes/full-scale-{cable}.toml")).unwrap();
        let mut true_scene = scene.clone();
        truth(&mut true_scene);
        let data = readings(&noisy(&forces_of(&run(&true_scene)), 4.0, seed));
        (scene, data)
    })
}

/// Fits both together: parameters within three standard errors of the truth.
fn fitted_jointly(
    cables: &[(Scene, Readings)],
    options: &CalibrateOptions<'_>,
    truths: &[f64],
) -> Calibrated {
    let series = |(scene, readings)| Series { scene, readings };
    let series: Vec<_> = cables.iter().map(|(scene, data)| series((scene, data))).collect();
    let answer = calibrate_jointly(&series, options).unwrap();
    assert_eq!(answer.parameters.len(), truths.len());
    for (parameter, truth) in answer.parameters.iter().zip(truths) {
        let error = parameter.standard_error.unwrap();
        assert!((parameter.value - truth).abs() < 3.0 * error, "{parameter:?}");
    }
    answer
}

/// A softer ground and the friction of both cables, from two series and a measured deflection.
#[test]
#[ignore = "half a minute: see CONTRIBUTING.md for the command"]
fn two_series_share_their_ground() {
    let value = 1.25 * creepage::profile_at(&upper(&[]), &[0.0]).unwrap().vertical_m[0];
    let cables = both_cables(|scene| {
        scene.traffic.passes = 100;
        scene.ground.vertical_peak = Some(value);
    });
    let options = CalibrateOptions {
        unknowns: [0, 1]
            .map(|series| Unknown::of(Quantity::DynamicCoefficient, series))
            .into(),
        deflection: Some(Deflection {
            value,
            sigma: 0.1 * value,
        }),
        ..CalibrateOptions::default()
    };
    let truths = [0.25, 0.27, 0.8];
    let answer = fitted_jointly(&cables, &options, &truths);
    let names = [
        "dynamic_coefficient_1",
        "dynamic_coefficient_2",
        "ground_stiffness",
    ];
    for ((parameter, name), truth) in answer.parameters.iter().zip(names).zip(truths) {
        assert_eq!(parameter.name, name);
        let error = parameter.standard_error.unwrap();
        assert!(parameter.identifiable && error < 0.03 * truth, "{parameter:?}");
    }
    assert_eq!((answer.fit.len(), answer.fit[199].series), (200, 2));
}

/// Friction and law of both cables and the ground that they share.
#[test]
#[ignore = "half a minute: see CONTRIBUTING.md for the command"]
fn five_parameters_of_two_series() {
    let cables = both_cables(|scene| {
        scene.ground.layers[0].young_modulus = ground_field::Modulus::Uniform(720e6);
        (scene.friction.shape_factor, scene.traffic.passes) = (Some(2e6), 60);
        (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.1), Some(0.05));
    });
    let of = |quantity| [0, 1].map(|series| Unknown::of(quantity, series));
    let mut unknowns = [of(Quantity::DynamicCoefficient), of(Quantity::ShapeFactor)].concat();
    unknowns.push(Unknown::shared(Quantity::GroundStiffness));
    let options = CalibrateOptions {
        unknowns,
        ..CalibrateOptions::default()
    };
    let answer = fitted_jointly(&cables, &options, &[0.25, 0.27, 2e6, 2e6, 0.9]);
    // Both scenes in each; on the finest mesh a run takes thirty times as long as on the coarsest.
    assert!(answer.evaluations <= 320, "{}", answer.evaluations);
}

#[test]
fn what_does_not_fit_is_named() {
    let data = readings(&series()[..6]);
    let refused = |scene: &Scene, data: &Readings, options: &CalibrateOptions<'_>| {
        let error = calibrate(scene, data, options).unwrap_err();
        assert!(error.is_bad_input(), "{error}");
        error
    };
    let default = CalibrateOptions::default();
    let free = refused(&upper(&["ends.downstream=free"]), &data, &default);
    assert!(free.to_string().contains("load cell"), "{free}");
    let few = refused(&upper(&[]), &readings(&series()[..2]), &default);
    assert!(few.to_string().contains("number of observations is 2"), "{few}");
    let shape = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::ShapeFactor)],
        ..default
    };
    let coulomb = refused(&upper(&["friction.law=coulomb"]), &data, &shape);
    assert!(
        matches!(
            coulomb,
            Error::Unfit {
                key: "friction.law",
                ..
            }
        ),
        "{coulomb}"
    );
}

/// With Coulomb's law there is only the coefficient to fit; the load cell may be at the upstream end.
#[test]
fn coulomb_and_an_upstream_load_cell() {
    let mut scene = upper(&[
        "friction.law=coulomb",
        "ends.upstream=fixed",
        "ends.downstream=free",
    ]);
    scene.traffic.passes = 30;
    let forces = run(&scene)
        .passes
        .iter()
        .map(|pass| pass.upstream_force_n)
        .collect::<Vec<_>>();
    scene.friction.dynamic_coefficient = 0.4;
    let answer = fit(&scene, &readings(&noisy(&forces, 1.0, 4)));
    assert_eq!(
        (answer.parameters.len(), &*answer.method.load_cell),
        (1, &["upstream".to_owned()][..])
    );
    assert_near(answer.parameters[0].value, 0.25, 0.02, &answer.parameters);
}
