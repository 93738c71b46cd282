//! Numbers of twice the precision: the unevaluated sum of two `f64`, good for 31 digits.
//!
//! T. J. Dekker, Numer. Math. 18 (1971) 224–242; D. E. Knuth, The Art of Computer Programming 2, 4.2.2.

use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    pub fn value(self) -> f64 {
        self.high
    }

    fn of_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }

    /// e^self for self ≤ 0, by Taylor's series of self/2^k and k squarings.
    pub fn exp(self) -> Self {
        if self == Self::ZERO {
            return Self::ONE;
        }
        if self.high < -700.0 {
            return Self::ZERO;
        }
        let mut halvings = 0;
        let mut x = self;
        while x.high.abs() > 0.02 {
            x = x * Self::from(0.5);
            halvings += 1;
        }
        // Horner's rule for 13!/0! + 13!/1! x + … + x¹³, whole numbers, and one division.
        let (mut sum, mut factorial) = (Self::ONE, 1.0);
        for k in (1..=13).rev() {
            factorial *= f64::from(k);
            sum = sum * x + Self::from(factorial);
        }
        let series = sum / Self::from(factorial);
        (0..halvings).fold(series, |power, _| power * power)
    }
}

impl From<f64> for Double {
    fn from(value: f64) -> Self {
        let low = 0.0;
        Self { high: value, low }
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let two_sum = |a: f64, b: f64| {
            let sum = a + b;
            let part = sum - a;
            (sum, (a - (sum - part)) + (b - part))
        };
        let (high, error) = two_sum(self.high, other.high);
        let (low, lost) = two_sum(self.low, other.low);
        let sum = Self::of_sum(high, error + low);
        Self::of_sum(sum.high, sum.low + lost)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.high * other.high;
        let error = self.high.mul_add(other.high, -product);
        Self::of_sum(product, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        Self::of_sum(first, second) + Self::from(rest.high / other.high)
    }
}

#[test]
fn thirty_digits_are_kept() {
    let third = Double::ONE / Double::from(3.0);
    let nothing = third + third + third - Double::ONE;
    assert!(nothing.high.abs() < 1e-31);
    // e^−1 · e^−2 = e^−3, and the known digits of 1/e: 0.367879441171442321595523770161460867…
    let e = |x: f64| Double::from(x).exp();
    assert!((e(-1.0) * e(-2.0) / e(-3.0) - Double::ONE).high.abs() < 1e-30);
    let known = Double {
        high: 0.367_879_441_171_442_33,
        low: -1.242_875_367_278_836_3e-17,
    };
    assert!((e(-1.0) - known).high.abs() < 1e-30, "{:?}", e(-1.0));
}
