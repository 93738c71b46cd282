//! How large the discrepancy is, and what that leaves open of the parameters.
//!
//! The size's likelihood is that of the residuals with the parameters integrated out, linearised at the optimum (H. D. Patterson, R. Thompson,
//! "Recovery of inter-block information when block sizes are unequal", Biometrika 58, 1971): with the whitened J and r and
//! A = JᵀJ,
//!
//! −2 ln L(λ) = Σ ln(1 + λ²s²) + ln det A + rᵀr − (Jᵀr)ᵀ A⁻¹ Jᵀr,
//!
//! where the noise is known; else its last terms R become ν ln R. The best size makes the fit. How far its intervals reach follows from all sizes:
//! each says where a parameter is and how exactly, as a distribution of Student's or Gauss's, and an interval is as wide as the
//! average of these distributions by the sizes' probabilities (J. O. Berger, B. Liseo, R. L. Wolpert, "Integrated likelihood
//! methods for eliminating nuisance parameters", Statistical Science 14, 1999).

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::Calibration;
use crate::descent::Optimum;
use crate::estimate::{Estimate, Interval};
use crate::uncertainty::Covariance;
use crate::whitening::Whitening;

/// Least and largest λ, in units in which its largest variance is that of the noise: below there is no discrepancy, above no noise.
const RATIOS: (f64, f64) = (1e-2, 1e5);
/// Sizes that are looked at, ten in each power of ten.
const SIZES: usize = 71;
/// Added to the diagonal of A: as much as knowing a free variable to ±4, as in a step of the descent.
const RIDGE: f64 = 1.0 / 16.0;
/// Rise of −2 ln L from which readings exclude a size: 95 % of χ² with one degree of freedom.
const EXCLUDED: f64 = 3.84;

/// What one size would mean.
#[derive(Debug, Clone)]
struct Size {
    /// λ and δ.
    ratio: f64,
    deviation: f64,
    /// −2 ln L, without and with the prior.
    data: f64,
    total: f64,
    /// Where it would move the free variables, and their standard errors.
    change: DVector<f64>,
    errors: DVector<f64>,
    /// Its probability.
    weight: f64,
}

/// Normal equations of the linearised fit, of which those for any λ follow.
struct Equations {
    /// JᵀJ, Jᵀr and rᵀr of the data without whitening, and the same of the priors.
    information: DMatrix<f64>,
    gradient: DVector<f64>,
    square: f64,
    priors: (DMatrix<f64>, DVector<f64>, f64),
    /// J and r along the singular vectors.
    along: (DMatrix<f64>, DVector<f64>),
    /// σ².
    noise: f64,
}

impl Equations {
    fn new(calibration: &Calibration<'_>, whitening: &Whitening, optimum: &Optimum) -> Self {
        let data = optimum.deviance.data;
        let mut jacobian = optimum.jacobian.clone();
        for k in 0..jacobian.ncols() {
            let mut column = jacobian.column(k).into_owned();
            whitening.undo(&mut column);
            jacobian.set_column(k, &column);
        }
        let mut residuals = optimum.point.residuals.clone();
        whitening.undo(&mut residuals);
        let split = |matrix: &DMatrix<f64>| {
            let rows = matrix.nrows() - data;
            (
                matrix.rows(0, data).into_owned(),
                matrix.rows(data, rows).into_owned(),
            )
        };
        let (of_data, of_priors) = split(&jacobian);
        let (off, off_priors) = (
            residuals.rows(0, data).into_owned(),
            residuals.rows(data, residuals.len() - data).into_owned(),
        );
        let mut known = of_priors.tr_mul(&of_priors);
        for k in 0..known.nrows() {
            known[(k, k)] += RIDGE;
        }
        Self {
            information: of_data.tr_mul(&of_data),
            gradient: of_data.tr_mul(&off),
            square: off.norm_squared(),
            priors: (known, of_priors.tr_mul(&off_priors), off_priors.norm_squared()),
            along: (whitening.vectors.tr_mul(&of_data), whitening.vectors.tr_mul(&off)),
            noise: if calibration.knows_noise {
                1.0
            } else {
                optimum.deviance.normalisation.recip()
            },
        }
    }

