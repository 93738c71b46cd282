//! A smooth emulator of a model that is expensive to run: kriging through its runs.
//!
//! Where not all parameters act on all predictions, as those of one of several series, each [part](Part) is followed by itself: over fewer
//! parameters it takes fewer runs. An emulator of a coarser model serves as the mean of a finer one, whose difference from it takes few
//! runs to learn (M. C. Kennedy, A. O'Hagan, "Predicting the output from a complex computer code when fast approximations are
//! available", Biometrika 87, 2000).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::kriging::{self, Kriging};
use crate::{Model, ModelError, Parameter, Part};

/// Distance of places that are one, as a share of the range: far below any standard error.
const SAME: f64 = 1e-9;

/// An emulator of a model, learned from its runs by [`Calibration::fit_emulated`](crate::Calibration::fit_emulated).
#[derive(Debug, Clone)]
pub struct Emulator {
    /// Those of the model.
    parameters: Vec<Parameter>,
    /// Their indices among all.
    indices: Vec<usize>,
    /// What the runs are compared with, if not with their mean alone.
    pub(crate) coarse: Option<Arc<Emulator>>,
    /// Free variables of these parameters, a run each, and the shares of the parameters' ranges that they are.
    points: Vec<DVector<f64>>,
    places: Vec<DVector<f64>>,
    /// What the model predicted there.
    predictions: Vec<Vec<f64>>,
    /// What acts on which predictions, and through what `coarse` misses of each part.
    parts: Vec<Part>,
    krigings: Vec<Kriging>,
    /// Where a finer model should run beside the optimum: ends of intervals of the fit that it was made for, and a rival of it.
    pub(crate) ends: Vec<DVector<f64>>,
    /// Parameters and their lower and upper bounds that this model, or a coarser one, was seen to exclude by far.
    pub(crate) excluded: Vec<(usize, bool)>,
}

impl Emulator {
    pub(crate) fn new(parameters: &[Parameter], parts: Vec<Part>, coarse: Option<&Self>) -> Self {
        let of_model = |k: &usize| parameters[*k].column().is_none();
        let indices: Vec<usize> = (0..parameters.len()).filter(of_model).collect();
        Self {
            parameters: indices.iter().map(|&k| parameters[k].clone()).collect(),
            indices,
            coarse: coarse.cloned().map(Arc::new),
            points: Vec::new(),
            places: Vec::new(),
            predictions: Vec::new(),
            parts,
            krigings: Vec::new(),
            ends: Vec::new(),
            excluded: coarse.map_or_else(Vec::new, |coarse| coarse.excluded.clone()),
        }
    }

    /// Whether it emulates a model of these parameters with these parts.
    pub(crate) fn is_of(&self, parameters: &[Parameter], parts: &[Part]) -> bool {
        let same = |(a, b): (&Parameter, &Parameter)| {
            (a.lower(), a.upper(), a.scale()) == (b.lower(), b.upper(), b.scale())
        };
        let of_model: Vec<&Parameter> = parameters
            .iter()
            .filter(|parameter| parameter.column().is_none())
            .collect();
        self.parameters.len() == of_model.len()
            && self.parameters.iter().zip(of_model).all(same)
            && self.parts == parts
    }

    /// Runs of the model that it rests on, without those of a coarser model.
    pub fn runs(&self) -> usize {
        self.places.len()
    }

