//! Whole numbers of vehicles that come near to given shares.

use cable_dem::{Order, Traffic};

use crate::error::Error;
use crate::tuning::periods::{EXACT, LONGER, MIN_VEHICLES, NEAR, SHORT};

/// Rounding of shares.
const SAME: f64 = 1e-9;

/// Whole numbers of vehicles of every kind.
#[derive(Debug, Clone)]
pub struct Mix {
    pub counts: Vec<usize>,
    /// By how much their shares differ from the wanted ones, as a share of these.
    off: Vec<f64>,
}

impl Mix {
    /// These numbers for vehicles whose `shares` sum to 1; none of those without a share.
    pub fn new(counts: Vec<usize>, shares: &[f64]) -> Self {
        let length = counts.iter().sum::<usize>() as f64;
        let off = |(&count, &share): (&usize, &f64)| {
            let off = count as f64 / length - share;
            if share > 0.0 { off / share } else { off }
        };
        let off = counts.iter().zip(shares).map(off).collect();
        Self { counts, off }
    }

    /// Whether its shares do not differ from the wanted ones at all.
    pub fn is_exact(&self) -> bool {
        self.distance() <= SAME
    }

    /// The mix of at most `most` vehicles that is taken for those with these `shares`: one that has
    /// them exactly, if that is not too long; or the nearest of those that are hardly longer than
    /// the first that is near; or the nearest of all.
    pub fn best(shares: &[f64], most: usize) -> Self {
        let all = (1..=most).map(|length| Self::nearest(shares, length));
        let all = all.filter(|mix| mix.len() <= most);
        let is_near = |mix: &Self| mix.distance() <= NEAR && mix.len() >= MIN_VEHICLES;
        let (shortest, longest) = all
            .clone()
            .find(is_near)
            .map_or((1, most), |mix| (mix.len(), (LONGER * mix.len() as f64) as usize));
        let exact = all.clone().take(SHORT.max(EXACT * shortest)).find(Self::is_exact);
        let in_length = |mix: &Self| (shortest..=longest).contains(&mix.len());
        let near = exact.or_else(|| nearest_of(all.filter(in_length)));
        near.unwrap_or_else(|| Self::nearest(shares, most))
    }

    /// A mix of at most `most` vehicles on the other side of the wanted shares, or at least another
    /// one, and the share of the way to it at which they lie: all of it where that is not known.
    pub fn opposite(&self, shares: &[f64], most: usize) -> (Self, f64) {
        let along = |mix: &Self| -> f64 { self.off.iter().zip(&mix.off).map(|(a, b)| a * b).sum() };
        let longest = most.min(2 * self.len());
        let all =
            (1..=longest).flat_map(|length| [Self::nearest(shares, length), Self::rounded(shares, length)]);
        let all: Vec<Self> = all.filter(|mix| mix.len() <= longest).collect();
        if let Some(opposite) = nearest_of(all.iter().filter(|mix| along(mix) < 0.0).cloned()) {
            let share = self.distance() / (self.distance() + opposite.distance());
            return (opposite, share);
        }
        let others = all.into_iter().filter(|mix| mix.off != self.off);
        (nearest_of(others).unwrap_or_else(|| self.clone()), 1.0)
    }

    /// The nearest mix of `length` vehicles, or of a few more: those with the largest remainders
    /// are rounded up, and every vehicle comes.
    fn nearest(shares: &[f64], length: usize) -> Self {
        let mut counts = Self::rounded(shares, length).counts;
        for (count, share) in counts.iter_mut().zip(shares) {
            *count = (*count).max(usize::from(*share > 0.0));
        }
        Self::new(counts, shares)
    }

    /// The same without the vehicles that are too seldom.
    fn rounded(shares: &[f64], length: usize) -> Self {
        let wanted: Vec<f64> = shares.iter().map(|share| share * length as f64).collect();
        let mut counts: Vec<usize> = wanted.iter().map(|wanted| (wanted + SAME) as usize).collect();
        let mut order: Vec<usize> = (0..shares.len()).collect();
        order.sort_by(|&a, &b| (wanted[b] - counts[b] as f64).total_cmp(&(wanted[a] - counts[a] as f64)));
        for &vehicle in order.iter().take(length - counts.iter().sum::<usize>()) {
            counts[vehicle] += 1;
        }
        Self::new(counts, shares)
    }

    /// Number of its vehicles.
    pub fn len(&self) -> usize {
        self.counts.iter().sum()
    }

    /// By how much the share of a vehicle is wrong at most, as a share of it.
    fn distance(&self) -> f64 {
        self.off.iter().fold(0.0, |most, off| most.max(off.abs()))
    }

    /// Its vehicles, as evenly as possible.
    pub fn interleaved(&self) -> Result<Vec<usize>, Error> {
        let present: Vec<usize> = (0..self.counts.len()).filter(|&k| self.counts[k] > 0).collect();
        let counts: Vec<f64> = present.iter().map(|&k| self.counts[k] as f64).collect();
        let traffic = Traffic::new(&counts, Order::Interleaved)?;
        Ok(traffic.take(self.len()).map(|index| present[index]).collect())
    }
}

/// The nearest mix, of equally near ones the first.
fn nearest_of(mixes: impl Iterator<Item = Mix>) -> Option<Mix> {
    mixes.min_by(|a, b| a.distance().total_cmp(&b.distance()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(weights: &[f64]) -> Vec<f64> {
        let total: f64 = weights.iter().sum();
        weights.iter().map(|weight| weight / total).collect()
    }

    fn best(weights: &[f64]) -> (usize, bool) {
        let mix = Mix::best(&shares(weights), 2000);
        (mix.len(), mix.is_exact())
    }

    #[test]
    fn whole_shares_are_taken_as_they_are() {
        assert_eq!(best(&[2.0, 1.0]), (3, true));
        assert_eq!(best(&[3.0, 2.0, 2.0, 1.0, 3.0, 1.0, 2.0, 1.0, 2.0]), (17, true));
        for n in [1, 20, 60, 100, 300, 1000, 1999] {
            assert_eq!(best(&[f64::from(n), 1.0]), (n as usize + 1, true));
        }
        assert_eq!(best(&[60.5, 1.0]), (123, true));
        assert_eq!(best(&[412.0, 37.0, 1.0]), (450, true));
    }

    #[test]
    fn a_near_mix_has_every_vehicle_and_another_one_on_the_other_side() {
        for weights in [
            [3.0, 2.0, 2.0, 1.03],
            [412.73, 37.21, 11.9, 1.0],
            [1000.0, 1.0, 1.0, 3.3],
            [900.7, 900.1, 700.3, 1.0],
        ] {
            let shares = shares(&weights);
            let mix = Mix::best(&shares, 2000);
            assert!(
                mix.is_exact() || mix.counts.iter().all(|&count| count > 0),
                "{mix:?}"
            );
            let (other, share) = mix.opposite(&shares, 2000);
            assert_ne!(other.off, mix.off, "{mix:?}");
            assert!((0.0..=1.0).contains(&share));
        }
        assert!(best(&[3.0, 2.0, 2.0, 1.03]).0 <= 125);
    }
}
