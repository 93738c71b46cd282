//! Kriging: smooth functions through the runs of a model, and how far they may be off.
//!
//! The predictions are Gaussian processes over the parameters' shares of their ranges: a mean, and
//! deviations from it whose correlation falls with the distance d by Matérn's function of order 5/2,
//!
//! c = (1 + a + a²/3) e^(−a), a = √5 d/length
//!
//! (J. Sacks, W. J. Welch, T. J. Mitchell, H. P. Wynn, "Design and Analysis of Computer Experiments",
//! Statistical Science 4, 1989; C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine
//! Learning, 2006, chapter 2 and equation 4.17). The length is fixed: where runs lie as close as they do
//! around an optimum, it hardly matters.

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::tuning::{LENGTH, NUGGETS};

/// Distance of places that are one, as a share of the range: far below any standard error.
const SAME: f64 = 1e-9;

/// What runs at some places say of some predictions at all others.
#[derive(Debug, Clone)]
pub(crate) struct Kriging {
    /// Which shares of a place act on them.
    inputs: Vec<usize>,
    places: Vec<DVector<f64>>,
    /// A constant, and where there are runs enough for it a slope by each share, a row each.
    mean: DMatrix<f64>,
    /// What each run's neighbourhood adds to the mean, a row each.
    weights: DMatrix<f64>,
    /// What `weights` were solved with; nothing if the places are no numbers.
    factor: Option<Cholesky<f64, Dyn>>,
    /// Sum of squares of each prediction about its mean, in units of the correlations.
    squares: Vec<f64>,
}

