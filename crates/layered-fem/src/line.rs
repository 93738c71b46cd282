//! The displacement along r at one depth, made smooth.
//!
//! Finite elements give a continuous field whose slope jumps from element to element, while friction on a buried cable
//! follows the second difference of `u_r` along the duct. So the nodal values along the line, where quadratic elements are
//! most accurate, are joined by a cubic spline in s = asinh(r/c), the coordinate in which the nodes are nearly even: its first and
//! second derivatives are continuous (C. de Boor, *A Practical Guide to Splines* (1978), chapter IV). On the axis `u_r` is odd and
//! `u_z` even in r, which gives the end condition there; at the far end the spline is straight.
//!
//! Beyond the mesh the closed form of the base answers (zero above rock).

use ground_field::Displacement;

use crate::material::HalfSpace;

/// Displacement \[m/N\] along r at one depth.
#[derive(Debug, Clone)]
pub(crate) struct DepthLine {
    /// Stretched coordinate, value and second derivative in it, at each node.
    nodes: Vec<(f64, Displacement, Displacement)>,
    scale: f64,
    reach: f64,
    /// A closed form to be added to the interpolant.
    near: Option<HalfSpace>,
    far: Option<HalfSpace>,
    depth: f64,
}

impl DepthLine {
    /// A line through `values` at `radii`, the first of which is the axis; without any, the closed form answers everywhere.
    pub(crate) fn new(
        radii: &[f64],
        scale: f64,
        values: &[Displacement],
        near: Option<HalfSpace>,
        far: Option<HalfSpace>,
        depth: f64,
    ) -> Self {
        let stretched: Vec<f64> = radii.iter().map(|r| (r / scale).asinh()).collect();
        let bends = second_derivatives(&stretched, values);
        let nodes = stretched.into_iter().zip(values).zip(bends);
        Self {
            nodes: nodes.map(|((s, value), bend)| (s, *value, bend)).collect(),
            scale,
            reach: radii.last().copied().unwrap_or(0.0),
            near,
            far,
            depth,
        }
    }

    /// Displacement at radius `r` \[m/N\]; not finite at a point load.
    pub(crate) fn at(&self, r: f64) -> Displacement {
        let closed_form = |soil: HalfSpace| soil.displacement(r, self.depth);
        let outside = |soil: Option<HalfSpace>| soil.map_or(Displacement::ZERO, closed_form);
        if r >= self.reach {
            return outside(self.far);
        }
        let s = (r / self.scale).asinh();
        let right = self.nodes.partition_point(|node| node.0 <= s);
        let right = right.clamp(1, self.nodes.len() - 1);
        let ((start, u, bend), (end, next, next_bend)) = (self.nodes[right - 1], self.nodes[right]);
        let h = end - start;
        let (a, b) = ((end - s) / h, (s - start) / h);
        let chord = u * a + next * b;
        chord + (bend * (a * a * a - a) + next_bend * (b * b * b - b)) * (h * h / 6.0) + outside(self.near)
    }
}

/// Second derivatives at the nodes `s` of the spline through `values`, by elimination from the axis outward.
fn second_derivatives(s: &[f64], values: &[Displacement]) -> Vec<Displacement> {
    let mut bends = vec![Displacement::ZERO; s.len()];
    // What each node's second derivative is without that of its right neighbour, and its share in the latter.
    let mut shares = vec![Displacement::ZERO; s.len()];
    for k in 0..s.len().saturating_sub(1) {
        let (h, step) = (s[k + 1] - s[k], values[k + 1] - values[k]);
        let slope = step * (1.0 / h);
        if k == 0 {
            // u_r bends by nothing; u_z'(0) = 0, which is h (2 M₀ + M₁) / 6 = slope.
            bends[0].vertical = 3.0 * slope.vertical / h;
            shares[0].vertical = 0.5;
            continue;
        }
        let (left, before) = (s[k] - s[k - 1], values[k] - values[k - 1]);
        let right = (slope - before * (1.0 / left)) * 6.0 - bends[k - 1] * left;
        let pivot = shares[k - 1].map(|share| 2.0 * (left + h) - left * share);
        bends[k] = right.zip(pivot, |right, pivot| right / pivot);
        shares[k] = pivot.map(|pivot| h / pivot);
    }
    for k in (1..s.len()).rev() {
        let known = bends[k].zip(shares[k - 1], |bend, share| bend * share);
        bends[k - 1] = bends[k - 1] - known;
    }
    bends
}

#[cfg(test)]
mod tests {
    use ground_field::Displacement;

    use super::DepthLine;

    /// Values 0, 1, 0 at s = 0, 1, 2, by hand. u_r: M₀ = M₂ = 0 and 4 M₁ = −12. u_z, level on the axis: 2 M₀ + M₁ = 6 and
    /// M₀ + 4 M₁ = −12. In the middle of an interval the spline is off its chord by −(M + M')/16.
    #[test]
    fn a_spline_of_three_nodes_is_that_of_its_definition() {
        let [radii, values] = [[0.0_f64, 1.0, 2.0].map(|s| 3.0 * s.sinh()), [0.0, 1.0, 0.0]];
        let values = values.map(|value| Displacement {
            radial: value,
            vertical: value,
        });
        let line = DepthLine::new(&radii, 3.0, &values, None, None, 1.0);
        let expected = [
            (0.5, 0.5 + 3.0 / 16.0, 0.5 - (36.0 - 30.0) / 7.0 / 16.0),
            (1.5, 0.5 + 3.0 / 16.0, 0.5 + 30.0 / 7.0 / 16.0),
        ];
        for (s, radial, vertical) in expected {
            let found = line.at(3.0 * f64::sinh(s));
            assert!((found.radial - radial).abs() < 1e-12, "{found:?}");
            assert!((found.vertical - vertical).abs() < 1e-12, "{found:?}");
        }
    }
}
