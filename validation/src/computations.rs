//! The computations whose cost is watched: one of each kind that users wait for, each with the time that it is meant to take.

use std::sync::{Mutex, PoisonError};

use cable_dem::{CableState, Mesh, Passage, QuasiStatic};
use creepage::report::{Report, ReportOptions};
use creepage::sweep::{Samples, Sweep, SweepOptions};
use creepage::{CalibrateOptions, Readings, Scene, SceneFile};

use crate::Failure;
use crate::passes::{APPROACH, cable, half_space_motion};

/// A computation.
pub struct Aim {
    pub name: &'static str,
    /// Processor time that it is meant to take on one core \[s\].
    pub seconds: f64,
    /// What is computed at once, of which the time is that of one.
    pub of: usize,
    /// Computes it; nodes eliminated, where they are counted.
    pub work: Box<dyn Fn() -> Result<Option<u64>, Failure> + Send + Sync>,
}

/// A road of three lanes on a pavement over rock: 250 m of duct, ten vehicles until the traffic repeats.
const ROAD: [&str; 8] = [
    "duct={ length = \"250 m\", depth = \"1.5 m\" }",
    "ground={ rigid_base_depth = \"8 m\", layers = [{ thickness = \"15 cm\", young_modulus = \"3000 MPa\", poisson_ratio = 0.35 }, \
     { thickness = \"40 cm\", young_modulus = \"200 MPa\", poisson_ratio = 0.35 }, \
     { young_modulus = \"60 MPa\", poisson_ratio = 0.45 }] }",
    "cable={ preset = \"xlpe-800-single-core\", normal_load_factor = 1.0 }",
    "friction={ law = \"elastic-plastic\", dynamic_coefficient = 0.3, shape_factor = \"7.4e6 1/m\" }",
    "ends={ upstream = \"free\", downstream = { spring = \"3 MN/m\" } }",
    LANES,
    "traffic={ passes = 292000 }",
    "title=\"a road of three lanes\"",
];
const LANES: &str = "vehicles=[\
    { name = \"lane 1\", speed = \"40 km/h\", share = 0.5, wheels = [{ x = 4, y = 0.875, load = \"25 kN\", contact_radius = 0.1784 }, { x = 4, y = -0.875, load = \"25 kN\", contact_radius = 0.1784 }, { x = 0, y = 0.875, load = \"100 kN\", contact_radius = 0.1784 }, { x = 0, y = -0.875, load = \"100 kN\", contact_radius = 0.1784 }] }, \
    { name = \"lane 2\", speed = \"40 km/h\", share = 0.3, wheels = [{ x = 4, y = 4.375, load = \"25 kN\", contact_radius = 0.1784 }, { x = 4, y = 2.625, load = \"25 kN\", contact_radius = 0.1784 }, { x = 0, y = 4.375, load = \"100 kN\", contact_radius = 0.1784 }, { x = 0, y = 2.625, load = \"100 kN\", contact_radius = 0.1784 }] }, \
    { name = \"lane 3\", speed = \"40 km/h\", direction = \"reverse\", share = 0.2, wheels = [{ x = 4, y = 7.875, load = \"25 kN\", contact_radius = 0.1784 }, { x = 4, y = 6.125, load = \"25 kN\", contact_radius = 0.1784 }, { x = 0, y = 7.875, load = \"100 kN\", contact_radius = 0.1784 }, { x = 0, y = 6.125, load = \"100 kN\", contact_radius = 0.1784 }] }]";
/// Days with heat on a slope.
const HEATED: [&str; 6] = [
    "duct.length=100 m",
    "duct.slope=3 %",
    "heat.expansion=17e-6",
    "heat.daily_swing=20 K",
    "traffic.per_day=480",
    "traffic.years=20",
];
const SAMPLES: usize = 100;
/// Passes timed together, after some that fill the solver's memory.
const PASSES: usize = 10;

/// All of them.
pub fn aims() -> Result<Vec<Aim>, Failure> {
    let full_scale = upper(&[])?.scene()?;
    let reported = full_scale.clone();
    let calibrated = full_scale.clone();
    let data = crate::file("examples/data/synthetic-upper.csv");
    let readings = Readings::from_csv("synthetic-upper.csv", &std::fs::read(data)?)?;
    let sampled = upper(&["solver.tolerance=0.02"])?;
    Ok(vec![
        Aim::run("200 passes of 30 m", 0.06, full_scale),
        pass()?,
        Aim::run(
            "5000 passes of 100 m",
            0.5,
            upper(&["traffic.passes=5000", "duct.length=100 m"])?.scene()?,
        ),
        Aim::run(
            "292 000 passes of 250 m with three lanes",
            1.0,
            upper(&ROAD)?.scene()?,
        ),
        Aim::run(
            "20 years of 100 m with daily heat on a slope",
            3.0,
            upper(&HEATED)?.scene()?,
        ),
        Aim::new("report of 200 passes of 30 m", 1.0, move || {
            Report::new(&reported, &ReportOptions::default())?.to_html();
            Ok(None)
        }),
        Aim::new("calibration of the synthetic series", 0.5, move || {
            creepage::calibrate(&calibrated, &readings, &CalibrateOptions::default())?;
            Ok(None)
        }),
        Aim {
            of: SAMPLES,
            ..Aim::new(
                "a Monte Carlo sample of 200 passes of 30 m at 2 %",
                0.01,
                move || {
                    let law = vec!["normal(0.25, 0.03)".to_owned()];
                    let table = vec![("friction.dynamic_coefficient".to_owned(), law)];
                    let samples = Samples {
                        count: SAMPLES,
                        seed: 1,
                    };
                    Sweep::of_table(sampled.clone(), table, samples)?.answers(&SweepOptions::default())?;
                    Ok(None)
                },
            )
        },
    ])
}

impl Aim {
    fn new(
        name: &'static str,
        seconds: f64,
        work: impl Fn() -> Result<Option<u64>, Failure> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name,
            seconds,
            of: 1,
            work: Box::new(work),
        }
    }

    fn run(name: &'static str, seconds: f64, scene: Scene) -> Self {
        Self::new(name, seconds, move || {
            Ok(Some(creepage::run(&scene)?.cost.node_updates))
        })
    }
}

/// One pass over 300 m, on six nodes a depth.
fn pass() -> Result<Aim, Failure> {
    let scene = upper(&["duct.length=300 m"])?.scene()?;
    let cable = cable(&scene)?;
    let mesh = Mesh::for_depth(scene.duct.length, scene.duct.depth, 6.0)?;
    let motion = half_space_motion(&scene, 1e-8)?;
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
    let mut solver = QuasiStatic::new(cable, mesh)?;
    let mut state = CableState::at_rest(&mesh);
    for _ in 0..PASSES {
        solver.pass(&passage, &mut state)?;
    }
    let started = Mutex::new((solver, state));
    Ok(Aim {
        of: PASSES,
        ..Aim::new("one pass of 300 m on 6 nodes per depth", 1.5e-3, move || {
            let (mut solver, mut state) = started.lock().unwrap_or_else(PoisonError::into_inner).clone();
            let mut updates = 0;
            for _ in 0..PASSES {
                updates += solver.pass(&passage, &mut state)?.statistics.node_updates as u64;
            }
            Ok(Some(updates))
        })
    })
}

/// The full-scale experiment's upper cable with some keys set.
fn upper(set: &[&str]) -> Result<SceneFile, Failure> {
    Ok(SceneFile::read(crate::file("examples/scenes/full-scale-upper.toml"))?.with(set)?)
}
