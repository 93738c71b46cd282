//! Elimination for a system with two bands on either side of the diagonal.

/// Half the bandwidth.
const REACH: usize = 2;

/// Row i reads Σ_k rows\[i\]\[k\] x\[i + k − 2\] = right\[i\]. Eliminated without pivoting: the rows of an implicit step are those
/// of a diffusion, whose diagonal dominates, with a lesser skew part.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    pub rows: Vec<[f64; 2 * REACH + 1]>,
    pub right: Vec<f64>,
}

impl Banded {
    pub fn new(size: usize) -> Self {
        Self {
            rows: vec![[0.0; 2 * REACH + 1]; size],
            right: vec![0.0; size],
        }
    }

    /// Solves in place; the answer stands in `right`. The rows are used up.
    pub fn solve(&mut self) {
        let size = self.right.len();
        for i in 0..size {
            for j in i + 1..size.min(i + REACH + 1) {
                let back = j - i;
                let factor = self.rows[j][REACH - back] / self.rows[i][REACH];
                if factor == 0.0 {
                    continue;
                }
                for k in 1..=REACH {
                    self.rows[j][REACH - back + k] -= factor * self.rows[i][REACH + k];
                }
                self.right[j] -= factor * self.right[i];
            }
        }
        for i in (0..size).rev() {
            let known: f64 = (1..=REACH)
                .filter(|k| i + k < size)
                .map(|k| self.rows[i][REACH + k] * self.right[i + k])
                .sum();
            self.right[i] = (self.right[i] - known) / self.rows[i][REACH];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_made_from_its_answer_gives_it_back() {
        let answer = [1.0, -2.0, 3.5, 0.25, 7.0, -1.0];
        let mut system = Banded::new(answer.len());
        for i in 0..answer.len() {
            system.rows[i] = [0.3, -1.0 - 0.1 * i as f64, 4.0, -1.5, 0.2];
            system.right[i] = (0..5)
                .filter(|k| (2..answer.len() + 2).contains(&(i + k)))
                .map(|k| system.rows[i][k] * answer[i + k - 2])
                .sum();
        }
        system.solve();
        for (found, expected) in system.right.iter().zip(answer) {
            assert!((found - expected).abs() < 1e-13);
        }
    }
}
