//! Chart 4: how often the 95 % interval of μ_d holds the truth where the model is not the truth, with and without `--discrepancy`.
//!
//! The upper cable of the full-scale experiment, 40 passes, noise of 4 N. Three models are wrong by more and more: Coulomb's law for a cable
//! that gives before it slips (μ_d alone is fitted), ground that is stiffer than the true one, and one load for two axles (μ_d and the shape
//! factor are fitted). The first value of each is the truth itself, or nearly.
//!
//! Readings are runs on a mesh twice as fine as the fit's first; what the next one says more is added to a fit, so that the meshes are the same.

use std::fmt::Write as _;
use std::path::Path;

use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use creepage::scene::{FrictionLaw, Law};
use creepage::{CalibrateOptions, Calibrated, Reading, Readings, Scene, calibrate};
use rayon::prelude::*;

use crate::{Failure, upper};

const FRICTION: f64 = 0.25;
const SHAPE_FACTOR: f64 = 2e6;
const NOISE: f64 = 4.0;
const PASSES: u64 = 40;
const DRAWS: u64 = 30;
/// Node spacing of fits; the vehicle's step is half of it \[m\].
const SPACING: f64 = 0.4;
/// Its size where `--discrepancy` does not say it.
const SIZE: f64 = 0.03;
/// Weight of the truck, 20 tf \[kN\].
const LOAD: f64 = 196.133;

/// A model that is wrong in one thing.
struct Wrong {
    name: &'static str,
    axis: &'static str,
    logarithmic: bool,
    /// What is true of it.
    truths: [f64; 4],
    /// What that changes in the true scene.
    change: fn(f64) -> String,
    /// What is fitted otherwise.
    law: FrictionLaw,
}

const GIVING: FrictionLaw = FrictionLaw::ElasticPlastic {
    shape_factor: SHAPE_FACTOR,
};

const CASES: [Wrong; 3] = [
    Wrong {
        name: "Coulomb's law where the cable gives",
        axis: "true shape factor, 1/m",
        logarithmic: true,
        truths: [1e8, 1e7, 4e6, 2e6],
        change: |truth| format!("friction.shape_factor={truth} 1/m"),
        law: FrictionLaw::Coulomb,
    },
    Wrong {
        name: "ground too stiff",
        axis: "true stiffness relative to the model's",
        logarithmic: false,
        truths: [1.0, 0.95, 0.9, 0.8],
        change: |truth| format!("ground.layers.0.young_modulus={} MPa", 800.0 * truth),
        law: GIVING,
    },
    Wrong {
        name: "one load for two axles",
        axis: "true distance of the axles, m",
        logarithmic: false,
        truths: [0.0, 0.5, 1.0, 1.5],
        change: |truth| {
            let wheel = |x: f64| format!("{{ x = \"{x} m\", y = \"0 m\", load = \"{} kN\" }}", 0.5 * LOAD);
            let wheels = format!("[{}, {}]", wheel(0.5 * truth), wheel(-0.5 * truth));
            format!("vehicles.0={{ name = \"truck\", speed = \"40 km/h\", wheels = {wheels} }}")
        },
        law: GIVING,
    },
];

/// The experiment's scene with changes, on a mesh of this spacing.
fn scene(changes: &[String], law: FrictionLaw, spacing: f64) -> Result<Scene, Failure> {
    let mut scene = upper(changes)?;
    if law == FrictionLaw::Coulomb {
        (scene.friction.law, scene.friction.shape_factor) = (Law::Coulomb, None);
    }
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(spacing), Some(0.5 * spacing));
    scene.traffic.passes = PASSES;
    Ok(scene)
}

impl Wrong {
    /// Forces without noise.
    fn forces(&self, truth: f64) -> Result<Vec<f64>, Failure> {
        let mut changes = vec![
            format!("friction.dynamic_coefficient={FRICTION}"),
            format!("friction.shape_factor={SHAPE_FACTOR} 1/m"),
        ];
        changes.push((self.change)(truth));
        let run = creepage::run(&scene(&changes, GIVING, 0.5 * SPACING)?)?;
        Ok(run.passes.iter().map(|pass| pass.downstream_force_n).collect())
    }

