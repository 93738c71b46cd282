//! Rounds of a few vehicles that follow each other again and again within a long period.

use crate::scale::Scale;
use crate::tuning::{LONGEST_ROUND, ROUND_TAIL};

/// Minimum number of rounds in a row: three show that they settle, and the last is simulated in any case.
const MIN_ROUNDS: usize = 5;

/// Some passes of a period, in their order: `times` rounds of `round` vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Passes of a round.
    pub round: usize,
    /// How often it comes, the same vehicles each time.
    pub times: usize,
}

/// The rounds of a period in which the vehicles come in this `order`; what is no round comes once.
pub fn rounds(order: &[usize]) -> Vec<Rounds> {
    let single = |round: usize| Rounds { round, times: 1 };
    let mut all = Vec::new();
    let (mut alone, mut place) = (0, 0);
    while place < order.len() {
        let rest = &order[place..];
        let repeated = (1..=LONGEST_ROUND.min(rest.len())).map(|round| Rounds {
            round,
            times: times(rest, round),
        });
        // Of equally long ones the shortest round.
        let longest = repeated
            .filter(|rounds| rounds.times >= MIN_ROUNDS)
            .max_by_key(|rounds| (rounds.round * rounds.times, std::cmp::Reverse(rounds.round)));
        if let Some(rounds) = longest {
            all.extend((alone > 0).then(|| single(alone)));
            all.push(rounds);
            alone = 0;
            place += rounds.round * rounds.times;
        } else {
            alone += 1;
            place += 1;
        }
    }
    all.extend((alone > 0).then(|| single(alone)));
    all
}

/// How often the first `round` vehicles of `order` follow each other at its beginning.
fn times(order: &[usize], round: usize) -> usize {
    let differs = (round..order.len()).find(|&place| order[place] != order[place - round]);
    differs.unwrap_or(order.len()) / round
}

/// How rounds change the cable less and less.
#[derive(Debug, Default)]
pub struct Settling {
    last: Option<Scale>,
    was_settled: bool,
}

impl Settling {
    /// Whether, after a round with this `change`, the rounds `left` change forces and movements by
    /// less than the share `allowed`; two rounds in a row have to show it.
    pub fn is_settled(&mut self, change: Scale, left: usize, allowed: f64) -> bool {
        let to_come = |now: f64, last: f64| {
            let ratio = if last > 0.0 { now / last } else { 0.0 };
            now * (left as f64).min(ROUND_TAIL / (1.0 - ratio).max(f64::MIN_POSITIVE))
        };
        let is_settled = self.last.is_some_and(|last| {
            to_come(change.force, last.force) <= allowed && to_come(change.movement, last.movement) <= allowed
        });
        self.last = Some(change);
        std::mem::replace(&mut self.was_settled, is_settled) && is_settled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn as_pairs(order: &[usize]) -> Vec<(usize, usize)> {
        let pairs = rounds(order)
            .into_iter()
            .map(|rounds| (rounds.round, rounds.times));
        pairs.collect()
    }

    #[test]
    fn rounds_between_a_seldom_vehicle_are_found() {
        let mut order = vec![0; 40];
        order.push(1);
        order.extend(vec![0; 60]);
        assert_eq!(as_pairs(&order), [(1, 40), (1, 1), (1, 60)]);
        let mut order: Vec<usize> = [0, 0, 1].repeat(30);
        order.push(2);
        order.extend([0, 1]);
        assert_eq!(as_pairs(&order), [(3, 30), (3, 1)]);
    }

    #[test]
    fn every_pass_stands_in_one_of_the_rounds() {
        let mut rng = 7_u64;
        for length in 1..300 {
            let order: Vec<usize> = (0..length)
                .map(|_| {
                    rng = rng.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    usize::from((rng >> 33).is_multiple_of(8))
                })
                .collect();
            let all: usize = as_pairs(&order).iter().map(|(round, times)| round * times).sum();
            assert_eq!(all, length);
        }
    }
}
