//! Map 7: where a calibration can tell the shape factor b of friction, over the true b and the noise of the load cell.
//!
//! The full-scale experiment's upper cable, read after every second of 60 passes; μ_d and b are fitted and the noise is estimated from
//! the residuals. The model is a table of forces over ln μ_d and ln b with cubics between, so that a fit takes milliseconds: what is
//! mapped is the fit's judgement, not a mesh. Every cell is drawn many times, with seeds of its own.
//!
//! *Outcomes of a draw.* Identified where the intervals of 95 % of both parameters are closed, else not identifiable, which the fit says.
//! Where only that of b is closed, it rests on the bound of μ_d: such draws are counted apart, and the wrong ones among them. An
//! identified b is right if the truth lies within the interval or within a tenth of b; it may miss it in one of twenty draws, where the true values
//! fit far worse; it is wrong if it misses it although they fit about as well.

use std::path::Path;

use calibrate::{Calibration, Estimate, Fit, ModelError, Parameter, Scale};
use fastrand::Rng;
use rayon::prelude::*;

use crate::map::Grid;
use crate::passes::{Solver, forces, half_space_motion};
use crate::{Failure, upper};

const PASSES: usize = 60;
/// How far beyond the duct's ends vehicles are followed \[m\]: past the outermost turn of D_l, ten depths off.
const APPROACH: f64 = 20.0;
/// One reading in so many passes.
const EVERY: usize = 2;
const TRUE_COEFFICIENT: f64 = 0.25;
/// Bounds of μ_d and b \[1/m\], and points of the table between them.
const COEFFICIENTS: (f64, f64, usize) = (0.05, 1.0, 19);
const SHAPE_FACTORS: (f64, f64, usize) = (1e5, 1e8, 19);
/// True values of b \[1/m\], inside of the bounds.
const TRUE_SHAPE_FACTORS: (f64, f64) = (2e5, 5e7);
/// Standard deviations of the noise \[N\]; the force levels off near 550 N.
const NOISES: (f64, f64) = (0.03, 100.0);
/// An estimate this near is right whatever its interval.
const NEAR: f64 = 0.1;
/// Rise of the deviance up to which true values lie inside of every 95 % interval: the square of Student's t is 4.2 with 28 degrees of freedom.
const FITS: f64 = 4.0;
/// Shares of the draws from which, and up to which, b counts as identified and as not identifiable.
const MAX_SHARE: f64 = 0.9;
const MIN_SHARE: f64 = 0.1;

/// Forces over the logarithms of μ_d and b.
pub struct Table {
    /// One list of readings a point, b running fastest.
    forces: Vec<Vec<f64>>,
}

impl Table {
    /// Simulates every point, with `density` nodes a depth of the duct.
    pub fn new(density: f64) -> Result<Self, Failure> {
        let mut scene = upper(&[""; 0])?;
        scene.solver.approach = Some(APPROACH);
        let motion = half_space_motion(&scene, 1e-6)?;
        let points = (0..COEFFICIENTS.2 * SHAPE_FACTORS.2).into_par_iter();
        let readings = |index: usize| -> Result<Vec<f64>, Failure> {
            let mut scene = scene.clone();
            scene.friction.dynamic_coefficient = place(COEFFICIENTS, index / SHAPE_FACTORS.2);
            scene.friction.shape_factor = Some(place(SHAPE_FACTORS, index % SHAPE_FACTORS.2));
            let forces = forces(&scene, &motion, Solver::QuasiStatic, density, PASSES)?;
            Ok(forces.into_iter().skip(EVERY - 1).step_by(EVERY).collect())
        };
        Ok(Self {
            forces: points.map(readings).collect::<Result<_, _>>()?,
        })
    }

    /// Readings at μ_d and b, by cubics through the four nearest points each way.
    pub fn readings(&self, coefficient: f64, shape_factor: f64) -> Vec<f64> {
        let (row, across) = weights(COEFFICIENTS, coefficient);
        let (column, along) = weights(SHAPE_FACTORS, shape_factor);
        let mut readings = vec![0.0; self.forces[0].len()];
        for (i, a) in across.into_iter().enumerate() {
            for (j, b) in along.into_iter().enumerate() {
                let forces = &self.forces[(row + i) * SHAPE_FACTORS.2 + column + j];
                for (reading, force) in readings.iter_mut().zip(forces) {
                    *reading += a * b * force;
                }
            }
        }
        readings
    }
}

