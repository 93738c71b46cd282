//! Do 95 % intervals hold the truth in 95 % of all cases? Minutes of computing, so left out of an ordinary test run:
//!
//! ```sh
//! cargo test --release --test calibration_coverage --test calibration -- --ignored --nocapture
//! ```
//!
//! Readings are those of the solver with inertia on a fine mesh, 40 of 118 passes, with Gaussian noise of 2 N. Two hundred fits of each need
//! a fast model: the quasi-static solver tabulated over friction and shape factor and interpolated by cubics. As in the
//! calibration of a scene, the difference to a fine mesh at one point, here the true one, corrects it.

use std::fmt::Write;

use calibrate::{Calibration, ModelError, Options, Parameter, Scale};
use creepage::Scene;
use creepage::scene::{FrictionLaw, SolverMethod};
use rayon::prelude::*;

const NOISE: f64 = 2.0;
const REPETITIONS: u64 = 200;
const LAST_PASS: u64 = 118;
/// Range and number of values of each parameter in the table, evenly spaced in the logarithm.
const FRICTION: (f64, f64, usize) = (0.1, 0.8, 27);
const SHAPE_FACTOR: (f64, f64, usize) = (2e5, 1e9, 29);

/// Passes 1, 4, … 118.
fn readings(forces: &[f64]) -> Vec<f64> {
    forces.iter().copied().step_by(3).collect()
}

fn forces(method: SolverMethod, spacing: f64, friction: f64, shape_factor: f64) -> Vec<f64> {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml".as_ref()).unwrap();
    scene.friction.dynamic_coefficient = friction;
    scene.friction.law = FrictionLaw::ElasticPlastic { shape_factor };
    scene.traffic.passes = LAST_PASS;
    scene.solver.method = method;
    scene.solver.node_spacing = Some(spacing);
    scene.solver.vehicle_step = Some(0.5 * spacing);
    let run = creepage::run(&scene).unwrap();
    readings(
        &run.passes
            .iter()
            .map(|pass| pass.downstream_force_n)
            .collect::<Vec<_>>(),
    )
}

/// Forces over the grid.
struct Table(Vec<Vec<f64>>);

impl Table {
    fn new() -> Self {
        let value = |(low, high, count): (f64, f64, usize), index: usize| {
            low * (high / low).powf(index as f64 / (count - 1) as f64)
        };
        let rows = (0..FRICTION.2 * SHAPE_FACTOR.2)
            .into_par_iter()
            .map(|index| {
                let (i, j) = (index / SHAPE_FACTOR.2, index % SHAPE_FACTOR.2);
                forces(
                    SolverMethod::QuasiStatic,
                    0.2,
                    value(FRICTION, i),
                    value(SHAPE_FACTOR, j),
                )
            })
            .collect();
        Self(rows)
    }

    /// Cubic convolution over four by four neighbours (R. G. Keys, IEEE Transactions on Acoustics, Speech and Signal
    /// Processing 29, 1981).
    fn at(&self, friction: f64, shape_factor: f64) -> Vec<f64> {
        let place = |(low, high, count): (f64, f64, usize), value: f64| {
            let place = (value / low).ln() / (high / low).ln() * (count - 1) as f64;
            let left = place.floor().clamp(1.0, (count - 3) as f64);
            (left as usize, weights(place - left))
        };
        let (i, across) = place(FRICTION, friction);
        let (j, along) = place(SHAPE_FACTOR, shape_factor);
        let mut sum = vec![0.0; self.0[0].len()];
        for (a, across) in across.into_iter().enumerate() {
            for (b, along) in along.into_iter().enumerate() {
                let row = &self.0[(i + a - 1) * SHAPE_FACTOR.2 + j + b - 1];
                for (sum, force) in sum.iter_mut().zip(row) {
                    *sum += across * along * force;
                }
            }
        }
        sum
    }
}

/// Weights of the neighbours at −1, 0, 1, 2 for a point at `t`.
fn weights(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (-t3 + 2.0 * t2 - t),
        0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
        0.5 * (-3.0 * t3 + 4.0 * t2 + t),
        0.5 * (t3 - t2),
    ]
}

