//! Complete elliptic integrals.
//!
//! With Δ = √(cos²θ + k_c² sin²θ) and all integrals from 0 to π/2:
//!
//! ```text
//! B = ∫ cos²θ/Δ dθ      D = ∫ sin²θ/Δ dθ      J = ∫ sin²θ/((cos²θ + p sin²θ) Δ) dθ
//! ```
//!
//! In Legendre's notation, with k² = 1 − k_c² and n = 1 − p: K = B + D, E = B + k_c² D, Π = K + n J. Unlike those three,
//! B, D and J are sums of positive terms that do not cancel against each other as k → 0.
//!
//! Method: repeated Landen (Gauss) transformation, R. Bulirsch, "Numerical calculation of elliptic integrals and
//! elliptic functions III", Numer. Math. 13 (1969) 305–315, procedure `cel`; here the three integrals share one sequence
//! of moduli. Convergence is quadratic: four to six steps, twelve at k_c = 1e-300.

use std::f64::consts::FRAC_PI_2;

/// The integrals B, D and J; see the [module](self).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Complete {
    pub b: f64,
    pub d: f64,
    pub j: f64,
}

/// Where two successive means agree to this, the next step would agree to its square.
const AGREEMENT: f64 = 1e-8;

/// Never reached: the means halve their logarithmic distance first, then converge quadratically.
const MAX_STEPS: usize = 40;

/// B, D and J for 0 < `kc` ≤ 1 and `p` > 0. For `p` = 0, where J is infinite, J is given as 0: its factor is then 0 too.
pub(crate) fn complete(kc: f64, p: f64) -> Complete {
    let mut arithmetic = 1.0;
    let mut geometric = kc;
    // Coefficients of cos² and sin² in each integral, carried through the transformations.
    let (mut b_cos, mut b_sin) = (1.0, 0.0);
    let (mut d_cos, mut d_sin) = (0.0, 1.0);
    let (mut j_cos, mut j_sin, mut root) = if p > 0.0 {
        let root = p.sqrt();
        (0.0, 1.0 / root, root)
    } else {
        (0.0, 0.0, 1.0)
    };
    for _ in 0..MAX_STEPS {
        let inverse = 1.0 / arithmetic;
        (b_cos, b_sin) = (b_cos + b_sin * inverse, 2.0 * (b_sin + b_cos * geometric));
        (d_cos, d_sin) = (d_cos + d_sin * inverse, 2.0 * (d_sin + d_cos * geometric));
        let product = geometric * arithmetic;
        let inverse_root = 1.0 / root;
        let quotient = product * inverse_root;
        (j_cos, j_sin) = (j_cos + j_sin * inverse_root, 2.0 * (j_sin + j_cos * quotient));
        root += quotient;
        let before = arithmetic;
        arithmetic += geometric;
        if (before - geometric).abs() <= AGREEMENT * before {
            break;
        }
        geometric = 2.0 * product.sqrt();
    }
    let common = FRAC_PI_2 / (2.0 * arithmetic * arithmetic);
    Complete {
        b: common * (b_sin + b_cos * arithmetic),
        d: common * (d_sin + d_cos * arithmetic),
        j: FRAC_PI_2 * (j_sin + j_cos * arithmetic) / (arithmetic * (arithmetic + root)),
    }
}

#[cfg(test)]
mod tests {
    use super::complete;
    use std::f64::consts::FRAC_PI_4;

    /// (k_c, p, B, D, J) from mpmath 1.3.0 (`ellipk`, `ellipe`, `ellippi`) at 60 digits, 700 for k_c = 1e-300;
    /// rounded to the nearest f64.
    #[rustfmt::skip]
    const MPMATH: [(f64, f64, f64, f64, f64); 18] = [
        (0.9, 0.7, 0.8055295128313704, 0.8490871546911566, 1.1077370262699333),
        (0.9, 0.01, 0.8055295128313704, 0.8490871546911566, 15.7860530189908),
        (0.9, 1e-30, 0.8055295128313704, 0.8490871546911566, 1745329251994327.8),
        (0.5, 0.7, 0.8959028209247316, 1.2606128265749117, 1.667746616196932),
        (0.5, 0.01, 0.8959028209247316, 1.2606128265749117, 27.244041184729618),
        (0.5, 1e-30, 0.8959028209247316, 1.2606128265749117, 3141592653589788.5),
        (0.1, 0.7, 0.9889264357528538, 2.706710927237021, 3.696519762282851),
        (0.1, 0.01, 0.9889264357528538, 2.706710927237021, 98.89264357528538),
        (0.1, 1e-30, 0.9889264357528538, 2.706710927237021, 15707963267948864.593),
        (1e-3, 0.7, 0.9999966029713114, 7.2940548606441284, 10.244288909608859),
        (1e-3, 0.01, 0.9999966029713114, 7.2940548606441284, 528.5988618905858),
        (1e-3, 1e-30, 0.9999966029713114, 7.2940548606441284, 1570796326793896615.3),
        (1e-8, 0.7, 0.9999999999999991, 18.806975105072258, 26.691315875970222),
        (1e-8, 0.01, 0.9999999999999991, 18.806975105072258, 1679.8672955217519),
        (1e-8, 1e-30, 0.9999999999999991, 18.806975105072258, 1.5707962267949046e23),
        (1e-300, 0.7, 1.0, 691.1618222593336, 987.1982403820579),
        (1e-300, 0.01, 1.0, 691.1618222593336, 68915.35201094788),
        (1e-300, 1e-30, 1.0, 691.1618222593336, 6.56929898683863e32),
    ];

    fn assert_close(value: f64, exact: f64, what: &str) {
        let error = (value / exact - 1.0).abs();
        assert!(
            error <= 4e-15,
            "{what}: {value} instead of {exact}, relative error {error:.1e}"
        );
    }

    #[test]
    fn agrees_with_mpmath() {
        for (kc, p, b, d, j) in MPMATH {
            let value = complete(kc, p);
            assert_close(value.b, b, &format!("B at kc = {kc}"));
            assert_close(value.d, d, &format!("D at kc = {kc}"));
            assert_close(value.j, j, &format!("J at kc = {kc}, p = {p}"));
        }
    }

    /// With k_c = 1 all three are elementary: B = D = π/4 and J = π/(2√p(1+√p)).
    #[test]
    fn circular_case() {
        for p in [1e-20, 1e-3, 0.4, 1.0] {
            let value = complete(1.0, p);
            assert_close(value.b, FRAC_PI_4, "B");
            assert_close(value.d, FRAC_PI_4, "D");
            assert_close(value.j, 2.0 * FRAC_PI_4 / (p.sqrt() * (1.0 + p.sqrt())), "J");
        }
    }

    /// D(k_c) = ln(4/k_c) − 1 + O(k_c² ln k_c): Abramowitz & Stegun 17.3.26 and 17.3.36.
    #[test]
    fn logarithmic_limit() {
        for kc in [1e-9, 1e-100, 1e-300, f64::MIN_POSITIVE] {
            let value = complete(kc, 0.0);
            assert_close(value.b, 1.0, "B");
            assert_close(value.d, 4.0_f64.ln() - kc.ln() - 1.0, "D");
            assert_eq!(value.j, 0.0);
        }
    }
}
