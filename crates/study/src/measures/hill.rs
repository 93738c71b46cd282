//! Where the worst lies between the combinations that are computed.
//!
//! Force against friction is a hill, and so may be force against other unknowns. Along every line of combinations that differ in one
//! unknown alone a parabola through the highest point and its neighbours says where the hill has its top, and how high; the highest of
//! all these tops is computed next (successive parabolic interpolation: R. P. Brent, Algorithms for Minimization without Derivatives,
//! 1973, chapter 5).

use super::answer::Outcome;
use super::unknown::{Combination, with};

/// Tops that are higher by less than this share than what was computed say nothing new.
const GAIN: f64 = 0.002;
/// Nor do those nearer to a point than this share of the distance between its neighbours.
const APART: f64 = 0.04;

/// The combination at which the worst may be worse than at all `outcomes`.
pub fn top(outcomes: &[Outcome]) -> Option<Combination> {
    let highest = outcomes.iter().map(Outcome::share).fold(0.0, f64::max);
    let tops = outcomes.iter().flat_map(|point| {
        let along = |key: &String| top_along(outcomes, point, key);
        point.at.keys().filter_map(along)
    });
    let higher = tops.filter(|(_, share)| *share > (1.0 + GAIN) * highest);
    let best = higher.max_by(|(_, a), (_, b)| a.total_cmp(b));
    best.map(|(at, _)| at)
}

/// The top of the hill along one unknown, if `point` is the highest of its line: where it is, and how high.
fn top_along(all: &[Outcome], point: &Outcome, key: &str) -> Option<(Combination, f64)> {
    let line = all.iter().filter(|other| other.differs_only_in(key, &point.at));
    let mut line: Vec<(f64, f64)> = line.map(|other| (other.at[key], other.share())).collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    let highest = (0..line.len()).max_by(|&a, &b| line[a].1.total_cmp(&line[b].1))?;
    if line.len() < 3 || line[highest].0 != point.at[key] {
        return None;
    }
    let middle = highest.clamp(1, line.len() - 2);
    let [(a, fa), (b, fb), (c, fc)] = [line[middle - 1], line[middle], line[middle + 1]];
    // f(x) = fb + s (x − b) + k (x − b)², through all three.
    let (left, right) = ((fb - fa) / (b - a), (fc - fb) / (c - b));
    let k = (right - left) / (c - a);
    let s = left + k * (b - a);
    let x = b - s / (2.0 * k);
    let is_apart = [a, b, c].iter().all(|known| (x - known).abs() > APART * (c - a));
    if !(k < 0.0 && (a..=c).contains(&x) && is_apart) {
        return None;
    }
    Some((with(point.at.clone(), key, x), fb - s * s / (4.0 * k)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use creepage_run::{Limited, Place, Verdict};

    /// An outcome whose only limit is 1.
    fn outcome(at: &[(&str, f64)], largest: f64) -> Outcome {
        let verdict = serde_json::json!({ "end": Place::Upstream, "quantity": Limited::Force, "limit": 1.0, "largest": largest,
            "pulled": false, "during_a_pass": false, "reached_after": null, "doubtful": false });
        let verdict: Verdict = serde_json::from_value(verdict).expect("a verdict");
        let at = at.iter().map(|(key, value)| ((*key).to_owned(), *value));
        Outcome {
            at: at.collect(),
            rough: true,
            verdicts: vec![verdict],
            force_n: 0.0,
            movement_m: 0.0,
            clamp_force_n: None,
        }
    }

    #[test]
    fn the_top_of_a_parabola_is_found_at_once_wherever_it_is() {
        for place in [0.22, 0.3, 0.33, 0.48] {
            let hill = |mu: f64, peak: f64| peak - (mu - place).powi(2);
            let mut all = Vec::new();
            for mu in [0.2, 0.275, 0.35, 0.425, 0.5] {
                all.extend(
                    [0.8, 1.0, 0.9].map(|peak| outcome(&[("mu", mu), ("peak", peak)], hill(mu, peak))),
                );
            }
            if let Some(at) = top(&all) {
                assert!(
                    (at["mu"] - place).abs() < 1e-12 && at["peak"] == 1.0,
                    "{place}: {at:?}"
                );
            } else {
                let found = all.iter().map(Outcome::share).fold(0.0, f64::max);
                assert!(found > 1.0 - 2e-3, "{place}: {found}");
            }
        }
    }

    #[test]
    fn a_slope_has_its_worst_at_its_end() {
        let slope = (0..5).map(|i| outcome(&[("mu", f64::from(i))], 1.0 + f64::from(i)));
        assert_eq!(top(&slope.collect::<Vec<_>>()), None);
    }
}
