//! The ground seen from one depth: laminae between the surface and the depth, laminae below it, and the base.
//!
//! Neighbouring layers of one soil are joined first, so that splitting a layer changes neither the answer nor the cost.

use ground_field::{Base, Displacement, GroundError, SoilProfile};

use crate::MODEL;
use crate::lamina::{Lamina, Support};
use crate::matrix::Matrix2;

/// Layers of distinct soils from the surface down, and what lies below.
#[derive(Debug, Clone)]
pub(crate) struct Ground {
    pub laminae: Vec<Lamina>,
    pub base: Option<Lamina>,
}

impl Ground {
    /// The ground of `profile`.
    ///
    /// # Errors
    ///
    /// [`GroundError::Unsupported`] for a modulus that varies within a layer.
    pub fn new(profile: &SoilProfile) -> Result<Self, GroundError> {
        let mut laminae: Vec<Lamina> = Vec::new();
        for layer in profile.layers() {
            let soil = layer.soil().ok_or(GroundError::Unsupported {
                model: MODEL,
                limit: "every layer must have a uniform modulus",
            })?;
            match laminae.last_mut() {
                Some(last) if last.soil == soil => last.thickness += layer.thickness(),
                _ => laminae.push(Lamina {
                    thickness: layer.thickness(),
                    soil,
                }),
            }
        }
        let base = match profile.base() {
            Base::Rigid => None,
            Base::HalfSpace(soil) => {
                while laminae.last().is_some_and(|last| last.soil == soil) {
                    laminae.pop();
                }
                // The base has no bottom; its thickness is not used.
                let thickness = f64::INFINITY;
                Some(Lamina { thickness, soil })
            }
        };
        Ok(Self { laminae, base })
    }

    /// Depth of the base.
    pub fn base_depth(&self) -> f64 {
        self.laminae.iter().map(|lamina| lamina.thickness).sum()
    }

    fn shear_moduli(&self) -> impl Iterator<Item = f64> {
        let soils = self.laminae.iter().chain(&self.base);
        soils.map(|lamina| lamina.soil.shear_modulus())
    }

    /// Largest shear compliance 1/G of any soil. No wave of a unit pressure moves any depth further than this over its wavenumber: a
    /// stiffer ground moves less, and a half-space of the softest soil moves its surface by (1 − ν)/G, ν ≥ 0.
    pub fn compliance(&self) -> f64 {
        1.0 / self.shear_moduli().fold(f64::INFINITY, f64::min)
    }

    /// A length \[m\] that no length of the ground exceeds: at wavenumbers m below its inverse the base is seen alone, with smooth
    /// corrections in powers of m.
    ///
    /// A stiff layer on a soft base is a plate up to h (`G`/`G_b`)^{1/3} and a membrane up to h `G`/`G_b`; between soft layers, or with one on
    /// rock, it shears them up to h (`G`/`G_s`)^{1/2}.
    pub fn longest_length(&self) -> f64 {
        let softest = self.shear_moduli().fold(f64::INFINITY, f64::min);
        let stiffest = self.shear_moduli().fold(0.0, f64::max);
        let base = self.base.map_or(stiffest, |base| base.soil.shear_modulus());
        self.base_depth() * (stiffest / base).max((stiffest / softest).sqrt())
    }

    /// The uppermost soil; infinitely thick if there is no other.
    pub fn top(&self) -> Option<Lamina> {
        self.laminae.first().copied().or(self.base)
    }

    /// The ground cut at `depth`.
    pub fn cut(&self, depth: f64) -> Stack {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut left = depth;
        for &Lamina { thickness, soil } in &self.laminae {
            let upper = left.clamp(0.0, thickness);
            left -= upper;
            let lower = thickness - upper;
            for (part, thickness) in [(&mut above, upper), (&mut below, lower)] {
                part.extend((thickness > 0.0).then_some(Lamina { thickness, soil }));
            }
        }
        above.reverse();
        below.reverse();
        Stack {
            below,
            above,
            base: self.base,
            beneath_base: left.max(0.0),
        }
    }
}

/// The ground cut at a depth; both lists run from the bottom up.
#[derive(Debug, Clone)]
pub(crate) struct Stack {
    below: Vec<Lamina>,
    above: Vec<Lamina>,
    base: Option<Lamina>,
    /// Distance of the depth below the top of the base, 0 if it lies above.
    beneath_base: f64,
}

impl Stack {
    /// m times the transform of (`u_r`, `u_z`) at the depth under a unit surface pressure \[1/Pa\], at `wavenumber` > 0.
    pub fn transform(&self, wavenumber: f64) -> Displacement {
        let (mut support, mut descent) = self.bottom(wavenumber);
        for lamina in &self.below {
            support = Support::Elastic(lamina.cross(wavenumber, support).impedance);
        }
        for lamina in &self.above {
            let crossing = lamina.cross(wavenumber, support);
            support = Support::Elastic(crossing.impedance);
            descent = descent * crossing.descent;
        }
        match support {
            // The surface carries no shear and a unit pressure: S u = (0, −1).
            Support::Elastic(surface) => {
                let response = descent * surface.inverse();
                Displacement {
                    radial: -response.b,
                    vertical: -response.d,
                }
            }
            Support::Rigid => Displacement::ZERO,
        }
    }

    /// Estimated rounding error of [`Stack::transform`].
    ///
    /// Each crossing rounds a quotient P Q⁻¹ by ε (|P| + |S| |Q|) |Q⁻¹|, with the sizes of the terms that make up P and Q, and
    /// carries the error δS of what lies below to the top as Dᵀ δS D, D the descent (exact to first order, S being the second
    /// derivative of an energy). A stiff plate on a soft ground is where this grows: its bending stiffness is a small
    /// difference of large membrane terms.
    pub fn rounding(&self, wavenumber: f64) -> Displacement {
        let (mut support, mut descent) = self.bottom(wavenumber);
        let mut error = match support {
            Support::Elastic(impedance) => impedance.abs() * f64::EPSILON,
            Support::Rigid => Matrix2::IDENTITY * 0.0,
        };
        let mut descent_error = descent.abs() * f64::EPSILON;
        let below = self.below.iter().map(|lamina| (lamina, false));
        for (lamina, passed) in below.chain(self.above.iter().map(|lamina| (lamina, true))) {
            let crossing = lamina.cross(wavenumber, support);
            let inverse = crossing.inverse.abs();
            let down = crossing.descent.abs();
            let rounded = crossing.traction + crossing.impedance.abs() * crossing.displacement;
            error = rounded * inverse * f64::EPSILON + down.transposed() * error * down;
            if passed {
                descent_error = descent_error * down
                    + descent.abs() * down * crossing.displacement * inverse * f64::EPSILON;
                descent = descent * crossing.descent;
            }
            support = Support::Elastic(crossing.impedance);
        }
        let Support::Elastic(surface) = support else {
            return Displacement::ZERO;
        };
        let compliance = surface.inverse().abs();
        let response = (descent.abs() * compliance * error + descent_error) * compliance;
        Displacement {
            radial: response.b,
            vertical: response.d,
        }
    }

    /// Impedance of the base and descent from its top to the depth.
    fn bottom(&self, wavenumber: f64) -> (Support, Matrix2) {
        match &self.base {
            Some(base) => (
                Support::Elastic(base.downward_impedance()),
                base.downward_decay(wavenumber * self.beneath_base),
            ),
            None => (Support::Rigid, Matrix2::IDENTITY),
        }
    }
}
