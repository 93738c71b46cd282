//! The error of an answer.

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
