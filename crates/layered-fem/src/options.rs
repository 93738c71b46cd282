//! What is asked of the solver, and what it reports about itself.

use ground_field::{GroundError, checked};

use crate::system::LEAST_CHANGE;

/// Accuracy and limits of a [`crate::LayeredFem`].
///
/// ```
/// use layered_fem::FemOptions;
///
/// let options = FemOptions::new(1e-3)?.with_max_unknowns(200_000);
/// assert_eq!(options.accuracy(), 1e-3);
/// assert!(FemOptions::new(1e-9).is_err());
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FemOptions {
    accuracy: f64,
    max_unknowns: usize,
}

impl FemOptions {
    /// Unknowns allowed unless [`FemOptions::with_max_unknowns`] says otherwise: within a gigabyte and a few seconds.
    pub const DEFAULT_MAX_UNKNOWNS: usize = 500_000;

    /// Options for an error of at most `accuracy`, as a share of the largest |`u_r`| and of the largest |`u_z`| at the depth
    /// asked for. (The largest |`u_r`| counts as at least a hundredth of the largest |`u_z`|.)
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless it lies between 1e-6 and 0.1.
    pub fn new(accuracy: f64) -> Result<Self, GroundError> {
        Ok(Self {
            accuracy: checked("accuracy", accuracy, "between 1e-6 and 0.1", |v| {
                (1e-6..=0.1).contains(&v)
            })?,
            max_unknowns: Self::DEFAULT_MAX_UNKNOWNS,
        })
    }

    /// Most unknowns that can be allowed: some hundred gigabytes.
    pub const MOST_UNKNOWNS: usize = 50_000_000;

    /// The same with another limit on the unknowns of one mesh, [`MOST_UNKNOWNS`](Self::MOST_UNKNOWNS) at most.
    /// Where the accuracy would need more, the answer is [`GroundError::Accuracy`].
    #[must_use]
    pub fn with_max_unknowns(mut self, max_unknowns: usize) -> Self {
        self.max_unknowns = max_unknowns.min(Self::MOST_UNKNOWNS);
        self
    }

    /// Asked error, as a share of the peak at a depth.
    pub fn accuracy(self) -> f64 {
        self.accuracy
    }

    /// How much of a solution a last correction may still change: rounding, a thousandth of the accuracy. Where λ is large beside a
    /// stiff layer rounding is felt long before it matters.
    pub(crate) fn rounding(self) -> f64 {
        (1e-3 * self.accuracy).max(LEAST_CHANGE)
    }

    /// Most unknowns a mesh may have.
    pub fn max_unknowns(self) -> usize {
        self.max_unknowns
    }
}

/// Estimated error of a displacement at one depth, from the difference between two meshes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ErrorEstimate {
    /// Largest error of `u_r` over all radii, as a share of the largest |`u_r`| at this depth.
    pub radial: f64,
    /// Largest error of `u_z` over all radii, as a share of the largest |`u_z`| at this depth.
    pub vertical: f64,
    /// Radius \[m\] at which the larger of the two occurs.
    pub radius: f64,
}

impl ErrorEstimate {
    /// The larger of the two shares.
    pub fn largest(self) -> f64 {
        // A NaN must not hide behind a number.
        if self.radial.is_nan() {
            self.radial
        } else {
            self.vertical.max(self.radial)
        }
    }
}

/// What a [`crate::LayeredFem`] has done so far and what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct FemStatistics {
    /// Unknowns of the finest mesh.
    pub unknowns: usize,
    /// Entries of its Cholesky factor.
    pub factor_entries: usize,
    /// Meshes factored since construction.
    pub factorisations: usize,
    /// Loads solved on the meshes that are held.
    pub solves: usize,
    /// Bytes held by the meshes, their matrices, factors and solutions.
    pub bytes: usize,
}
