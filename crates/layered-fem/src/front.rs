//! Dense elimination of the first unknowns of a symmetric matrix: a part of a Cholesky factorisation.
//!
//! With the unknowns to be eliminated first,
//!
//! ```text
//! [ A  Bᵀ ]   [ L   0 ] [ Lᵀ  Wᵀ ]
//! [ B  C  ] = [ W   I ] [ 0   S  ],   A = L Lᵀ,   W = B L⁻ᵀ,   S = C − W Wᵀ
//! ```
//!
//! (J. W. H. Liu, SIAM Review 34 (1992) 82–109.) Columns are taken in blocks; the product of each block with itself, where nearly all
//! of the time goes, is summed in tiles of 4 × 4 that stay in registers.

/// Columns eliminated before the rest of the matrix is brought up to date.
const BLOCK: usize = 48;
const TILE: usize = 4;

/// Replaces the first `count` columns of a matrix of order `order` by (L, W), and C by S; `None` if A is not positive
/// definite. Only the lower triangle, column by column, has a meaning.
pub(crate) fn eliminate(matrix: &mut [f64], order: usize, count: usize) -> Option<()> {
    let mut packed = Vec::new();
    for first in (0..count).step_by(BLOCK) {
        let end = count.min(first + BLOCK);
        for column in first..end {
            let (before, rest) = matrix.split_at_mut(column * order);
            let target = &mut rest[column..order];
            for source in before[first * order..].chunks_exact(order) {
                let factor = source[column];
                for (value, other) in target.iter_mut().zip(&source[column..]) {
                    *value -= factor * other;
                }
            }
            let pivot = target[0].sqrt();
            // Of a negative number the root is NaN.
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            target[0] = pivot;
            let inverse = 1.0 / pivot;
            for value in &mut target[1..] {
                *value *= inverse;
            }
        }
        pack(matrix, order, first..end, &mut packed);
        subtract_product(matrix, order, end, &packed, end - first);
    }
    Some(())
}

/// Rows below `block.end` of the columns in `block`, in tiles of rows, column by column within each; filled up with zeros.
fn pack(matrix: &[f64], order: usize, block: std::ops::Range<usize>, packed: &mut Vec<f64>) {
    packed.clear();
    for row in (block.end..order).step_by(TILE) {
        let rows = TILE.min(order - row);
        for column in block.clone() {
            let start = column * order + row;
            packed.extend(&matrix[start..start + rows]);
            packed.resize(packed.len() + TILE - rows, 0.0);
        }
    }
}

/// Subtracts the `packed` rows' products with each other from the matrix beyond `from`, each row having `width` entries.
fn subtract_product(matrix: &mut [f64], order: usize, from: usize, packed: &[f64], width: usize) {
    let tiles = || packed.chunks_exact(TILE * width);
    for (right, other) in tiles().enumerate() {
        for (left, rows) in tiles().enumerate().skip(right) {
            let product = product(rows, other);
            let (row, column) = (from + TILE * left, from + TILE * right);
            let rows = TILE.min(order - row);
            for (k, values) in product.iter().enumerate().take(order - column) {
                let start = (column + k) * order + row;
                for (entry, value) in matrix[start..start + rows].iter_mut().zip(values) {
                    *entry -= value;
                }
            }
        }
    }
}

/// The product of one tile of rows with another's transpose, column by column.
fn product(rows: &[f64], columns: &[f64]) -> [[f64; TILE]; TILE] {
    let mut sum = [[0.0; TILE]; TILE];
    for (row, column) in rows.chunks_exact(TILE).zip(columns.chunks_exact(TILE)) {
        for (sum, &b) in sum.iter_mut().zip(column) {
            for (sum, &a) in sum.iter_mut().zip(row) {
                *sum += a * b;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A symmetric matrix with a heavy diagonal.
    fn entry(i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        if i == j {
            50.0
        } else {
            ((7 * i + 13 * j) % 19) as f64 / 19.0 - 0.5
        }
    }

    /// L, W and S put together give the matrix again, whatever the sizes are to the blocks and tiles.
    #[test]
    fn factors_multiply_to_the_matrix() {
        for (order, count) in [(1, 1), (5, 2), (18, 18), (61, 50), (130, 97), (53, 0)] {
            let mut matrix: Vec<f64> = (0..order * order).map(|k| entry(k % order, k / order)).collect();
            eliminate(&mut matrix, order, count).unwrap();
            let at = |i: usize, j: usize| matrix[i + j * order];
            for j in 0..order {
                for i in j..order {
                    let product: f64 = (0..count.min(j + 1)).map(|k| at(i, k) * at(j, k)).sum();
                    let rest = if j >= count { at(i, j) } else { 0.0 };
                    assert!(
                        (product + rest - entry(i, j)).abs() < 1e-12,
                        "{order}, {count}: {i}, {j}"
                    );
                }
            }
        }
    }

    #[test]
    fn matrices_that_are_not_positive_definite_are_refused() {
        for matrix in [
            [0.0, 1.0, 1.0, 1.0],
            [1.0, 2.0, 2.0, 1.0],
            [f64::NAN, 0.0, 0.0, 1.0],
        ] {
            assert!(eliminate(&mut matrix.clone(), 2, 2).is_none());
        }
    }
}
