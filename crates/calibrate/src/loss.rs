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
    /// Tukey's biweight: constant beyond this many sigmas, so that what lies there does not count at all. It
    /// is not convex, and the fit begins with Huber's loss, which is.
    Tukey {
        /// Where it turns constant, in sigmas.
        threshold: f64,
    },
}

impl Loss {
    /// Tukey's loss at its usual constant.
    pub const TUKEY: Self = Self::Tukey { threshold: 4.685 };

    pub(crate) fn rho(self) -> Rho {
        match self {
            Self::Squares => Rho::Squares,
            Self::Tukey { threshold } => Rho::Tukey { threshold },
        }
    }

    pub(crate) fn threshold(self) -> Option<f64> {
        match self {
            Self::Squares => None,
            Self::Tukey { threshold } => Some(threshold),
        }
    }
}

/// The loss of one descent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rho {
    Squares,
    /// Huber's: quadratic up to 1.345 sigmas, then linear. Convex, it has no minima of its own making and
    /// leads to Tukey's.
    Huber,
    Tukey {
        threshold: f64,
    },
}

/// Sigmas at which Huber's loss turns linear.
const HUBER: f64 = 1.345;

impl Rho {
    /// ρ(u).
    pub fn value(self, u: f64) -> f64 {
        match self {
            Self::Huber if u.abs() > HUBER => HUBER * (u.abs() - 0.5 * HUBER),
            Self::Squares | Self::Huber => 0.5 * u * u,
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
            Self::Huber => HUBER / u.abs().max(HUBER),
            Self::Tukey { threshold } => (1.0 - (u / threshold).powi(2)).max(0.0).powi(2),
        }
    }

    /// ψ′(u).
    pub fn curvature(self, u: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => f64::from(u8::from(u.abs() <= HUBER)),
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
}
