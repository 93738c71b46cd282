//! A smooth emulator of a model that is expensive to run, which knows where it is in doubt.
//!
//! Where not all parameters act on all predictions, as those of one of several series, each [part](Part)
//! is followed by itself: over fewer parameters it takes fewer runs. What a coarser model is known to
//! predict serves as the trend of a finer one, whose difference from it takes few runs to learn (M. C.
//! Kennedy, A. O'Hagan, "Predicting the output from a complex computer code when fast approximations are
//! available", Biometrika 87, 2000). Where the nearest run has no answer, there is none.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::kriging::{Kriging, PredictionVariance, is_same};
use crate::{Parameter, Part};

/// What a fit learned of its model: its runs, and smooth functions through them.
#[derive(Debug, Clone)]
pub struct Emulator {
    /// Those of the model.
    parameters: Vec<Parameter>,
    parts: Vec<Part>,
    trend: Option<Arc<Emulator>>,
    nugget: f64,
    /// Shares of the parameters' ranges, and what the model predicted there beyond the trend.
    runs: Vec<(DVector<f64>, DVector<f64>)>,
    /// Where it had no answer.
    failures: Vec<DVector<f64>>,
    /// Through the runs, of each part.
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
        self.parameters.iter().map(range).eq(parameters.iter().map(range)) && self.parts == parts
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
    pub(crate) fn known(&self, place: &DVector<f64>) -> Option<Vec<f64>> {
        let (_, beyond) = self.runs.iter().find(|(run, _)| is_same(run, place))?;
        let trend = self.trend.as_ref().map(|trend| trend.predict(place));
        Some(
            trend
                .map_or_else(|| beyond.clone(), |trend| trend + beyond)
                .data
                .into(),
        )
    }

    /// Whether the model should have an answer at a place: whether the nearest run has.
    fn has_answer(&self, place: &DVector<f64>) -> bool {
        let distance = |run: &DVector<f64>| (run - place).norm_squared();
        let failed = self.failures.iter().map(distance).fold(f64::INFINITY, f64::min);
        failed.is_infinite() || self.runs.iter().any(|(run, _)| distance(run) < failed)
    }

    /// Adds runs at places, with what the model predicted where it had an answer.
    pub(crate) fn learn(&mut self, runs: Vec<(DVector<f64>, Option<Vec<f64>>)>) {
        for (place, predicted) in runs {
            match predicted {
                _ if self.knows(&place) => {}
                None => self.failures.push(place),
                Some(predicted) => {
                    let mut beyond = DVector::from_vec(predicted);
                    if let Some(trend) = &self.trend {
                        beyond -= trend.predict(&place);
                    }
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

    /// Predictions at a place; nothing where the model should have no answer.
    pub(crate) fn at(&self, place: &DVector<f64>) -> Option<DVector<f64>> {
        self.has_answer(place).then(|| self.predict(place))
    }

    fn predict(&self, place: &DVector<f64>) -> DVector<f64> {
        let mut predicted = match &self.trend {
            Some(trend) => trend.predict(place),
            None => DVector::zeros(self.predictions()),
        };
        let mut next = 0;
        for (kriging, part) in self.krigings.iter().zip(&self.parts) {
            let mut rows = predicted.rows_mut(next, part.predictions);
            rows += kriging.at(place);
            next += part.predictions;
        }
        predicted
    }

    /// Derivatives of the predictions by the shares, a column each.
    pub(crate) fn slopes(&self, place: &DVector<f64>) -> DMatrix<f64> {
        let mut slopes = match &self.trend {
            Some(trend) => trend.slopes(place),
            None => DMatrix::zeros(self.predictions(), place.len()),
        };
        let mut next = 0;
        for (kriging, part) in self.krigings.iter().zip(&self.parts) {
            for (input, slope) in kriging.slopes(place) {
                let mut rows = slopes.view_mut((next, input), (part.predictions, 1));
                rows += slope;
            }
            next += part.predictions;
        }
        slopes
    }

    fn predictions(&self) -> usize {
        self.parts.iter().map(|part| part.predictions).sum()
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`;
    /// nothing with less than two runs.
    pub(crate) fn doubt(&self, weights: &[f64]) -> Option<Doubt> {
        let mut left = weights;
        let of_part = |(kriging, part): (&Kriging, &Part)| {
            let (own, others) = left.split_at_checked(part.predictions)?;
            left = others;
            kriging.variance(own)
        };
        let doubts = self.krigings.iter().zip(&self.parts).map(of_part);
        Some(Doubt(doubts.collect::<Option<Vec<_>>>()?))
    }
}

/// Standard error of an emulator's predictions, all of them together, by the variance of each part.
pub(crate) struct Doubt(Vec<PredictionVariance>);

impl Doubt {
    /// At a place.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        self.0.iter().map(|part| part.at(place)).sum::<f64>().sqrt()
    }

    /// What is left of it once the model has run there.
    pub fn learn(&mut self, place: &DVector<f64>) {
        for part in &mut self.0 {
            part.learn(place);
        }
    }

    /// Indices of places, each beside a standard error that is allowed there, at which the model should
    /// run: the one of most doubt, then of what that run leaves, until all is allowed.
    pub fn asked(&mut self, places: &[(DVector<f64>, f64)]) -> Vec<usize> {
        let mut asked = Vec::new();
        loop {
            let size = |&index: &usize| {
                let (place, allowed) = &places[index];
                let size = self.at(place) / allowed;
                (if size.is_nan() { f64::INFINITY } else { size }, index)
            };
            let left = (0..places.len()).filter(|index| !asked.contains(index));
            let most = left.map(|index| size(&index)).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, most)) = most.filter(|(size, _)| *size > 1.0) else {
                return asked;
            };
            self.learn(&places[most].0);
            asked.push(most);
        }
    }
}