    /// The free variables of the model's parameters.
    pub(crate) fn of_model(&self, free: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.indices.len(), |k, _| free[self.indices[k]])
    }

    /// Those of all parameters, terms at the middle of their ranges.
    pub(crate) fn with_terms(&self, of_model: &DVector<f64>, count: usize) -> DVector<f64> {
        let mut free = DVector::zeros(count);
        for (&k, z) in self.indices.iter().zip(of_model.iter()) {
            free[k] = *z;
        }
        free
    }

    /// Shares of the parameters' ranges at free variables.
    pub(crate) fn place(&self, free: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.parameters.len(), |k, _| {
            let parameter = &self.parameters[k];
            parameter.share(parameter.bounded(free[self.indices[k]]))
        })
    }

    /// Where the model fits: of its runs whose `score` is at most `margin` above the least, the best one and up to `count` more, each as
    /// far as can be from those before it.
    pub(crate) fn low_points(
        &self,
        score: impl Fn(&DVector<f64>, &[f64]) -> f64,
        margin: f64,
        count: usize,
    ) -> Vec<DVector<f64>> {
        let runs = self.points.iter().zip(&self.predictions);
        let scores: Vec<f64> = runs.map(|(free, predicted)| score(free, predicted)).collect();
        let least = scores.iter().copied().fold(f64::INFINITY, f64::min);
        let mut low: Vec<usize> = (0..scores.len())
            .filter(|&run| scores[run] <= least + margin)
            .collect();
        low.sort_by(|&a, &b| scores[a].total_cmp(&scores[b]));
        let mut chosen: Vec<usize> = low.first().copied().into_iter().collect();
        for _ in 0..count {
            let distance = |run: usize| {
                let to = |&other: &usize| (&self.places[run] - &self.places[other]).norm();
                chosen.iter().map(to).fold(f64::INFINITY, f64::min)
            };
            let farthest = low.iter().max_by(|&&a, &&b| distance(a).total_cmp(&distance(b)));
            chosen.extend(farthest.copied().filter(|&run| distance(run) > 0.0));
        }
        chosen.into_iter().map(|run| self.points[run].clone()).collect()
    }

    /// What the model predicted at free variables, if it ran there.
    pub(crate) fn known(&self, free: &DVector<f64>) -> Option<&[f64]> {
        let place = self.place(free);
        let run = self.places.iter().position(|other| is_same(other, &place))?;
        Some(&self.predictions[run])
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`; nothing with less than two runs.
    pub(crate) fn doubt(&self, weights: impl Fn(usize) -> f64) -> Option<Doubt> {
        let mut first = 0;
        let of_part = |(kriging, part): (&Kriging, &Part)| {
            let doubt = kriging.doubt(|k| weights(first + k));
            first += part.predictions;
            Some((doubt?, part.parameters.clone()))
        };
        let doubts = self.krigings.iter().zip(&self.parts).map(of_part);
        Some(Doubt(doubts.collect::<Option<Vec<_>>>()?))
    }

    /// Adds runs at free variables.
    pub(crate) fn learn(&mut self, runs: impl IntoIterator<Item = (DVector<f64>, Vec<f64>)>) {
        for (free, predicted) in runs {
            if self.known(&free).is_some() {
                continue;
            }
            let place = self.place(&free);
            self.points.push(self.of_model(&free));
            self.places.push(place);
            self.predictions.push(predicted);
        }
        self.solve();
    }

    fn solve(&mut self) {
        let mut missed = self.predictions.clone();
        if let Some(coarse) = &self.coarse {
            for (missed, place) in missed.iter_mut().zip(&self.places) {
                for (value, coarse) in missed.iter_mut().zip(coarse.at(place)) {
                    *value -= coarse;
                }
            }
        }
        let mut first = 0;
        let of_part = |part: &Part| {
            let mut places: Vec<DVector<f64>> = Vec::new();
            let mut runs = Vec::new();
            for (run, place) in self.places.iter().enumerate() {
                let place = chosen(place, &part.parameters);
                // Runs that differ in other parameters alone say the same.
                if !places.iter().any(|other| is_same(other, &place)) {
                    places.push(place);
                    runs.push(run);
                }
            }
            let value = |row: usize, column| missed[runs[row]][first + column];
            let values = DMatrix::from_fn(runs.len(), part.predictions, value);
            first += part.predictions;
            Kriging::through(places, values)
        };
        self.krigings = self.parts.iter().map(of_part).collect();
    }

    /// Predictions at shares of the ranges.
    fn at(&self, place: &DVector<f64>) -> Vec<f64> {
        let mut predicted = match &self.coarse {
            Some(coarse) => coarse.at(place),
            None => vec![0.0; self.parts.iter().map(|part| part.predictions).sum()],
        };
        let mut first = 0;
        for (part, kriging) in self.parts.iter().zip(&self.krigings) {
            let next = first + part.predictions;
            kriging.add_to(&mut predicted[first..next], &chosen(place, &part.parameters));
            first = next;
        }
        predicted
    }
}

impl Model for Emulator {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let place = DVector::from_fn(parameters.len(), |k, _| {
            let parameter = &self.parameters[k];
            parameter.share(parameter.coordinate(parameters[k]))
        });
        Ok(self.at(&place))
    }

    fn parts(&self) -> Vec<Part> {
        self.parts.clone()
    }
}

/// Standard error of an emulator's predictions, all of them together: of each part, with the indices of its parameters.
pub(crate) struct Doubt(Vec<(kriging::Doubt, Vec<usize>)>);

impl Doubt {
    /// At shares of the ranges.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        let variance =
            |(doubt, parameters): &(kriging::Doubt, Vec<usize>)| doubt.variance(&chosen(place, parameters));
        self.0.iter().map(variance).sum::<f64>().sqrt()
    }

    /// What is left of it once the model has run there.
    pub fn without(&mut self, place: &DVector<f64>) {
        for (doubt, parameters) in &mut self.0 {
            doubt.without(chosen(place, parameters));
        }
    }
}

/// Index of the largest of these doubts, shares of what is allowed, if it is not allowed. What is no number is the largest.
pub(crate) fn least_sure(doubts: &[f64]) -> Option<usize> {
    let size = |k: usize| {
        if doubts[k].is_nan() {
            f64::INFINITY
        } else {
            doubts[k]
        }
    };
    let most = (0..doubts.len()).max_by(|&a, &b| size(a).total_cmp(&size(b)));
    most.filter(|&most| size(most) > 1.0)
}

/// Whether two places are one.
fn is_same(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    (a - b).amax() < SAME
}

/// The entries of a place with these indices.
fn chosen(place: &DVector<f64>, indices: &[usize]) -> DVector<f64> {
    DVector::from_fn(indices.len(), |k, _| place[indices[k]])
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};

    use super::{Emulator, least_sure};
    use crate::{Model, Parameter, Part, Scale};

    fn parameters() -> Vec<Parameter> {
        ["a", "b"]
            .map(|name| Parameter::new(name, 0.0, 1.0, Scale::Linear).unwrap())
            .to_vec()
    }

    fn whole() -> Vec<Part> {
        vec![Part {
            predictions: 2,
            parameters: vec![0, 1],
        }]
    }

    /// Free variables of a grid, and what the function gives there.
    fn grid(function: impl Fn(f64, f64) -> f64) -> Vec<(DVector<f64>, Vec<f64>)> {
        let shares = [0.1, 0.3, 0.5, 0.7, 0.9];
        let free = |share: f64| (share / (1.0 - share)).ln();
        shares
            .iter()
            .flat_map(|&a| shares.map(|b| (dvector![free(a), free(b)], vec![function(a, b), 1.0])))
            .collect()
    }

    /// It returns what it has learned, and in between what a smooth function does; a constant everywhere.
    #[test]
    fn a_smooth_function_is_followed() {
        let function = |a: f64, b: f64| (2.0 * a).sin() * (1.0 + b * b);
        let mut emulator = Emulator::new(&parameters(), whole(), None);
        emulator.learn(grid(function));
        for (a, b, tolerance) in [(0.3, 0.7, 1e-6), (0.4, 0.6, 5e-3), (0.55, 0.45, 5e-3)] {
            let found = emulator.predict(&[a, b]).unwrap();
            assert!((found[0] - function(a, b)).abs() < tolerance, "{found:?}");
            assert!((found[1] - 1.0).abs() < 1e-9, "{found:?}");
        }
        assert_eq!(emulator.runs(), 25);
    }

    /// What a coarse model misses is learned from few runs.
    #[test]
    fn a_coarse_model_is_corrected() {
        let coarse = |a: f64, b: f64| (2.0 * a).sin() * (1.0 + b * b);
        let missed = |a: f64| 0.1 + 0.02 * a;
        let mut first = Emulator::new(&parameters(), whole(), None);
        first.learn(grid(coarse));
        let mut second = Emulator::new(&parameters(), whole(), Some(&first));
        let fine = grid(|a, b| coarse(a, b) + missed(a));
        second.learn(fine.into_iter().step_by(4));
        for (a, b) in [(0.3, 0.7), (0.4, 0.6), (0.8, 0.2)] {
            let [before, after] = [&first, &second].map(|one| one.predict(&[a, b]).unwrap()[0]);
            assert!((after - before - missed(a)).abs() < 2e-3, "{before} {after}");
        }
        assert_eq!(second.runs(), 7);
    }

    /// What is no number is asked first.
    #[test]
    fn the_largest_doubt_is_asked() {
        for nan in [f64::NAN, -f64::NAN] {
            assert_eq!(least_sure(&[0.5, nan, 2.0]), Some(1));
            assert_eq!(least_sure(&[nan, 0.5]), Some(0));
        }
        assert_eq!(least_sure(&[0.5, 1.2, 2.0]), Some(2));
        assert_eq!((least_sure(&[0.5, 1.0]), least_sure(&[])), (None, None));
    }

    /// Runs that are nearly one, and runs that are one, do not make it swing.
    #[test]
    fn near_runs_are_averaged() {
        let mut emulator = Emulator::new(&parameters(), whole(), None);
        emulator.learn(grid(|a, b| 1.0 + a + b));
        let near = [(0.0, 1.0), (0.0, 1.0), (2e-6, -1.0), (4e-6, 1.0)];
        emulator.learn(near.map(|(off, sign)| {
            let a: f64 = 0.6 + off;
            let free = dvector![(a / (1.0 - a)).ln(), 0.0];
            (free, vec![1.0 + a + 0.5 + sign * 1e-5, 1.0])
        }));
        let at = |a: f64| emulator.predict(&[a, 0.5]).unwrap()[0];
        let slope = (at(0.602) - at(0.6)) / 0.002;
        assert!((slope - 1.0).abs() < 0.05, "{slope}");
        assert_eq!(emulator.runs(), 28);
    }
}
