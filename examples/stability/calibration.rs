//! Map 7: where a calibration can tell the shape factor b of friction, over the true b and the noise of the load cell.
//!
//! The full-scale experiment's upper cable, read after every second of 60 passes; μ_d and b are fitted and the noise is estimated from
//! the residuals. The model is a table of forces over ln μ_d and ln b with cubics between, so that a fit takes milliseconds: what is
//! mapped is the fit's judgement, not a mesh. Every cell is drawn many times, with seeds of its own.
//!
//! *Outcomes of a draw.* Identified where the intervals of 95 % of both parameters are closed, else not identifiable, which the fit says.
//! Where only that of b is closed, it rests on the bound of μ_d: such draws are counted apart, and the wrong ones among them. An
//! identified b is right if the truth lies within the interval or within a tenth of it; it may miss it in one of twenty draws; it is wrong if it lies
//! further off than three times the interval's half width on that side, in ln b.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use boussinesq::HalfSpace;
use cable_dem::{CableError, CableState, DuctedCable, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
use calibrate::{Calibration, Estimate, Fit, ModelError, Parameter, Scale};
use creepage::Scene;
use creepage::figure::{Axis, Chart};
use fastrand::Rng;
use ground_field::{DuctLine, DuctMotion};
use rayon::prelude::*;

const PASSES: u64 = 60;
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
const MOST: f64 = 0.9;
const FEWEST: f64 = 0.1;

/// Forces over the logarithms of μ_d and b.
pub struct Table {
    /// One list of readings a point, b running fastest.
    forces: Vec<Vec<f64>>,
}

impl Table {
    /// Simulates every point, with `density` nodes a depth of the duct.
    ///
    /// # Errors
    ///
    /// Those of the scene and of the solver.
    pub fn new(density: f64) -> Result<Self, Box<dyn Error>> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/full-scale-upper.toml");
        let scene = Scene::from_file(&path)?;
        let ground = HalfSpace::new(
            scene
                .ground
                .profile()?
                .homogeneous()
                .ok_or("the ground has layers")?,
        );
        let line = DuctLine::new(scene.duct.depth, scene.offset_from(&scene.vehicles[0]))?;
        let vehicle = &scene.vehicles[0].vehicle()?;
        let motion = DuctMotion::new(&ground, vehicle, line, scene.duct.length + APPROACH, 1e-6)?;
        let spacing = scene.duct.depth / density;
        let mesh = Mesh::new(scene.duct.length, spacing, 0.5 * spacing)?;
        let (rows, columns) = (COEFFICIENTS.2, SHAPE_FACTORS.2);
        let forces = (0..rows * columns)
            .into_par_iter()
            .map(|index| {
                let law = FrictionLaw::ElasticPlastic {
                    shape_factor: place(SHAPE_FACTORS, index % columns),
                };
                let limit = place(COEFFICIENTS, index / columns) * scene.normal_load();
                let cable = DuctedCable::new(
                    scene.duct.length,
                    scene.cable.axial_stiffness,
                    Friction::new(law, limit)?,
                )?
                .with_ends(scene.ends.upstream, scene.ends.downstream)?;
                let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
                let mut solver = QuasiStatic::new(cable, mesh)?;
                let mut state = CableState::at_rest(&mesh);
                let forces = (0..PASSES).map(|_| Ok(solver.pass(&passage, &mut state)?.force.downstream));
                forces.skip(EVERY - 1).step_by(EVERY).collect()
            })
            .collect::<Result<_, CableError>>()?;
        Ok(Self { forces })
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
        } else if share >= MOST {
            Outcome::Identified
        } else if share > FEWEST {
            Outcome::Sometimes
        } else {
            Outcome::NotIdentifiable
        }
    }
}

/// The map: true b along x, noise along y.
pub struct Grid {
    pub shape_factors: Vec<f64>,
    pub noises: Vec<f64>,
    /// The noise runs slowest.
    pub cells: Vec<Cell>,
}

impl Grid {
    /// `columns` true values of b and `rows` noises, each drawn `draws` times.
    ///
    /// # Errors
    ///
    /// Parameters that are none.
    pub fn fill(table: &Table, columns: usize, rows: usize, draws: u64) -> Result<Self, Box<dyn Error>> {
        let axis = |(from, to), count| {
            (0..count)
                .map(|k| place((from, to, count), k))
                .collect::<Vec<f64>>()
        };
        let (shape_factors, noises) = (axis(TRUE_SHAPE_FACTORS, columns), axis(NOISES, rows));
        let cells = (0..rows * columns)
            .into_par_iter()
            .map(|index| {
                let (b, noise) = (shape_factors[index % columns], noises[index / columns]);
                let draws = (0..draws).map(|draw| fit(table, b, noise, index as u64 * draws + draw));
                draws.collect::<Result<_, String>>().map(|draws| Cell { draws })
            })
            .collect::<Result<_, String>>()?;
        Ok(Self {
            shape_factors,
            noises,
            cells,
        })
    }

    /// How many draws of all cells ended so.
    pub fn draws(&self, draw: Draw) -> usize {
        self.cells.iter().map(|cell| cell.count(draw)).sum()
    }

    fn csv(&self) -> Result<String, std::fmt::Error> {
        let mut text = String::from(
            "true_shape_factor_per_m,noise_n,outcome,draws,right,missed_the_interval,wrong,not_identifiable,only_b_closed,only_b_closed_and_wrong,failed\n",
        );
        for (index, cell) in self.cells.iter().enumerate() {
            let columns = self.shape_factors.len();
            writeln!(
                text,
                "{:.4e},{:.4e},\"{}\",{},{},{},{},{},{},{},{}",
                self.shape_factors[index % columns],
                self.noises[index / columns],
                NAMES[cell.outcome() as usize],
                cell.draws.len(),
                cell.count(Draw::Right),
                cell.count(Draw::Missed),
                cell.count(Draw::Wrong),
                cell.count(Draw::NotIdentifiable),
                cell.count(Draw::HalfOpen),
                cell.count(Draw::HalfOpenWrong),
                cell.count(Draw::Failed)
            )?;
        }
        Ok(text)
    }
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

pub fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let table = Table::new(6.0)?;
    let grid = Grid::fill(&table, 18, 15, 40)?;
    std::fs::write(out.join("stability-calibration.csv"), grid.csv()?)?;
    let map = Chart::of_classes(
        "Calibration of μ_d and b from 30 readings in 60 passes: where b is identifiable",
        Axis::logarithmic("true shape factor b, 1/m").cells(grid.shape_factors.clone()),
        Axis::logarithmic("standard deviation of the load cell, N").cells(grid.noises.clone()),
        NAMES,
        grid.cells.iter().map(|cell| cell.outcome() as usize),
    );
    std::fs::write(out.join("stability-calibration.svg"), map.to_svg()?)?;
    match grid.draws(Draw::Wrong) {
        0 => Ok(()),
        wrong => Err(format!("{wrong} draws are wrong").into()),
    }
}
