//! Noise of readings by themselves, before any fit.

use crate::readings::Reading;

/// Makes the median of |e| under Gaussian noise a standard deviation.
pub const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// Minimum noise relative to the largest value: digits that an instrument shows.
const MIN_SHARE: f64 = 1e-3;

/// Standard deviations that weigh readings of several kinds against each other; `None` if all
/// are of one kind.
pub fn relative_sigmas(rows: &[Reading]) -> Option<Vec<f64>> {
    let kinds = || rows.iter().map(|row| row.measured.name());
    let first = kinds().next()?;
    let noises = || kinds().map(|kind| noise(rows, kind)).collect();
    (!kinds().all(|kind| kind == first)).then(noises)
}

/// Noise of readings of a kind: by how far each reading lies off the line between its
/// neighbours (T. Gasser, L. Sroka, C. Jennen-Steinmetz, "Residual variance and residual pattern in
/// nonlinear regression", Biometrika 73, 1986).
fn noise(rows: &[Reading], kind: &str) -> f64 {
    let is_like = |row: &&Reading| row.measured.name() == kind;
    let mut like: Vec<&Reading> = rows.iter().filter(is_like).collect();
    like.sort_by_key(|row| (row.series, row.run, row.passes));
    let sizes = like.iter().map(|row| row.value.abs());
    let largest = sizes.fold(0.0, f64::max);
    let group = |row: &Reading| (row.instrument(), row.run);
    let threes = like.windows(3).filter(|three| group(three[0]) == group(three[2]));
    let least = (MIN_SHARE * largest).max(f64::MIN_POSITIVE);
    least.max(MEDIAN_TO_SIGMA * median(threes.map(off_line)))
}

/// The median of some numbers, the higher of two; 0 of none.
pub fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}

/// How far the second of three readings lies off the line between the others, in standard
/// deviations of that distance.
fn off_line(three: &[&Reading]) -> f64 {
    let point = |k: usize| (three[k].passes as f64, three[k].value);
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
