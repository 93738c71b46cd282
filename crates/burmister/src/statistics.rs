//! What an evaluation cost.

/// Work and error estimate of one call.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Statistics {
    /// Wavenumbers at which the layered system was solved, shared by all radii.
    pub wavenumbers: usize,
    /// Evaluations of the pair (J0, J1) in the transforms.
    pub bessel_pairs: usize,
    /// Largest estimated error over the radii, radial or vertical, as a share of the peak at this depth.
    pub estimated_error: f64,
}