    /// What λ would mean; nothing where the equations are singular.
    fn size(
        &self,
        whitening: &Whitening,
        ratio: f64,
        sigma: f64,
        freedom: Option<f64>,
        least: f64,
    ) -> Option<Size> {
        let shares = whitening.shares(ratio);
        let (jacobian, residuals) = &self.along;
        let mut taken = jacobian.clone();
        for (mut row, share) in taken.row_iter_mut().zip(shares.iter()) {
            row *= *share;
        }
        let (known, pull, off) = &self.priors;
        let information = &self.information - jacobian.tr_mul(&taken) + known * self.noise;
        let gradient = &self.gradient - taken.tr_mul(residuals) + pull * self.noise;
        let square = self.square - residuals.component_mul(residuals).dot(&shares) + off * self.noise;
        let solved = information.cholesky()?;
        let change = -solved.solve(&gradient);
        let left = (square + gradient.dot(&change)).max(0.0);
        let determinants: f64 = shares.iter().map(|share| -(1.0 - share).ln()).sum::<f64>()
            + 2.0
                * solved
                    .l_dirty()
                    .diagonal()
                    .iter()
                    .map(|entry| entry.ln())
                    .sum::<f64>();
        let (fits, noise) = match freedom {
            Some(freedom) => {
                let noise = (left / freedom).max(least * least);
                (freedom * noise.ln(), noise)
            }
            None => (left, 1.0),
        };
        let (data, deviation) = (determinants + fits, ratio * noise.sqrt());
        Some(Size {
            ratio,
            deviation,
            data,
            total: data + (deviation / sigma).powi(2) - 2.0 * deviation.ln(),
            errors: (solved.inverse() * noise).diagonal().map(f64::sqrt),
            change,
            weight: 0.0,
        })
    }
}

/// All sizes.
#[derive(Debug, Clone)]
pub(crate) struct Sizes {
    list: Vec<Size>,
    /// Degrees of freedom of the noise, where it is estimated.
    freedom: Option<f64>,
}

impl Sizes {
    /// Around `optimum`; nothing without a discrepancy, or where its prior is so small that even the least size is too large.
    pub fn of(calibration: &Calibration<'_>, optimum: &Optimum, freedom: f64) -> Option<Self> {
        let (discrepancy, whitening) = (calibration.discrepancy.as_ref()?, calibration.whitening.as_ref()?);
        let equations = Equations::new(calibration, whitening, optimum);
        let largest = whitening.variances.iter().copied().fold(0.0, f64::max).sqrt();
        let freedom = (!calibration.knows_noise).then_some(freedom.max(1.0));
        let least = calibration.least_noise();
        let size = |index: usize| {
            let share = index as f64 / (SIZES - 1) as f64;
            let ratio = RATIOS.0 * (RATIOS.1 / RATIOS.0).powf(share) / largest;
            equations.size(whitening, ratio, discrepancy.sigma, freedom, least)
        };
        let list = (0..SIZES).filter_map(size);
        let mut list: Vec<Size> = list.filter(|size| size.total.is_finite()).collect();
        let best = list.iter().map(|size| size.total).fold(f64::INFINITY, f64::min);
        for size in &mut list {
            size.weight = (-0.5 * (size.total - best)).exp();
        }
        let sum: f64 = list.iter().map(|size| size.weight).sum();
        for size in &mut list {
            size.weight /= sum;
        }
        let sizes = Self { list, freedom };
        (sizes.best() > 0).then_some(sizes)
    }

    /// Index of the most likely size.
    fn best(&self) -> usize {
        let likely = |a: &usize, b: &usize| self.list[*a].total.total_cmp(&self.list[*b].total);
        (0..self.list.len()).min_by(likely).unwrap_or(0)
    }