    fn fit(&self, forces: &[f64], seed: u64, discrepancy: Option<f64>) -> Result<Calibrated, Failure> {
        // A fork: generators of neighbouring seeds begin with related numbers.
        let mut random = fastrand::Rng::with_seed(seed).fork();
        let readings: Readings = (1..)
            .zip(forces)
            .map(|(pass, force)| Reading::force(pass, force + NOISE * testkit::gaussian(&mut random)))
            .collect();
        let options = CalibrateOptions {
            discrepancy,
            ..CalibrateOptions::default()
        };
        Ok(calibrate(&scene(&[], self.law, SPACING)?, &readings, &options)?)
    }
}

/// What came out of all draws.
struct Count {
    held: usize,
    /// Intervals that miss the truth and are called identifiable.
    claimed: usize,
    /// Median width of the closed intervals.
    width: f64,
}

fn count(wrong: &Wrong, forces: &[f64], discrepancy: Option<f64>) -> Result<Count, Failure> {
    let answers = (0..DRAWS)
        .into_par_iter()
        .map(|seed| wrong.fit(forces, seed, discrepancy))
        .collect::<Result<Vec<_>, _>>()?;
    let friction = || answers.iter().map(|answer| &answer.parameters[0]);
    let holds = |[lower, upper]: [Option<f64>; 2]| {
        lower.is_none_or(|lower| lower <= FRICTION) && upper.is_none_or(|upper| FRICTION <= upper)
    };
    let mut widths: Vec<f64> = friction()
        .filter_map(|parameter| Some(parameter.interval_95[1]? - parameter.interval_95[0]?))
        .collect();
    widths.sort_by(f64::total_cmp);
    Ok(Count {
        held: friction()
            .filter(|parameter| holds(parameter.interval_95))
            .count(),
        claimed: friction()
            .filter(|parameter| parameter.identifiable && !holds(parameter.interval_95))
            .count(),
        width: widths.get(widths.len() / 2).copied().unwrap_or(f64::NAN),
    })
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut table = String::from(
        "model,what_is_true,true_value,discrepancy,draws,held,missed_and_called_identifiable,median_width\n",
    );
    let mut panels =
        Panels::new("Intervals of μ_d that hold the truth, of 30, where the model is wrong").columns(3);
    for wrong in &CASES {
        let mut shares = [Vec::new(), Vec::new()];
        for truth in wrong.truths {
            let forces = wrong.forces(truth)?;
            for (shares, discrepancy) in shares.iter_mut().zip([None, Some(SIZE)]) {
                let found = count(wrong, &forces, discrepancy)?;
                let word = if discrepancy.is_some() { "with" } else { "without" };
                writeln!(
                    table,
                    "\"{}\",\"{}\",{truth},{word},{DRAWS},{},{},{:.4}",
                    wrong.name, wrong.axis, found.held, found.claimed, found.width
                )?;
                shares.push((truth, 100.0 * found.held as f64 / DRAWS as f64));
            }
        }
        let axis = if wrong.logarithmic {
            Axis::logarithmic(wrong.axis)
        } else {
            Axis::linear(wrong.axis)
        };
        let mut chart = Chart::new(wrong.name, axis, Axis::linear("held, %").range(0.0, 105.0))
            .refer(Reference::horizontal(95.0, "95 %"));
        for (index, (name, shares)) in ["without", "with --discrepancy"]
            .into_iter()
            .zip(shares)
            .enumerate()
        {
            chart = chart.with(Series::line_points(name, shares).look(index));
        }
        panels = panels.with(chart);
    }
    crate::table::write(&out.join("discrepancy.csv"), &table)?;
    std::fs::write(out.join("discrepancy.svg"), panels.to_svg()?)?;
    Ok(())
}
