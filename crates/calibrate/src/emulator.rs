//! A smooth emulator of a model that is expensive to run: kriging through its runs.
//!
//! The predictions are Gaussian processes over the parameters' shares of their ranges: a mean, and deviations from it whose
//! correlation falls with the distance by B. Matérn's function of order 5/2 (J. Sacks, W. J. Welch, T. J. Mitchell, H. P. Wynn, "Design and Analysis of Computer
//! Experiments", Statistical Science 4, 1989; C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, 2006, chapter
//! 2 and equation 4.17). An emulator of a coarser model serves as the mean of a finer one, whose difference from it takes few
//! runs to learn (M. C. Kennedy, A. O'Hagan, "Predicting the output from a complex computer code when fast approximations are
//! available", Biometrika 87, 2000).
//!
//! The length of correlation is fixed: where runs lie as close as they do around an optimum, it hardly matters.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::{Model, ModelError, Parameter};

/// Length of correlation, as a share of a parameter's range.
const LENGTH: f64 = 0.5;
/// Distance of places that are one, as a share of the range: far below any standard error.
const SAME: f64 = 1e-9;
/// Nugget, in the variance of the predictions: runs closer than a few ten-thousandths of the ranges are averaged, because ripple is most of
/// what tells them apart. A larger one, such as the ripple itself measures, would take what a model really does at short range for noise.
const NUGGET: f64 = 1e-8;

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
    /// Mean of what `coarse` misses, and what each run's neighbourhood adds to it, a row each.
    mean: DVector<f64>,
    weights: DMatrix<f64>,
    /// What `weights` were solved with, and the sum of squares of each prediction about its mean, in units of the correlations.
    factor: Option<Cholesky<f64, Dyn>>,
    squares: Vec<f64>,
    /// Where a finer model should run beside the optimum: ends of intervals of the fit that it was made for, and a rival of it.
    pub(crate) ends: Vec<DVector<f64>>,
    /// Parameters and their lower and upper bounds that this model, or a coarser one, was seen to exclude by far.
    pub(crate) excluded: Vec<(usize, bool)>,
}

impl Emulator {
    pub(crate) fn new(parameters: &[Parameter], coarse: Option<&Self>) -> Self {
        let of_model = |k: &usize| parameters[*k].column().is_none();
        let indices: Vec<usize> = (0..parameters.len()).filter(of_model).collect();
        Self {
            parameters: indices.iter().map(|&k| parameters[k].clone()).collect(),
            indices,
            coarse: coarse.cloned().map(Arc::new),
            points: Vec::new(),
            places: Vec::new(),
            predictions: Vec::new(),
            mean: DVector::zeros(0),
            weights: DMatrix::zeros(0, 0),
            factor: None,
            squares: Vec::new(),
            ends: Vec::new(),
            excluded: coarse.map_or_else(Vec::new, |coarse| coarse.excluded.clone()),
        }
    }

