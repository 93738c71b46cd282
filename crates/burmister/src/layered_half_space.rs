//! The ground model: a layered half-space with its accuracy.

use ground_field::{Displacement, GroundError, GroundField, SoilProfile, SurfaceLoad, check_place, checked};

use crate::remainder::Remainder;
use crate::stack::Ground;
use crate::statistics::Statistics;
use crate::transform::Transform;

/// Error, as a share of the peak displacement at the same depth, that is met unless another one is asked.
pub const DEFAULT_ACCURACY: f64 = 1e-8;

/// Bonded, isotropic, linear elastic layers on a half-space or on rock, solved exactly up to quadrature (Burmister's problem).
///
/// # Method
///
/// 1. **Per wavenumber** U and W follow from the impedance (traction over displacement), carried layer by layer from the base to the
///    surface and back to the depth, without growing exponentials and without cancellation in thin layers.
/// 2. **Closed form first**: half-spaces with known fields are subtracted, chosen so that the remainder vanishes for m → 0 and
///    decays fast for m → ∞; far points keep their relative accuracy, and the surface needs no slowly converging integral.
/// 3. **Panels**: the remainder is represented by Chebyshev series on intervals that halve themselves until they suffice, a few
///    hundred wavenumbers whatever the number of radii.
/// 4. **Per radius** each panel is integrated against the Bessel functions by a Gauss rule whose size follows from an error bound,
///    or, where they turn often, by Levin's method at a cost that does not depend on the radius.
/// 5. **The error** is added up from all of these, with rounding, and compared with the peak.
///
/// # Accuracy
///
/// The [`accuracy`](Self::accuracy) is a share of the peak over the radius of |`u_r`| (for `u_r`) and |`u_z`| (for `u_z`) at the depth of the
/// point: `u_r` changes its sign with r, so an error relative to its value has no meaning. What cannot be had is
/// [`GroundError::Accuracy`], never a worse value. The error sum is dominated by bounds: the true error is usually a hundred times
/// smaller. Far to the side, where next to nothing moves, the accuracy is a larger share of what is left.
///
/// What is [`GroundError::Unsupported`] is a modulus that varies; a point load's own point is [`GroundError::Singular`]. Limits, references and
/// an example stand on the front page of the crate.
#[derive(Debug, Clone)]
pub struct LayeredHalfSpace {
    ground: Ground,
    accuracy: f64,
}

impl LayeredHalfSpace {
    /// The layered half-space of `profile`, with the [`DEFAULT_ACCURACY`].
    ///
    /// # Errors
    ///
    /// [`GroundError::Unsupported`] if a layer's modulus varies with depth.
    pub fn new(profile: &SoilProfile) -> Result<Self, GroundError> {
        Ok(Self {
            ground: Ground::new(profile)?,
            accuracy: DEFAULT_ACCURACY,
        })
    }

    /// The same ground, with every value met to `accuracy`, a share of the peak displacement at its depth.
    ///
    /// Double precision ends near 1e-12 for usual grounds; what is asked beyond is answered with
    /// [`GroundError::Accuracy`].
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless it lies between 1e-15 and 0.1.
    pub fn with_accuracy(mut self, accuracy: f64) -> Result<Self, GroundError> {
        let is_possible = |accuracy| (1e-15..=0.1).contains(&accuracy);
        self.accuracy = checked("accuracy", accuracy, "between 1e-15 and 0.1", is_possible)?;
        Ok(self)
    }

    /// The accuracy that is met, as a share of the peak displacement at the same depth.
    pub fn accuracy(&self) -> f64 {
        self.accuracy
    }

    /// Displacements at many `radii` \[m\] and one `depth` \[m\], in the order of the radii, with what they cost.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless radii and depth are finite and not negative; [`GroundError::Singular`] at a
    /// point load; [`GroundError::Accuracy`] if the accuracy is not reached.
    pub fn displacements_with_statistics(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<(Vec<Displacement>, Statistics), GroundError> {
        for &radius in radii.iter().chain(&[0.0]) {
            check_place(radius, depth)?;
        }
        if self.ground.base.is_none() && depth >= self.ground.base_depth() {
            return Ok((vec![Displacement::ZERO; radii.len()], Statistics::default()));
        }
        let remainder = Remainder::new(&self.ground, load.contact_radius(), depth);
        Transform {
            remainder: &remainder,
            load,
            depth,
            accuracy: self.accuracy,
            probes: self.probes(load, depth),
        }
        .run(radii)
    }

    /// Radii that find the peaks: powers of 3 from half the depth (or contact radius, or a tenth of the top layer) up to
    /// several hundred times it, past the bending length of any stiff plate; the edge of the disc, where all of a soft skin's
    /// motion is; and the axis, unless it is singular.
    fn probes(&self, load: SurfaceLoad, depth: f64) -> Vec<f64> {
        let scale = depth.max(load.contact_radius());
        let start = match self.ground.top() {
            _ if scale > 0.0 => 0.5 * scale,
            Some(top) => 0.1 * top.thickness,
            None => 1.0,
        };
        let axis = (scale > 0.0).then_some(0.0);
        let edge = (!load.is_point()).then_some(load.contact_radius());
        let spread = (0..7).map(|k| start * 3_f64.powi(k));
        axis.into_iter().chain(edge).chain(spread).collect()
    }
}

impl GroundField for LayeredHalfSpace {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        Ok(self.displacements(load, &[radius], depth)?[0])
    }

    fn displacements(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<Vec<Displacement>, GroundError> {
        Ok(self.displacements_with_statistics(load, radii, depth)?.0)
    }
}
