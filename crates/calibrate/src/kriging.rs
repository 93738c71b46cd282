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

use crate::tuning::{LENGTH, NUGGETS, UNKNOWN};

/// Distance of places that are one, as a share of the range: far below any standard error.
const SAME: f64 = 1e-9;

/// Places at which the model ran.
#[derive(Debug, Clone)]
pub(crate) struct Design {
    /// Which shares of a place act on the predictions.
    inputs: Vec<usize>,
    places: Vec<DVector<f64>>,
    /// Of the correlations between them.
    factor: Cholesky<f64, Dyn>,
}

impl Design {
    fn new(inputs: Vec<usize>, places: Vec<DVector<f64>>, nugget: f64) -> Self {
        let count = places.len();
        let correlations = DMatrix::from_fn(count, count, |i, j| correlation(&places[i], &places[j]));
        // A larger nugget makes the matrix positive definite whatever the rounding.
        let factor = [nugget, NUGGETS.1, 1e-4].into_iter().find_map(|nugget| {
            Cholesky::new(&correlations + DMatrix::from_diagonal_element(count, count, nugget))
        });
        Self {
            inputs,
            places,
            factor: factor.unwrap_or_else(|| Cholesky::pack_dirty(DMatrix::identity(count, count))),
        }
    }

    fn correlations(&self, place: &DVector<f64>) -> DVector<f64> {
        let place = place.select_rows(&self.inputs);
        DVector::from_fn(self.places.len(), |run, _| correlation(&place, &self.places[run]))
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
        self.places.push(place.select_rows(&self.inputs));
    }
}

/// What runs at some places say of some predictions at all others.
#[derive(Debug, Clone)]
pub(crate) struct Kriging {
    /// Which predictions.
    pub rows: Range<usize>,
    pub design: Design,
    mean: DVector<f64>,
    /// What each run's neighbourhood adds to the mean, a column each.
    weights: DMatrix<f64>,
    /// Sum of squares of each prediction about its mean, in units of the correlations.
    squares: DVector<f64>,
}

impl Kriging {
    /// Through the predictions `rows` of runs: solves (K + nugget) w = values − mean for all of them at
    /// once.
    pub fn through(
        runs: &[(DVector<f64>, DVector<f64>)],
        inputs: &[usize],
        rows: Range<usize>,
        nugget: f64,
    ) -> Self {
        let (mut places, mut own): (Vec<DVector<f64>>, Vec<&DVector<f64>>) = Default::default();
        for (place, predicted) in runs {
            let place = place.select_rows(inputs);
            // Runs that differ in other parameters alone say the same.
            if !places.iter().any(|other| is_same(other, &place)) {
                places.push(place);
                own.push(predicted);
            }
        }
        let (count, width) = (places.len(), rows.len());
        let mut values = DMatrix::from_fn(count, width, |run, row| own[run][rows.start + row]);
        let mean = values.row_mean().transpose();
        for (mut column, mean) in values.column_iter_mut().zip(&mean) {
            column.add_scalar_mut(-mean);
        }
        let design = Design::new(inputs.to_vec(), places, nugget);
        let weights = design.factor.solve(&values);
        let squares = weights.component_mul(&values).row_sum().transpose();
        Self {
            rows,
            design,
            mean,
            weights: weights.transpose(),
            squares,
        }
    }

    /// What is predicted at a place.
    pub fn at(&self, place: &DVector<f64>) -> DVector<f64> {
        &self.mean + &self.weights * self.design.correlations(place)
    }

    /// Its derivatives by the shares that act on it, each with its index: ∂c/∂u = −5/(3 length²) (1 + a)
    /// e^(−a) (u − u_run).
    pub fn slopes(&self, place: &DVector<f64>) -> impl Iterator<Item = (usize, DVector<f64>)> {
        let Design { inputs, places, .. } = &self.design;
        let place = place.select_rows(inputs);
        let factors = DVector::from_fn(places.len(), |run, _| {
            let a = scaled_distance(&place, &places[run]);
            -5.0 / (3.0 * LENGTH * LENGTH) * (1.0 + a) * (-a).exp()
        });
        inputs.iter().enumerate().map(move |(k, &input)| {
            let near = |run: usize, _| factors[run] * (place[k] - places[run][k]);
            (input, &self.weights * DVector::from_fn(factors.len(), near))
        })
    }

    /// Variance of its error far from all runs, if the square of that of prediction k of all counts
    /// `weights[k]`. One run says nothing of it.
    pub fn scale(&self, weights: &[f64]) -> f64 {
        let squares = self.squares.iter().zip(&weights[self.rows.clone()]);
        let sum: f64 = squares.map(|(square, weight)| weight * square).sum();
        match self.design.places.len() {
            0 | 1 => UNKNOWN * UNKNOWN,
            // NaN propagates; `max` would hide it.
            runs => (sum / (runs - 1) as f64).clamp(0.0, f64::INFINITY),
        }
    }
}

/// Whether two places are one.
pub(crate) fn is_same(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    (a - b).amax() < SAME
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
        assert!(kriging.scale(&[1.0; 2]) > 0.0 && kriging.design.variance(&dvector![0.4, 0.6]) > 0.0);
        kriging.squares = dvector![-1e-20, 0.0];
        assert_eq!(kriging.scale(&[1.0; 2]), 0.0);
        kriging.squares = dvector![1.0, f64::NAN];
        assert!(kriging.scale(&[1.0; 2]).is_nan());
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
