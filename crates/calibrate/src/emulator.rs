//! A smooth emulator of a model that is expensive to run, which knows where it is in doubt.
//!
//! Where not all parameters act on all predictions, as those of one of several series, each [part](Part)
//! is followed by itself: over fewer parameters it takes fewer runs. What a coarser model is known to
//! predict serves as the trend of a finer one, whose difference from it takes few runs to learn (M. C.
//! Kennedy, A. O'Hagan, "Predicting the output from a complex computer code when fast approximations are
//! available", Biometrika 87, 2000). Where the nearest run has no answer, there is none.

use std::ops::AddAssign;

use nalgebra::{DMatrix, DVector};

use crate::kriging::{Design, Kriging, is_same};
use crate::tuning::NUGGETS;
use crate::{Parameter, Part};

/// What a fit learned of its model: its runs, and smooth functions through them.
#[derive(Debug, Clone)]
pub struct Emulator {
    /// Those of the model.
    parameters: Vec<Parameter>,
    parts: Vec<Part>,
    nugget: f64,
    /// Through the runs of coarser models: their sum is the trend.
    trend: Vec<Kriging>,
    /// Through the runs beyond the trend, of each part.
    krigings: Vec<Kriging>,
    /// Shares of the parameters' ranges, and what the model predicted there beyond the trend.
    runs: Vec<(DVector<f64>, DVector<f64>)>,
    /// Where it had no answer.
    failures: Vec<DVector<f64>>,
    /// That of the fit: there a finer model runs first.
    pub(crate) optimum: Option<DVector<f64>>,
    /// That of the coarser model, if there is one.
    pub(crate) coarse_optimum: Option<DVector<f64>>,
}

impl Emulator {
    /// One that has seen no run of a model with these `parameters` and `parts`, whose own noise is the share
    /// `relative_noise` of its predictions.
    pub(crate) fn new(parameters: Vec<Parameter>, parts: Vec<Part>, relative_noise: f64) -> Self {
        Self {
            parameters,
            parts,
            nugget: relative_noise.powi(2).clamp(NUGGETS.0, NUGGETS.1),
            trend: Vec::new(),
            krigings: Vec::new(),
            runs: Vec::new(),
            failures: Vec::new(),
            optimum: None,
            coarse_optimum: None,
        }
    }

    /// One of a finer model, which has seen none of its runs and learns what this one misses: a fit that begins
    /// with it runs first at the optimum of this one.
    #[must_use]
    pub fn of_finer(self) -> Self {
        Self {
            trend: [self.trend, self.krigings].concat(),
            coarse_optimum: self.optimum,
            ..Self::new(self.parameters, self.parts, 0.0)
        }
    }

    /// The same for the model of `other`, which has seen no run of it; `None` if it has other parameters or
    /// parts.
    pub(crate) fn taken_for(&self, other: &Self) -> Option<Self> {
        let is_like = self.parameters == other.parameters && self.parts == other.parts;
        is_like.then(|| Self {
            nugget: other.nugget,
            ..self.clone()
        })
    }

    /// Runs of the model that it rests on, without those of a coarser model.
    pub fn runs(&self) -> usize {
        self.runs.len()
    }

    /// All runs of the model, those without an answer too.
    pub(crate) fn evaluations(&self) -> usize {
        self.runs.len() + self.failures.len()
    }

    /// Values of the model's parameters at a place.
    pub(crate) fn values(&self, place: &DVector<f64>) -> Vec<f64> {
        let pairs = self.parameters.iter().zip(place);
        let values = pairs.map(|(parameter, &share)| parameter.value_at(share));
        values.collect()
    }

    /// Whether the model ran there.
    pub(crate) fn has_run(&self, place: &DVector<f64>) -> bool {
        let runs = self.runs.iter().map(|(run, _)| run);
        runs.chain(&self.failures).any(|other| is_same(other, place))
    }

