//! Real 2 × 2 matrices and vectors: displacement and traction of one wavenumber have two components each.

use std::ops::{Add, Mul, Sub};

/// The matrix `[[a, b], [c, d]]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Matrix2 {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub d: f64,
}

impl Matrix2 {
    pub const IDENTITY: Self = Self::new(1.0, 0.0, 0.0, 1.0);

    pub const fn new(a: f64, b: f64, c: f64, d: f64) -> Self {
        Self { a, b, c, d }
    }

    /// Absolute values, entry by entry.
    pub fn abs(self) -> Self {
        Self::new(self.a.abs(), self.b.abs(), self.c.abs(), self.d.abs())
    }

    pub fn transposed(self) -> Self {
        Self::new(self.a, self.c, self.b, self.d)
    }

    /// Inverse; not finite if the matrix is singular, which the caller's check of the result catches.
    pub fn inverse(self) -> Self {
        let scale = 1.0 / (self.a * self.d - self.b * self.c);
        Self::new(self.d, -self.b, -self.c, self.a) * scale
    }
}

impl Add for Matrix2 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.a + o.a, self.b + o.b, self.c + o.c, self.d + o.d)
    }
}

impl Sub for Matrix2 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.a - o.a, self.b - o.b, self.c - o.c, self.d - o.d)
    }
}

impl Mul for Matrix2 {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(
            self.a * o.a + self.b * o.c,
            self.a * o.b + self.b * o.d,
            self.c * o.a + self.d * o.c,
            self.c * o.b + self.d * o.d,
        )
    }
}

impl Mul<f64> for Matrix2 {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self::new(self.a * s, self.b * s, self.c * s, self.d * s)
    }
}
