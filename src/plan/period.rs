//! The vehicles after which traffic repeats itself.
//!
//! Shares such as 2:1 have a period of their own: 3 vehicles, and up to 48 where the traffic is long. Others get the nearest mix of at
//! most twelve, and a second one on the other side of theirs shows what that changes. Of many kinds that differ by their load alone, as axles of a histogram do, twelve
//! stand in for all (`stand_ins`).

use cable_dem::{Order, Traffic};
use ground_field::DuctMotion;

use super::stand_ins;
use crate::Error;
use crate::scene::Scene;

/// Most vehicles in a period that is chosen here.
const LONGEST: usize = 12;
/// Periods that are simulated at the start: a sequence that is shorter than the traffic by this factor is its own period.
const FIRST_PERIODS: u64 = 8;
/// Most vehicles in a period that shares have of their own, where the traffic is longer by the factor above.
const LONGEST_OWN: usize = 48;
/// Longest sequence that is its own period: a run simulates some fifty periods.
const LONGEST_SEQUENCE: usize = 200;
/// Rounding of shares.
const SAME: f64 = 1e-9;

/// What twelve stand-ins leave wrong beside their difference to half as many.
const HALVED: f64 = 1.0;

/// A period of traffic.
#[derive(Debug, Clone, PartialEq)]
pub struct Period {
    /// Its vehicles, by their place in the scene.
    pub vehicles: Vec<usize>,
    /// Where they only stand in for the traffic's own mix: another mix, and how far the own one lies from the first on the way to it.
    pub other: Option<(Vec<usize>, f64)>,
    /// Whether the traffic is in another order than that of its period: at random, or a long sequence.
    pub reordered: bool,
}

impl Period {
    /// The period of the scene's traffic, whose vehicles move the duct by `motions`.
    pub fn new(scene: &Scene, motions: &[DuctMotion]) -> Result<Self, Error> {
        if let Some(vehicles) = Self::own(scene)? {
            return Ok(Self {
                vehicles,
                other: None,
                reordered: false,
            });
        }
        let traffic = &scene.traffic;
        let shares: Vec<f64> = match &traffic.order {
            Order::Sequence(sequence) => {
                let count = |vehicle| sequence.iter().filter(|&&one| one == vehicle).count();
                (0..scene.vehicles.len())
                    .map(|vehicle| count(vehicle) as f64)
                    .collect()
            }
            _ => scene.vehicles.iter().map(|vehicle| vehicle.share).collect(),
        };
        let (shares, mixes) = Mix::all(&shares, until_anew(scene));
        let first = &mixes[0];
        let reordered = traffic.order != Order::Interleaved;
        if first.distance > SAME
            && let Some(advances) = stand_ins::advances(scene, motions)
        {
            let mix = |length| Mix::of(stand_ins::counts(&shares, &advances, length), &shares);
            return Ok(Self {
                vehicles: mix(LONGEST).interleaved()?,
                other: Some((mix(LONGEST / 2).interleaved()?, HALVED)),
                reordered,
            });
        }
        let other = (first.distance > SAME).then(|| first.opposite(&mixes)).flatten();
        Ok(Self {
            vehicles: first.interleaved()?,
            other: match other {
                Some((other, share)) => Some((other.interleaved()?, share)),
                None => None,
            },
            reordered,
        })
    }

    /// The vehicles after which the scene's own traffic repeats itself, one after the other, if it does and they are few.
    pub fn own(scene: &Scene) -> Result<Option<Vec<usize>>, Error> {
        let traffic = &scene.traffic;
        match &traffic.order {
            Order::Sequence(sequence) => {
                let fits = FIRST_PERIODS * sequence.len() as u64 <= traffic.passes;
                let is_own = sequence.len() <= LONGEST || fits && sequence.len() <= LONGEST_SEQUENCE;
                Ok(is_own.then(|| sequence.clone()))
            }
            Order::Interleaved => {
                let shares: Vec<f64> = scene.vehicles.iter().map(|vehicle| vehicle.share).collect();
                let (_, mixes) = Mix::all(&shares, until_anew(scene));
                let exact = mixes.first().filter(|mix| mix.distance <= SAME);
                exact.map(Mix::interleaved).transpose()
            }
            Order::Random { .. } => Ok(None),
        }
    }

    /// Number of its passes.
    pub fn len(&self) -> usize {
        self.vehicles.len()
    }
}

/// Passes before the vehicles begin their round anew: with heat they do so every day.
fn until_anew(scene: &Scene) -> u64 {
    let traffic = &scene.traffic;
    let a_day = traffic.per_day.filter(|_| scene.warming().is_some());
    traffic
        .passes
        .min(a_day.map_or(u64::MAX, |per_day| per_day as u64))
}

