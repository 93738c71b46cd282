//! A smooth emulator of a model that is expensive to run, which knows where it is in doubt.
//!
//! Where not all parameters act on all predictions, as those of one of several series, each [part](Part)
//! is followed by itself: over fewer parameters it takes fewer runs. What a coarser model is known to
//! predict serves as the trend of a finer one, whose difference from it takes few runs to learn (M. C.
//! Kennedy, A. O'Hagan, "Predicting the output from a complex computer code when fast approximations are
//! available", Biometrika 87, 2000). Where the nearest run has no answer, there is none.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::kriging::{Kriging, PredictionVariance};
use crate::{Parameter, Part};

/// Distance of places that are one, as a share of the range: far below any standard error.
const SAME: f64 = 1e-9;

/// What a fit learned of its model: its runs, and smooth functions through them.
#[derive(Debug, Clone)]
pub struct Emulator {
    /// Those of the model.
    parameters: Vec<Parameter>,
    parts: Vec<Part>,
    trend: Option<Arc<Emulator>>,
    nugget: f64,
    /// Shares of the parameters' ranges, and what the model predicted there.
    runs: Vec<(DVector<f64>, Vec<f64>)>,
    /// Where it had no answer.
    failures: Vec<DVector<f64>>,
    /// Through what the trend misses of each part.
    krigings: Vec<Kriging>,
    /// That of the fit: there a finer model runs first.
    pub(crate) optimum: Option<DVector<f64>>,
}

impl Emulator {
    pub(crate) fn new(
        parameters: Vec<Parameter>,
        parts: Vec<Part>,
        trend: Option<Arc<Self>>,
        nugget: f64,
    ) -> Self {
        Self {
            parameters,
            parts,
            trend,
            nugget,
            runs: Vec::new(),
            failures: Vec::new(),
            krigings: Vec::new(),
            optimum: None,
        }
    }

    /// Whether it emulates a model of these parameters with these parts.
    pub(crate) fn is_of(&self, parameters: &[Parameter], parts: &[Part]) -> bool {
        let range = |parameter: &Parameter| (parameter.lower(), parameter.upper(), parameter.scale());
        let ranges = self.parameters.iter().map(range);
        ranges.eq(parameters.iter().map(range)) && self.parts == parts
    }

    /// Runs of the model that it rests on, without those of a coarser model.
    pub fn runs(&self) -> usize {
        self.runs.len()
    }

    /// Values of the model's parameters at a place.
    pub(crate) fn values(&self, place: &DVector<f64>) -> Vec<f64> {
        let pairs = self.parameters.iter().zip(place.iter());
        pairs.map(|(parameter, &share)| parameter.value(share)).collect()
    }

    /// Whether the model ran there.
    pub(crate) fn knows(&self, place: &DVector<f64>) -> bool {
        let runs = self.runs.iter().map(|(run, _)| run);
        runs.chain(&self.failures).any(|other| is_same(other, place))
    }

    /// What the model predicted there, if it ran and had an answer.
    pub(crate) fn known(&self, place: &DVector<f64>) -> Option<&[f64]> {
        let run = self.runs.iter().find(|(run, _)| is_same(run, place))?;
        Some(&run.1)
    }

    /// Whether the model should have an answer at a place: whether the nearest run has.
    fn has_answer(&self, place: &DVector<f64>) -> bool {
        let nearest = |places: &mut dyn Iterator<Item = &DVector<f64>>| {
            places
                .map(|run| (run - place).norm_squared())
                .fold(f64::INFINITY, f64::min)
        };
        self.failures.is_empty()
            || nearest(&mut self.runs.iter().map(|(run, _)| run)) < nearest(&mut self.failures.iter())
    }

    /// Adds runs at places, with what the model predicted where it had an answer.
    pub(crate) fn learn(&mut self, runs: Vec<(DVector<f64>, Option<Vec<f64>>)>) {
        for (place, predicted) in runs {
            match predicted {
                _ if self.knows(&place) => {}
                Some(predicted) => self.runs.push((place, predicted)),
                None => self.failures.push(place),
            }
        }
        let trends: Vec<Option<DVector<f64>>> = self
            .runs
            .iter()
            .map(|(place, _)| self.trend.as_ref().map(|trend| trend.predict(place)))
            .collect();
        let mut first = 0;
        let mut of_part = |part: &Part| {
            let mut places: Vec<DVector<f64>> = Vec::new();
            let mut rows = Vec::new();
            for (row, (place, _)) in self.runs.iter().enumerate() {
                let place = chosen(place, &part.parameters);
                // Runs that differ in other parameters alone say the same.
                if !places.iter().any(|other| is_same(other, &place)) {
                    places.push(place);
                    rows.push(row);
                }
            }
            let values = DMatrix::from_fn(rows.len(), part.predictions, |row, column| {
                let trend = trends[rows[row]]
                    .as_ref()
                    .map_or(0.0, |trend| trend[first + column]);
                self.runs[rows[row]].1[first + column] - trend
            });
            first += part.predictions;
            Kriging::through(places, values, self.nugget)
        };
        self.krigings = if self.runs.is_empty() {
            Vec::new()
        } else {
            self.parts.iter().map(&mut of_part).collect()
        };
    }

