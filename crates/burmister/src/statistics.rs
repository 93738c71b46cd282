//! What an evaluation cost.

/// Work and error estimate of one call.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Statistics {
    /// Wavenumbers at which the layered system was solved, shared by all radii.
    pub wavenumbers: usize,
    /// Panels of the wavenumber axis.
    pub panels: usize,
    /// Evaluations of the pair (J0, J1) in the transforms.
    pub bessel_pairs: usize,
    /// Largest estimated error over the radii, as a share of the peak displacement at this depth; the larger of the
    /// radial and the vertical one.
    pub estimated_error: f64,
}