fn place((from, to, count): (f64, f64, usize), index: usize) -> f64 {
    from * (to / from).powf(index as f64 / (count - 1) as f64)
}

/// The first of the four points around `value` and their weights: the cubic of E. Catmull and R. Rom (1974), whose slope is
/// continuous, so that a fit finds its way. Beyond the ends the table goes on straight.
fn weights((from, to, count): (f64, f64, usize), value: f64) -> (usize, [f64; 4]) {
    let position = (value / from).ln() / (to / from).ln() * (count - 1) as f64;
    let left = (position.floor() as usize).min(count - 2);
    let t = position - left as f64;
    let mut weights = [
        0.5 * (((2.0 - t) * t - 1.0) * t),
        0.5 * ((3.0 * t - 5.0) * t * t + 2.0),
        0.5 * (((4.0 - 3.0 * t) * t + 1.0) * t),
        0.5 * ((t - 1.0) * t * t),
    ];
    if left == 0 {
        let [outside, a, b, c] = weights;
        weights = [a + 2.0 * outside, b - outside, c, 0.0];
        return (0, weights);
    }
    if left == count - 2 {
        let [a, b, c, outside] = weights;
        weights = [0.0, a, b - outside, c + 2.0 * outside];
        return (count - 4, weights);
    }
    (left - 1, weights)
}

/// What became of one draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Draw {
    Right,
    /// Outside of the interval, as one of twenty may be: other values fit far better.
    Missed,
    /// Outside of the interval, although it fits.
    Wrong,
    NotIdentifiable,
    /// μ_d is not identifiable, and said so; the interval of b is closed nevertheless, and this b right or missed, or wrong.
    HalfOpen,
    HalfOpenWrong,
    /// No fit: a typed error.
    Failed,
}

/// What became of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    Identified,
    /// At least one draw.
    Wrong,
    Sometimes,
    /// At least one draw.
    Failed,
    NotIdentifiable,
}

const NAMES: [&str; 5] = [
    "b identified in 90 % or more of the draws, and right",
    "wrong: an interval without a b that fits",
    "identified in some draws, and right there",
    "some draws without a fit: a typed error",
    "not identifiable, and said so",
];

/// All draws of one cell.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    pub draws: Vec<Draw>,
}

impl Cell {
    pub fn count(&self, draw: Draw) -> usize {
        self.draws.iter().filter(|other| **other == draw).count()
    }

    /// Draws with a closed interval.
    pub fn identified(&self) -> usize {
        self.count(Draw::Right) + self.count(Draw::Missed) + self.count(Draw::Wrong)
    }

    pub fn outcome(&self) -> Outcome {
        let share = self.identified() as f64 / self.draws.len() as f64;
        if self.count(Draw::Wrong) > 0 {
            Outcome::Wrong
        } else if self.count(Draw::Failed) > 0 {
            Outcome::Failed
        } else if share >= MAX_SHARE {
            Outcome::Identified
        } else if share > MIN_SHARE {
            Outcome::Sometimes
        } else {
            Outcome::NotIdentifiable
        }
    }
}

/// The map: true b along x, noise along y; `columns` values of b and `rows` noises, each drawn `draws` times.
pub fn map(table: &Table, columns: usize, rows: usize, draws: u64) -> Result<Grid<Cell>, Failure> {
    let axis = |(from, to), count| -> Vec<f64> { (0..count).map(|k| place((from, to, count), k)).collect() };
    let (shape_factors, noises) = (axis(TRUE_SHAPE_FACTORS, columns), axis(NOISES, rows));
    Ok(Grid::fill(shape_factors, noises, |index, b, noise| {
        let draws = (0..draws).map(|draw| fit(table, b, noise, index as u64 * draws + draw));
        draws.collect::<Result<_, String>>().map(|draws| Cell { draws })
    })?)
}

