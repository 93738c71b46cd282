//! Displacement of one point of the ground.

use std::ops::{Add, AddAssign, Mul, Sub};

/// Displacement of a material point of the ground under a vertical surface load, in cylindrical components about the
/// load's axis \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Displacement {
    /// Horizontal component, positive outward, away from the load's axis \[m\].
    pub radial: f64,
    /// Vertical component, positive downward \[m\].
    pub vertical: f64,
}

impl Displacement {
    /// No displacement.
    pub const ZERO: Self = Self {
        radial: 0.0,
        vertical: 0.0,
    };

    /// Both components changed by `f`.
    #[must_use]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        self.zip(self, |value, _| f(value))
    }

    /// Both components joined with those of `other` by `f`.
    #[must_use]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            radial: f(self.radial, other.radial),
            vertical: f(self.vertical, other.vertical),
        }
    }

    /// Whether both components are finite numbers.
    pub fn is_finite(self) -> bool {
        self.radial.is_finite() && self.vertical.is_finite()
    }
}

impl Add for Displacement {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |one, other| one + other)
    }
}

impl AddAssign for Displacement {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Displacement {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Displacement {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.map(|value| value * factor)
    }
}
