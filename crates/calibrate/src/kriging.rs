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

use crate::tuning::{LENGTH, NUGGETS, UNKNOWN};

/// Places at which the model ran.
#[derive(Debug, Clone)]
pub(crate) struct Design {
    places: Vec<DVector<f64>>,
    /// Of the correlations between them.
    factor: Cholesky<f64, Dyn>,
}

impl Design {
    fn new(places: Vec<DVector<f64>>, nugget: f64) -> Self {
        let count = places.len();
        let correlations = DMatrix::from_fn(count, count, |i, j| correlation(&places[i], &places[j]));
        // A larger nugget makes the matrix positive definite whatever the rounding.
        let factor = [nugget, NUGGETS.1, 1e-4].into_iter().find_map(|nugget| {
            Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget))
        });
        Self {
            places,
            factor: factor.unwrap_or_else(|| Cholesky::pack_dirty(DMatrix::identity(count, count))),
        }
    }

    fn correlations(&self, place: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.places.len(), |run, _| correlation(place, &self.places[run]))
    }

    /// Variance of predictions at a place, as a share of that far from all runs, at a mean that is taken as
    /// known (Sacks et al., equation 9). It depends on where the model runs, not on what it says there, so
    /// that a run can be weighed before it is made.
    pub fn variance(&self, place: &DVector<f64>) -> f64 {
        let near = self.correlations(place);
        (1.0 - near.dot(&self.factor.solve(&near))).clamp(0.0, 1.0)
    }

    /// The same places and one more.
    pub fn learn(&mut self, place: &DVector<f64>) {
        let column = self.correlations(place).push(1.0 + NUGGETS.1);
        self.factor = self.factor.insert_column(self.places.len(), column);
        self.places.push(place.clone());
    }
}

/// What runs at some places say of the predictions at all others.
#[derive(Debug, Clone)]
pub(crate) struct Kriging {
    pub design: Design,
    mean: DVector<f64>,
    /// What each run's neighbourhood adds to the mean, a row each.
    weights: DMatrix<f64>,
    /// Sum of squares of each prediction about its mean, in units of the correlations.
    squares: DVector<f64>,
}

impl Kriging {
    /// Through runs, of which there is at least one: solves (K + nugget) w = values − mean for all predictions
    /// at once.
    pub fn through(runs: &[(DVector<f64>, DVector<f64>)], nugget: f64) -> Self {
        let (places, rows): (Vec<_>, Vec<_>) = runs.iter().map(|(a, b)| (a.clone(), b.transpose())).unzip();
        let mut values = DMatrix::from_rows(&rows);
        let mean = values.row_mean().transpose();
        for (mut column, mean) in values.column_iter_mut().zip(&mean) {
            column.add_scalar_mut(-mean);
        }
        let design = Design::new(places, nugget);
        let weights = design.factor.solve(&values);
        let squares = weights.component_mul(&values).row_sum().transpose();
        Self {
            design,
            mean,
            weights,
            squares,
        }
    }

    /// What is predicted at a place.
    pub fn at(&self, place: &DVector<f64>) -> DVector<f64> {
        &self.mean + self.weights.tr_mul(&self.design.correlations(place))
    }

    /// Its derivatives by the shares, a column each: ∂c/∂u = −5/(3 length²) (1 + a) e^(−a) (u − u_run).
    pub fn slopes(&self, place: &DVector<f64>) -> DMatrix<f64> {
        let places = &self.design.places;
        let factors = DVector::from_fn(places.len(), |run, _| {
            let a = scaled_distance(place, &places[run]);
            -5.0 / (3.0 * LENGTH * LENGTH) * (1.0 + a) * (-a).exp()
        });
        let slope = |run: usize, k: usize| factors[run] * (place[k] - places[run][k]);
        self.weights
            .tr_mul(&DMatrix::from_fn(places.len(), place.len(), slope))
    }

    /// Variance of its error far from all runs, if the square of that of prediction k counts `weights[k]`.
    /// One run says nothing of it.
    pub fn scale(&self, weights: &DVector<f64>) -> f64 {
        match self.design.places.len() {
            0 | 1 => UNKNOWN * UNKNOWN,
            // NaN propagates; `max` would hide it.
            runs => (self.squares.dot(weights) / (runs - 1) as f64).clamp(0.0, f64::INFINITY),
        }
    }
}

fn correlation(one: &DVector<f64>, other: &DVector<f64>) -> f64 {
    let a = scaled_distance(one, other);
    (1.0 + a + a * a / 3.0) * (-a).exp()
}

/// a.
fn scaled_distance(one: &DVector<f64>, other: &DVector<f64>) -> f64 {
    5.0_f64.sqrt() * (one - other).norm() / LENGTH
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};

    use super::Kriging;

    fn through(function: impl Fn(&DVector<f64>) -> f64) -> Kriging {
        let place = |k: i32| dvector![0.1 + 0.2 * f64::from(k % 5), 0.1 + 0.2 * f64::from(k / 5)];
        let run = |k| (place(k), dvector![function(&place(k)), 1.0]);
        Kriging::through(&(0..25).map(run).collect::<Vec<_>>(), 1e-8)
    }

    /// Slopes are those of differences; a constant has none.
    #[test]
    fn slopes_are_those_of_differences() {
        let kriging = through(|place| (2.0 * place[0]).sin() * (1.0 + place[1]));
        let (here, step) = (dvector![0.43, 0.61], 1e-5);
        for (k, slope) in kriging.slopes(&here).column_iter().enumerate() {
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
        assert!(
            kriging.scale(&dvector![1.0, 1.0]) > 0.0 && kriging.design.variance(&dvector![0.4, 0.6]) > 0.0
        );
        kriging.squares = dvector![-1e-20, 0.0];
        assert_eq!(kriging.scale(&dvector![1.0, 1.0]), 0.0);
        kriging.squares = dvector![1.0, f64::NAN];
        assert!(kriging.scale(&dvector![1.0, 1.0]).is_nan());
    }

    /// A run that is made leaves no doubt where it was, and less around it.
    #[test]
    fn a_run_takes_the_doubt() {
        let mut design = through(DVector::sum).design;
        let (place, near) = (dvector![0.4, 0.6], dvector![0.42, 0.6]);
        let before = design.variance(&near);
        design.learn(&place);
        assert!(design.variance(&place) < 1e-3 * before && design.variance(&near) < 0.2 * before);
    }
}