/// How many draws of all cells ended so.
pub fn draws(map: &Grid<Cell>, draw: Draw) -> usize {
    map.cells.iter().map(|cell| cell.count(draw)).sum()
}

/// Fits one series with noise; an error is one of the map itself.
fn fit(table: &Table, b: f64, noise: f64, seed: u64) -> Result<Draw, String> {
    // A fork: generators of neighbouring seeds begin with related numbers.
    let mut random = Rng::with_seed(seed).fork();
    let exact = table.readings(TRUE_COEFFICIENT, b);
    let errors: Vec<f64> = exact
        .iter()
        .map(|_| noise * testkit::gaussian(&mut random))
        .collect();
    let measured = exact.iter().zip(&errors).map(|(force, error)| force + error);
    let measured = measured.collect();
    let model = |p: &[f64]| Ok::<_, ModelError>(table.readings(p[0], p[1]));
    let parameter = |name, (from, to, _)| Parameter::new(name, from, to, Scale::Logarithmic);
    let calibration = parameter("dynamic_coefficient", COEFFICIENTS)
        .and_then(|coefficient| Ok(vec![coefficient, parameter("shape_factor", SHAPE_FACTORS)?]))
        .and_then(|parameters| Calibration::new(&model, parameters, measured))
        .map_err(|error| error.to_string())?;
    let squares = |residuals: &[f64]| residuals.iter().map(|r| r * r).sum::<f64>();
    let outcome = |fit: Fit| {
        let rise = fit.degrees_of_freedom * (squares(&errors) / squares(&fit.residuals) - 1.0);
        match (judge(&fit.estimates[1], b, rise), fit.estimates[0].identifiable) {
            (Draw::Wrong, false) => Draw::HalfOpenWrong,
            (Draw::Right | Draw::Missed, false) => Draw::HalfOpen,
            (draw, _) => draw,
        }
    };
    // As `creepage calibrate` fits.
    Ok(calibration.fit().map_or(Draw::Failed, outcome))
}

/// `rise` is that of the deviance from the fit to the true values.
fn judge(estimate: &Estimate, truth: f64, rise: f64) -> Draw {
    if !estimate.interval.is_closed() {
        Draw::NotIdentifiable
    } else if estimate.interval.contains(truth) || (truth / estimate.value).ln().abs() <= NEAR {
        Draw::Right
    } else if rise > FITS {
        Draw::Missed
    } else {
        Draw::Wrong
    }
}

pub fn run(out: &Path) -> Result<(), Failure> {
    use Draw::{Failed, HalfOpen, HalfOpenWrong, Missed, NotIdentifiable, Right, Wrong};
    let map = map(&Table::new(6.0)?, 18, 15, 40)?;
    let header = "true_shape_factor_per_m,noise_n,outcome,draws,right,missed_the_interval,wrong,not_identifiable,only_b_closed,only_b_closed_and_wrong,failed\n";
    let rows = map.lines(|b, noise, cell| {
        let all = [
            Right,
            Missed,
            Wrong,
            NotIdentifiable,
            HalfOpen,
            HalfOpenWrong,
            Failed,
        ];
        let counts = all.map(|draw| cell.count(draw).to_string()).join(",");
        let (outcome, draws) = (NAMES[cell.outcome() as usize], cell.draws.len());
        format!("{b:.4e},{noise:.4e},\"{outcome}\",{draws},{counts}")
    });
    crate::table::write(
        &out.join("stability-calibration.csv"),
        &(header.to_owned() + &rows),
    )?;
    let axes = [
        map.x_axis("true shape factor b, 1/m"),
        map.y_axis("standard deviation of the load cell, N"),
    ];
    let title = "Calibration of μ_d and b from 30 readings in 60 passes: where b is identifiable";
    let chart = map.panel(title, axes, NAMES, |cell| cell.outcome() as usize);
    std::fs::write(out.join("stability-calibration.svg"), chart.to_svg()?)?;
    match draws(&map, Wrong) {
        0 => Ok(()),
        wrong => Err(format!("{wrong} draws are wrong").into()),
    }
}
