//! A part of the chain.

use std::ops::RangeInclusive;

/// The nodes lo..=hi, one at least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// The first node.
    pub lo: usize,
    /// The last node.
    pub hi: usize,
}

impl Stretch {
    /// Its nodes.
    pub fn nodes(self) -> RangeInclusive<usize> {
        self.lo..=self.hi
    }

    /// How many they are.
    pub fn count(self) -> usize {
        self.hi + 1 - self.lo
    }

    /// The shortest one that holds both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// Its part of the `values` of all nodes.
    #[inline]
    pub(crate) fn of<T>(self, values: &[T]) -> &[T] {
        &values[self.lo..][..self.count()]
    }

    /// As [`Self::of`], to be changed.
    #[inline]
    pub(crate) fn of_mut<T>(self, values: &mut [T]) -> &mut [T] {
        &mut values[self.lo..][..self.count()]
    }

    /// The `values` of its neighbours before and after it, as far as there are any.
    pub(crate) fn neighbours(self, values: &[f64]) -> [Option<f64>; 2] {
        let before = self.lo.checked_sub(1).map(|before| values[before]);
        [before, values.get(self.hi + 1).copied()]
    }
}
