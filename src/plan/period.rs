//! The vehicles after which traffic repeats itself.
//!
//! A sequence is its own period, and shares such as 2 : 1 or 100 : 1 have one: 3 and 101 vehicles. Other shares get a mix that is near to
//! theirs, and a second one on the other side shows what that changes. A vehicle that is too seldom for any period is the only thing in which a second
//! one differs. Of many kinds that differ by their load alone, as axles of a histogram do, some stand in for all (`stand_ins`), and half as many
//! show what that changes; vehicles that come in random order are compared with another order.

use cable_dem::Order;
use ground_field::DuctMotion;

use super::mix::Mix;
use super::stand_ins;
use crate::Error;
use crate::cable::{known_order, traffic};
use crate::scene::Scene;

/// Most vehicles in a period that is chosen here.
const LONGEST: usize = 2000;
/// More kinds than this that differ by their load alone have others that stand in for them.
const KINDS: usize = 12;
/// Stand-ins for them.
const STAND_INS: usize = 48;
/// In random order a period of at most so many vehicles is taken as it is, and with heat it may be longer than a day.
const FEW: usize = 12;

/// A period of traffic.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Period {
    /// Its vehicles, by their place in the scene.
    pub vehicles: Vec<usize>,
    /// Where they only stand in for the traffic, others to compare them with, each with the share of the difference that is wrong.
    pub others: Vec<(Vec<usize>, f64)>,
    /// Whether the traffic is in another order than that of its period: at random, or in a sequence that is longer than a day of heat.
    pub reordered: bool,
    /// Vehicles and their shares of which draws show what a random order changes, if it does.
    pub drawn: Vec<(usize, f64)>,
    /// Vehicles that come within the passes of the scene, but not in the period.
    pub absent: Vec<usize>,
}

impl Period {
    /// The period of the scene's traffic, whose vehicles move the duct by `motions`.
    pub fn new(scene: &Scene, motions: &[DuctMotion]) -> Result<Self, Error> {
        if let Some(vehicles) = Self::own(scene)? {
            return Ok(Self {
                vehicles,
                ..Self::default()
            });
        }
        let coming = coming(scene)?;
        let shares = shares(scene, &coming);
        let most = longest(scene);
        let reordered = scene.order() != Order::Interleaved;
        let at_random = matches!(scene.order(), Order::Random { .. });
        let is_drawn = |mix: &Mix| at_random && scene.warming().is_none() && mix.len() > FEW;
        let mut others = Vec::new();
        let mut weights = shares.clone();
        let mix = match stand_ins::advances(scene, motions) {
            Some(advances) if shares.len() > KINDS => {
                let advances: Vec<f64> = coming.iter().map(|&vehicle| advances[vehicle]).collect();
                let of = |length| Mix::new(stand_ins::counts(&shares, &advances, length), &shares);
                others.push((of(STAND_INS / 2), 1.0));
                let mix = of(STAND_INS);
                weights = mix.counts.iter().map(|&count| count as f64).collect();
                mix
            }
            _ => {
                // On a day of heat every vehicle comes: its largest forces do not depend on how many days it does.
                let daily = scene.warming().is_some();
                let of_held = |share: &f64| daily || 2.0 * share * most as f64 >= 1.0;
                let held: Vec<f64> = shares.iter().copied().filter(of_held).collect();
                let mut mix = Mix::best(&normal(&held), most);
                if !mix.is_exact && !is_drawn(&mix) {
                    let (mut other, share) = mix.opposite(&normal(&held), most);
                    other.counts = spread(&other.counts, &shares, of_held);
                    others.push((other, share));
                }
                mix.counts = spread(&mix.counts, &shares, of_held);
                let seldom: f64 = shares.iter().filter(|share| !of_held(share)).sum();
                if seldom > 0.0 {
                    let counts = shares
                        .iter()
                        .map(|share| ((share * most as f64) as usize).max(1))
                        .collect();
                    others.push((Mix::new(counts, &shares), (seldom * most as f64).min(1.0)));
                }
                mix
            }
        };
        let named = |mix: &Mix| -> Result<Vec<usize>, Error> {
            Ok(mix.interleaved()?.into_iter().map(|kind| coming[kind]).collect())
        };
        let vehicles = named(&mix)?;
        let mut others: Vec<(Vec<usize>, f64)> = others
            .iter()
            .map(|(mix, share)| Ok::<_, Error>((named(mix)?, *share)))
            .collect::<Result<_, _>>()?;
        let drawn = if is_drawn(&mix) {
            let kinds = (0..coming.len()).filter(|&kind| mix.counts[kind] > 0);
            kinds.map(|kind| (coming[kind], weights[kind])).collect()
        } else {
            Vec::new()
        };
        if reordered && drawn.is_empty() && (vehicles.len() > FEW || !at_random) {
            let mut shuffled = vehicles.clone();
            fastrand::Rng::with_seed(0).shuffle(&mut shuffled);
            others.push((shuffled, 1.0));
        }
        Ok(Self {
            absent: coming
                .into_iter()
                .filter(|vehicle| !vehicles.contains(vehicle))
                .collect(),
            vehicles,
            others,
            reordered,
            drawn,
        })
    }

