//! J0 and J1 together.
//!
//! Every quadrature node needs both. Below [`ASYMPTOTIC`] they come from `libm`. Above it Hankel's asymptotic series
//! (Abramowitz & Stegun 9.2.5–9.2.10) shares one sine, one cosine and one square root between the two, and is
//! three times faster; its first neglected term is below 2e-16 there.

/// Argument from which the asymptotic series has full precision.
const ASYMPTOTIC: f64 = 32.0;

/// Coefficients `a_k`(ν) = Π (4ν² − (2j−1)²) / (k! 8^k) with the signs of the series for P (even k), then for Q (odd k).
const fn hankel(order: f64) -> [[f64; 7]; 2] {
    let mut series = [[0.0; 7]; 2];
    let mut coefficient = 1.0;
    let mut k = 0;
    while k < 14 {
        let sign = if (k / 2) % 2 == 0 { 1.0 } else { -1.0 };
        series[k % 2][k / 2] = sign * coefficient;
        k += 1;
        let odd_number = 2.0 * k as f64 - 1.0;
        coefficient *= (4.0 * order * order - odd_number * odd_number) / (8.0 * k as f64);
    }
    series
}

const ORDER_0: [[f64; 7]; 2] = hankel(0.0);
const ORDER_1: [[f64; 7]; 2] = hankel(1.0);

/// (J0(x), J1(x)) for x ≥ 0.
#[inline]
pub(crate) fn j0_j1(x: f64) -> (f64, f64) {
    if x < ASYMPTOTIC {
        return (libm::j0(x), libm::j1(x));
    }
    let inverse = 1.0 / x;
    let square = inverse * inverse;
    let series = |c: &[f64; 7]| {
        c[0] + square
            * (c[1] + square * (c[2] + square * (c[3] + square * (c[4] + square * (c[5] + square * c[6])))))
    };
    let (sine, cosine) = x.sin_cos();
    let (sum, difference) = (sine + cosine, sine - cosine);
    let amplitude = (inverse * std::f64::consts::FRAC_1_PI).sqrt();
    (
        amplitude * (series(&ORDER_0[0]) * sum - inverse * series(&ORDER_0[1]) * difference),
        amplitude * (series(&ORDER_1[0]) * difference + inverse * series(&ORDER_1[1]) * sum),
    )
}

/// Transform of a uniform disc of radius a, over that of the point load: 2 J1(x)/x with x = m a.
pub(crate) fn disc_factor(x: f64) -> f64 {
    if x < 1e-4 {
        1.0 - x * x / 8.0
    } else {
        2.0 * j0_j1(x).1 / x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_libm_everywhere() {
        let mut x = 0.0;
        while x < 3000.0 {
            let (j0, j1) = j0_j1(x);
            assert!((j0 - libm::j0(x)).abs() < 3e-16, "J0({x})");
            assert!((j1 - libm::j1(x)).abs() < 3e-16, "J1({x})");
            x += 0.0371;
        }
    }

    #[test]
    fn disc_factor_is_continuous_and_one_at_zero() {
        assert_eq!(disc_factor(0.0), 1.0);
        assert!((disc_factor(0.99999e-4) - disc_factor(1.00001e-4)).abs() < 1e-13);
    }
}