impl Kriging {
    /// Through the predictions `rows` of runs: solves (K + nugget) w = values − mean for all of them at
    /// once, the mean by generalised least squares.
    pub fn through(
        runs: &[(DVector<f64>, DVector<f64>)],
        inputs: &[usize],
        rows: Range<usize>,
        nugget: f64,
    ) -> Self {
        let (mut places, mut own): (Vec<DVector<f64>>, Vec<&DVector<f64>>) = Default::default();
        for (place, predicted) in runs {
            let place = chosen(place, inputs);
            // Runs that differ in other parameters alone say the same.
            if !places.iter().any(|other| is_same(other, &place)) {
                places.push(place);
                own.push(predicted);
            }
        }
        let (count, width) = (places.len(), rows.len());
        let mut values = DMatrix::from_fn(count, width, |run, row| own[run][rows.start + row]);
        let correlations = DMatrix::from_fn(count, count, |i, j| correlation(&places[i], &places[j]));
        // A larger nugget makes the matrix positive definite whatever the rounding.
        let factor = [nugget, NUGGETS.1, 1e-4, 1.0].into_iter().find_map(|nugget| {
            Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget))
        });
        let solve = |values: &DMatrix<f64>| match &factor {
            Some(factor) => factor.solve(values),
            None => DMatrix::zeros(count, values.ncols()),
        };
        let terms = if count > 2 * (inputs.len() + 1) {
            1 + inputs.len()
        } else {
            1
        };
        let basis = DMatrix::from_fn(count, terms, |run, term| basis(&places[run], term));
        let known = solve(&basis);
        let mean = match basis.tr_mul(&known).cholesky() {
            Some(solved) => solved.solve(&known.tr_mul(&values)),
            None => DMatrix::zeros(terms, width),
        };
        values -= basis * &mean;
        let weights = solve(&values);
        let square = |column| weights.column(column).dot(&values.column(column));
        let squares = (0..width).map(square).collect();
        Self {
            inputs: inputs.to_vec(),
            places,
            mean,
            weights,
            factor,
            squares,
        }
    }

    /// What is predicted at a place.
    pub fn at(&self, place: &DVector<f64>) -> DVector<f64> {
        let place = chosen(place, &self.inputs);
        let basis = DVector::from_fn(self.mean.nrows(), |term, _| basis(&place, term));
        self.mean.tr_mul(&basis) + self.weights.tr_mul(&correlations(&self.places, &place))
    }

    /// Its derivatives by the shares that act on it, each with its index: ∂c/∂u = −5/(3 length²) (1 + a)
    /// e^(−a) (u − u_run).
    pub fn slopes(&self, place: &DVector<f64>) -> impl Iterator<Item = (usize, DVector<f64>)> {
        let place = chosen(place, &self.inputs);
        let factors = DVector::from_fn(self.places.len(), |run, _| {
            let a = scaled_distance(&place, &self.places[run]);
            -5.0 / (3.0 * LENGTH * LENGTH) * (1.0 + a) * (-a).exp()
        });
        self.inputs.iter().enumerate().map(move |(k, &input)| {
            let near = |run: usize, _| factors[run] * (place[k] - self.places[run][k]);
            let mut slope = self.weights.tr_mul(&DVector::from_fn(factors.len(), near));
            if self.mean.nrows() > 1 {
                slope += self.mean.row(k + 1).transpose();
            }
            (input, slope)
        })
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`;
    /// nothing with less than two runs.
    pub fn variance(&self, weights: &[f64]) -> Option<PredictionVariance> {
        let factor = self.factor.clone().filter(|_| self.places.len() > 1)?;
        let squares = self
            .squares
            .iter()
            .zip(weights)
            .map(|(square, weight)| weight * square);
        Some(PredictionVariance {
            scale: at_least_zero(squares.sum::<f64>() / (self.places.len() - 1) as f64),
            inputs: self.inputs.clone(),
            places: self.places.clone(),
            factor,
        })
    }
}

/// Variance of predictions, all of them together, at a mean that is taken as known (Sacks et al., equation
/// 9). It depends on where the model runs, not on what it says there, so that a run can be weighed before
/// it is made.
pub(crate) struct PredictionVariance {
    scale: f64,
    inputs: Vec<usize>,
    places: Vec<DVector<f64>>,
    factor: Cholesky<f64, Dyn>,
}

impl PredictionVariance {
    /// At a place.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        let near = correlations(&self.places, &chosen(place, &self.inputs));
        self.scale * at_least_zero(1.0 - near.dot(&self.factor.solve(&near)))
    }

    /// What is left of it once the model has run there.
    pub fn learn(&mut self, place: &DVector<f64>) {
        let place = chosen(place, &self.inputs);
        let column = correlations(&self.places, &place).push(1.0 + NUGGETS.1);
        self.factor = self.factor.insert_column(self.places.len(), column);
        self.places.push(place);
    }
}

/// A variance that rounding may have made negative. NaN propagates; `max` would hide it.
fn at_least_zero(variance: f64) -> f64 {
    variance.clamp(0.0, f64::INFINITY)
}

/// Whether two places are one.
pub(crate) fn is_same(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    (a - b).amax() < SAME
}

/// The entries of a place with these indices.
fn chosen(place: &DVector<f64>, indices: &[usize]) -> DVector<f64> {
    DVector::from_fn(indices.len(), |k, _| place[indices[k]])
}

/// A term of the mean at a place.
fn basis(place: &DVector<f64>, term: usize) -> f64 {
    if term == 0 { 1.0 } else { place[term - 1] }
}

fn correlations(places: &[DVector<f64>], place: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(places.len(), |run, _| correlation(place, &places[run]))
}

fn correlation(one: &DVector<f64>, other: &DVector<f64>) -> f64 {
    let a = scaled_distance(one, other);
    (1.0 + a + a * a / 3.0) * (-a).exp()
}

/// a.
fn scaled_distance(one: &DVector<f64>, other: &DVector<f64>) -> f64 {
    let square = |(a, b): (&f64, &f64)| (a - b) * (a - b);
    let distance = one.iter().zip(other).map(square).sum::<f64>().sqrt();
    5.0_f64.sqrt() * distance / LENGTH
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};

    use super::Kriging;

    fn through(function: impl Fn(&DVector<f64>) -> f64) -> Kriging {
        let place = |k: i32| dvector![0.1 + 0.2 * f64::from(k % 5), 0.1 + 0.2 * f64::from(k / 5)];
        let run = |k| (place(k), dvector![function(&place(k)), 1.0]);
        Kriging::through(&(0..25).map(run).collect::<Vec<_>>(), &[0, 1], 0..2, 1e-8)
    }

    /// Slopes are those of differences; a constant has none.
    #[test]
    fn slopes_are_those_of_differences() {
        let kriging = through(|place| (2.0 * place[0]).sin() * (1.0 + place[1]));
        let (here, step) = (dvector![0.43, 0.61], 1e-5);
        for (k, slope) in kriging.slopes(&here) {
            let at = |sign: f64| {
                let mut place = here.clone();
                place[k] += sign * step;
                kriging.at(&place)[0]
            };
            let difference = (at(1.0) - at(-1.0)) / (2.0 * step);
            assert!((slope[0] / difference - 1.0).abs() < 1e-6);
            assert!(slope[1].abs() < 1e-9);
        }
    }

    /// Rounding leaves no doubt; what is no number leaves nothing sure.
    #[test]
    fn variance_is_a_number() {
        let mut kriging = through(DVector::sum);
        let at = |kriging: &Kriging| kriging.variance(&[1.0; 2]).unwrap().at(&dvector![0.4, 0.6]);
        assert!(at(&kriging) > 0.0);
        kriging.squares = vec![-1e-20, 0.0];
        assert_eq!(at(&kriging), 0.0);
        kriging.squares = vec![1.0, f64::NAN];
        assert!(at(&kriging).is_nan());
    }

    /// A run that is made leaves no doubt where it was, and less around it.
    #[test]
    fn a_run_takes_the_doubt() {
        let kriging = through(DVector::sum);
        let mut variance = kriging.variance(&[1.0; 2]).unwrap();
        let (place, near) = (dvector![0.4, 0.6], dvector![0.42, 0.6]);
        let before = variance.at(&near);
        variance.learn(&place);
        assert!(variance.at(&place) < 1e-3 * before && variance.at(&near) < 0.2 * before);
    }
}
