//! Kriging: smooth functions through the runs of a model.
//!
//! The predictions are Gaussian processes over the parameters' shares of their ranges: a mean, and deviations from it whose
//! correlation falls with the distance by Matérn's function of order 5/2 (J. Sacks, W. J. Welch, T. J. Mitchell, H. P. Wynn, "Design and Analysis
//! of Computer Experiments", Statistical Science 4, 1989; C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, 2006, chapter
//! 2 and equation 4.17).
//!
//! The length of correlation is fixed: where runs lie as close as they do around an optimum, it hardly matters.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Length of correlation, as a share of a parameter's range.
const LENGTH: f64 = 0.5;
/// Nugget, in the variance of the predictions: runs closer than a few ten-thousandths of the ranges are averaged, because ripple is most of
/// what tells them apart. A larger one, such as the ripple itself measures, would take what a model really does at short range for noise.
const NUGGET: f64 = 1e-8;

/// What runs at some places say of all others.
#[derive(Debug, Clone)]
pub struct Kriging {
    /// Shares of the parameters' ranges.
    places: Vec<DVector<f64>>,
    mean: DVector<f64>,
    /// What each run's neighbourhood adds to the mean, a row each.
    weights: DMatrix<f64>,
    /// What `weights` were solved with, and the sum of squares of each prediction about its mean, in units of the correlations.
    factor: Option<Cholesky<f64, Dyn>>,
    squares: Vec<f64>,
}

impl Kriging {
    /// Through `values`, a row for each place: solves (K + nugget) w = values − mean for all columns at once, the mean by generalised least
    /// squares.
    pub fn through(places: Vec<DVector<f64>>, mut values: DMatrix<f64>) -> Self {
        let (count, width) = values.shape();
        let correlations = DMatrix::from_fn(count, count, |i, j| correlation(&places[i], &places[j]));
        // A larger nugget makes the matrix positive definite whatever the rounding; only places that are no numbers defy it.
        let factor =
            |nugget| Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget));
        let Some(solved) = [NUGGET, 1e-6, 1e-4, 1e-2, 1.0].into_iter().find_map(factor) else {
            return Self {
                mean: values.row_mean().transpose(),
                weights: DMatrix::zeros(count, width),
                places,
                factor: None,
                squares: vec![0.0; width],
            };
        };
        let ones = solved.solve(&DVector::from_element(count, 1.0));
        let mean = values.tr_mul(&ones) / ones.sum();
        for mut row in values.row_iter_mut() {
            row -= mean.transpose();
        }
        let weights = solved.solve(&values);
        let square = |column| weights.column(column).dot(&values.column(column));
        Self {
            squares: (0..width).map(square).collect(),
            places,
            mean,
            weights,
            factor: Some(solved),
        }
    }

    /// Adds what is predicted at a place.
    pub fn add_to(&self, predicted: &mut [f64], place: &DVector<f64>) {
        let near = correlations(&self.places, place);
        let found = self.weights.tr_mul(&near);
        for ((value, mean), deviation) in predicted.iter_mut().zip(&self.mean).zip(&found) {
            *value += mean + deviation;
        }
    }

    /// What it knows of its own error, where the square of that of prediction k counts `weights[k]`; nothing with less than two runs.
    pub fn doubt(&self, weights: impl Fn(usize) -> f64) -> Option<Doubt> {
        let factor = self.factor.clone().filter(|_| self.places.len() > 1)?;
        let squares = (0..self.squares.len()).map(|k| weights(k) * self.squares[k]);
        let variance = squares.sum::<f64>() / (self.places.len() - 1) as f64;
        Some(Doubt {
            variance: at_least_zero(variance),
            places: self.places.clone(),
            factor,
        })
    }
}

/// Variance of predictions, all of them together (Sacks et al., equation 9). It depends on where the model runs, not on what it says there,
/// so that a run can be weighed before it is made.
pub struct Doubt {
    variance: f64,
    places: Vec<DVector<f64>>,
    factor: Cholesky<f64, Dyn>,
}

impl Doubt {
    /// At shares of the ranges.
    pub fn variance(&self, place: &DVector<f64>) -> f64 {
        let near = correlations(&self.places, place);
        let known = self.factor.solve(&near);
        let ones = DVector::from_element(near.len(), 1.0);
        let of_mean = (1.0 - known.sum()).powi(2) / self.factor.solve(&ones).sum();
        self.variance * at_least_zero(1.0 - near.dot(&known) + of_mean)
    }

    /// What is left of it once the model has run there.
    pub fn without(&mut self, place: DVector<f64>) {
        let column = correlations(&self.places, &place).push(1.0 + NUGGET);
        self.factor = self.factor.insert_column(self.places.len(), column);
        self.places.push(place);
    }
}

/// A variance that rounding may have made negative. What is no number stays so: `max` would take it for 0, and so for sure.
fn at_least_zero(variance: f64) -> f64 {
    variance.clamp(0.0, f64::INFINITY)
}

fn correlations(places: &[DVector<f64>], place: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(places.len(), |run, _| correlation(place, &places[run]))
}

/// Correlation between two places: Matérn's function of order 5/2.
fn correlation(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let square = |(a, b): (&f64, &f64)| (a - b) * (a - b);
    let distance = a.iter().zip(b).map(square).sum::<f64>().sqrt();
    let scaled = 5.0_f64.sqrt() * distance / LENGTH;
    (1.0 + scaled + scaled * scaled / 3.0) * (-scaled).exp()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, dvector};

    use super::Kriging;

    /// Rounding leaves no doubt; what is no number leaves nothing sure.
    #[test]
    fn doubt_is_a_number() {
        let places: Vec<DVector<f64>> = (0..25)
            .map(|k| dvector![0.1 + 0.2 * f64::from(k % 5), 0.1 + 0.2 * f64::from(k / 5)])
            .collect();
        let values = DMatrix::from_fn(
            25,
            2,
            |run, column| if column == 0 { places[run].sum() } else { 1.0 },
        );
        let mut kriging = Kriging::through(places, values);
        let at = |kriging: &Kriging| kriging.doubt(|_| 1.0).unwrap().variance(&dvector![0.4, 0.6]);
        assert!(at(&kriging) > 0.0);
        kriging.squares = vec![-1e-20, 0.0];
        assert_eq!(at(&kriging), 0.0);
        kriging.squares = vec![1.0, f64::NAN];
        assert!(at(&kriging).is_nan());
        let doubt = kriging.doubt(|_| 0.0);
        assert!(doubt.unwrap().variance(&dvector![f64::NAN, 0.6]).is_nan());
    }
}
