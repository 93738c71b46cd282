//! Thomas's elimination for a tridiagonal system.

/// Row i reads Σ_k rows\[i\]\[k\] x\[i + k − 1\] = right\[i\]. Eliminated without pivoting: the rows of an implicit step are those
/// of a diffusion, whose diagonal dominates, with a skew part.
#[derive(Debug, Clone)]
pub(crate) struct Tridiagonal {
    pub rows: Vec<[f64; 3]>,
    pub right: Vec<f64>,
}

impl Tridiagonal {
    pub fn new(size: usize) -> Self {
        Self {
            rows: vec![[0.0; 3]; size],
            right: vec![0.0; size],
        }
    }

    /// Solves in place; the answer stands in `right`. The rows are used up.
    pub fn solve(&mut self) {
        let size = self.right.len();
        for i in 1..size {
            let factor = self.rows[i][0] / self.rows[i - 1][1];
            self.rows[i][1] -= factor * self.rows[i - 1][2];
            self.right[i] -= factor * self.right[i - 1];
        }
        for i in (0..size).rev() {
            let next = if i + 1 < size {
                self.rows[i][2] * self.right[i + 1]
            } else {
                0.0
            };
            self.right[i] = (self.right[i] - next) / self.rows[i][1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_made_from_its_answer_gives_it_back() {
        let answer = [1.0, -2.0, 3.5, 0.25, 7.0, -1.0];
        let mut system = Tridiagonal::new(answer.len());
        for i in 0..answer.len() {
            system.rows[i] = [-1.0 - 0.1 * i as f64, 4.0, -1.5];
            system.right[i] = (0..3)
                .filter(|k| (1..=answer.len()).contains(&(i + k)))
                .map(|k| system.rows[i][k] * answer[i + k - 1])
                .sum();
        }
        system.solve();
        for (found, expected) in system.right.iter().zip(answer) {
            assert!((found - expected).abs() < 1e-13);
        }
    }
}
