//! Calibration of scenes: readings made by another solver, on a finer mesh, give back their friction.

use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use creepage::calibration::{Deflection, Loss, Quantity, Unknown};
use creepage::readings::{Measured, Place};
use creepage::scene::{End, Law, SolverMethod};
use creepage::{
    CalibrateOptions, Calibrated, Error, Progress, Reading, Readings, Scene, Series, calibrate,
    calibrate_jointly,
};

const UPPER: &str = "examples/scenes/full-scale-upper.toml";

fn upper() -> Scene {
    Scene::from_file(UPPER).unwrap()
}

/// Forces after passes of the upper phase, by the solver with inertia on a mesh twice as fine as the fit's first.
fn forces(dynamic_coefficient: f64, shape_factor: f64, passes: u64) -> Vec<f64> {
    let mut scene = upper();
    scene.friction.dynamic_coefficient = dynamic_coefficient;
    (scene.friction.law, scene.friction.shape_factor) = (Law::ElasticPlastic, Some(shape_factor));
    scene.traffic.passes = passes;
    scene.solver.method = SolverMethod::Explicit;
    scene.solver.node_spacing = Some(0.1);
    scene.solver.vehicle_step = Some(0.05);
    let run = creepage::run(&scene).unwrap();
    run.passes.iter().map(|pass| pass.downstream_force_n).collect()
}

/// The series that most tests share.
fn series() -> &'static [f64] {
    static FORCES: OnceLock<Vec<f64>> = OnceLock::new();
    FORCES.get_or_init(|| forces(0.25, 2e6, 40))
}

/// Gaussian noise (G. E. P. Box, M. E. Muller, 1958).
fn noisy(forces: &[f64], sigma: f64, seed: u64) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut gaussian = || {
        let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
        radius * (std::f64::consts::TAU * random.f64()).cos()
    };
    forces.iter().map(|force| force + sigma * gaussian()).collect()
}

fn readings(forces: &[f64]) -> Readings {
    (1..)
        .zip(forces)
        .map(|(pass, &force)| Reading::force(pass, force))
        .collect()
}

fn value(answer: &Calibrated, name: &str) -> f64 {
    answer
        .parameters
        .iter()
        .find(|parameter| parameter.name == name)
        .unwrap()
        .value
}

#[test]
fn friction_comes_back_from_another_solver() {
    let data = readings(&noisy(series(), 3.0, 1));
    let answer = calibrate(&upper(), &data, &CalibrateOptions::default()).unwrap();
    assert!(
        (value(&answer, "dynamic_coefficient") / 0.25 - 1.0).abs() < 0.02,
        "{:?}",
        answer.parameters
    );
    assert!(
        (value(&answer, "shape_factor") / 2e6 - 1.0).abs() < 0.1,
        "{:?}",
        answer.parameters
    );
    assert!(answer.parameters.iter().all(|parameter| parameter.identifiable));
    assert!(answer.evaluations <= 200, "{}", answer.evaluations);
    assert!(
        (2.0..4.0).contains(&answer.residual_rms_n),
        "{}",
        answer.residual_rms_n
    );
    assert!(answer.r_squared.unwrap() > 0.999);
    assert!(
        answer
            .fit
            .iter()
            .all(|row| (row.value - row.fitted - row.residual).abs() < 1e-9 && row.force_n == Some(row.value))
    );
    assert!(answer.model_error.relative < 0.01);
}

/// From 1e9 1/m on, forces differ from Coulomb's by less than any load cell shows.
/// No friction makes the force that was read: a fit goes where the model comes nearest, and says that this is not near.
#[test]
fn a_force_out_of_reach_is_met_as_nearly_as_can_be() {
    let mut scene = Scene::from_file("examples/scenes/full-scale-lower.toml").unwrap();
    scene.ground.vertical_peak = Some(90e-6);
    let read = Reading {
        sigma: Some(45.0),
        ..Reading::force(200, 900.0)
    };
    let options = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::DynamicCoefficient)],
        ..CalibrateOptions::default()
    };
    let answer = calibrate(&scene, &[read].into_iter().collect(), &options).unwrap();
    scene.solver.node_spacing = Some(answer.method.node_spacing_m[0]);
    let force = |k: u8| {
        scene.friction.dynamic_coefficient = 0.05 * f64::from(k);
        creepage::run(&scene).unwrap().passes[199].downstream_force_n
    };
    let most = (4..=10).map(force).fold(0.0, f64::max);
    let fitted = answer.fit[0].fitted;
    assert!(
        (most - 0.5..900.0).contains(&fitted),
        "{fitted} N, but {most} N are possible"
    );
    assert!(answer.lack_of_fit.suspicious && !answer.parameters[0].identifiable);
}