    /// Whether it emulates a model of these parameters with this number of observations.
    pub(crate) fn is_of(&self, parameters: &[Parameter], observations: usize) -> bool {
        let same = |(a, b): (&Parameter, &Parameter)| {
            (a.lower(), a.upper(), a.scale()) == (b.lower(), b.upper(), b.scale())
        };
        let of_model: Vec<&Parameter> = parameters
            .iter()
            .filter(|parameter| parameter.column().is_none())
            .collect();
        self.parameters.len() == of_model.len()
            && self.parameters.iter().zip(of_model).all(same)
            && self.predictions.iter().all(|run| run.len() == observations)
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
        let same = |other: &DVector<f64>| (other - &place).amax() < SAME;
        let run = self.places.iter().position(same)?;
        Some(&self.predictions[run])
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`; nothing with less than two runs.
    pub(crate) fn doubt(&self, weights: impl Fn(usize) -> f64) -> Option<Doubt> {
        let factor = self.factor.clone().filter(|_| self.places.len() > 1)?;
        let squares = (0..self.squares.len()).map(|k| weights(k) * self.squares[k]);
        let variance = squares.sum::<f64>() / (self.places.len() - 1) as f64;
        Some(Doubt {
            variance: at_least_zero(variance),
            places: self.places.clone(),
            factor,
        })
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

    /// Solves (K + nugget) w = y − mean for all predictions at once, the mean by generalised least squares.
    fn solve(&mut self) {
        let (count, width) = (self.places.len(), self.predictions.first().map_or(0, Vec::len));
        let mut missed = DMatrix::from_fn(count, width, |run, column| self.predictions[run][column]);
        if let Some(coarse) = &self.coarse {
            for (mut row, place) in missed.row_iter_mut().zip(&self.places) {
                row -= coarse.at(place).transpose();
            }
        }
        let correlations = DMatrix::from_fn(count, count, |i, j| {
            correlation((&self.places[i] - &self.places[j]).norm())
        });
        // A larger nugget makes the matrix positive definite whatever the rounding; only places that are no numbers defy it.
        let factor =
            |nugget| Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget));
        let Some(solved) = [NUGGET, 1e-6, 1e-4, 1e-2, 1.0].into_iter().find_map(factor) else {
            self.factor = None;
            self.mean = missed.row_mean().transpose();
            self.weights = DMatrix::zeros(count, width);
            return;
        };
        let ones = solved.solve(&DVector::from_element(count, 1.0));
        self.mean = missed.tr_mul(&ones) / ones.sum();
        for mut row in missed.row_iter_mut() {
            row -= self.mean.transpose();
        }
        self.weights = solved.solve(&missed);
        self.squares = (0..width)
            .map(|k| self.weights.column(k).dot(&missed.column(k)))
            .collect();
        self.factor = Some(solved);
    }

    /// Predictions at shares of the ranges.
    fn at(&self, place: &DVector<f64>) -> DVector<f64> {
        let near = DVector::from_fn(self.places.len(), |run, _| {
            correlation((place - &self.places[run]).norm())
        });
        let mut predicted = self.mean.clone();
        predicted.gemv_tr(1.0, &self.weights, &near, 1.0);
        match &self.coarse {
            Some(coarse) => predicted + coarse.at(place),
            None => predicted,
        }
    }
}

impl Model for Emulator {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let place = DVector::from_fn(parameters.len(), |k, _| {
            let parameter = &self.parameters[k];
            parameter.share(parameter.coordinate(parameters[k]))
        });
        Ok(self.at(&place).data.into())
    }
}

/// Standard error of an emulator's predictions, all of them together (Sacks et al., equation 9). It depends on where the model runs, not on
/// what it says there, so that a run can be weighed before it is made.
pub(crate) struct Doubt {
    variance: f64,
    places: Vec<DVector<f64>>,
    factor: Cholesky<f64, Dyn>,
}

impl Doubt {
    /// At shares of the ranges.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        let near = self.near(place);
        let known = self.factor.solve(&near);
        let ones = DVector::from_element(near.len(), 1.0);
        let of_mean = (1.0 - known.sum()).powi(2) / self.factor.solve(&ones).sum();
        (self.variance * at_least_zero(1.0 - near.dot(&known) + of_mean)).sqrt()
    }

    /// What is left of it once the model has run there.
    pub fn without(&mut self, place: DVector<f64>) {
        let column = self.near(&place).push(1.0 + NUGGET);
        self.factor = self.factor.insert_column(self.places.len(), column);
        self.places.push(place);
    }

    fn near(&self, place: &DVector<f64>) -> DVector<f64> {
        let correlations = self
            .places
            .iter()
            .map(|other| correlation((place - other).norm()));
        DVector::from_iterator(self.places.len(), correlations)
    }
}

/// A variance that rounding may have made negative. What is no number stays so: `max` would take it for 0, and so for sure.
fn at_least_zero(variance: f64) -> f64 {
    variance.clamp(0.0, f64::INFINITY)
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

/// Correlation at a distance: Matérn's function of order 5/2.
fn correlation(distance: f64) -> f64 {
    let scaled = 5.0_f64.sqrt() * distance / LENGTH;
    (1.0 + scaled + scaled * scaled / 3.0) * (-scaled).exp()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};

    use super::{Emulator, least_sure};
    use crate::{Model, Parameter, Scale};

    fn parameters() -> Vec<Parameter> {
        ["a", "b"]
            .map(|name| Parameter::new(name, 0.0, 1.0, Scale::Linear).unwrap())
            .to_vec()
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
        let mut emulator = Emulator::new(&parameters(), None);
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
        let mut first = Emulator::new(&parameters(), None);
        first.learn(grid(coarse));
        let mut second = Emulator::new(&parameters(), Some(&first));
        let fine = grid(|a, b| coarse(a, b) + missed(a));
        second.learn(fine.into_iter().step_by(4));
        for (a, b) in [(0.3, 0.7), (0.4, 0.6), (0.8, 0.2)] {
            let [before, after] = [&first, &second].map(|one| one.predict(&[a, b]).unwrap()[0]);
            assert!((after - before - missed(a)).abs() < 2e-3, "{before} {after}");
        }
        assert_eq!(second.runs(), 7);
    }

    /// Rounding leaves no doubt; what is no number leaves nothing sure.
    #[test]
    fn doubt_is_a_number_or_asked() {
        let mut emulator = Emulator::new(&parameters(), None);
        emulator.learn(grid(|a, b| a + b));
        let at = |emulator: &Emulator| emulator.doubt(|_| 1.0).unwrap().at(&dvector![0.4, 0.6]);
        assert!(at(&emulator) > 0.0);
        emulator.squares = vec![-1e-20, 0.0];
        assert_eq!(at(&emulator), 0.0);
        emulator.squares = vec![1.0, f64::NAN];
        assert!(at(&emulator).is_nan());
        let doubt = emulator.doubt(|_| 0.0);
        assert!(doubt.unwrap().at(&dvector![f64::NAN, 0.6]).is_nan());

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
        let mut emulator = Emulator::new(&parameters(), None);
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