    /// The most likely λ and δ, between sizes by a parabola.
    fn most_likely(&self) -> (f64, f64) {
        let best = self.best();
        let here = &self.list[best];
        let shift = match (
            best.checked_sub(1).map(|k| &self.list[k]),
            self.list.get(best + 1),
        ) {
            (Some(before), Some(after)) => {
                let bend = before.total - 2.0 * here.total + after.total;
                if bend > 0.0 {
                    0.5 * (before.total - after.total) / bend
                } else {
                    0.0
                }
            }
            _ => 0.0,
        };
        let neighbour = if shift < 0.0 {
            best.saturating_sub(1)
        } else {
            (best + 1).min(self.list.len() - 1)
        };
        let between = |value: fn(&Size) -> f64| {
            value(here) * (value(&self.list[neighbour]) / value(here)).powf(shift.abs())
        };
        (between(|size| size.ratio), between(|size| size.deviation))
    }

    /// The most likely λ.
    pub fn ratio(&self) -> f64 {
        self.most_likely().0
    }

    /// The distance from the estimate of variable `k`, in its standard errors, that is exceeded with probability `tail`.
    pub fn quantile(&self, k: usize, tail: f64, covariance: &Covariance) -> Option<f64> {
        let own = covariance.standard_error(k).filter(|error| *error > 0.0)?;
        let below = |u: f64| match self.freedom {
            Some(freedom) => StudentsT::new(0.0, 1.0, freedom.min(1e6)).map_or(0.5, |student| student.cdf(u)),
            None => Normal::standard().cdf(u),
        };
        let beyond = |distance: f64| {
            let one = |size: &Size| {
                let (centre, scale) = (size.change[k] / own, size.errors[k] / own);
                size.weight * (below((-distance - centre) / scale) + below((centre - distance) / scale))
            };
            self.list
                .iter()
                .filter(|size| size.weight > 1e-6)
                .map(one)
                .sum::<f64>()
        };
        let (mut inner, mut outer) = (0.0, 1.0);
        while beyond(outer) > tail && outer < 1e6 {
            outer *= 2.0;
        }
        for _ in 0..40 {
            let middle = 0.5 * (inner + outer);
            if beyond(middle) > tail {
                inner = middle;
            } else {
                outer = middle;
            }
        }
        Some(outer)
    }

    /// δ as a parameter; an end is open where the readings, or with them the prior, do not exclude what lies beyond.
    pub fn estimate(&self, tail: f64) -> Estimate {
        let least = self
            .list
            .iter()
            .map(|size| size.data)
            .fold(f64::INFINITY, f64::min);
        let total = self.list[self.best()].total;
        let excluded = |size: Option<&Size>| {
            size.is_some_and(|size| size.data > least + EXCLUDED && size.total > total + EXCLUDED)
        };
        // Each size stands for those around it, evenly spread in the logarithm.
        let step = (RATIOS.1 / RATIOS.0).powf(1.0 / (SIZES - 1) as f64);
        let at = |share: f64| {
            let mut sum = 0.0;
            for size in &self.list {
                if sum + size.weight >= share {
                    return size.deviation * step.powf((share - sum) / size.weight - 0.5);
                }
                sum += size.weight;
            }
            f64::INFINITY
        };
        let mean: f64 = self.list.iter().map(|size| size.weight * size.deviation).sum();
        let square: f64 = self
            .list
            .iter()
            .map(|size| size.weight * (size.deviation - mean).powi(2))
            .sum();
        let value = self.most_likely().1;
        // The most likely size of a skewed distribution may lie beyond its quantiles.
        let interval = Interval {
            lower: excluded(self.list.first()).then(|| at(0.5 * tail).min(value)),
            upper: excluded(self.list.last()).then(|| at(1.0 - 0.5 * tail).max(value)),
        };
        Estimate {
            name: "discrepancy".into(),
            value,
            standard_error: Some(square.sqrt()),
            interval,
            identifiable: interval.is_closed(),
            profile: self
                .list
                .iter()
                .map(|size| (size.deviation, size.total - total))
                .collect(),
        }
    }
}