#[test]
fn a_steep_law_is_called_not_identifiable() {
    let exact = forces(0.25, 1e9, 25);
    for (seed, sigma) in [(1, 3.0), (2, 6.0)] {
        let data = readings(&noisy(&exact, sigma, seed));
        let answer = calibrate(&upper(), &data, &CalibrateOptions::default()).unwrap();
        let shape = &answer.parameters[1];
        assert!(!shape.identifiable, "{shape:?}");
        let [lower, open] = shape.interval_95;
        assert!(
            open.is_none() && lower.is_some_and(|lower| (1e6..1e9).contains(&lower)),
            "{shape:?}"
        );
        assert!(
            answer
                .warnings
                .iter()
                .any(|warning| warning.contains("shape_factor is not identifiable"))
        );
        assert!(answer.evaluations <= 200, "{}", answer.evaluations);
    }
}

/// An instrument that is overloaded writes a number that no cable can make: the fit is that without the row.
#[test]
fn an_overload_is_no_reading() {
    let clean = readings(&noisy(series(), 3.0, 1)[..12]);
    let mut list = clean.list.clone();
    list.insert(7, Reading::force(8, -9.9e37));
    let options = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::DynamicCoefficient)],
        ..CalibrateOptions::default()
    };
    let fit = |readings: &Readings| calibrate(&upper(), readings, &options).unwrap();
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
    let mut list = readings(&noisy(series(), 3.0, 1)[..30]).list;
    let inside = |pass: u64| Reading {
        measured: Measured::Force(Place::At(20.0)),
        ..Reading::force(pass, 2e5 + 1e3 * pass as f64)
    };
    list.extend((1..=6).map(inside));
    let options = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::DynamicCoefficient)],
        ..CalibrateOptions::default()
    };
    let answer = calibrate(&upper(), &list.into_iter().collect(), &options).unwrap();
    let all: Vec<&String> = answer
        .warnings
        .iter()
        .filter(|text| text.contains("left out"))
        .collect();
    assert!(
        all.is_empty() && answer.lack_of_fit.suspicious,
        "{all:?} {:?}",
        answer.lack_of_fit
    );
}

/// Readings of a run each are tested together: forces that stay where the model lets them grow do not follow it.
#[test]
fn readings_of_a_run_each_are_judged_together() {
    let fit = |force: &dyn Fn(usize) -> f64| {
        let row = |pass: usize| format!("run {pass},{pass},{}\n", force(pass));
        let rows: String = (1..=14).map(row).collect();
        let text = format!("run,pass,force_n\n{rows}");
        let readings = Readings::from_csv("runs.csv", text.as_bytes()).unwrap();
        let unknowns = vec![Unknown::shared(Quantity::DynamicCoefficient)];
        calibrate(
            &upper(),
            &readings,
            &CalibrateOptions {
                unknowns,
                ..CalibrateOptions::default()
            },
        )
        .unwrap()
    };
    let noise = noisy(&[0.0; 15], 3.0, 4);
    let level = fit(&|pass| 230.0 + noise[pass]).lack_of_fit;
    assert!(level.suspicious && level.p_runs < 0.01, "{level:?}");
    let followed = forces(0.25, 7352941.0, 14);
    let lack = fit(&|pass| followed[pass - 1] + noise[pass]).lack_of_fit;
    assert!(!lack.suspicious && lack.p_noise.is_some(), "{lack:?}");
}