    /// The vehicles after which the scene's own traffic repeats itself, one after the other, if it does.
    pub fn own(scene: &Scene) -> Result<Option<Vec<usize>>, Error> {
        let most = longest(scene);
        match scene.order() {
            Order::Sequence(sequence) if scene.warming().is_some() && sequence.len() > most => Ok(None),
            Order::Sequence(sequence) => Ok(Some(sequence)),
            Order::Interleaved => {
                let coming = coming(scene)?;
                let mix = Mix::best(&shares(scene, &coming), most);
                let named = |vehicles: Vec<usize>| vehicles.into_iter().map(|kind| coming[kind]).collect();
                mix.is_exact.then(|| mix.interleaved().map(named)).transpose()
            }
            Order::Random { .. } => Ok(None),
        }
    }

    /// Number of its passes.
    pub fn len(&self) -> usize {
        self.vehicles.len()
    }

    /// As many vehicles by their shares, in an order that is drawn with this seed: of each kind the whole number below or above its part.
    pub fn draw(&self, seed: u64) -> Vec<usize> {
        let mut random = fastrand::Rng::with_seed(seed);
        let begin = random.f64();
        let all: f64 = self.drawn.iter().map(|(_, share)| share).sum();
        let mut kinds = self.drawn.iter();
        let (mut vehicle, mut upto) = (0, 0.0);
        let mut vehicles = Vec::with_capacity(self.len());
        for place in 0..self.len() {
            while (place as f64 + begin) / self.len() as f64 >= upto / all {
                let Some((next, share)) = kinds.next() else { break };
                (vehicle, upto) = (*next, upto + share);
            }
            vehicles.push(vehicle);
        }
        random.shuffle(&mut vehicles);
        vehicles
    }

    /// Whether it stands in for the traffic, and others are compared with it.
    pub fn stands_in(&self) -> bool {
        !self.drawn.is_empty() || !self.others.is_empty()
    }

    /// Whether its passes are those of the scene's traffic.
    pub fn is_own(&self) -> bool {
        self.others.is_empty() && !self.reordered
    }
}

/// Most vehicles in a period: with heat they begin anew every day.
fn longest(scene: &Scene) -> usize {
    let a_day = scene.traffic.per_day.filter(|_| scene.warming().is_some());
    a_day.map_or(LONGEST, |per_day| (per_day.round() as usize).clamp(FEW, LONGEST))
}

/// The vehicles that come within the passes of the scene, ascending.
pub fn coming(scene: &Scene) -> Result<Vec<usize>, Error> {
    let passes = scene.traffic.passes;
    let kinds = scene.vehicles.len();
    let mut comes = vec![false; kinds];
    if let Order::Sequence(sequence) = scene.order() {
        for &vehicle in sequence.iter().take(passes as usize) {
            comes[vehicle] = true;
        }
    } else {
        for (comes, share) in comes.iter_mut().zip(scene.shares()) {
            *comes = passes > known_order(scene) && share * passes as f64 >= 0.5;
        }
        let mut left = comes.iter().filter(|comes| !**comes).count();
        let traffic = traffic(scene, scene.order())?;
        for vehicle in traffic.take(passes.min(known_order(scene)) as usize) {
            left -= usize::from(!std::mem::replace(&mut comes[vehicle], true));
            if left == 0 {
                break;
            }
        }
    }
    Ok((0..kinds).filter(|&vehicle| comes[vehicle]).collect())
}

/// Their shares, which sum to 1.
fn shares(scene: &Scene, coming: &[usize]) -> Vec<f64> {
    let shares = scene.shares();
    let coming: Vec<f64> = coming.iter().map(|&vehicle| shares[vehicle]).collect();
    normal(&coming)
}

/// The same shares, whose sum is 1.
fn normal(weights: &[f64]) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    weights.iter().map(|weight| weight / total).collect()
}

/// The `counts` of those vehicles that are `held`, and none of the others.
fn spread(counts: &[usize], shares: &[f64], held: impl Fn(&f64) -> bool) -> Vec<usize> {
    let mut counts = counts.iter().copied();
    let of = |share: &f64| {
        if held(share) {
            counts.next().unwrap_or(0)
        } else {
            0
        }
    };
    shares.iter().map(of).collect()
}
