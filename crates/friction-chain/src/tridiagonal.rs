//! Chains of equations in which every unknown knows its two neighbours alone.

/// Rows after which determinants are made 1 again.
const RESCALED: usize = 256;

/// The equation of one unknown, x = `share` · (the sum of both neighbours) + `value`.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// What it takes of each neighbour.
    pub share: f64,
    /// What it is apart from them, in the unit of x.
    pub value: f64,
}

/// What elimination makes of a row: x = factor · (the next neighbour) + value, with factor = minor/determinant.
#[derive(Clone, Copy)]
struct Eliminated {
    /// d_i = d_{i−1} − a_i a_{i−1} d_{i−2} of the rows so far, with their shares a.
    determinant: f64,
    /// a_i d_{i−1}.
    minor: f64,
    value: f64,
}

impl Eliminated {
    /// The row after it, and its factor. Determinants in place of their ratios, since each row waits for the one before it, and a product
    /// takes a fourth of a division.
    #[inline]
    fn next(self, row: Row) -> (Self, f64) {
        let determinant = self.determinant - row.share * self.minor;
        let inverse = self.determinant / determinant;
        let factor = row.share * inverse;
        let next = Self {
            determinant,
            minor: row.share * self.determinant,
            value: row.value * inverse + factor * self.value,
        };
        (next, factor)
    }

    /// The same with a determinant of 1: each may be half the one before.
    fn rescaled(self) -> Self {
        Self {
            determinant: 1.0,
            minor: self.minor / self.determinant,
            ..self
        }
    }
}

/// Solves the rows of every index of `x`, of which there is one at least, between neighbours that are held at `before` and `after`;
/// `factors` is storage of as many or more.
///
/// Gaussian elimination (L. H. Thomas, 1949), from both ends at once, since each row waits for the one before it. With determinants a pass
/// takes 0.92 to 0.95 of the time that it takes with their ratios, the pivots. Shares between 0 and ½, or up to 1 at an end without a
/// neighbour, need no pivoting.
///
/// # Panics
///
/// Where `x` is empty, or `factors` shorter.
#[inline]
pub fn solve([before, after]: [f64; 2], row: impl Fn(usize) -> Row, factors: &mut [f64], x: &mut [f64]) {
    let count = x.len();
    let factors = &mut factors[..count];
    let middle = count / 2;
    let held = |value| Eliminated {
        determinant: 1.0,
        minor: 0.0,
        value,
    };
    let (mut low, mut high) = (held(before), held(after));
    for i in 0..middle {
        (low, factors[i]) = low.next(row(i));
        x[i] = low.value;
        let j = count - 1 - i;
        if j > middle {
            (high, factors[j]) = high.next(row(j));
            x[j] = high.value;
        }
        if i % RESCALED == 0 {
            (low, high) = (low.rescaled(), high.rescaled());
        }
    }
    let Row { share, value } = row(middle);
    let met = (value + share * (low.value + high.value))
        / (1.0 - share * (low.rescaled().minor + high.rescaled().minor));
    x[middle] = met;
    let (mut left, mut right) = (met, met);
    for k in 1..=middle {
        let (i, j) = (middle - k, middle + k);
        left = x[i] + factors[i] * left;
        x[i] = left;
        if j < count {
            right = x[j] + factors[j] * right;
            x[j] = right;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Row, solve};

    #[test]
    fn every_row_holds() {
        for count in [1, 2, 3, 1000] {
            // Any numbers; the first row has no neighbour before it, and its share is up to 1.
            let noise = |i: usize| ((i * 7919 + 13) % 1009) as f64 / 1009.0;
            let share = |i: usize| if i == 0 { 0.999 } else { 0.5 * noise(i) };
            let row = |i: usize| Row {
                share: share(i),
                value: noise(i + 500) - 0.5,
            };
            let (held, mut x) = ([0.0, 3.0], vec![0.0; count]);
            solve(held, row, &mut vec![0.0; count], &mut x);
            for i in 0..count {
                let left = i.checked_sub(1).map_or(held[0], |i| x[i]);
                let right = x.get(i + 1).copied().unwrap_or(held[1]);
                let missed = x[i] - row(i).share * (left + right) - row(i).value;
                assert!(missed.abs() < 1e-12, "row {i} of {count}: {missed:e}");
            }
        }
    }
}
