//! Which vehicle comes when.

use crate::CableError;
use crate::error::{checked, positive};

/// In which order vehicles follow each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Order {
    /// As evenly as their shares allow.
    #[default]
    Interleaved,
    /// Drawn at random by their shares; the same seed draws the same traffic.
    Random {
        /// Seed of the generator.
        seed: u64,
    },
    /// These vehicles by index, over and over.
    Sequence(Vec<usize>),
}

/// Endless traffic: an iterator over vehicle indices.
#[derive(Debug, Clone)]
pub struct Traffic {
    shares: Vec<f64>,
    order: Order,
    passed: u64,
    counts: Vec<u64>,
    random: fastrand::Rng,
}

impl Traffic {
    /// Traffic of vehicles with `shares` of the passes (any positive weights), in `order`; a sequence needs no shares, only
    /// their number.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless there is a vehicle, every share is positive, their sum is finite, and a sequence names
    /// vehicles that exist.
    pub fn new(shares: &[f64], order: Order) -> Result<Self, CableError> {
        checked("vehicles", shares.len() as f64, "at least one", |v| v > 0.0)?;
        if let Order::Sequence(sequence) = &order {
            let (length, vehicles) = (sequence.len() as f64, shares.len() as f64);
            checked("sequence length", length, "at least one", |v| v > 0.0)?;
            for &index in sequence {
                let is_one = |v| v < vehicles;
                checked("sequence entry", index as f64, "the index of a vehicle", is_one)?;
            }
        } else {
            for &share in shares {
                positive("share", share)?;
            }
        }
        let total: f64 = shares.iter().sum();
        checked("sum of the shares", total, "finite", |_| true)?;
        let seed = if let Order::Random { seed } = order {
            seed
        } else {
            0
        };
        Ok(Self {
            shares: shares.iter().map(|share| share / total).collect(),
            order,
            passed: 0,
            counts: vec![0; shares.len()],
            random: fastrand::Rng::with_seed(seed),
        })
    }

    /// The vehicle that is furthest behind its share; the first of several.
    fn most_overdue(&self) -> usize {
        let due = |index: usize| self.shares[index] * (self.passed + 1) as f64 - self.counts[index] as f64;
        // Shares such as 1/3 leave rounding in what should be equal.
        let more_overdue = |best, index| {
            if due(index) > due(best) + 1e-9 {
                index
            } else {
                best
            }
        };
        (1..self.shares.len()).fold(0, more_overdue)
    }

    fn drawn(&mut self) -> usize {
        let mut left = self.random.f64();
        let reaches = |share: &f64| {
            left -= share;
            left < 0.0
        };
        let found = self.shares.iter().position(reaches);
        found.unwrap_or(self.shares.len() - 1)
    }
}

impl Iterator for Traffic {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let index = match &self.order {
            Order::Interleaved => self.most_overdue(),
            Order::Random { .. } => self.drawn(),
            Order::Sequence(sequence) => sequence[(self.passed % sequence.len() as u64) as usize],
        };
        self.passed += 1;
        self.counts[index] += 1;
        Some(index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_met_evenly() -> Result<(), CableError> {
        let two_to_one: Vec<usize> = Traffic::new(&[2.0, 1.0], Order::Interleaved)?.take(6).collect();
        assert_eq!(two_to_one, [0, 1, 0, 0, 1, 0]);
        let thirds: Vec<usize> = Traffic::new(&[1.0; 3], Order::Interleaved)?.take(6).collect();
        assert_eq!(thirds, [0, 1, 2, 0, 1, 2]);
        Ok(())
    }

    #[test]
    fn random_traffic_repeats_with_its_seed_and_keeps_its_shares() -> Result<(), CableError> {
        let draw = |seed| -> Result<Vec<usize>, CableError> {
            Ok(Traffic::new(&[3.0, 1.0], Order::Random { seed })?
                .take(4000)
                .collect())
        };
        assert_eq!(draw(7)?, draw(7)?);
        assert_ne!(draw(7)?, draw(8)?);
        let second = draw(7)?.iter().sum::<usize>() as f64;
        // Four standard deviations of the binomial count.
        assert!((second - 1000.0).abs() < 4.0 * (4000.0_f64 * 0.25 * 0.75).sqrt());
        Ok(())
    }

    #[test]
    fn a_sequence_repeats() -> Result<(), CableError> {
        let traffic = Traffic::new(&[1.0, 1.0], Order::Sequence(vec![0, 0, 1]))?;
        assert_eq!(traffic.take(5).collect::<Vec<_>>(), [0, 0, 1, 0, 0]);
        assert!(Traffic::new(&[1.0], Order::Sequence(vec![1])).is_err());
        assert!(Traffic::new(&[], Order::Interleaved).is_err());
        assert!(Traffic::new(&[0.0], Order::Interleaved).is_err());
        Ok(())
    }
}
