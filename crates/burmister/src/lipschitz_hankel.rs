//! The integrals of Lipschitz and Hankel for a uniform disc, I(μ, ν; λ) = ∫ Jμ(ma) Jν(mr) e^{−mz} m^λ dm.
//!
//! With ρ² = a² + r² − 2ar cos φ and R² = ρ² + z², Neumann's addition theorem turns those with λ = 0 into means over the angle φ
//! between load and field point:
//!
//! ```text
//! I(0,0;0) = ⟨1/R⟩,   I(1,1;0) = ⟨cos φ/R⟩,   I(1,0;0) = ⟨(a − r cos φ)/ρ² · (1 − z/R)⟩
//! ```
//!
//! which are complete elliptic integrals (substitute φ = π − 2θ). The integrals with λ = −1 follow by Euler's theorem, because
//! a I(1,0;−1) is homogeneous of degree 1 in (a, r, z) and I(1,1;−1) of degree 0:
//!
//! ```text
//! I(1,0;−1) = a I(0,0;0) − r I(1,1;0) − z I(1,0;0)
//! 2 I(1,1;−1) = a I(0,1;0) + r I(1,0;0) − z I(1,1;0)
//! ```
//!
//! This holds inside, outside and under the edge of the disc. The integrals: G. Eason, B. Noble and I. N. Sneddon,
//! Phil. Trans. R. Soc. A 247 (1955) 529–551.

use std::f64::consts::FRAC_1_PI;

use crate::elliptic::complete;

/// The four integrals a displacement needs.
pub(crate) struct LipschitzHankel {
    /// z I(1,1;0)
    pub z_i110: f64,
    /// z I(1,0;0)
    pub z_i100: f64,
    /// I(1,1;−1)
    pub i11_minus_1: f64,
    /// I(1,0;−1)
    pub i10_minus_1: f64,
}

/// The integrals for a disc of radius `a` > 0 at distance `r` ≥ 0 and depth `z` ≥ 0.
pub(crate) fn lipschitz_hankel(a: f64, r: f64, z: f64) -> LipschitzHankel {
    let sum = a + r;
    let far = sum.hypot(z);
    let modulus = (a - r).hypot(z) / far;
    let scale = 2.0 * FRAC_1_PI / far;
    let split = (a - r) / sum;

    // a I(0,0;0) − r I(1,1;0); finite under the edge of the disc too.
    let near = scale * complete(modulus, 1.0, sum, a - r);
    // ⟨(1 − z/R)(a − r cos φ)/ρ²⟩ and the same with a and r exchanged.
    let (step_a, step_r) = match r.total_cmp(&a) {
        std::cmp::Ordering::Less => (1.0 / a, 0.0),
        std::cmp::Ordering::Equal => (0.5 / a, 0.5 / a),
        std::cmp::Ordering::Greater => (0.0, 1.0 / r),
    };
    let (i100, i010, i110) = if z == 0.0 {
        (step_a, step_r, 0.0)
    } else {
        // p is (split)²; under the edge its limit p → 0 with b → 0 leaves the first integral only.
        let p = (split * split).max(f64::MIN_POSITIVE);
        let shadow = |s: f64| {
            scale * z / sum
                * if split == 0.0 {
                    complete(modulus, 1.0, 1.0, 1.0)
                } else {
                    complete(modulus, p, 1.0, s)
                }
        };
        (
            step_a - shadow(split),
            step_r - shadow(-split),
            scale * complete(modulus, 1.0, -1.0, 1.0),
        )
    };
    LipschitzHankel {
        z_i110: z * i110,
        z_i100: z * i100,
        i11_minus_1: 0.5 * (a * i010 + r * i100 - z * i110),
        i10_minus_1: near - z * i100,
    }
}
