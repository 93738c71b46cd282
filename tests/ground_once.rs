//! The ground is computed once for a scene, however many runs of it an answer takes.

use std::time::{Duration, Instant};

use creepage::Scene;
use creepage::design::{DesignOptions, Limits, Place, design};
use creepage::report::{Report, ReportOptions};

/// Finite elements, whose ground takes many times as long as a pass.
fn scene() -> Scene {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml").expect("a scene");
    scene.ground.model = creepage::scene::GroundModel::FiniteElements;
    scene.traffic.passes = 1;
    scene.solver.tolerance = 0.05;
    scene
}

/// The shortest of three: other tests compute beside this one.
fn time(mut work: impl FnMut()) -> Duration {
    let once = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..3).map(once).min().expect("three times")
}

#[test]
fn design_and_report_take_little_longer_than_the_ground() {
    let scene = scene();
    let ground = time(|| {
        creepage::plan(&scene).expect("a plan");
    });
    let limits = Limits::both(Some(60.0), None);
    let options = DesignOptions::new(Place::Downstream, limits);
    let works: [(&str, f64, &mut dyn FnMut()); 2] = [
        // Some twenty runs.
        ("design", 6.0, &mut || {
            drop(design(&scene, &options).expect("a design"));
        }),
        // A dozen ways to hold the cable, and the motion of the duct.
        ("report", 5.0, &mut || {
            drop(Report::new(&scene, &ReportOptions::default()).expect("a report"));
        }),
    ];
    for (name, most, work) in works {
        let factor = time(work).div_duration_f64(ground);
        println!("{name}: {factor:.2} times the ground's {ground:.2?}");
        assert!(
            factor < most,
            "{name} takes {factor:.2} times as long as the ground"
        );
    }
}
