//! Noise of readings by themselves, before any fit.

use crate::instrument::Row;
use crate::readings::Measured;

/// Makes the median of |e| under Gaussian noise a standard deviation.
pub const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// Least noise beside the largest value: digits that an instrument shows.
const LEAST: f64 = 1e-3;

/// Standard deviations that weigh readings of several kinds against each other; `None` where all
/// are of one kind.
pub fn relative_sigmas(rows: &[Row<'_>]) -> Option<Vec<f64>> {
    let first = rows.first()?.reading.measured;
    if rows.iter().all(|row| row.reading.measured.is_like(first)) {
        return None;
    }
    Some(rows.iter().map(|row| noise(rows, row.reading.measured)).collect())
}

/// Noise of what is like `measured`: by how far each reading lies off the line between its
/// neighbours (T. Gasser, L. Sroka, C. Jennen-Steinmetz, "Residual variance and residual pattern in
/// nonlinear regression", Biometrika 73, 1986).
fn noise(rows: &[Row<'_>], measured: Measured) -> f64 {
    let is_like = |row: &&Row<'_>| row.reading.measured.is_like(measured);
    let mut like: Vec<&Row<'_>> = rows.iter().filter(is_like).collect();
    like.sort_by_key(|row| (row.series, row.reading.run, row.reading.passes));
    let largest = like
        .iter()
        .fold(0.0_f64, |most, row| most.max(row.reading.value.abs()));
    let group = |row: &Row<'_>| (row.instrument(), row.reading.run);
    let threes = like.windows(3).filter(|three| group(three[0]) == group(three[2]));
    let mut off: Vec<f64> = threes.map(off_line).collect();
    off.sort_by(f64::total_cmp);
    let median = off.get(off.len() / 2).copied().unwrap_or(0.0);
    let least = (LEAST * largest).max(f64::MIN_POSITIVE);
    least.max(MEDIAN_TO_SIGMA * median)
}

/// How far the second of three readings lies off the line between the others, in standard
/// deviations of that distance.
fn off_line(three: &[&Row<'_>]) -> f64 {
    let point = |k: usize| (three[k].reading.passes as f64, three[k].reading.value);
    let [before, here, after] = [0, 1, 2].map(point);
    let width = after.0 - before.0;
    let share = if width > 0.0 {
        (here.0 - before.0) / width
    } else {
        0.5
    };
    let off = here.1 - (1.0 - share) * before.1 - share * after.1;
    off.abs() / (1.0 + share * share + (1.0 - share).powi(2)).sqrt()
}
