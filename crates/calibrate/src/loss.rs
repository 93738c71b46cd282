//! How much a residual counts.
//!
//! A loss ρ(u) of the standardised residual u, its slope ψ = ρ′, and the weight ψ/u. Least squares is
//! ρ = u²/2. Tukey's loss levels off beyond a few sigmas, so that outliers do not draw the fit to
//! themselves (P. J. Huber, Robust Statistics, 1981, chapters 4 and 7).

/// A loss.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Loss {
    /// u²/2: best under Gaussian noise, misled by outliers.
    #[default]
    Squares,
    /// Tukey's biweight: constant beyond this many sigmas, so that what lies there does not count at all.
    Tukey {
        /// Where it turns constant, in sigmas.
        threshold: f64,
    },
}

impl Loss {
    /// Tukey's loss, 95 % as efficient as least squares under Gaussian noise.
    pub const TUKEY: Self = Self::Tukey { threshold: 4.685 };

    /// 2 ρ(u).
    pub(crate) fn doubled(self, u: f64) -> f64 {
        match self {
            Self::Squares => u * u,
            Self::Tukey { threshold } => {
                let left = (1.0 - (u / threshold).powi(2)).max(0.0);
                threshold * threshold / 3.0 * (1.0 - left.powi(3))
            }
        }
    }

    /// ψ(u)/u.
    pub(crate) fn weight(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Tukey { threshold } => (1.0 - (u / threshold).powi(2)).max(0.0).powi(2),
        }
    }

    /// ψ′(u).
    pub(crate) fn curvature(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Tukey { threshold } => {
                let square = (u / threshold).powi(2);
                (1.0 - square).max(0.0) * (1.0 - 5.0 * square)
            }
        }
    }

    /// Whether it needs a scale of the noise that outliers do not blow up.
    pub(crate) fn is_robust(self) -> bool {
        self != Self::Squares
    }
}