    /// Predictions at a place; nothing where the model should have no answer.
    pub(crate) fn at(&self, place: &DVector<f64>) -> Option<DVector<f64>> {
        self.has_answer(place).then(|| self.predict(place))
    }

    fn predict(&self, place: &DVector<f64>) -> DVector<f64> {
        let mut predicted = match &self.trend {
            Some(trend) => trend.predict(place),
            None => DVector::zeros(self.parts.iter().map(|part| part.predictions).sum()),
        };
        let mut first = 0;
        for (part, kriging) in self.parts.iter().zip(&self.krigings) {
            let mut rows = predicted.rows_mut(first, part.predictions);
            rows += kriging.at(&chosen(place, &part.parameters));
            first += part.predictions;
        }
        predicted
    }

    /// Derivatives of the predictions by the shares, a column each.
    pub(crate) fn slopes(&self, place: &DVector<f64>) -> DMatrix<f64> {
        let mut slopes = match &self.trend {
            Some(trend) => trend.slopes(place),
            None => DMatrix::zeros(self.parts.iter().map(|part| part.predictions).sum(), place.len()),
        };
        let mut first = 0;
        for (part, kriging) in self.parts.iter().zip(&self.krigings) {
            let own = kriging.slopes(&chosen(place, &part.parameters));
            for (column, &k) in part.parameters.iter().enumerate() {
                let mut rows = slopes.view_mut((first, k), (part.predictions, 1));
                rows += own.column(column);
            }
            first += part.predictions;
        }
        slopes
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`;
    /// nothing with less than two runs.
    pub(crate) fn doubt(&self, weights: &[f64]) -> Option<Doubt> {
        let mut first = 0;
        let of_part = |(kriging, part): (&Kriging, &Part)| {
            let own = weights.get(first..first + part.predictions)?;
            first += part.predictions;
            Some((kriging.variance(own)?, part.parameters.clone()))
        };
        let doubts: Option<Vec<_>> = self.krigings.iter().zip(&self.parts).map(of_part).collect();
        doubts.filter(|doubts| !doubts.is_empty()).map(Doubt)
    }
}

/// Standard error of an emulator's predictions, all of them together: of each part, with the indices of
/// its parameters.
pub(crate) struct Doubt(Vec<(PredictionVariance, Vec<usize>)>);

impl Doubt {
    /// At shares of the ranges.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        let variance = |(variance, parameters): &(PredictionVariance, Vec<usize>)| {
            variance.at(&chosen(place, parameters))
        };
        self.0.iter().map(variance).sum::<f64>().sqrt()
    }

    /// Indices of places, each beside a standard error that is allowed there, at which the model should run:
    /// the one of most doubt, then of what that run leaves, until all is allowed.
    pub fn asked(&mut self, places: &[(DVector<f64>, f64)]) -> Vec<usize> {
        let mut asked = Vec::new();
        loop {
            let size = |(place, allowed): &(DVector<f64>, f64)| {
                let size = self.at(place) / allowed;
                if size.is_nan() { f64::INFINITY } else { size }
            };
            let sizes: Vec<f64> = places.iter().map(size).collect();
            let left = (0..sizes.len()).filter(|index| !asked.contains(index));
            let most = left.max_by(|&a, &b| sizes[a].total_cmp(&sizes[b]));
            let Some(most) = most.filter(|&most| sizes[most] > 1.0) else {
                return asked;
            };
            self.learn(&places[most].0);
            asked.push(most);
        }
    }

    /// What is left of it once the model has run there.
    pub fn learn(&mut self, place: &DVector<f64>) {
        for (variance, parameters) in &mut self.0 {
            variance.learn(chosen(place, parameters));
        }
    }
}

/// Whether two places are one.
pub(crate) fn is_same(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    (a - b).amax() < SAME
}

/// The entries of a place with these indices.
fn chosen(place: &DVector<f64>, indices: &[usize]) -> DVector<f64> {
    DVector::from_fn(indices.len(), |k, _| place[indices[k]])
}
