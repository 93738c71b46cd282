//! One uniform layer at one wavenumber: how the impedance of what lies below becomes the impedance at its top.
//!
//! With u = (U, W) and t = (τ, `σ_z`)/m the transformed displacement and traction, everything below a level answers to
//! t = S u with a symmetric, negative definite *impedance* S. A layer of dimensionless thickness x = m h maps the S at its
//! bottom to the S at its top, and the displacement at its top to the one at its bottom. No single formula for that
//! map is accurate for every x:
//!
//! - **Thin, x ≤ 1**: the layer's propagator. The state (U, W, τ/m, σ/m) obeys y' = H y in x, where
//!   (H² − 1)² = 0, so that exp(−H x) = cosh x − sinh x · H + N (x sinh x)/2 − H N (x cosh x − sinh x)/2, N = H² − 1.
//!   Every entry is written out below without cancellation, so a plate of 2 mm keeps its bending stiffness (∝ x³) to
//!   full precision. The growing exponentials it contains are what makes this form useless for thick layers.
//! - **Thick, x > 1**: reflection. The solution is a part that decays downward and one that decays upward; the ratio R of
//!   the two at the bottom is carried to the top through decaying exponentials only, so that nothing overflows.
//!
//! Elimination of λ leaves only ν/(1 − ν), (1 − 2ν)/(1 − ν) and κ = 3 − 4ν ≥ 1: ν = 0.5 is no special case.
//!
//! References: D. M. Burmister, J. Appl. Phys. 16 (1945) 89–94; E. Kausel and J. M. Roësset, Bull. Seism. Soc. Am. 71 (1981)
//! 1743–1761, for the stiffness view of a layer.

use ground_field::Soil;

use crate::matrix::Matrix2;

/// Dimensionless thickness up to which the propagator is used.
const THIN: f64 = 1.0;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Lamina {
    pub thickness: f64,
    pub soil: Soil,
}

/// What a lamina does at one wavenumber.
///
/// The impedance is a quotient of matrices, traction over displacement. The rounding error of either is a share of the terms that were
/// added up.
pub(crate) struct Crossing {
    /// Impedance at the top.
    pub impedance: Matrix2,
    /// Displacement at the bottom for a displacement at the top.
    pub descent: Matrix2,
    /// Sums of the terms' absolute values.
    pub traction: Matrix2,
    pub displacement: Matrix2,
    /// Inverse of the denominator.
    pub inverse: Matrix2,
}

/// Impedance of what lies below: a matrix, or rock.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Support {
    Elastic(Matrix2),
    Rigid,
}

impl Lamina {
    /// κ = 3 − 4ν.
    fn kappa(&self) -> f64 {
        3.0 - 4.0 * self.soil.poisson_ratio()
    }

    /// Impedance of this soil without end below: what decays downward.
    pub fn downward_impedance(&self) -> Matrix2 {
        let kappa = self.kappa();
        let (own, across) = (-(1.0 + kappa), 1.0 - kappa);
        Matrix2::new(own, across, across, own) * (self.soil.shear_modulus() / kappa)
    }

    /// What decays downward, displacement to displacement over `x` = m·distance.
    pub fn downward_decay(&self, x: f64) -> Matrix2 {
        let s = x / self.kappa();
        Matrix2::new(1.0 - s, s, -s, 1.0 + s) * (-x).exp()
    }

    /// The lamina at `wavenumber` on `support`.
    pub fn cross(&self, wavenumber: f64, support: Support) -> Crossing {
        let x = wavenumber * self.thickness;
        if x <= THIN {
            self.cross_thin(x, support)
        } else {
            self.cross_thick(x, support)
        }
    }

    fn cross_thin(&self, x: f64, support: Support) -> Crossing {
        let (mu, nu) = (self.soil.shear_modulus(), self.soil.poisson_ratio());
        let g = 1.0 / (1.0 - nu);
        let nu_g = nu * g;
        let f = g / (2.0 * mu);
        let b = 2.0 * mu * g;
        // sinh and cosh from one e^x − 1, both without cancellation.
        let grown = x.exp_m1();
        let sh = 0.5 * (grown + grown / (1.0 + grown));
        let ch = 1.0 + 0.5 * grown * grown / (1.0 + grown);
        let p = 0.5 * x * sh;
        let q = half_x_cosh_minus_sinh(x);

        let diagonal_up = ch + g * p;
        let diagonal_down = ch - g * p;
        // y(top) = exp(−H x) y(bottom), in 2 × 2 blocks.
        let uu = Matrix2::new(diagonal_up, -(sh + g * q), nu_g * sh + g * q, diagonal_down);
        let ut = Matrix2::new(-(sh / mu + f * q), f * p, -f * p, f * (q - (1.0 - 2.0 * nu) * sh));
        let tu = Matrix2::new(-(sh + q), p, -p, q) * b;
        let tt = Matrix2::new(diagonal_up, -(nu_g * sh + g * q), sh + g * q, diagonal_down);
        match support {
            Support::Elastic(below) => {
                let descent = (uu + ut * below).inverse();
                Crossing {
                    impedance: (tu + tt * below) * descent,
                    descent,
                    traction: tu.abs() + tt.abs() * below.abs(),
                    displacement: uu.abs() + ut.abs() * below.abs(),
                    inverse: descent,
                }
            }
            Support::Rigid => {
                let inverse = ut.inverse();
                Crossing {
                    impedance: tt * inverse,
                    descent: Matrix2::IDENTITY * 0.0,
                    traction: tt.abs(),
                    displacement: ut.abs(),
                    inverse,
                }
            }
        }
    }

