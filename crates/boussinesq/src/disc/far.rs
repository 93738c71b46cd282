//! The disc's integrals far from it: multipoles.
//!
//! The disc's Hankel transform, expanded in the wavenumber m,
//!
//! ```text
//! 2 J₁(ma)/(ma) = Σ_k (−1)^k (ma/2)^{2k} / (k! (k+1)!)
//! ```
//!
//! turns every term into a Legendre polynomial by ∫ m^n e^{−mz} J₀(mr) dm = n! P_n(c)/R^{n+1} and
//! ∫ m^n e^{−mz} J₁(mr) dm = (n−1)! s P_n'(c)/R^{n+1} (s/(1+c)/R for n = 0), with c = z/R and s = r/R. With R as the length
//! and β_0 = 1, β_k = −β_{k−1} (2k−1)/(2k+2):
//!
//! ```text
//! shear_radial     = s c Σ β_k (a/R)^{2k} P'_{2k+1}(c)
//! surface_radial   = s/(1+c) + s Σ_{k≥1} β_k (a/R)^{2k} P'_{2k}(c)/(2k)
//! shear_vertical   = c Σ β_k (a/R)^{2k} (2k+1) P_{2k+1}(c)
//! surface_vertical = Σ β_k (a/R)^{2k} P_{2k}(c)
//! ```
//!
//! The first term is the point load. The terms fall as (a/R)^{2k}; the largest, P'_{2k+1}(c) ≤ (k+1)(2k+1) with
//! |β_k| < k^{−3/2}, by less than 2√k beyond that.

use crate::shape::Shape;

/// Terms below this are left out.
const NEGLIGIBLE: f64 = 1e-17;

/// Enough for R ≥ 4a, where (1/16)^14 is below the bound.
const MAX_TERMS: usize = 16;

/// Factors of one term's step, all of them known beforehand.
struct Step {
    /// β_k/β_{k−1}.
    beta: f64,
    /// (2n−1)/n and (n−1)/n for n = 2k, then for n = 2k+1: P_n = first · c P_{n−1} − second · P_{n−2}.
    even: (f64, f64),
    odd: (f64, f64),
    /// 2k.
    twice: f64,
    /// 1/(2k).
    half: f64,
}

const STEPS: [Step; MAX_TERMS] = steps();

const fn steps() -> [Step; MAX_TERMS] {
    const FIRST: Step = Step {
        beta: 1.0,
        even: (0.0, 0.0),
        odd: (0.0, 0.0),
        twice: 0.0,
        half: 0.0,
    };
    let mut table = [FIRST; MAX_TERMS];
    let mut k = 1;
    while k < MAX_TERMS {
        let n = 2.0 * k as f64;
        table[k] = Step {
            beta: -(n - 1.0) / (n + 2.0),
            even: ((2.0 * n - 1.0) / n, (n - 1.0) / n),
            odd: ((2.0 * n + 1.0) / (n + 1.0), n / (n + 1.0)),
            twice: n,
            half: 1.0 / n,
        };
        k += 1;
    }
    table
}

/// The integrals at a point `distance` ≥ 4 `contact_radius` from the disc's centre, with `distance` as their length.
pub(super) fn shape(radius: f64, depth: f64, distance: f64, contact_radius: f64) -> Shape {
    let sine = radius / distance;
    let cosine = depth / distance;
    let ratio = contact_radius / distance;
    let square = ratio * ratio;
    // Legendre polynomials and derivatives of degrees 2k and 2k+1.
    let (mut even, mut odd) = (1.0, cosine);
    let (mut even_slope, mut odd_slope) = (0.0, 1.0);
    let mut factor = 1.0;
    let mut power = 1.0;
    let mut sum = Shape {
        shear_radial: 1.0,
        surface_radial: 1.0 / (1.0 + cosine),
        shear_vertical: cosine,
        surface_vertical: 1.0,
    };
    for step in &STEPS[1..] {
        power *= square;
        if power < NEGLIGIBLE {
            break;
        }
        factor *= step.beta * square;
        even_slope += (2.0 * step.twice - 1.0) * odd;
        even = step.even.0 * cosine * odd - step.even.1 * even;
        odd_slope += (2.0 * step.twice + 1.0) * even;
        odd = step.odd.0 * cosine * even - step.odd.1 * odd;
        sum.shear_radial += factor * odd_slope;
        sum.surface_radial += factor * step.half * even_slope;
        sum.shear_vertical += factor * (step.twice + 1.0) * odd;
        sum.surface_vertical += factor * even;
    }
    Shape {
        shear_radial: sine * cosine * sum.shear_radial,
        surface_radial: sine * sum.surface_radial,
        shear_vertical: cosine * sum.shear_vertical,
        surface_vertical: sum.surface_vertical,
    }
}
