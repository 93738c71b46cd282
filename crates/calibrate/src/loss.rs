//! How much a residual counts.
//!
//! A loss ρ(u) of the standardised residual u, its slope ψ = ρ′, and the weight ψ/u. Least squares is ρ = u²/2. The
//! others grow more slowly beyond a few sigmas, so that outliers do not draw the fit to themselves (P. J. Huber, Robust
//! Statistics, 1981, chapters 4 and 7). Their constants make them 95 % as efficient as least squares under Gaussian noise.

/// A loss.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Loss {
    /// u²/2: best under Gaussian noise, misled by outliers.
    #[default]
    Squares,
    /// Quadratic up to this many sigmas, then linear. Convex: it has no minima of its own making.
    Huber {
        /// Where it turns linear, in sigmas.
        threshold: f64,
    },
    /// Tukey's biweight: constant beyond this many sigmas, so that what lies there does not count at all. Fits with
    /// Huber's loss first, as it is not convex.
    Tukey {
        /// Where it turns constant, in sigmas.
        threshold: f64,
    },
}

impl Loss {
    /// Huber's loss at its usual constant.
    pub const HUBER: Self = Self::Huber { threshold: 1.345 };
    /// Tukey's loss at its usual constant.
    pub const TUKEY: Self = Self::Tukey { threshold: 4.685 };

    /// ρ(u).
    pub fn value(self, u: f64) -> f64 {
        match self {
            Self::Squares => 0.5 * u * u,
            Self::Huber { threshold } if u.abs() <= threshold => 0.5 * u * u,
            Self::Huber { threshold } => threshold * (u.abs() - 0.5 * threshold),
            Self::Tukey { threshold } => {
                let left = (1.0 - (u / threshold).powi(2)).max(0.0);
                threshold * threshold / 6.0 * (1.0 - left.powi(3))
            }
        }
    }

    /// ψ(u)/u.
    pub fn weight(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber { threshold } => threshold / u.abs().max(threshold),
            Self::Tukey { threshold } => (1.0 - (u / threshold).powi(2)).max(0.0).powi(2),
        }
    }

    /// ψ′(u).
    pub fn curvature(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber { threshold } => f64::from(u8::from(u.abs() <= threshold)),
            Self::Tukey { threshold } => {
                let square = (u / threshold).powi(2);
                (1.0 - square).max(0.0) * (1.0 - 5.0 * square)
            }
        }
    }

    /// Whether it needs a scale of the noise that outliers do not blow up.
    pub fn is_robust(self) -> bool {
        self != Self::Squares
    }

    pub(crate) fn threshold(self) -> Option<f64> {
        match self {
            Self::Squares => None,
            Self::Huber { threshold } | Self::Tukey { threshold } => Some(threshold),
        }
    }
}
