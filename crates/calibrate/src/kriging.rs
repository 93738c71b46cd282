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

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::tuning::LENGTH;

/// What runs at some places say of all others.
#[derive(Debug, Clone)]
pub(crate) struct Kriging {
    /// Shares of the parameters' ranges.
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
    /// Through `values`, a row for each place: solves (K + nugget) w = values − mean for all columns at
    /// once, the mean by generalised least squares.
    pub fn through(places: Vec<DVector<f64>>, mut values: DMatrix<f64>, nugget: f64) -> Self {
        let (count, width) = values.shape();
        let correlations = DMatrix::from_fn(count, count, |i, j| correlation(&places[i], &places[j]));
        // A larger nugget makes the matrix positive definite whatever the rounding.
        let factor = [nugget, 1e-8, 1e-4, 1.0].into_iter().find_map(|nugget| {
            Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget))
        });
        let slopes = places.first().map_or(0, DVector::len);
        let terms = if count > 2 * (slopes + 1) { 1 + slopes } else { 1 };
        let basis = DMatrix::from_fn(count, terms, |run, term| basis(&places[run], term));
        let known = factor
            .as_ref()
            .map_or_else(|| basis.clone(), |factor| factor.solve(&basis));
        let mean = match basis.tr_mul(&known).cholesky() {
            Some(solved) => solved.solve(&known.tr_mul(&values)),
            None => DMatrix::zeros(terms, width),
        };
        values -= basis * &mean;
        let weights = match &factor {
            Some(factor) => factor.solve(&values),
            None => DMatrix::zeros(count, width),
        };
        let square = |column| weights.column(column).dot(&values.column(column));
        Self {
            squares: (0..width).map(square).collect(),
            places,
            mean,
            weights,
            factor,
        }
    }

    /// What is predicted at a place.
    pub fn at(&self, place: &DVector<f64>) -> DVector<f64> {
        let basis = DVector::from_fn(self.mean.nrows(), |term, _| basis(place, term));
        self.mean.tr_mul(&basis) + self.weights.tr_mul(&correlations(&self.places, place))
    }

    /// Its derivatives by the shares, a column each: ∂c/∂u = −5/(3 length²) (1 + a) e^(−a) (u − u_run).
    pub fn slopes(&self, place: &DVector<f64>) -> DMatrix<f64> {
        let mut near = DMatrix::zeros(self.places.len(), place.len());
        for (run, other) in self.places.iter().enumerate() {
            let a = scaled_distance(place, other);
            let factor = -5.0 / (3.0 * LENGTH * LENGTH) * (1.0 + a) * (-a).exp();
            for k in 0..place.len() {
                near[(run, k)] = factor * (place[k] - other[k]);
            }
        }
        let mut slopes = self.weights.tr_mul(&near);
        for (term, row) in self.mean.row_iter().enumerate().skip(1) {
            let mut column = slopes.column_mut(term - 1);
            column += row.transpose();
        }
        slopes
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
        let scale = squares.sum::<f64>() / (self.places.len() - 1) as f64;
        Some(PredictionVariance {
            scale: at_least_zero(scale),
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
    places: Vec<DVector<f64>>,
    factor: Cholesky<f64, Dyn>,
}

impl PredictionVariance {
    /// At shares of the ranges.
    pub fn at(&self, place: &DVector<f64>) -> f64 {
        let near = correlations(&self.places, place);
        self.scale * at_least_zero(1.0 - near.dot(&self.factor.solve(&near)))
    }

    /// What is left of it once the model has run there.
    pub fn learn(&mut self, place: DVector<f64>) {
        let column = correlations(&self.places, &place).push(1.0 + 1e-8);
        self.factor = self.factor.insert_column(self.places.len(), column);
        self.places.push(place);
    }
}

/// A variance that rounding may have made negative. NaN propagates; `max` would hide it.
fn at_least_zero(variance: f64) -> f64 {
    variance.clamp(0.0, f64::INFINITY)
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
    use nalgebra::{DMatrix, DVector, dvector};

    use super::Kriging;

    fn through(function: impl Fn(&DVector<f64>) -> f64) -> Kriging {
        let places: Vec<DVector<f64>> = (0..25)
            .map(|k| dvector![0.1 + 0.2 * f64::from(k % 5), 0.1 + 0.2 * f64::from(k / 5)])
            .collect();
        let values = DMatrix::from_fn(
            25,
            2,
            |run, column| {
                if column == 0 { function(&places[run]) } else { 1.0 }
            },
        );
        Kriging::through(places, values, 1e-8)
    }

    /// Slopes are those of differences; a constant has none.
    #[test]
    fn slopes_are_those_of_differences() {
        let kriging = through(|place| (2.0 * place[0]).sin() * (1.0 + place[1]));
        let (here, step) = (dvector![0.43, 0.61], 1e-5);
        let slopes = kriging.slopes(&here);
        for k in 0..2 {
            let at = |sign: f64| {
                let mut place = here.clone();
                place[k] += sign * step;
                kriging.at(&place)[0]
            };
            let difference = (at(1.0) - at(-1.0)) / (2.0 * step);
            assert!((slopes[(0, k)] / difference - 1.0).abs() < 1e-6);
            assert!(slopes[(1, k)].abs() < 1e-9);
        }
    }

    /// Rounding leaves no doubt; what is no number leaves nothing sure.
    #[test]
    fn variance_is_a_number() {
        let mut kriging = through(|place| place.sum());
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
        let kriging = through(|place| place.sum());
        let mut variance = kriging.variance(&[1.0; 2]).unwrap();
        let (place, near) = (dvector![0.4, 0.6], dvector![0.42, 0.6]);
        let before = variance.at(&near);
        variance.learn(place.clone());
        assert!(variance.at(&place) < 1e-3 * before && variance.at(&near) < 0.2 * before);
    }
}
