//! How far means over stretches of a mix scatter.
//!
//! A mix that stands in for the traffic has its shares, but in a stretch of the traffic as long as
//! the mix vehicles follow each other otherwise, above all where two kinds come nearly equally
//! often. How far apart means over parts of the mix lie shows how far that may lead: a mean over n
//! vehicles scatters m/n times as much as one over m of them.

use cable_dem::PassOutcome;
use cycle_jump::Record;

use crate::answer::differences::{Scale, Shares, difference};

/// The mix is cut into so many parts. A mix of two equal halves has others than these.
const PARTS: [usize; 2] = [2, 3];
/// Parts of one length are compared that begin at so many places each.
const PLACES: usize = 8;

/// Error of a mean over as many vehicles of the traffic as the mix has, whose last passes were the
/// `period`.
pub fn scatter(period: &[PassOutcome], scale: Scale) -> Shares {
    let of_parts = |parts: usize| {
        let length = period.len() / parts;
        let weight = 1.0 / length as f64;
        let mean = |begin: usize| {
            let part = period.iter().cycle().skip(begin).take(length);
            let part: Vec<_> = part.map(|outcome| (weight, outcome)).collect();
            let (pass, outcome) = (1, PassOutcome::combined(&part));
            [Record {
                pass,
                outcome,
                interpolated: true,
            }]
        };
        let begins = (0..period.len()).step_by((length / PLACES).max(1));
        let means: Vec<_> = begins.map(mean).collect();
        let pairs = means.iter().enumerate();
        let pairs = pairs.flat_map(|(k, one)| means[..k].iter().map(move |other| (one, other)));
        let spread = pairs
            .map(|(one, other)| difference(one, other, scale))
            .fold(Shares::default(), Shares::max);
        spread.times(1.0 / parts as f64)
    };
    PARTS
        .into_iter()
        .filter(|parts| *parts <= period.len())
        .map(of_parts)
        .fold(Shares::default(), Shares::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What 12 vehicles leave, of which some drive `backward`: 10 N in either direction.
    fn mix(backward: impl Fn(usize) -> bool) -> Vec<PassOutcome> {
        let outcome = |place: usize| {
            let mut outcome = PassOutcome::default();
            outcome.force.downstream = if backward(place) { -10.0 } else { 10.0 };
            outcome
        };
        (0..12).map(outcome).collect()
    }

    #[test]
    fn vehicles_that_come_evenly_scatter_least() {
        let scale = Scale {
            force: 10.0,
            movement: 1.0,
        };
        assert!(scatter(&mix(|place| place % 2 == 0), scale).force < 1e-12);
        // Means over half of it are -10 to 10 N.
        let halves = scatter(&mix(|place| place < 6), scale).force;
        assert!((halves - 1.0).abs() < 1e-12, "{halves}");
        // Means over half of it are all the same, over a third -5 to 5 N.
        let thirds = scatter(&mix(|place| place % 6 < 3), scale).force;
        assert!((thirds - 1.0 / 3.0).abs() < 1e-12, "{thirds}");
        assert_eq!(scatter(&[], scale), Shares::default());
    }
}
