//! Where a few vehicles follow each other again and again within a long period.

/// Periods of at most this many vehicles are simulated as they are.
const LONG: usize = 48;
/// Most vehicles of a round that is looked for, and fewest rounds in a row that make a stretch.
const LONGEST_ROUND: usize = 12;
const FEWEST_ROUNDS: usize = 8;

/// Some passes of a period, in their order: `times` rounds of `round` vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// Passes of a round.
    pub round: usize,
    /// How often it comes, the same vehicles each time.
    pub times: usize,
}

/// The stretches of a period in which the vehicles come in this `order`.
pub fn stretches(order: &[usize]) -> Vec<Stretch> {
    if order.len() <= LONG {
        return vec![Stretch {
            round: order.len(),
            times: 1,
        }];
    }
    let mut stretches = Vec::new();
    let mut alone = 0;
    let mut place = 0;
    while place < order.len() {
        let rest = &order[place..];
        let repeated = (1..=LONGEST_ROUND.min(rest.len())).map(|round| Stretch {
            round,
            times: rounds(rest, round),
        });
        let passes = |stretch: &Stretch| stretch.round * stretch.times;
        // Of equally long ones the shortest round.
        let longest = repeated
            .filter(|stretch| stretch.times >= FEWEST_ROUNDS)
            .max_by_key(|stretch| (passes(stretch), std::cmp::Reverse(stretch.round)));
        if let Some(stretch) = longest {
            stretches.extend(once(alone));
            stretches.push(stretch);
            alone = 0;
            place += passes(&stretch);
        } else {
            alone += 1;
            place += 1;
        }
    }
    stretches.extend(once(alone));
    stretches
}

/// So many passes that are no rounds, if there are any.
fn once(round: usize) -> Option<Stretch> {
    (round > 0).then_some(Stretch { round, times: 1 })
}

/// How often the first `round` vehicles of `order` follow each other at its beginning.
fn rounds(order: &[usize], round: usize) -> usize {
    let differs = (round..order.len()).find(|&place| order[place] != order[place - round]);
    differs.unwrap_or(order.len()) / round
}

#[cfg(test)]
mod tests {
    use super::*;

    fn as_pairs(order: &[usize]) -> Vec<(usize, usize)> {
        let pairs = stretches(order)
            .into_iter()
            .map(|stretch| (stretch.round, stretch.times));
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
    fn every_pass_stands_in_one_stretch() {
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
