//! How much a residual counts.
//!
//! A loss ρ(u) of the standardised residual u, its slope ψ = ρ′, and the weight ψ/u. Least squares is
//! ρ = u²/2. Tukey's loss levels off beyond a few sigmas, so that outliers do not draw the fit to
//! themselves (P. J. Huber, Robust Statistics, 1981, chapters 4 and 7).

/// Where Tukey's loss turns constant, in sigmas: with this it is 95 % as efficient as least squares under
/// Gaussian noise.
const THRESHOLD: f64 = 4.685;

/// A loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Loss {
    /// u²/2: best under Gaussian noise, misled by outliers.
    #[default]
    Squares,
    /// Tukey's biweight: constant beyond 4.685 sigmas, so that what lies there does not count at all.
    Tukey,
}

impl Loss {
    /// 2 ρ(u).
    pub(crate) fn doubled(self, u: f64) -> f64 {
        match self {
            Self::Squares => u * u,
            Self::Tukey => THRESHOLD * THRESHOLD / 3.0 * (1.0 - weight_root(u).powi(3)),
        }
    }

    /// ψ(u)/u.
    pub(crate) fn weight(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Tukey => weight_root(u).powi(2),
        }
    }

    /// ψ′(u).
    pub(crate) fn curvature(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Tukey => weight_root(u) * (1.0 - 5.0 * (u / THRESHOLD).powi(2)),
        }
    }

    /// Whether it needs a scale of the noise that outliers do not blow up.
    pub(crate) fn is_robust(self) -> bool {
        self != Self::Squares
    }
}

/// 1 − (u/threshold)², as long as it is positive.
fn weight_root(u: f64) -> f64 {
    (1.0 - (u / THRESHOLD).powi(2)).max(0.0)
}
