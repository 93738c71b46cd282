//! A monotone table: cubic Hermite pieces that never overshoot.
//!
//! Slopes after F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300–304: the weighted harmonic mean of
//! neighbouring differences where these agree in sign, 0 where they do not. Between nodes the interpolant is monotone, with
//! continuous slope. Beyond its ends the table goes on along its end slopes.

/// Nodes in ascending order with values and slopes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    nodes: Vec<[f64; 2]>,
    slopes: Vec<f64>,
}

impl Table {
    /// A table through at least two `nodes` (argument, value), ascending by argument.
    pub fn new(nodes: Vec<[f64; 2]>) -> Self {
        let secants: Vec<(f64, f64)> = nodes
            .windows(2)
            .map(|pair| {
                let width = pair[1][0] - pair[0][0];
                (width, (pair[1][1] - pair[0][1]) / width)
            })
            .collect();
        let mut slopes: Vec<f64> = Vec::with_capacity(nodes.len());
        for i in 0..nodes.len() {
            slopes.push(match (i.checked_sub(1).map(|k| secants[k]), secants.get(i)) {
                (Some((h0, s0)), Some(&(h1, s1))) => interior(h0, s0, h1, s1),
                (None, Some(&(h0, s0))) => edge(h0, s0, secants.get(1).copied()),
                (Some((h0, s0)), None) => edge(h0, s0, secants.len().checked_sub(2).map(|k| secants[k])),
                (None, None) => 0.0,
            });
        }
        Self { nodes, slopes }
    }

    /// Value and slope at `x`.
    pub fn at(&self, x: f64) -> (f64, f64) {
        let last = self.nodes.len() - 1;
        for (outside, i) in [(x <= self.nodes[0][0], 0), (x >= self.nodes[last][0], last)] {
            if outside {
                let [node, value] = self.nodes[i];
                return (value + self.slopes[i] * (x - node), self.slopes[i]);
            }
        }
        // None of the nodes for what is not a number.
        let Some(i) = self.nodes.partition_point(|node| node[0] <= x).checked_sub(1) else {
            return (f64::NAN, f64::NAN);
        };
        let ([x0, y0], [x1, y1]) = (self.nodes[i], self.nodes[i + 1]);
        let h = x1 - x0;
        let t = (x - x0) / h;
        let (m0, m1) = (h * self.slopes[i], h * self.slopes[i + 1]);
        let (c2, c3) = (3.0 * (y1 - y0) - 2.0 * m0 - m1, 2.0 * (y0 - y1) + m0 + m1);
        (
            y0 + t * (m0 + t * (c2 + t * c3)),
            (m0 + t * (2.0 * c2 + 3.0 * t * c3)) / h,
        )
    }

    /// First and last argument.
    pub fn domain(&self) -> (f64, f64) {
        (self.nodes[0][0], self.nodes[self.nodes.len() - 1][0])
    }

    /// The nodes (argument, value).
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }
}

/// Weighted harmonic mean of two secants (widths and slopes).
fn interior(h0: f64, s0: f64, h1: f64, s1: f64) -> f64 {
    if s0 * s1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / s0 + w1 / s1)
}

/// Slope at an end from the parabola through the three nodes there, limited to stay monotone.
fn edge(h0: f64, s0: f64, next: Option<(f64, f64)>) -> f64 {
    let Some((h1, s1)) = next else { return s0 };
    let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
    if slope * s0 <= 0.0 {
        0.0
    } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
        3.0 * s0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monotone_data_give_a_monotone_curve_through_its_nodes() {
        let nodes = vec![[0.0, 5.0], [1.0, 4.9], [1.5, 1.0], [3.0, 0.9], [4.0, -6.0]];
        let table = Table::new(nodes.clone());
        for [x, y] in nodes {
            assert!((table.at(x).0 - y).abs() < 1e-14);
        }
        let values: Vec<f64> = (0..=400).map(|k| table.at(0.01 * f64::from(k)).0).collect();
        assert!(values.windows(2).all(|pair| pair[1] <= pair[0] + 1e-14));
    }

    #[test]
    fn the_slope_is_the_derivative_and_goes_on_outside() {
        let table = Table::new(vec![[0.0, 1.0], [0.7, 0.2], [1.0, -0.4], [2.0, -3.0]]);
        for x in [-0.5, 0.1, 0.6, 0.85, 1.4, 1.9, 2.5] {
            let (h, slope) = (1e-6, table.at(x).1);
            let difference = (table.at(x + h).0 - table.at(x - h).0) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-7, "{x}: {slope} {difference}");
        }
    }

    #[test]
    fn a_smooth_function_is_met_to_third_order() {
        let error = |n: i32| {
            let f = |x: f64| -(x.exp());
            let table = Table::new(
                (0..=n)
                    .map(|k| f64::from(k) / f64::from(n))
                    .map(|x| [x, f(x)])
                    .collect(),
            );
            (0..1000)
                .map(|k| f64::from(k) / 1000.0)
                .map(|x| (table.at(x).0 - f(x)).abs())
                .fold(0.0, f64::max)
        };
        let order = (error(20) / error(40)).log2();
        assert!(order > 2.7, "{order}");
    }
}
