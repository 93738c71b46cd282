//! The ground is computed once for a scene, however many runs of it an answer takes.

use std::time::{Duration, Instant};

use creepage::design::{DesignOptions, Limits, Place, design};
use creepage::report::{Report, ReportOptions};
use creepage::{CalibrateOptions, PassRecord, Reading, Readings, Scene};

/// Finite elements, whose ground takes a hundred times as long as a pass on this mesh.
fn scene() -> Scene {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml").expect("a scene");
    scene.ground.model = creepage::scene::GroundModel::FiniteElements;
    scene.traffic.passes = 1;
    scene.solver.tolerance = 0.001;
    scene.solver.node_spacing = Some(0.2);
    scene.solver.vehicle_step = Some(0.1);
    scene
}

fn time(work: &mut dyn FnMut()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

#[test]
#[ignore = "seven seconds: .ci/run runs it"]
fn what_takes_many_runs_takes_little_longer_than_the_ground() {
    let scene = scene();
    let mut plan = || drop(creepage::plan(&scene).expect("a plan"));
    let limits = Limits::both(Some(60.0), None);
    let options = DesignOptions::new(Place::Downstream, limits);
    let mut measured = scene.clone();
    measured.traffic.passes = 6;
    let passes = creepage::run(&measured).expect("a run").passes;
    let reading = |record: &PassRecord| Reading::force(record.pass, record.downstream_force_n);
    let readings: Readings = passes.iter().map(reading).collect();
    let works: [(&str, &mut dyn FnMut()); 3] = [
        // Some thirty model runs.
        ("calibration", &mut || {
            drop(creepage::calibrate(&scene, &readings, &CalibrateOptions::default()).expect("a fit"));
        }),
        // Some twenty runs.
        ("design", &mut || {
            drop(design(&scene, &options).expect("a design"));
        }),
        // The run, and the motion of the duct.
        ("report", &mut || {
            drop(Report::new(&scene, &ReportOptions::default()).expect("a report"));
        }),
    ];
    for (name, work) in works {
        // Other tests compute at the same time: one of several pairs, one after the other.
        let pair = |_| time(work).div_duration_f64(time(&mut plan)) < 1.5;
        assert!((0..3).any(pair), "{name} takes far longer than the ground");
    }
}
