//! Which passes an answer lists.

use super::calendar::calendar;
use creepage_plan::Period;
use creepage_scene::Scene;

/// The first passes are all listed, then each this much later than the one before.
const GROWTH: f64 = 1.03;
/// A run lists all passes up to this number.
const ALL_LISTED: u64 = 10_000;
/// Of longer traffic the last passes are listed too: at least so many, and a period, of which each
/// vehicle leaves another force.
const LAST: u64 = 12;
/// How far it is followed where forces lead: this number of passes, and this many times those of
/// the traffic.
const FAR: u64 = 1_000_000_000;
const TIMES: u64 = 100;
/// Leading digits of round numbers, which a reader looks for.
pub const ROUND: [u64; 3] = [1, 2, 5];

/// The first passes, then evenly growing numbers, round ones, and the last.
pub fn listed(count: u64) -> Vec<u64> {
    let mut passes = Vec::new();
    let mut next = 1;
    while next < count {
        passes.push(next);
        next = (next + 1).max((GROWTH * next as f64) as u64);
    }
    passes.push(count);
    let round = (0..19).flat_map(|power| ROUND.map(|leading| leading * 10_u64.pow(power)));
    passes.extend(round.filter(|&pass| pass < count));
    passes.sort_unstable();
    passes.dedup();
    passes
}

/// Passes beyond `count`, evenly growing, until nothing that creeps at all still does.
pub fn passes_beyond(count: u64) -> Vec<u64> {
    let far = FAR.max(count.saturating_mul(TIMES));
    listed(far).into_iter().filter(|&pass| pass > count).collect()
}

/// The passes that a run of `scene` lists whose traffic has this `period`: where it is the traffic's
/// own, all of the last period among them.
pub fn listed_passes(scene: &Scene, period: &Period) -> Vec<u64> {
    let traffic = &scene.traffic;
    if traffic.passes <= ALL_LISTED {
        return (1..=traffic.passes).collect();
    }
    let mut passes = listed(traffic.passes);
    passes.extend(calendar(traffic).into_iter().map(|(pass, _)| pass));
    let period = if period.is_own() { period.len() } else { 1 };
    let last = LAST.max(period as u64).min(traffic.passes);
    passes.extend(traffic.passes - last + 1..traffic.passes);
    passes.sort_unstable();
    passes.dedup();
    passes
}
