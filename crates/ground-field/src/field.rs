//! The trait every ground model implements.

use std::sync::Arc;

use crate::{Displacement, GroundError, SurfaceLoad};

/// A model of the ground: the displacement it shows under one vertical surface load.
///
/// The displacement (u_r, u_z) at (r, z) is axisymmetric about the load's axis and linear in its force P: u(P) = P u(1). Several loads
/// superpose, which is how [`DuctMotion`](crate::DuctMotion) is made of wheels. Implementations answer for every finite
/// `radius ≥ 0` and `depth ≥ 0`, or return an error; they never return a value that is not finite.
///
/// # Example
///
/// A ground model of one's own, a Winkler-like bowl that has no horizontal motion:
///
/// ```
/// use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};
///
/// struct Bowl;
///
/// impl GroundField for Bowl {
///     fn displacement(&self, load: SurfaceLoad, radius: f64, _depth: f64) -> Result<Displacement, GroundError> {
///         Ok(Displacement { radial: 0.0, vertical: 1e-9 * load.force() * (-radius * radius).exp() })
///     }
/// }
///
/// let bowl: Box<dyn GroundField> = Box::new(Bowl);
/// let load = SurfaceLoad::point(1e5)?;
/// assert_eq!(bowl.displacement(load, 0.0, 1.2)?.vertical, 1e-4);
/// # Ok::<(), GroundError>(())
/// ```
pub trait GroundField: Send + Sync {
    /// Displacement at horizontal distance `radius` \[m\] from the load's axis and `depth` \[m\] below the surface.
    ///
    /// # Errors
    ///
    /// [`GroundError`] when an argument is out of range, the point is singular, or the model cannot reach its accuracy.
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError>;

    /// Displacements at many distances and one depth, in the order of `radii`.
    ///
    /// Models that can share work among the radii override this; the answers are the same.
    ///
    /// # Errors
    ///
    /// As for [`GroundField::displacement`].
    fn displacements(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<Vec<Displacement>, GroundError> {
        radii
            .iter()
            .map(|&radius| self.displacement(load, radius, depth))
            .collect()
    }
}

macro_rules! forward_to_inner {
    ($($pointer:ty),+) => {$(
        impl<G: GroundField + ?Sized> GroundField for $pointer {
            fn displacement(
                &self,
                load: SurfaceLoad,
                radius: f64,
                depth: f64,
            ) -> Result<Displacement, GroundError> {
                (**self).displacement(load, radius, depth)
            }

            fn displacements(
                &self,
                load: SurfaceLoad,
                radii: &[f64],
                depth: f64,
            ) -> Result<Vec<Displacement>, GroundError> {
                (**self).displacements(load, radii, depth)
            }
        }
    )+};
}

forward_to_inner!(&G, Box<G>, Arc<G>);
