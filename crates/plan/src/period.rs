//! The vehicles after which traffic repeats itself.
//!
//! A sequence is its own period, and shares such as 2 : 1 or 100 : 1 have one: 3 and 101 vehicles.
//! Other shares get a mix that is near to theirs, and a second one on the other side shows what
//! that changes. A vehicle that is too seldom for any period is the only thing in which a second
//! one differs. Of many kinds that differ by their load alone, as axles of a histogram do, some
//! stand in for all (`representatives`), and half as many show what that changes; vehicles that
//! come in random order are compared with another order.

use std::collections::BTreeSet;

use cable_dem::Order;
use ground_field::DuctMotion;

use crate::cable::{known_order, traffic};
use crate::error::Error;
use crate::mix::Mix;
use crate::representatives;
use crate::tuning::periods::{FEW, STAND_INS};
use creepage_scene::Scene;

/// Maximum number of vehicles in a period that is chosen here.
const LONGEST: usize = 2000;

/// A period of traffic.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Period {
    /// Its vehicles, by their place in the scene.
    pub vehicles: Vec<usize>,
    /// Where they only stand in for the traffic, its own vehicles of the first passes, unless these
    /// come at random.
    pub first: Vec<usize>,
    /// Where they only stand in for the traffic, others to compare them with, each with the share
    /// of the difference that is wrong.
    pub others: Vec<(Vec<usize>, f64)>,
    /// Whether the traffic is in another order than that of its period: at random, or in a sequence
    /// that is longer than a day of heat.
    pub reordered: bool,
    /// Whether draws show what a random order changes.
    pub is_drawn: bool,
    /// Vehicles that come within the passes of the scene, but not in the period.
    pub absent: Vec<usize>,
}

impl Period {
    /// The period of the scene's traffic, whose vehicles move the duct by `motions`.
    ///
    /// # Errors
    ///
    /// [`Error`] when shares are too uneven for a period.
    pub fn new(scene: &Scene, motions: &[DuctMotion]) -> Result<Self, Error> {
        if let Some(vehicles) = Self::own(scene)? {
            return Ok(Self {
                vehicles,
                ..Self::default()
            });
        }
        let shares = shares(scene)?;
        let kinds = shares.iter().filter(|share| **share > 0.0).count();
        let (mix, others) = match representatives::advances(scene, motions) {
            Some(advances) if kinds > FEW => {
                let of = |length| Mix::new(representatives::counts(&shares, &advances, length), &shares);
                (of(STAND_INS), vec![(of(STAND_INS / 2), 1.0)])
            }
            _ => near(scene, &shares),
        };
        let others = others.iter().map(|(mix, share)| Ok((mix.interleaved()?, *share)));
        let vehicles = mix.interleaved()?;
        let at_random = matches!(scene.order(), Order::Random { .. });
        let first = if at_random { 0 } else { vehicles.len() };
        let is_absent = |vehicle: &usize| shares[*vehicle] > 0.0 && mix.counts[*vehicle] == 0;
        let mut period = Self {
            first: traffic(scene, scene.order())?.take(first).collect(),
            absent: (0..shares.len()).filter(is_absent).collect(),
            others: others.collect::<Result<_, Error>>()?,
            reordered: scene.order() != Order::Interleaved,
            is_drawn: at_random && scene.warming().is_none() && vehicles.len() > FEW,
            vehicles,
        };
        if period.reordered && !period.is_drawn && (period.len() > FEW || !at_random) {
            period.others.push((period.shuffled(0), 1.0));
        }
        Ok(period)
    }

    /// The vehicles after which the scene's own traffic repeats itself, one after the other, if it
    /// does.
    ///
    /// # Errors
    ///
    /// [`Error`] when the traffic is none.
    pub fn own(scene: &Scene) -> Result<Option<Vec<usize>>, Error> {
        let most = longest(scene);
        match scene.order() {
            Order::Sequence(sequence) if scene.warming().is_some() && sequence.len() > most => Ok(None),
            Order::Sequence(sequence) => Ok(Some(sequence)),
            Order::Interleaved => {
                let mix = Mix::best(&shares(scene)?, most);
                mix.is_exact().then(|| mix.interleaved()).transpose()
            }
            Order::Random { .. } => Ok(None),
        }
    }

