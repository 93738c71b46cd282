//! A tridiagonal solve that does nothing else.

/// Solves r_i − a (r_{i−1} + r_{i+1}) = b, whose neighbours beyond the ends are zero, by Thomas's elimination; `factor` and the answer `r` are of one length.
#[inline(never)]
pub fn solve(a: f64, b: f64, factor: &mut [f64], r: &mut [f64]) {
    let (mut above, mut before) = (0.0, 0.0);
    for (factor, r) in factor.iter_mut().zip(&mut *r) {
        let inverse = 1.0 / (1.0 - a * above);
        above = a * inverse;
        before = (b + a * before) * inverse;
        (*factor, *r) = (above, before);
    }
    let mut next = 0.0;
    for (factor, r) in factor.iter().zip(r).rev() {
        *r += factor * next;
        next = *r;
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_row_holds() {
        let (a, b) = (0.45, 2.0);
        let (mut factor, mut r) = ([0.0; 20], [0.0; 20]);
        super::solve(a, b, &mut factor, &mut r);
        for i in 0..r.len() {
            let left = if i > 0 { r[i - 1] } else { 0.0 };
            let right = r.get(i + 1).copied().unwrap_or(0.0);
            assert!((r[i] - a * (left + right) - b).abs() < 1e-12, "row {i}");
        }
    }
}
