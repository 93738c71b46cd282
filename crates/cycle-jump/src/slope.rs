//! How the advance per period answers to the locked friction: g = −∂v/∂f̄, learned from the passes themselves.
//!
//! Two measured periods differ in their advance by dv and in the friction between their middles by df. A least-squares slope
//! of the one over the other, over a stretch of cable, is all the law there is. Too small a slope makes a jump overshoot, too large a one
//! only makes it cautious; so it rises at once and falls slowly.

/// Share of the last slope that counts where friction hardly changed.
const INERTIA: f64 = 0.02;
/// Change of friction that counts as large, as a share of its limit: near saturation smaller ones are noise.
const LARGE: f64 = 0.05;
/// Least of the last slope, and of the typical one, that is kept.
const FALL: f64 = 0.8;
const LEAST: f64 = 0.3;
/// Largest growth where a jump overshot, and the overshoot from which on there is any.
const MOST_GROWTH: f64 = 3.0;
const OVERSHOT: f64 = 1.3;
/// Least of the typical slope that one measurement keeps.
const TYPICAL_FALL: f64 = 0.7;
/// Slope before anything is known \[m²/N\].
const UNKNOWN: f64 = 1e-9;

/// The slope at every node \[m²/N per period\].
#[derive(Debug, Clone)]
pub struct Slope {
    values: Vec<f64>,
    /// One number for the whole cable.
    typical: f64,
    /// Nodes in the sliding mean.
    width: usize,
    /// Friction limit \[N/m\].
    limit: f64,
}

/// What changed from one measured period to another.
#[derive(Debug, Clone, Copy)]
pub struct Change<'a> {
    /// Of the advance per period \[m\].
    pub rate: &'a [f64],
    /// Of the friction between them \[N/m\].
    pub friction: &'a [f64],
    /// What the slope had said of the advance; `None` where nothing was jumped.
    pub predicted: Option<&'a [f64]>,
}

impl Slope {
    /// Of a cable with the friction `limit` \[N/m\], as `change` shows it; means run over `width` nodes.
    pub fn new(change: Change<'_>, width: usize, limit: f64) -> Self {
        let typical = secant(change);
        let mut slope = Self {
            values: vec![if typical > 0.0 { typical } else { UNKNOWN }; change.rate.len()],
            typical,
            width: width.max(3) | 1,
            limit,
        };
        slope.learn(change);
        slope
    }

    /// The slope at every node.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Takes a change into account.
    pub fn learn(&mut self, change: Change<'_>) {
        let secant = secant(change);
        let largest = change.friction.iter().fold(0.0_f64, |a, f| a.max(f * f));
        let large = (LARGE * self.limit).powi(2);
        if largest > large && secant > 0.0 {
            self.typical = secant.max(TYPICAL_FALL * self.typical);
        }
        let products = change.rate.iter().zip(change.friction);
        let mut above = sliding_mean(products.map(|(v, f)| -v * f), self.width);
        let below = sliding_mean(change.friction.iter().map(|f| f * f), self.width);
        let weight = INERTIA * largest.max(large);
        let overshoot = change.predicted.map_or(0.0, |predicted| {
            let seen: f64 = change.rate.iter().zip(predicted).map(|(v, p)| v * p).sum();
            seen / predicted
                .iter()
                .map(|p| p * p)
                .sum::<f64>()
                .max(f64::MIN_POSITIVE)
        });
        for ((value, last), below) in above.iter_mut().zip(&self.values).zip(below) {
            *value = (*value + weight * last) / (below + weight);
            if overshoot > OVERSHOT {
                *value = value.max(last * overshoot.min(MOST_GROWTH));
            }
            *value = value.max(FALL * last).max(LEAST * self.typical);
        }
        self.values = sliding_mean(above.into_iter(), self.width);
    }
}

/// −Σ dv df/Σ df², at least 0.
fn secant(change: Change<'_>) -> f64 {
    let pairs = || change.rate.iter().zip(change.friction);
    let above: f64 = pairs().map(|(v, f)| -v * f).sum();
    let below: f64 = pairs().map(|(_, f)| f * f).sum();
    (above / below.max(f64::MIN_POSITIVE)).max(0.0)
}

/// Mean over `width` neighbours, the first and the last value repeated beyond the ends.
fn sliding_mean(values: impl Iterator<Item = f64>, width: usize) -> Vec<f64> {
    let values: Vec<f64> = values.collect();
    let last = values.len() - 1;
    let half = width / 2;
    let at = |i: isize| values[i.clamp(0, last as isize) as usize];
    let mut sum: f64 = (-(half as isize)..=half as isize).map(at).sum();
    let mut means = Vec::with_capacity(values.len());
    for i in 0..=last as isize {
        means.push(sum / (2 * half + 1) as f64);
        sum += at(i + half as isize + 1) - at(i - half as isize);
    }
    means
}