/// Whole numbers of vehicles.
struct Mix {
    counts: Vec<usize>,
    /// Its shares less the wanted ones.
    off: Vec<f64>,
    /// Largest of them.
    distance: f64,
}

impl Mix {
    /// The shares of vehicles of which so many pass, `passes` in all, and the mixes of ever more vehicles that come nearest to these: first
    /// the shortest of the nearest.
    fn all(weights: &[f64], passes: u64) -> (Vec<f64>, Vec<Self>) {
        let total: f64 = weights.iter().sum();
        let shares: Vec<f64> = weights.iter().map(|weight| weight / total).collect();
        let mut mixes: Vec<Self> = (1..=LONGEST)
            .map(|length| Self::nearest(&shares, length))
            .collect();
        mixes.sort_by(|a, b| {
            (a.distance / SAME)
                .round()
                .total_cmp(&(b.distance / SAME).round())
        });
        if mixes[0].distance > SAME {
            let most = LONGEST_OWN.min((passes / FIRST_PERIODS) as usize);
            let exact = (LONGEST + 1..=most)
                .map(|length| Self::nearest(&shares, length))
                .find(|mix| mix.distance <= SAME);
            mixes.splice(0..0, exact);
        }
        (shares, mixes)
    }

    /// The nearest mix of `length` vehicles: those with the largest remainders are rounded up.
    fn nearest(shares: &[f64], length: usize) -> Self {
        let wanted: Vec<f64> = shares.iter().map(|share| share * length as f64).collect();
        let mut counts: Vec<usize> = wanted.iter().map(|wanted| (wanted + SAME) as usize).collect();
        let mut order: Vec<usize> = (0..shares.len()).collect();
        order.sort_by(|&a, &b| (wanted[b] - counts[b] as f64).total_cmp(&(wanted[a] - counts[a] as f64)));
        for &vehicle in order.iter().take(length - counts.iter().sum::<usize>()) {
            counts[vehicle] += 1;
        }
        Self::of(counts, shares)
    }

    /// The mix of these numbers of vehicles.
    fn of(counts: Vec<usize>, shares: &[f64]) -> Self {
        let length: usize = counts.iter().sum();
        let off: Vec<f64> = counts
            .iter()
            .zip(shares)
            .map(|(&count, share)| count as f64 / length as f64 - share)
            .collect();
        Self {
            distance: off.iter().fold(0.0, |most, off| most.max(off.abs())),
            counts,
            off,
        }
    }

    /// The mix on the other side of the wanted shares that is nearest to them, and the share of the way to it at which they lie.
    fn opposite<'a>(&self, mixes: &'a [Mix]) -> Option<(&'a Mix, f64)> {
        let along = |mix: &Mix| -> f64 { self.off.iter().zip(&mix.off).map(|(a, b)| a * b).sum() };
        let other = mixes
            .iter()
            .filter(|mix| along(mix) < 0.0)
            .min_by(|a, b| a.distance.total_cmp(&b.distance))?;
        Some((other, self.distance / (self.distance + other.distance)))
    }

    /// Its vehicles, as evenly as possible.
    fn interleaved(&self) -> Result<Vec<usize>, Error> {
        let present: Vec<usize> = (0..self.counts.len())
            .filter(|&vehicle| self.counts[vehicle] > 0)
            .collect();
        let counts: Vec<f64> = present
            .iter()
            .map(|&vehicle| self.counts[vehicle] as f64)
            .collect();
        let traffic = Traffic::new(&counts, Order::Interleaved)?;
        Ok(traffic
            .take(self.counts.iter().sum())
            .map(|index| present[index])
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_shares_have_a_period_of_their_own_where_eight_fit_in_the_traffic() {
        let of = |weights: &[f64], passes| {
            let (_, mixes) = Mix::all(weights, passes);
            (mixes[0].counts.iter().sum::<usize>(), mixes[0].distance <= SAME)
        };
        assert_eq!(of(&[2.0, 1.0], 3), (3, true));
        let many = [3.0, 2.0, 2.0, 1.0, 3.0, 1.0, 2.0, 1.0, 2.0];
        assert_eq!(of(&many, 8 * 17), (17, true));
        let (length, is_own) = of(&many, 8 * 17 - 1);
        assert!(length <= LONGEST && !is_own);
        let (length, is_own) = of(&[3.0, 2.0, 2.0, 1.03], 1_000_000);
        assert!(length <= LONGEST && !is_own);
    }
}
