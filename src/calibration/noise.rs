//! Noise of readings by themselves, before any fit.

use super::options::Series;
use crate::readings::{Measured, Reading};

/// Makes the median of |e| under Gaussian noise a standard deviation.
const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// Least noise beside the largest value: digits that an instrument shows.
const LEAST: f64 = 1e-3;

/// Standard deviations that weigh readings of several kinds against each other; `None` where all are of one kind.
pub fn relative_sigmas(series: &[Series<'_>]) -> Option<Vec<f64>> {
    let readings = || series.iter().flat_map(|one| one.readings.readings());
    let first = readings().next()?.measured;
    if readings().all(|reading| reading.measured.is_like(first)) {
        return None;
    }
    let noise = readings().map(|reading| noise(series, reading.measured));
    Some(noise.collect())
}

/// Noise of what is like `measured`: by how far each reading lies off the line between its neighbours (T. Gasser, L. Sroka,
/// C. Jennen-Steinmetz, "Residual variance and residual pattern in nonlinear regression", Biometrika 73, 1986).
fn noise(series: &[Series<'_>], measured: Measured) -> f64 {
    let mut off = Vec::new();
    let mut largest = 0.0_f64;
    for one in series {
        let mut like: Vec<&Reading> = one.readings.readings().iter().collect();
        like.retain(|reading| reading.measured.is_like(measured));
        like.sort_by_key(|reading| (reading.run, reading.passes));
        largest = like
            .iter()
            .fold(largest, |most, reading| most.max(reading.value.abs()));
        let threes = like.windows(3).filter(|three| {
            let [first, last] = [three[0], three[2]];
            (first.run, first.measured) == (last.run, last.measured)
        });
        off.extend(threes.map(off_line));
    }
    off.sort_by(f64::total_cmp);
    let median = off.get(off.len() / 2).copied().unwrap_or(0.0);
    (MEDIAN_TO_SIGMA * median)
        .max(LEAST * largest)
        .max(f64::MIN_POSITIVE)
}

fn off_line(three: &[&Reading]) -> f64 {
    let [before, here, after] = [0, 1, 2].map(|k| (three[k].passes as f64, three[k].value));
    let width = after.0 - before.0;
    let share = if width > 0.0 {
        (here.0 - before.0) / width
    } else {
        0.5
    };
    let off = here.1 - (1.0 - share) * before.1 - share * after.1;
    off.abs() / (1.0 + share * share + (1.0 - share).powi(2)).sqrt()
}
