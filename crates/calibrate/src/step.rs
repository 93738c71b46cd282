//! One step of Levenberg–Marquardt, and what its success says about the next.
//!
//! A step solves (H + λ diag H) Δz = −g with g = Jᵀ(w ∘ r) and H = Jᵀ diag(w) J. λ falls when the deviance falls as predicted and rises
//! when it does not (J. J. Moré, "The Levenberg–Marquardt algorithm", 1978; K. Madsen, H. B. Nielsen, O. Tingleff, Methods for Non-Linear
//! Least Squares Problems, 2004, section 3.2).

use nalgebra::{DMatrix, DVector};

use crate::deviance::information;
use crate::parameter::FARTHEST;
use crate::point::Point;

/// Least and largest λ. In a narrow valley λ must fall far: with 0.01 at least, one of the closed forms of the tests takes 1080 runs
/// instead of 170. Beyond the largest no step lowers the deviance.
const DAMPING: (f64, f64) = (1e-9, 1e4);
/// λ after a failure at least: less of it would only repeat the step, and with 0.01 a fit of the tests takes 123 runs instead of 108.
const FELT: f64 = 0.03;
/// Factor by which λ falls and rises; J. J. Moré and K. Madsen name 2 to 10.
const FACTOR: f64 = 8.0;
/// Shares of the predicted gain: below the first λ rises, above the second it falls; usual values are 0.25 and 0.75.
const GAINS: (f64, f64) = (0.1, 0.5);
/// Added to the diagonal of H: as much as knowing a free variable to ±4, so that one of which the data know nothing, whose slopes are
/// noise, stays about where it is. Beside the information in data that determine a parameter it is nothing.
const RIDGE: f64 = 1.0 / 16.0;
/// Longest step of a free variable, a third of the way from the middle of a range to its bound, and so far as J holds at all.
pub(crate) const LONGEST_STEP: f64 = 2.0;

/// The deviance to second order around a point.
pub(crate) struct Quadratic {
    free: DVector<f64>,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
    /// Whether a step may move each variable.
    moves: Vec<bool>,
}

/// A step and by how much it should lower the deviance.
pub(crate) struct Step {
    pub change: DVector<f64>,
    pub gain: f64,
}

impl Quadratic {
    /// Around `point`, where the residuals have these weights and derivatives; variable `held` stays where it is, as do those that are
    /// pressed against a bound.
    pub fn new(point: &Point, weights: &DVector<f64>, jacobian: &DMatrix<f64>, held: Option<usize>) -> Self {
        let gradient = jacobian.tr_mul(&weights.component_mul(&point.residuals));
        let pressed = |k: usize| gradient[k] * point.free[k] < 0.0 && point.free[k].abs() >= FARTHEST;
        Self {
            moves: (0..gradient.len())
                .map(|k| Some(k) != held && !pressed(k))
                .collect(),
            free: point.free.clone(),
            information: information(jacobian, weights),
            gradient,
        }
    }

    /// The step at damping λ; nothing where H is singular for it.
    pub fn step(&self, damping: f64) -> Option<Step> {
        let (mut matrix, mut downhill) = (self.information.clone(), -&self.gradient);
        for (k, &moves) in self.moves.iter().enumerate() {
            if moves {
                // Where the slopes vanish while the deviance bends, damping acts on the ridge alone.
                matrix[(k, k)] = (1.0 + damping) * (matrix[(k, k)] + RIDGE);
            } else {
                matrix.fill_row(k, 0.0);
                matrix.fill_column(k, 0.0);
                (matrix[(k, k)], downhill[k]) = (1.0, 0.0);
            }
        }
        let solved = matrix.cholesky()?.solve(&downhill);
        let change = self.free.zip_map(&solved, |free, solved| {
            let moved = free + solved.clamp(-LONGEST_STEP, LONGEST_STEP);
            moved.clamp(-FARTHEST, FARTHEST) - free
        });
        let gain = -2.0 * self.gradient.dot(&change) - change.dot(&(&self.information * &change));
        Some(Step { change, gain })
    }

    /// Length of the undamped step in standard errors, √(gᵀH⁻¹g) (D. M. Bates, D. G. Watts, "A relative offset orthogonality convergence
    /// criterion", Technometrics 23, 1981).
    pub fn offset(&self) -> f64 {
        // So little damping keeps a nearly singular H positive definite whatever the rounding.
        self.step(1e-9)
            .map_or(f64::INFINITY, |step| step.gain.max(0.0).sqrt())
    }
}

/// λ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Damping(f64);

impl Damping {
    /// Where a descent begins.
    pub const FIRST: Self = Self(1e-3);

    pub fn value(self) -> f64 {
        self.0
    }

    /// After a step that brought this share of the gain that was predicted; the answer is whether that is less than J promised.
    pub fn judge(&mut self, share: f64) -> bool {
        let poor = share.is_nan() || share < GAINS.0;
        if poor {
            self.0 = (FACTOR * self.0).max(FELT);
        } else if share > GAINS.1 {
            self.0 = (self.0 / FACTOR).max(DAMPING.0);
        }
        poor
    }

    /// Whether so short a step did not help either.
    pub fn is_spent(self) -> bool {
        self.0 > DAMPING.1
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{dmatrix, dvector};

    use super::{Damping, FACTOR, FELT, Quadratic};
    use crate::point::Point;

    fn line(held: Option<usize>, free: [f64; 2]) -> Quadratic {
        let point = Point {
            free: dvector![free[0], free[1]],
            residuals: dvector![10.0, 20.0],
        };
        Quadratic::new(
            &point,
            &dvector![1.0, 1.0],
            &dmatrix![-10.0, 0.0; 0.0, 20.0],
            held,
        )
    }

    /// Undamped, the step leads to the minimum of a straight model, and its length is that of the residuals.
    #[test]
    fn a_straight_model_takes_one_step() {
        let quadratic = line(None, [0.0, 0.0]);
        let step = quadratic.step(0.0).unwrap();
        assert!((step.change[0] - 1.0).abs() < 1e-3 && (step.change[1] + 1.0).abs() < 1e-3);
        assert!((quadratic.offset() - 500.0_f64.sqrt()).abs() < 1e-3);
        assert!(quadratic.step(100.0).unwrap().change.amax() < 0.01);
    }

    /// What is held or pressed against a bound stays.
    #[test]
    fn what_may_not_move_stays() {
        assert_eq!(line(Some(0), [0.0, 0.0]).step(0.0).unwrap().change[0], 0.0);
        assert_eq!(line(None, [7.0, 0.0]).step(0.0).unwrap().change[0], 0.0);
    }

    #[test]
    fn damping_follows_the_gain() {
        let mut damping = Damping::FIRST;
        let mut at = |share| {
            let poor = damping.judge(share);
            (poor, damping.value())
        };
        assert_eq!(at(-1.0), (true, FELT));
        assert_eq!(at(0.3), (false, FELT));
        assert_eq!(at(0.9), (false, FELT / FACTOR));
        while !damping.is_spent() {
            damping.judge(f64::NAN);
        }
    }
}
