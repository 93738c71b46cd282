//! Every long computation says how far it is, and may be stopped.

use std::ops::ControlFlow;
use std::sync::Mutex;

use creepage::design::{DesignError, DesignOptions, Limits, Place, design};
use creepage::measures::Study;
use creepage::sweep::{Axis, Samples, Sweep, SweepError, SweepOptions};
use creepage::{
    CalibrateOptions, Error, Progress, Reading, Readings, RunOptions, SceneFile, calibrate, run_with,
};

use crate::scenes::{upper, upper_file};

/// A computation that takes a progress; its error says whether it was stopped.
type Computation = fn(Progress<'_>) -> Result<(), bool>;

fn jumps(progress: Progress<'_>) -> Result<(), bool> {
    let options = RunOptions {
        progress,
        ..RunOptions::default()
    };
    let run = run_with(&upper(&["duct.length=20 m", "traffic.passes=1000000"]), &options);
    run.map(drop).map_err(|error| matches!(error, Error::Stopped))
}

/// Days whose traffic may begin with either vehicle.
fn days(progress: Progress<'_>) -> Result<(), bool> {
    let file = SceneFile::read("examples/scenes/two-directions.toml").expect("a file");
    let heat = ["heat.daily_swing=15 K", "heat.expansion=17e-6 /K"];
    let traffic = [
        "duct.length=12 m",
        "traffic.passes=205",
        "traffic.per_day=41",
        "solver.method=pass-law",
    ];
    let file = file.with(&[heat.as_slice(), &traffic].concat());
    let scene = file.and_then(|file| file.scene()).expect("a scene");
    let options = RunOptions {
        progress,
        ..RunOptions::default()
    };
    run_with(&scene, &options)
        .map(drop)
        .map_err(|error| matches!(error, Error::Stopped))
}

fn fit(progress: Progress<'_>) -> Result<(), bool> {
    let forces = [(1, 102.0), (2, 137.0), (3, 160.0), (10, 284.0)];
    let readings: Readings = forces
        .map(|(pass, force)| Reading::force(pass, force))
        .into_iter()
        .collect();
    let options = CalibrateOptions {
        progress,
        ..CalibrateOptions::default()
    };
    let fit = calibrate(&upper(&[]), &readings, &options);
    fit.map(drop).map_err(|error| matches!(error, Error::Stopped))
}

fn search(progress: Progress<'_>) -> Result<(), bool> {
    let mut options = DesignOptions::new(Place::Downstream, Limits::both(Some(150.0), None));
    options.progress = progress;
    let design = design(
        &upper(&["traffic.passes=12", "solver.node_spacing=0.25 m"]),
        &options,
    );
    design
        .map(drop)
        .map_err(|error| matches!(error, DesignError::Analysis(Error::Stopped)))
}

fn comparison(progress: Progress<'_>) -> Result<(), bool> {
    let limits = |_: &creepage::Scene| Limits::both(Some(300.0), Some(0.01));
    let study = Study::new(&upper_file(&["traffic.passes=20"])).expect("a study");
    let compared = study.compare(&limits, progress);
    compared
        .map(drop)
        .map_err(|error| matches!(error, Error::Stopped))
}

fn rows(progress: Progress<'_>) -> Result<(), bool> {
    let axis = Axis::parse("duct.depth=1.2m").expect("an axis");
    let sweep = Sweep::new(upper_file(&[]), vec![axis], Samples::default()).expect("a sweep");
    let options = SweepOptions {
        progress,
        ..SweepOptions::default()
    };
    let answers = sweep.answers(&options);
    answers
        .map(drop)
        .map_err(|error| matches!(error, SweepError::Stopped))
}

/// Shares that a computation reports, until `last` of them.
fn reported(compute: Computation, last: usize) -> (Vec<f64>, Result<(), bool>) {
    let shares = Mutex::new(Vec::new());
    let callback = |share| {
        let mut shares = shares.lock().expect("no panic");
        shares.push(share);
        match shares.len() {
            count if count < last => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    let done = compute(Progress::new(&callback));
    (shares.into_inner().expect("no panic"), done)
}

#[test]
fn every_long_computation_may_be_stopped() {
    // Where several threads compute, some may say so once more.
    let computations: [(Computation, bool); 6] = [
        (jumps, true),
        (days, true),
        (fit, true),
        (search, false),
        (comparison, false),
        (rows, false),
    ];
    for (number, (compute, is_exact)) in computations.into_iter().enumerate() {
        for last in [1, 6] {
            let (shares, done) = reported(compute, last);
            assert_eq!(done, Err(true), "{number}");
            assert!(
                shares.iter().all(|share| (0.0..=1.0).contains(share)),
                "{shares:?}"
            );
            // Nothing is computed after the one that stopped it.
            assert!(shares.len() == last || !is_exact, "{number}: {shares:?}");
        }
    }
}

#[test]
fn the_progress_of_jumps_never_falls() {
    let (shares, done) = reported(jumps, usize::MAX);
    assert_eq!(done, Ok(()));
    assert!(shares.is_sorted() && shares[0] < 0.05);
    assert!(shares.last().is_some_and(|last| (0.5..=1.0).contains(last)));
}

#[test]
fn the_progress_of_days_never_falls_and_ends_with_their_error() {
    let (shares, done) = reported(days, usize::MAX);
    assert_eq!(done, Ok(()));
    assert!(shares.is_sorted());
    assert_eq!(shares.last(), Some(&1.0));
}
