//! What is left of the layered field once the known closed forms are taken away.
//!
//! Subtracted are half-spaces under the same load, each in a depth of its own ("images"):
//!
//! - the **base soil** in the equivalent depth of N. Odemark's rule (1949), z + Σ hᵢ ((Gᵢ/`G_b`)^{1/3} − 1): it has the layered field's
//!   limit for m → 0, so the remainder fades faster than the field itself at far points;
//! - where the point lies in the upper two thirds of the uppermost soil, **that soil** in its true depth: it has the
//!   limit for m → ∞, so the remainder decays with exp(−m (2h − z)) instead of exp(−m z), which at the surface is
//!   not at all; and the same soil with opposite sign in depth 2h − z, which restores the limit for m → 0.
//!
//! Any choice of images gives the same sum; only the remainder's length and size depend on it.

use ground_field::{Displacement, GroundError, SurfaceLoad};

use crate::bessel::disc_factor;
use crate::image::{Bounded, Image};
use crate::lamina::Lamina;
use crate::stack::{Ground, Stack};

/// Layered field minus images, at one depth, under one load.
#[derive(Debug, Clone)]
pub(crate) struct Remainder {
    stack: Stack,
    images: Vec<Image>,
    contact_radius: f64,
    /// The transform decays like exp(−m · `decay_length`).
    pub decay_length: f64,
    /// The ground is one soil: there is no remainder.
    pub vanishes: bool,
    /// See [`Remainder::hidden`].
    longest_length: f64,
    bound: f64,
}

impl Remainder {
    pub fn new(ground: &Ground, contact_radius: f64, depth: f64) -> Self {
        let mut images = Vec::with_capacity(3);
        let mut decay_length = depth;
        let shallow = |top: &Lamina| !ground.laminae.is_empty() && depth < top.thickness * (2.0 / 3.0);
        if let Some(top) = ground.top().filter(shallow) {
            decay_length = 2.0 * top.thickness - depth;
            images.push(Image::new(1.0, top.soil, depth));
            images.push(Image::new(-1.0, top.soil, decay_length.max(contact_radius)));
        }
        if let Some(base) = &ground.base {
            let shift = |lamina: &Lamina| {
                let stiffer = lamina.soil.shear_modulus() / base.soil.shear_modulus();
                lamina.thickness * (stiffer.cbrt() - 1.0)
            };
            let shift: f64 = ground.laminae.iter().map(shift).sum();
            images.push(Image::new(1.0, base.soil, (depth + shift).max(decay_length)));
        }
        Self {
            stack: ground.cut(depth),
            bound: ground.compliance() * (1 + images.len()) as f64,
            longest_length: ground.longest_length(),
            images,
            contact_radius,
            decay_length,
            vanishes: ground.laminae.is_empty(),
        }
    }

    /// Transform of the remainder for a load of 2π: the integrand of `u_r` with J1(mr), and that of `u_z` with J0(mr).
    pub fn sample(&self, wavenumber: f64) -> Displacement {
        let images = self.images.iter().map(|image| image.transform(wavenumber));
        let rest = images.fold(self.stack.transform(wavenumber), |rest, image| rest - image);
        rest * disc_factor(wavenumber * self.contact_radius)
    }

    /// Estimated rounding error of [`Remainder::sample`].
    pub fn rounding(&self, wavenumber: f64) -> Displacement {
        let images = self.images.iter().map(|image| image.transform(wavenumber));
        let sum = images.fold(self.stack.rounding(wavenumber), |sum, image| {
            sum + image.map(f64::abs) * (2.0 * f64::EPSILON)
        });
        sum * disc_factor(wavenumber * self.contact_radius).abs()
    }

    /// Bound of what samples between 0 and `wavenumber` may have missed of the integral there. What a deep base does lies below the inverse
    /// of its depth, too close to 0 for any sample of a longer interval; beyond, the bound of the transform itself is all that is known.
    pub fn hidden(&self, wavenumber: f64) -> f64 {
        if wavenumber * self.longest_length <= 1.0 {
            0.0
        } else {
            wavenumber * self.bound
        }
    }

    /// Transform of the layered field itself, for a point load of 2π.
    pub fn field(&self, wavenumber: f64) -> Displacement {
        self.stack.transform(wavenumber)
    }

    /// Displacement of the images under `load`, and its rounding error.
    ///
    /// # Errors
    ///
    /// [`GroundError::Singular`] if it has no finite value.
    pub fn closed_form(&self, load: SurfaceLoad, radius: f64) -> Result<Bounded, GroundError> {
        let (mut sum, mut rounding) = (Displacement::ZERO, Displacement::ZERO);
        for image in &self.images {
            let (part, error) = image.displacement(load, radius)?;
            sum += part;
            rounding += error;
        }
        Ok((sum, rounding))
    }
}