    /// Number of its passes.
    #[allow(clippy::len_without_is_empty, reason = "none is empty")]
    pub fn len(&self) -> usize {
        self.vehicles.len()
    }

    /// Its vehicles in an order that is drawn with this seed.
    pub fn shuffled(&self, seed: u64) -> Vec<usize> {
        let mut vehicles = self.vehicles.clone();
        fastrand::Rng::with_seed(seed).shuffle(&mut vehicles);
        vehicles
    }

    /// Whether its passes are those of the scene's traffic.
    pub fn is_own(&self) -> bool {
        self.others.is_empty() && !self.reordered
    }
}

/// The mix that is taken for these shares, without the vehicles that are too seldom for it; and
/// others to compare it with, each with the share of the difference that is wrong.
fn near(scene: &Scene, shares: &[f64]) -> (Mix, Vec<(Mix, f64)>) {
    let most = longest(scene);
    // On a day of heat every vehicle comes: its largest forces do not depend on how many days it
    // does.
    let daily = scene.warming().is_some();
    let is_held = |share: f64| daily || 2.0 * share * most as f64 >= 1.0;
    let held = shares
        .iter()
        .map(|&share| if is_held(share) { share } else { 0.0 });
    let held = normal(held.collect());
    let mix = Mix::best(&held, most);
    let opposite = (!mix.is_exact()).then(|| mix.opposite(&held, most));
    let seldom: f64 = shares.iter().filter(|share| !is_held(**share)).sum();
    let with_seldom = (seldom > 0.0).then(|| {
        let count = |&share: &f64| ((share * most as f64) as usize).max(usize::from(share > 0.0));
        let counts = shares.iter().map(count).collect();
        (Mix::new(counts, shares), (seldom * most as f64).min(1.0))
    });
    (mix, opposite.into_iter().chain(with_seldom).collect())
}

/// Maximum number of vehicles in a period: with heat they begin anew every day.
fn longest(scene: &Scene) -> usize {
    let a_day = scene.traffic.per_day.filter(|_| scene.warming().is_some());
    a_day.map_or(LONGEST, |per_day| (per_day.round() as usize).clamp(FEW, LONGEST))
}

/// The vehicles that come within the passes of the scene, ascending.
pub fn coming(scene: &Scene) -> Result<Vec<usize>, Error> {
    let (passes, known) = (scene.traffic.passes, known_order(scene));
    if let Order::Sequence(sequence) = scene.order() {
        let coming: BTreeSet<usize> = sequence.into_iter().take(passes as usize).collect();
        return Ok(coming.into_iter().collect());
    }
    let shares = scene.shares().into_iter();
    let beyond_known = |share: f64| passes > known && share * passes as f64 >= 0.5;
    let mut comes: Vec<bool> = shares.map(beyond_known).collect();
    let mut left = comes.iter().filter(|comes| !**comes).count();
    let mut traffic = traffic(scene, scene.order())?.take(passes.min(known) as usize);
    while left > 0
        && let Some(vehicle) = traffic.next()
    {
        left -= usize::from(!std::mem::replace(&mut comes[vehicle], true));
    }
    Ok((0..comes.len()).filter(|&vehicle| comes[vehicle]).collect())
}

/// The shares of the vehicles that come, which sum to 1; of the others none.
fn shares(scene: &Scene) -> Result<Vec<f64>, Error> {
    let (all, mut shares) = (scene.shares(), vec![0.0; scene.vehicles.len()]);
    for vehicle in coming(scene)? {
        shares[vehicle] = all[vehicle];
    }
    Ok(normal(shares))
}

/// The same shares, whose sum is 1.
fn normal(weights: Vec<f64>) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / total).collect()
}