/// 5 % of the readings off by 30 %.
#[test]
#[ignore = "a quarter of a minute: see CONTRIBUTING.md for the command"]
fn outliers_do_not_move_a_robust_fit() {
    for seed in 0..3 {
        let clean = noisy(series(), 4.0, seed);
        let mut spoiled = clean.clone();
        spoiled[11] *= 1.3;
        spoiled[29] *= 0.7;
        let fit = |forces: &[f64]| {
            let options = CalibrateOptions {
                loss: Loss::Tukey,
                ..CalibrateOptions::default()
            };
            calibrate(&upper(), &readings(forces), &options).unwrap()
        };
        let (before, after) = (fit(&clean), fit(&spoiled));
        let friction = |answer: &Calibrated| value(answer, "dynamic_coefficient");
        let moved = friction(&after) / friction(&before) - 1.0;
        assert!(moved.abs() < 0.01, "seed {seed}: {moved}");
        for (row, reading) in after.fit.iter().enumerate() {
            assert_eq!(reading.weight < 0.05, row == 11 || row == 29, "{reading:?}");
        }
    }
}

/// A softer ground and the friction of both cables, from two series and a measured deflection.
#[test]
#[ignore = "half a minute: see CONTRIBUTING.md for the command"]
fn two_series_share_their_ground() {
    let scenes = ["upper", "lower"]
        .map(|cable| Scene::from_file(format!("examples/scenes/full-scale-{cable}.toml")).unwrap());
    let deflection = 1.25 * creepage::profile_at(&scenes[0], &[0.0]).unwrap().vertical_m[0];
    let measured: Vec<Readings> = (0..)
        .zip(&scenes)
        .map(|(seed, scene)| {
            let mut scene = scene.clone();
            scene.traffic.passes = 100;
            scene.ground.vertical_peak = Some(deflection);
            let run = creepage::run(&scene).unwrap();
            let forces: Vec<f64> = run.passes.iter().map(|pass| pass.downstream_force_n).collect();
            readings(&noisy(&forces, 4.0, seed))
        })
        .collect();
    let series: Vec<Series<'_>> = scenes
        .iter()
        .zip(&measured)
        .map(|(scene, readings)| Series { scene, readings })
        .collect();
    let options = CalibrateOptions {
        unknowns: vec![
            Unknown::of(Quantity::DynamicCoefficient, 0),
            Unknown::of(Quantity::DynamicCoefficient, 1),
        ],
        deflection: Some(Deflection {
            value: deflection,
            sigma: 0.1 * deflection,
        }),
        ..CalibrateOptions::default()
    };
    let answer = calibrate_jointly(&series, &options).unwrap();
    let names: Vec<&str> = answer
        .parameters
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "dynamic_coefficient_1",
            "dynamic_coefficient_2",
            "ground_stiffness"
        ]
    );
    for (parameter, truth) in answer.parameters.iter().zip([0.25, 0.27, 0.8]) {
        let error = parameter.standard_error.unwrap();
        assert!((parameter.value - truth).abs() < 3.0 * error, "{parameter:?}");
        assert!(parameter.identifiable && error < 0.03 * truth, "{parameter:?}");
    }
    assert_eq!((answer.fit.len(), answer.fit[199].series), (200, 2));
}

