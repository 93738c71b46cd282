//! Where the worst lies between the combinations that are computed.
//!
//! Force against friction is a hill, and so may be force against other unknowns. Along every line of combinations that differ in one
//! unknown alone a parabola through the highest point and its neighbours says where the hill has its top, and how high; the highest of
//! all these tops is computed next (successive parabolic interpolation: R. P. Brent, Algorithms for Minimization without Derivatives,
//! 1973, chapter 5).

use super::answer::Outcome;

/// Tops that are higher by less than this share than what was computed say nothing new.
const GAIN: f64 = 0.002;
/// Nor do those nearer to a point than this share of the distance between its neighbours.
const APART: f64 = 0.04;

/// The combination at which the worst may be worse than at all `outcomes`.
pub fn closer(outcomes: &[Outcome]) -> Option<Vec<f64>> {
    let computed: Vec<&Outcome> = outcomes
        .iter()
        .filter(|outcome| outcome.failure.is_none())
        .collect();
    let highest = computed.iter().map(|outcome| outcome.share()).fold(0.0, f64::max);
    let unknowns = computed.first()?.at.len();
    let tops = computed.iter().flat_map(|point| {
        let of_line = |unknown| top(&computed, point, unknown);
        (0..unknowns).filter_map(of_line)
    });
    let higher = tops.filter(|(_, share)| *share > (1.0 + GAIN) * highest);
    let best = higher.max_by(|(_, a), (_, b)| a.total_cmp(b));
    best.map(|(at, _)| at)
}

/// The top of the hill along one unknown, if `point` is the highest of its line: where it is, and how high.
fn top(all: &[&Outcome], point: &Outcome, unknown: usize) -> Option<(Vec<f64>, f64)> {
    let is_beside = |other: &&&Outcome| {
        let mut pairs = other.at.iter().zip(&point.at).enumerate();
        pairs.all(|(index, (a, b))| index == unknown || a == b)
    };
    let mut line: Vec<(f64, f64)> = all
        .iter()
        .filter(is_beside)
        .map(|other| (other.at[unknown], other.share()))
        .collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    let highest = (0..line.len()).max_by(|&a, &b| line[a].1.total_cmp(&line[b].1))?;
    if line.len() < 3 || line[highest].0 != point.at[unknown] {
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
    let mut at = point.at.clone();
    at[unknown] = x;
    Some((at, fb - s * s / (4.0 * k)))
}

#[cfg(test)]
mod tests {
    use super::super::answer::Effort;
    use super::*;
    use creepage_run::{Limited, Place, Verdict};

    /// An outcome whose only limit is 1.
    fn outcome(at: &[f64], largest: f64) -> Outcome {
        let verdict = serde_json::json!({ "end": Place::Upstream, "quantity": Limited::Force, "limit": 1.0, "largest": largest,
            "reached_after": null, "doubtful": false });
        let verdict: Verdict = serde_json::from_value(verdict).expect("a verdict");
        Outcome::new(at, Effort::Coarse, vec![verdict], [0.0; 3])
    }

    #[test]
    fn the_top_of_a_parabola_is_found_at_once_wherever_it_is() {
        for top in [0.22, 0.3, 0.33, 0.48] {
            let hill = |mu: f64, peak: f64| peak - (mu - top).powi(2);
            let mut all = Vec::new();
            for mu in [0.2, 0.275, 0.35, 0.425, 0.5] {
                all.extend([0.8, 1.0, 0.9].map(|peak| outcome(&[mu, peak], hill(mu, peak))));
            }
            if let Some(at) = closer(&all) {
                assert!((at[0] - top).abs() < 1e-12 && at[1] == 1.0, "{top}: {at:?}");
            } else {
                let found = all.iter().map(Outcome::share).fold(0.0, f64::max);
                assert!(found > 1.0 - 2e-3, "{top}: {found}");
            }
        }
    }

    #[test]
    fn a_slope_has_its_worst_at_its_end() {
        let all: Vec<Outcome> = (0..5)
            .map(|i| outcome(&[f64::from(i)], 1.0 + f64::from(i)))
            .collect();
        assert_eq!(closer(&all), None);
    }
}