    fn cross_thick(&self, x: f64, support: Support) -> Crossing {
        let (downward, decay) = (self.downward_impedance(), self.downward_decay(x));
        // Upside down, horizontal displacement and vertical traction change their signs against the others.
        let upward = Matrix2::new(-downward.a, downward.b, downward.c, -downward.d);
        let upward_decay = Matrix2::new(decay.a, -decay.b, -decay.c, decay.d);
        let reflection = match support {
            Support::Elastic(below) => (upward - below).inverse() * (below - downward),
            Support::Rigid => Matrix2::IDENTITY * -1.0,
        };
        let returned = upward_decay * reflection * decay;
        let share = (Matrix2::IDENTITY + returned).inverse();
        Crossing {
            impedance: (downward + upward * returned) * share,
            descent: (Matrix2::IDENTITY + reflection) * decay * share,
            traction: downward.abs() + upward.abs() * returned.abs(),
            displacement: Matrix2::IDENTITY + returned.abs(),
            inverse: share,
        }
    }
}

/// (x cosh x − sinh x)/2 for 0 ≤ x ≤ 1 by its series Σ k x^(2k+1)/(2k+1)!, whose terms are all positive.
fn half_x_cosh_minus_sinh(x: f64) -> f64 {
    const RECIPROCALS: [f64; 8] = [
        1.0 / 6.0,
        1.0 / 60.0,
        1.0 / 1680.0,
        1.0 / 90720.0,
        1.0 / 7983360.0,
        1.0 / 1037836800.0,
        1.0 / 186810624000.0,
        1.0 / 44460928512000.0,
    ];
    let square = x * x;
    x * square * RECIPROCALS.iter().rev().fold(0.0, |sum, c| sum * square + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lamina(thickness: f64, poisson_ratio: f64) -> Lamina {
        let soil = Soil::new(1e8, poisson_ratio).expect("soil");
        Lamina { thickness, soil }
    }

    fn close(a: Matrix2, b: Matrix2, tolerance: f64) {
        let scale = a.a.abs() + a.b.abs() + a.c.abs() + a.d.abs();
        let gap = a - b;
        let gap = gap.a.abs() + gap.b.abs() + gap.c.abs() + gap.d.abs();
        assert!(gap <= tolerance * scale, "{a:?} {b:?}");
    }

    /// Any soil on itself is the half-space again, in both forms.
    #[test]
    fn own_half_space_is_a_fixed_point() {
        for poisson_ratio in [0.0, 0.3, 0.49, 0.5] {
            for x in [1e-9, 1e-4, 0.1, 0.7, 1.0, 1.1, 5.0, 50.0, 800.0] {
                let lamina = lamina(x, poisson_ratio);
                let own = lamina.downward_impedance();
                let crossing = lamina.cross(1.0, Support::Elastic(own));
                close(crossing.impedance, own, 1e-14);
                close(crossing.descent, lamina.downward_decay(x), 1e-14);
            }
        }
    }

    /// The two forms agree where both are accurate, on soft, equal, stiff and rigid support.
    #[test]
    fn both_forms_agree_at_moderate_thickness() {
        for poisson_ratio in [0.0, 0.35, 0.5] {
            let lamina = lamina(1.0, poisson_ratio);
            for contrast in [1e-4, 1.0, 1e4] {
                let soil = Soil::new(1e8 * contrast, 0.2).expect("soil");
                let support = Support::Elastic(Lamina { thickness: 1.0, soil }.downward_impedance());
                let thin = lamina.cross_thin(0.8, support);
                let thick = lamina.cross_thick(0.8, support);
                // The reflection form loses the contrast, which is why it is not used here.
                close(thin.impedance, thick.impedance, 1e-11);
                close(thin.descent, thick.descent, 1e-10);
            }
            let thin = lamina.cross_thin(0.8, Support::Rigid);
            let thick = lamina.cross_thick(0.8, Support::Rigid);
            close(thin.impedance, thick.impedance, 1e-13);
        }
    }

    #[test]
    fn series_of_the_bending_term() {
        for x in [0.3_f64, 0.6, 1.0] {
            let direct = 0.5 * (x * x.cosh() - x.sinh());
            assert!((half_x_cosh_minus_sinh(x) - direct).abs() < 1e-15);
        }
        assert!((half_x_cosh_minus_sinh(1e-6) * 6e18 - 1.0).abs() < 1e-12);
    }
}