    /// What the model predicted there, if it ran and had an answer.
    pub(crate) fn known(&self, place: &DVector<f64>) -> Option<Vec<f64>> {
        let (_, beyond) = self.runs.iter().find(|(run, _)| is_same(run, place))?;
        Some((self.sum(&self.trend, place) + beyond).data.into())
    }

    /// Adds runs at places, with what the model predicted where it had an answer.
    pub(crate) fn learn(&mut self, runs: Vec<(DVector<f64>, Option<Vec<f64>>)>) {
        for (place, predicted) in runs {
            match predicted {
                None => self.failures.push(place),
                Some(predicted) => {
                    let beyond = DVector::from_vec(predicted) - self.sum(&self.trend, &place);
                    self.runs.push((place, beyond));
                }
            }
        }
        let mut next = 0;
        let of_part = |part: &Part| {
            let rows = next..next + part.predictions;
            next = rows.end;
            Kriging::through(&self.runs, &part.parameters, rows, self.nugget)
        };
        self.krigings = self.parts.iter().map(of_part).collect();
    }

    /// Predictions at a place; nothing if the model should have no answer, because the nearest run has
    /// none.
    pub(crate) fn at(&self, place: &DVector<f64>) -> Option<DVector<f64>> {
        let distance = |run: &DVector<f64>| (run - place).norm_squared();
        let failed = self.failures.iter().map(distance).fold(f64::INFINITY, f64::min);
        let has_answer = failed.is_infinite() || self.runs.iter().any(|(run, _)| distance(run) < failed);
        has_answer.then(|| self.sum(self.trend.iter().chain(&self.krigings), place))
    }

    /// The sum of what these say of the predictions.
    fn sum<'a>(&self, krigings: impl IntoIterator<Item = &'a Kriging>, place: &DVector<f64>) -> DVector<f64> {
        let mut sum = DVector::zeros(self.count());
        for kriging in krigings {
            let mut rows = sum.rows_range_mut(kriging.rows.clone());
            rows += kriging.at(place);
        }
        sum
    }

    /// Number of predictions.
    fn count(&self) -> usize {
        self.parts.iter().map(|part| part.predictions).sum()
    }

    /// Derivatives of the predictions by the shares, a column each.
    pub(crate) fn slopes(&self, place: &DVector<f64>) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.count(), place.len());
        for kriging in self.trend.iter().chain(&self.krigings) {
            for (input, slope) in kriging.slopes(place) {
                let mut rows = slopes.rows_range_mut(kriging.rows.clone());
                rows.column_mut(input).add_assign(&slope);
            }
        }
        slopes
    }

    /// Those of some places, each with a standard error of all predictions together that is allowed there, at
    /// which the model should run, as it did at `ran`: the one of most doubt, then of what that run leaves,
    /// until all is allowed. The square of an error of prediction k counts `weights[k]`.
    pub(crate) fn doubtful(
        &self,
        weights: &[f64],
        ran: &DVector<f64>,
        mut places: Vec<(DVector<f64>, f64)>,
    ) -> Vec<DVector<f64>> {
        let of_part = |kriging: &Kriging| (kriging.scale(weights), kriging.design.clone());
        let mut parts: Vec<(f64, Design)> = self.krigings.iter().map(of_part).collect();
        let (mut next, mut doubtful) = (ran.clone(), Vec::new());
        loop {
            for (_, design) in &mut parts {
                design.learn(&next);
            }
            let doubt = |(place, allowed): &(DVector<f64>, f64)| {
                let variances = parts.iter().map(|(scale, design)| scale * design.variance(place));
                let doubt = variances.sum::<f64>().sqrt() / allowed;
                if doubt.is_nan() { f64::INFINITY } else { doubt }
            };
            let sizes = places.iter().map(doubt).enumerate();
            let largest = sizes.max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((index, _)) = largest.filter(|(_, size)| *size > 1.0) else {
                return doubtful;
            };
            (next, _) = places.swap_remove(index);
            doubtful.push(next.clone());
        }
    }
}