/// Friction and law of both cables and the ground that they share.
#[test]
#[ignore = "half a minute: see CONTRIBUTING.md for the command"]
fn five_parameters_of_two_series() {
    let scenes = ["upper", "lower"]
        .map(|cable| Scene::from_file(format!("examples/scenes/full-scale-{cable}.toml")).unwrap());
    let truths = [0.25, 0.27, 2e6, 2e6, 0.9];
    let measured: Vec<Readings> = (0..2)
        .map(|index| {
            let file = creepage::SceneFile::read(format!(
                "examples/scenes/full-scale-{}.toml",
                ["upper", "lower"][index]
            ));
            let set = [
                "ground.layers.0.young_modulus=720 MPa",
                "friction.shape_factor=2e6 1/m",
                "traffic.passes=60",
            ];
            let mut scene = file
                .unwrap()
                .with(&set.map(String::from))
                .unwrap()
                .scene()
                .unwrap();
            (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.1), Some(0.05));
            let run = creepage::run(&scene).unwrap();
            let forces: Vec<f64> = run.passes.iter().map(|pass| pass.downstream_force_n).collect();
            readings(&noisy(&forces, 4.0, 1 + index as u64))
        })
        .collect();
    let series: Vec<Series<'_>> = scenes
        .iter()
        .zip(&measured)
        .map(|(scene, readings)| Series { scene, readings })
        .collect();
    let of = |quantity| [0, 1].map(|series| Unknown::of(quantity, series));
    let mut unknowns = [of(Quantity::DynamicCoefficient), of(Quantity::ShapeFactor)].concat();
    unknowns.push(Unknown::shared(Quantity::GroundStiffness));
    let options = CalibrateOptions {
        unknowns,
        ..CalibrateOptions::default()
    };
    let answer = calibrate_jointly(&series, &options).unwrap();
    for (parameter, truth) in answer.parameters.iter().zip(truths) {
        let error = parameter.standard_error.unwrap();
        assert!((parameter.value - truth).abs() < 3.0 * error, "{parameter:?}");
    }
    // Both scenes in each; on the finest mesh a run takes thirty times as long as on the coarsest.
    assert!(answer.evaluations <= 320, "{}", answer.evaluations);
}

#[test]
fn what_does_not_fit_is_named() {
    let data = readings(&series()[..6]);
    let with = |change: &dyn Fn(&mut Scene), options: &CalibrateOptions| {
        let mut scene = upper();
        change(&mut scene);
        calibrate(&scene, &data, options)
    };
    let free = with(
        &|scene| scene.ends.downstream = End::Free,
        &CalibrateOptions::default(),
    )
    .unwrap_err();
    assert!(
        free.is_bad_input() && free.to_string().contains("load cell"),
        "{free}"
    );

    let shape = CalibrateOptions {
        unknowns: vec![Unknown::shared(Quantity::ShapeFactor)],
        ..CalibrateOptions::default()
    };
    let coulomb = with(
        &|scene| (scene.friction.law, scene.friction.shape_factor) = (Law::Coulomb, None),
        &shape,
    )
    .unwrap_err();
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

    let few = calibrate(&upper(), &readings(&series()[..2]), &CalibrateOptions::default()).unwrap_err();
    assert!(
        few.is_bad_input()
            && few
                .to_string()
                .contains("number of observations is 2; allowed: 3 or more"),
        "{few}"
    );
}

/// With Coulomb's law there is only the coefficient to fit; the load cell may be at the upstream end.
#[test]
fn coulomb_and_an_upstream_load_cell() {
    let mut scene = upper();
    (scene.friction.law, scene.friction.shape_factor) = (Law::Coulomb, None);
    (scene.ends.upstream, scene.ends.downstream) = (End::Fixed, End::Free);
    scene.traffic.passes = 30;
    let forces: Vec<f64> = creepage::run(&scene)
        .unwrap()
        .passes
        .iter()
        .map(|pass| pass.upstream_force_n)
        .collect();
    let mut start = scene.clone();
    start.friction.dynamic_coefficient = 0.4;
    let data = readings(&noisy(&forces, 1.0, 4));
    let answer = calibrate(&start, &data, &CalibrateOptions::default()).unwrap();
    assert_eq!(answer.parameters.len(), 1);
    assert_eq!(answer.method.load_cell, ["upstream"]);
    assert!(
        (answer.parameters[0].value / 0.25 - 1.0).abs() < 0.02,
        "{:?}",
        answer.parameters
    );
}

#[test]
fn the_progress_may_stop_a_calibration() {
    let data = readings(&noisy(series(), 3.0, 1));
    let runs = AtomicUsize::new(0);
    let stop = |share: f64| {
        assert!((0.0..=1.0).contains(&share), "{share}");
        match runs.fetch_add(1, Ordering::Relaxed) {
            0..5 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    let options = CalibrateOptions {
        progress: Progress::new(&stop),
        ..CalibrateOptions::default()
    };
    let error = calibrate(&upper(), &data, &options).expect_err("stopped");
    assert!(matches!(error, Error::Stopped), "{error}");
    // No run follows the one that stopped it.
    assert_eq!(runs.into_inner(), 6);
}
