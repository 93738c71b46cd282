//! tanh without branches or calls, so that the compiler can take several nodes at once.
//!
//! tanh |x| = −E/(2 + E) with E = e^(−2|x|) − 1, which loses nothing near zero. The exponential is reduced to |r| ≤ ln 2/2
//! by a power of two, and its Taylor series there is cut at r¹³/13!, below rounding.

/// 1.5·2⁵²: added to a small number it leaves the nearest integer in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Hyperbolic tangent to about 2e-16 relative; ±1 for |x| ≥ 20, and for NaN.
#[inline]
pub(super) fn tanh(x: f64) -> f64 {
    let t = -2.0 * x.abs().min(20.0);
    let shifted = t * std::f64::consts::LOG2_E + ROUNDER;
    let n = shifted - ROUNDER;
    let scale = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    let r = (t - n * LN_2_HIGH) - n * LN_2_LOW;
    let mut series = 1.0 / 6_227_020_800.0;
    for coefficient in [
        1.0 / 479_001_600.0,
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
    ] {
        series = series * r + coefficient;
    }
    let e = scale * (series * r) + (scale - 1.0);
    (-e / (2.0 + e)).copysign(x)
}

#[cfg(test)]
mod tests {
    #[test]
    fn agrees_with_the_standard_library() {
        let mut x = 1e-300;
        while x < 1e3 {
            for x in [x, -x] {
                let (found, expected) = (super::tanh(x), x.tanh());
                assert!(
                    (found - expected).abs() <= 6e-16 * expected.abs(),
                    "{x}: {found} {expected}"
                );
            }
            x *= 1.003;
        }
        assert_eq!(super::tanh(0.0), 0.0);
        assert_eq!(super::tanh(f64::NEG_INFINITY), -1.0);
    }
}
