//! The scene's own order of vehicles, where a period only stands in for it.

use crate::plan::Period;
use crate::tuning::listing::{AWAY, DEEP, NEAR};

/// Which vehicle drives in each pass, as far as that is known, beside those of a period.
pub struct OwnOrder<'a> {
    pub vehicles: Vec<u32>,
    pub period: &'a Period,
}

impl OwnOrder<'_> {
    /// The place of `pass` in the period.
    pub fn place(&self, pass: u64) -> usize {
        ((pass - 1) % self.period.len() as u64) as usize
    }

    /// How many vehicles up to `pass` are those up to a `place` of the period, as far as it counts.
    fn alike(&self, pass: u64, place: usize) -> usize {
        let length = self.period.len();
        let own = &self.vehicles[..pass as usize];
        let same = |steps: &usize| {
            let before = (place + length - steps % length) % length;
            self.period.vehicles[before] == own[own.len() - 1 - steps] as usize
        };
        (0..DEEP.min(own.len())).take_while(same).count()
    }

    /// The pass of the period's traffic near `pass`, among those `within`, that follows the same
    /// vehicles as far back as possible, if one does far enough.
    pub fn shown_by(&self, pass: u64, within: std::ops::RangeInclusive<u64>) -> Option<u64> {
        if pass > self.vehicles.len() as u64 {
            return None;
        }
        let reach = ((AWAY * pass as f64) as u64)
            .max(NEAR)
            .min(self.period.len() as u64 / 2 + 1);
        // Of equally alike ones the nearest.
        let near = (0..=reach)
            .flat_map(|away| [pass.checked_sub(away), Some(pass + away)])
            .flatten();
        let alike = near.filter(|shown| within.contains(shown)).map(|shown| {
            (
                self.alike(pass, self.place(shown)),
                std::cmp::Reverse(shown.abs_diff(pass)),
                shown,
            )
        });
        let (back, _, shown) = alike.max()?;
        (back >= DEEP.min(pass as usize)).then_some(shown)
    }

    /// The places of the period that follow the same vehicles as `pass` as far back as possible, so
    /// many.
    pub fn most_alike(&self, pass: u64, count: usize) -> Vec<usize> {
        let mut places: Vec<(usize, usize)> = (0..self.period.len())
            .map(|place| (self.alike(pass, place), place))
            .collect();
        places.sort_unstable_by(|a, b| b.cmp(a));
        places.into_iter().take(count).map(|(_, place)| place).collect()
    }
}
