//! How the samples of a row are computed: by few runs, the pilots, that show how far its answers scatter and what a coarse mesh leaves wrong.
//!
//! With all drawn keys at their medians, and each in turn at its 5 % and its 95 % quantile, the largest force F gives the standard deviation
//! σ² = Σ ((F₉₅ − F₀₅)/2z)² of a linear answer. An error of σ/4 is a seventh of the distance from the median to the 95 % quantile. On a
//! coarse mesh of its own, without the finer and coarser ones that a single run needs to know its error, a sample then costs a tenth; what
//! that mesh leaves wrong is what it leaves wrong of the pilots, and half as much again: of samples beyond them, or with several keys far
//! out, a few are off by more than the pilots.

use rayon::prelude::*;

use super::evaluator::Evaluator;
use super::grid::Sweep;
use super::row::Answer;
use crate::plan::KnownMesh;
use crate::{Error, Progress, RunOptions, Scene};

/// Quantiles of the pilots, and how many standard deviations they lie from the median.
const QUANTILES: [f64; 2] = [0.05, 0.95];
const DEVIATIONS: f64 = 1.6449;
/// Share of the standard deviation that the error may have, and the largest tolerance.
const SHARE: f64 = 0.25;
const MOST: f64 = 0.05;
/// Pilots are computed to the scene's tolerance, and at least to this one.
const EXACT: f64 = 0.01;
/// Fewer samples a pilot are computed as single runs are.
const WORTHWHILE: usize = 10;
/// Samples may be off by this many times what the pilots are: in a lognormal with sigma 0.6, 3 of 40 samples were off by more than their
/// pilots showed, at worst 1.64 times.
const BEYOND: f64 = 1.5;
/// The meshes that are tried, from coarse to fine.
const LEVELS: std::ops::RangeInclusive<usize> = 1..=3;
/// Forces that are smaller beside the largest count as this share of it.
const SMALL: f64 = 0.1;

/// How the samples of a row are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    pub tolerance: f64,
    pub mesh: Option<KnownMesh>,
}

impl Sampling {
    /// What the pilots of a row say; `None` where one of them has no answer, and samples are computed as single runs are.
    pub fn of(sweep: &Sweep, row: usize, progress: Progress<'_>) -> Result<Option<Self>, Error> {
        match Self::find(sweep, row, progress) {
            Err(Error::Stopped) => Err(Error::Stopped),
            found => Ok(found.ok().flatten()),
        }
    }

    fn find(sweep: &Sweep, row: usize, progress: Progress<'_>) -> Result<Option<Self>, Error> {
        let drawn: Vec<&str> = sweep.drawn(row).collect();
        let corners = drawn
            .iter()
            .flat_map(|key| QUANTILES.map(|quantile| Some((*key, quantile))));
        let scene = |corner: Option<(&str, f64)>| -> Result<Scene, Error> {
            let share = |key: &str| match corner {
                Some((moved, quantile)) if moved == key => quantile,
                _ => 0.5,
            };
            Ok(sweep.file_with(sweep.row_values(row, share))?.scene()?)
        };
        let scenes = std::iter::once(None)
            .chain(corners)
            .map(scene)
            .collect::<Result<Vec<_>, _>>()?;
        if sweep.samples.count < WORTHWHILE * scenes.len() {
            return Ok(None);
        }
        let rows = Evaluator::new(sweep.file.clone());
        let own = scenes[0].solver.tolerance;
        // One vehicle alone: jumps are wrong by less than they say, and the answers on a coarse mesh have such an error too. Of a mix that
        // stands in for others all have the same.
        let alone = scenes[0].vehicles.len() == 1;
        // The answers of the pilots, and their own error.
        let answers = |tolerance: f64, mesh: Option<KnownMesh>| {
            let answer = |scene: &Scene| {
                let mut scene = scene.clone();
                scene.solver.tolerance = tolerance;
                let options = RunOptions {
                    progress,
                    ..RunOptions::default()
                };
                let run = rows.run_scene(&scene, mesh, &options)?;
                let answer = Answer::of(&run).ok_or(Error::NoPass)?;
                let parts = run.error_estimate.parts;
                Ok((answer, parts.mesh + if alone { 0.0 } else { parts.passes }))
            };
            scenes.par_iter().map(answer).collect::<Result<Vec<_>, Error>>()
        };
        let pilots = answers(own.min(EXACT), None)?;
        let force = |index: usize| largest(&pilots[index].0);
        let variance: f64 = (1..pilots.len())
            .step_by(2)
            .map(|low| ((force(low + 1) - force(low)) / (2.0 * DEVIATIONS)).powi(2))
            .sum();
        let spread = variance.sqrt() / force(0);
        // Written so that NaN, of no force at all, leaves the scene's own.
        let tolerance = own.max((SHARE * spread).min(MOST));
        let known = pilots.iter().map(|(_, mesh)| *mesh).fold(0.0, f64::max);
        let mut sampling = Self {
            tolerance,
            mesh: None,
        };
        if !scenes.iter().all(KnownMesh::fits) {
            return Ok(Some(sampling));
        }
        for level in LEVELS {
            let Ok(coarse) = answers(tolerance, Some(KnownMesh { level, error: 0.0 })) else {
                continue;
            };
            let off = coarse
                .iter()
                .zip(&pilots)
                .map(|(coarse, pilot)| difference(&coarse.0, &pilot.0));
            let error = known + off.fold(0.0, f64::max);
            if error <= tolerance {
                let error = known + BEYOND * (error - known);
                sampling.mesh = Some(KnownMesh { level, error });
                break;
            }
        }
        Ok(Some(sampling))
    }
}

fn forces(answer: &Answer) -> [f64; 3] {
    [
        answer.downstream_force_n,
        answer.upstream_force_n,
        answer.max_compression_n,
    ]
}

fn largest(answer: &Answer) -> f64 {
    forces(answer).into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// By what share of the forces an answer is off.
fn difference(answer: &Answer, exact: &Answer) -> f64 {
    let least = SMALL * largest(exact);
    let off = |(a, b): (f64, f64)| (a - b).abs() / b.abs().max(least);
    forces(answer)
        .into_iter()
        .zip(forces(exact))
        .map(off)
        .fold(0.0, f64::max)
}