fn gaussian(random: &mut fastrand::Rng) -> f64 {
    let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.f64()).cos()
}

/// What came out of the repetitions at one truth.
#[derive(Default, Clone, Copy)]
struct Count {
    failed: usize,
    friction_covered: usize,
    friction_close: usize,
    shape_covered: usize,
    shape_identifiable: usize,
    shape_close: usize,
}

#[test]
#[ignore = "two minutes in release mode: a table of 783 simulations and 2400 fits"]
fn intervals_cover_the_truth() {
    let table = Table::new();
    // The table against the solver between its nodes.
    let (friction, shape_factor) = (0.2871, 3.77e6);
    let direct = forces(SolverMethod::QuasiStatic, 0.2, friction, shape_factor);
    for (table, direct) in table.at(friction, shape_factor).iter().zip(&direct) {
        assert!((table / direct - 1.0).abs() < 3e-3, "{table} {direct}");
    }

    let truths: Vec<(f64, f64)> = [0.2, 0.3, 0.4, 0.5]
        .into_iter()
        .flat_map(|friction| [1e6, 1e7, 1e8].map(|shape_factor| (friction, shape_factor)))
        .collect();
    let mut report = String::new();
    let mut wrong = Vec::new();
    for (friction, shape_factor) in truths {
        let count = repeat(&table, friction, shape_factor);
        let _ = writeln!(
            report,
            "mu {friction} b {shape_factor:.0e}: mu covered {} within 2 % {}; b covered {} identifiable {} of these within 10 % {}; failed {}",
            count.friction_covered,
            count.friction_close,
            count.shape_covered,
            count.shape_identifiable,
            count.shape_close,
            count.failed
        );
        let covers = |covered: usize| (180..=198).contains(&covered);
        // Where the upper end is open, the interval holds nearly all that can be true.
        let identifiable = count.shape_identifiable > 190;
        let shape_covers = if identifiable {
            covers(count.shape_covered)
        } else {
            count.shape_covered >= 180
        };
        let close = !identifiable || count.shape_close >= 190;
        if !(covers(count.friction_covered) && shape_covers && close && count.failed == 0) {
            wrong.push((friction, shape_factor));
        }
    }
    println!("{report}");
    assert!(wrong.is_empty(), "{wrong:?}\n{report}");
}

fn repeat(table: &Table, friction: f64, shape_factor: f64) -> Count {
    let truth = forces(SolverMethod::Dynamic, 0.05, friction, shape_factor);
    let fine = forces(SolverMethod::QuasiStatic, 0.05, friction, shape_factor);
    let correction: Vec<f64> = fine
        .iter()
        .zip(table.at(friction, shape_factor))
        .map(|(fine, table)| fine - table)
        .collect();
    let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        let forces = table.at(p[0], p[1]);
        Ok(forces
            .iter()
            .zip(&correction)
            .map(|(force, correction)| force + correction)
            .collect())
    };
    let mut count = Count::default();
    for seed in 0..REPETITIONS {
        let mut random = fastrand::Rng::with_seed(seed);
        let data = truth
            .iter()
            .map(|force| force + NOISE * gaussian(&mut random))
            .collect();
        let parameters = vec![
            Parameter::new("friction", 0.11, 0.75, Scale::Logarithmic).unwrap(),
            Parameter::new("shape_factor", 2.5e5, 9e8, Scale::Logarithmic).unwrap(),
        ];
        let options = Options {
            relative_noise: 1e-4,
            ..Options::default()
        };
        let fit = Calibration::new(&model, parameters, data)
            .unwrap()
            .with_options(options)
            .unwrap()
            .fit();
        let Ok(fit) = fit else {
            count.failed += 1;
            continue;
        };
        let [mu, b] = &fit.estimates[..] else {
            unreachable!("two parameters were fitted")
        };
        count.friction_covered += usize::from(mu.interval.contains(friction));
        count.friction_close += usize::from((mu.value / friction - 1.0).abs() < 0.02);
        count.shape_covered += usize::from(b.interval.contains(shape_factor));
        count.shape_identifiable += usize::from(b.identifiable);
        count.shape_close += usize::from(b.identifiable && (b.value / shape_factor - 1.0).abs() < 0.1);
    }
    count
}
