//! The displacement along r at one depth, made smooth.
//!
//! Finite elements give a continuous field whose slope jumps from element to element, while friction on a buried cable
//! follows the second difference of `u_r` along the duct. So the nodal values along the line, where quadratic elements are
//! most accurate, are joined by a curve with continuous first and second derivatives: a quintic Hermite interpolant in
//! s = asinh(r/c), the coordinate in which the nodes are nearly even, with the derivatives of the polynomial through the
//! seven nearest nodes. The axis needs no one-sided stencil, since `u_r` is odd and `u_z` even in r.
//!
//! Beyond the mesh the closed form of the base answers (zero above rock).

use ground_field::Displacement;

use crate::material::HalfSpace;

/// Nodes of the stencil that gives the derivatives.
const STENCIL: usize = 7;

/// Displacement \[m/N\] along r at one depth.
#[derive(Debug, Clone)]
pub(crate) struct DepthLine {
    /// Stretched coordinates of the nodes.
    stretched: Vec<f64>,
    scale: f64,
    reach: f64,
    /// Value, first and second derivative in s of `u_r` and `u_z` at each node.
    nodes: Vec<[[f64; 3]; 2]>,
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
        let nodes = (0..radii.len())
            .map(|k| derivatives(&stretched, values, k))
            .collect();
        Self {
            stretched,
            scale,
            reach: radii.last().copied().unwrap_or(0.0),
            nodes,
            near,
            far,
            depth,
        }
    }

    /// Displacement at radius `r` \[m/N\]; not finite at a point load.
    pub(crate) fn at(&self, r: f64) -> Displacement {
        let outside = |soil: Option<HalfSpace>| {
            soil.map_or(Displacement::ZERO, |soil| soil.displacement(r, self.depth))
        };
        if r >= self.reach {
            return outside(self.far);
        }
        let [radial, vertical] = self.interpolate((r / self.scale).asinh());
        Displacement { radial, vertical } + outside(self.near)
    }

    fn interpolate(&self, s: f64) -> [f64; 2] {
        let right = self
            .stretched
            .partition_point(|&x| x <= s)
            .clamp(1, self.stretched.len() - 1);
        let (start, end) = (self.stretched[right - 1], self.stretched[right]);
        let h = end - start;
        let t = (s - start) / h;
        // Quintic Hermite basis: value, slope and curvature at the left end; the right end by symmetry.
        let basis = |t: f64| {
            let w = (1.0 - t) * (1.0 - t) * (1.0 - t);
            [
                w * (1.0 + 3.0 * t + 6.0 * t * t),
                w * t * (1.0 + 3.0 * t),
                0.5 * w * t * t,
            ]
        };
        let (left, mirrored) = (basis(t), basis(1.0 - t));
        [0, 1].map(|c| {
            let (a, b) = (self.nodes[right - 1][c], self.nodes[right][c]);
            left[0] * a[0]
                + mirrored[0] * b[0]
                + h * (left[1] * a[1] - mirrored[1] * b[1])
                + h * h * (left[2] * a[2] + mirrored[2] * b[2])
        })
    }
}

/// Value and the first two derivatives at node `k` of the polynomial through the nearest nodes.
fn derivatives(s: &[f64], values: &[Displacement], k: usize) -> [[f64; 3]; 2] {
    let half = (STENCIL / 2) as isize;
    let last = s.len() as isize - 1;
    // Indices below zero are mirror images in the axis.
    let start = (k as isize - half).min(last + 1 - STENCIL as isize).max(-last);
    let mut places = [0.0; STENCIL];
    let mut samples = [[0.0; 2]; STENCIL];
    for (m, (place, sample)) in places.iter_mut().zip(&mut samples).enumerate() {
        let index = start + m as isize;
        let node = index.unsigned_abs().min(s.len() - 1);
        let sign = if index < 0 { -1.0 } else { 1.0 };
        *place = sign * s[node] - s[k];
        *sample = [sign * values[node].radial, values[node].vertical];
    }
    let weights = fornberg(&places);
    let own = [values[k].radial, values[k].vertical];
    [0, 1].map(|c| {
        let sum = |order: usize| {
            (0..STENCIL)
                .map(|m| weights[m][order] * samples[m][c])
                .sum::<f64>()
        };
        [own[c], sum(1), sum(2)]
    })
}

/// Weights of value, first and second derivative at 0 of the polynomial through `places`.
///
/// B. Fornberg, Mathematics of Computation 51 (1988) 699–706.
fn fornberg(places: &[f64; STENCIL]) -> [[f64; 3]; STENCIL] {
    let mut weights = [[0.0; 3]; STENCIL];
    weights[0][0] = 1.0;
    let mut previous = 1.0;
    for i in 1..STENCIL {
        let lower = |weight: [f64; 3]| [0.0, weight[0], 2.0 * weight[1]];
        let product: f64 = places[..i].iter().map(|place| places[i] - place).product();
        let last = weights[i - 1];
        for (m, lower) in lower(last).into_iter().enumerate() {
            weights[i][m] = previous / product * (lower - places[i - 1] * last[m]);
        }
        for (weight, place) in weights.iter_mut().zip(&places[..i]) {
            let lower = lower(*weight);
            for m in 0..3 {
                weight[m] = (places[i] * weight[m] - lower[m]) / (places[i] - place);
            }
        }
        previous = product;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use ground_field::Soil;

    #[test]
    fn weights_differentiate_a_polynomial_exactly() {
        let places = [-2.1, -1.3, -0.4, 0.0, 0.7, 1.1, 2.6];
        let weights = fornberg(&places);
        let polynomial = |x: f64| 1.0 + x * (2.0 + x * (-1.5 + x * (0.3 + x * x * 0.1)));
        let sum = |m: usize| {
            (0..STENCIL)
                .map(|i| weights[i][m] * polynomial(places[i]))
                .sum::<f64>()
        };
        assert_relative_eq!(sum(1), 2.0, max_relative = 1e-12);
        assert_relative_eq!(sum(2), -3.0, max_relative = 1e-12);
    }

    #[test]
    fn line_reproduces_smooth_values_and_their_second_difference() {
        let radii: Vec<f64> = (0..60).map(|k| 0.15 * (0.1 * f64::from(k)).sinh()).collect();
        let soil = HalfSpace::new(Soil::new(1.0, 0.3).unwrap());
        let values: Vec<Displacement> = radii.iter().map(|&r| soil.displacement(r, 1.2)).collect();
        let line = DepthLine::new(&radii, 0.15, &values, None, Some(soil), 1.2);
        for k in 0..100 {
            let r = 0.0433 * f64::from(k);
            let exact = soil.displacement(r, 1.2);
            assert_relative_eq!(line.at(r).radial, exact.radial, epsilon = 1e-5);
            assert_relative_eq!(line.at(r).vertical, exact.vertical, epsilon = 1e-5);
        }
    }
}
