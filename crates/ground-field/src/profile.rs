//! A radial profile: one load's displacement at one depth, sampled adaptively and evaluated fast.

use crate::error::checked;
use crate::{Displacement, GroundError, GroundField, SurfaceLoad};

/// Interpolation nodes a cell.
const NODES: usize = 9;
/// Where a cell's interpolant is held against the model: extrema of the nodal polynomial, where its error is largest.
const CHECKS: [f64; 2] = [-0.939_692_620_785_908_4, 0.939_692_620_785_908_4];
/// Places a cell that show its bumps.
const PLACES: usize = 4;
/// Bisections after which a cell counts as not smooth.
const MAX_LEVEL: usize = 24;

type Series = [f64; NODES];

/// Displacement under a unit load at one depth, as a function of the radius.
///
/// A ground model may cost microseconds or milliseconds a point; a duct's motion needs thousands of points. The profile
/// asks the model at as few radii as the accuracy allows and interpolates between them with piecewise Chebyshev
/// polynomials. At depth z the field is analytic in r up to the complex points r = ±i z, so that cells as wide as
/// their distance to these converge geometrically (L. N. Trefethen, Approximation Theory and Approximation Practice,
/// SIAM 2013, theorem 8.2); where a layer or a contact patch asks for more, cells are bisected.
///
/// Interpolated is u_r / r rather than u_r: it is even and smooth through the axis, and the components along a duct
/// follow from it without a division.
///
/// ```
/// use ground_field::{Displacement, GroundError, GroundField, RadialProfile, SurfaceLoad};
///
/// struct Bowl;
///
/// impl GroundField for Bowl {
///     fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
///         let distance = radius.hypot(depth);
///         Ok(Displacement { radial: load.force() * radius * depth / distance.powi(3), vertical: load.force() / distance })
///     }
/// }
///
/// let profile = RadialProfile::sample(&Bowl, 0.0, 1.2, 20.0, 1e-6)?;
/// let exact = 1.0 / 2.5_f64.hypot(1.2);
/// assert!((profile.displacement(2.5).vertical - exact).abs() < 1e-6 / 1.2);
/// # Ok::<(), GroundError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RadialProfile {
    /// Left ends of the cells, ascending from 0, and the end of the last one.
    edges: Vec<f64>,
    cells: Vec<Cell>,
    samples: usize,
}

/// Chebyshev coefficients of one cell.
#[derive(Debug, Clone)]
struct Cell {
    /// u_r / r.
    ratio: Series,
    /// d(u_r / r)/dr.
    ratio_slope: Series,
    /// u_z.
    vertical: Series,
}

/// The profile at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ProfilePoint {
    /// u_r / r.
    pub ratio: f64,
    /// d(u_r / r)/dr.
    pub ratio_slope: f64,
    /// u_z.
    pub vertical: f64,
}

impl RadialProfile {
    /// Samples `field` under a unit load (1 N) on a disc of `contact_radius` \[m\] at `depth` \[m\], for radii up to
    /// `reach` \[m\], to `accuracy` as a share of the largest |u_r| and |u_z| at that depth.
    ///
    /// Beyond `reach`, and at least two depths, the profile is zero.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] for an argument out of range, [`GroundError::Accuracy`] where the field is not
    /// smooth enough for the asked accuracy, and whatever the field returns.
    pub fn sample(
        field: &dyn GroundField,
        contact_radius: f64,
        depth: f64,
        reach: f64,
        accuracy: f64,
    ) -> Result<Self, GroundError> {
        checked("depth", depth, "finite and positive", |v| v > 0.0)?;
        checked("reach", reach, "finite and positive", |v| v > 0.0)?;
        checked("accuracy", accuracy, "between 1e-13 and 0.1", |v| {
            (1e-13..=0.1).contains(&v)
        })?;
        let load = SurfaceLoad::new(1.0, contact_radius)?;
        // A little more, so that rounding of the farthest radius stays inside.
        let end = 1.05 * reach.max(2.0 * depth);
        checked("reach", end, "finite and positive", |_| true)?;
        let mut sampler = Sampler {
            field,
            load,
            depth,
            accuracy,
            peak: Displacement::ZERO,
            samples: 0,
        };
        let found = sampler.refine(&initial_edges(depth, end))?;

        let mut edges: Vec<f64> = found.iter().map(|(start, _, _)| *start).collect();
        edges.push(end);
        Ok(Self {
            edges,
            cells: found.into_iter().map(|(_, _, cell)| cell).collect(),
            samples: sampler.samples,
        })
    }

    /// Displacement under the unit load at `radius` \[m\].
    pub fn displacement(&self, radius: f64) -> Displacement {
        // Across the axis lies the field of the other side.
        let point = self.at(radius.abs());
        Displacement {
            radial: point.ratio * radius,
            vertical: point.vertical,
        }
    }

    /// How many radii the ground model was asked for.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Radii, a few in every cell, between which the profile has at most one bump; the axis is one.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        let share = |k: usize| k as f64 / PLACES as f64;
        self.edges
            .windows(2)
            .flat_map(move |ends| (0..PLACES).map(move |k| ends[0] + (ends[1] - ends[0]) * share(k)))
    }

    pub(crate) fn at(&self, radius: f64) -> ProfilePoint {
        let index = self.edges.partition_point(|&edge| edge <= radius).max(1) - 1;
        let Some(cell) = self.cells.get(index) else {
            return ProfilePoint::default();
        };
        let (start, stop) = (self.edges[index], self.edges[index + 1]);
        let t = (2.0 * radius - start - stop) / (stop - start);
        ProfilePoint {
            ratio: clenshaw(&cell.ratio, t),
            ratio_slope: clenshaw(&cell.ratio_slope, t),
            vertical: clenshaw(&cell.vertical, t),
        }
    }
}

/// Asks the model, cell by cell, until every cell is accurate.
struct Sampler<'a> {
    field: &'a dyn GroundField,
    load: SurfaceLoad,
    depth: f64,
    accuracy: f64,
    peak: Displacement,
    samples: usize,
}

impl Sampler<'_> {
    /// Bisects the cells between `edges` until all are accurate; returns them in order with their ends.
    /// All new radii of one round go to the model in one call, which may share work among them.
    fn refine(&mut self, edges: &[f64]) -> Result<Vec<(f64, f64, Cell)>, GroundError> {
        let mut pending: Vec<(f64, f64)> = edges.windows(2).map(|pair| (pair[0], pair[1])).collect();
        let mut done = Vec::new();
        for level in 0..=MAX_LEVEL {
            let radii: Vec<f64> = pending
                .iter()
                .flat_map(|&(start, stop)| {
                    (0..NODES)
                        .map(node)
                        .chain(CHECKS)
                        .map(move |t| 0.5 * (start + stop) + 0.5 * (stop - start) * t)
                })
                .collect();
            let values = self.field.displacements(self.load, &radii, self.depth)?;
            self.samples += radii.len();
            for value in &values {
                self.peak.radial = self.peak.radial.max(value.radial.abs());
                self.peak.vertical = self.peak.vertical.max(value.vertical.abs());
            }
            let mut next = Vec::new();
            let mut worst = (0.0_f64, 0.0_f64);
            for (index, &(start, stop)) in pending.iter().enumerate() {
                let range = index * (NODES + CHECKS.len())..(index + 1) * (NODES + CHECKS.len());
                let cell = Cell::fit(start, stop, &radii[range.clone()], &values[range.clone()]);
                let error = self.error(&cell, &radii[range.clone()], &values[range]);
                if error <= self.accuracy {
                    done.push((start, stop, cell));
                } else {
                    if error > worst.0 || !error.is_finite() {
                        worst = (error, start);
                    }
                    let middle = 0.5 * (start + stop);
                    next.extend([(start, middle), (middle, stop)]);
                }
            }
            if next.is_empty() {
                done.sort_by(|a, b| a.0.total_cmp(&b.0));
                return Ok(done);
            }
            if level == MAX_LEVEL || next.len() > 20_000 {
                return Err(GroundError::Accuracy {
                    model: "radial profile",
                    asked: self.accuracy,
                    reached: worst.0,
                    radius: worst.1,
                    depth: self.depth,
                });
            }
            pending = next;
        }
        unreachable!("the last level returns")
    }

    /// Largest error at the check points, as a share of the peaks.
    fn error(&self, cell: &Cell, radii: &[f64], values: &[Displacement]) -> f64 {
        let share = |difference: f64, peak: f64| {
            if difference == 0.0 {
                0.0
            } else {
                difference.abs() / peak
            }
        };
        (0..CHECKS.len()).fold(0.0, |worst: f64, check| {
            let (t, r, value) = (CHECKS[check], radii[NODES + check], values[NODES + check]);
            let radial = share(clenshaw(&cell.ratio, t) * r - value.radial, self.peak.radial);
            let vertical = share(clenshaw(&cell.vertical, t) - value.vertical, self.peak.vertical);
            // `f64::max` would drop a NaN, which must count as an error.
            if radial.is_finite() && vertical.is_finite() {
                worst.max(radial).max(vertical)
            } else {
                f64::INFINITY
            }
        })
    }
}

impl Cell {
    fn fit(start: f64, stop: f64, radii: &[f64], values: &[Displacement]) -> Self {
        let ratio = coefficients(|k| values[k].radial / radii[k]);
        Self {
            ratio_slope: derivative(&ratio, 2.0 / (stop - start)),
            ratio,
            vertical: coefficients(|k| values[k].vertical),
        }
    }
}

/// Cells that grow with their distance from the axis.
fn initial_edges(depth: f64, end: f64) -> Vec<f64> {
    let mut edges = vec![0.0];
    // A depth that is nothing beside the reach is left to bisection.
    let mut edge = (0.5 * depth).max(1e-12 * end);
    // Lengths too small to be added up make one cell.
    while edge > edges[edges.len() - 1] && edge < 0.999 * end {
        edges.push(edge);
        edge += (0.5 * depth).max(0.5 * edge);
    }
    edges.push(end);
    edges
}

/// Chebyshev node of the first kind.
fn node(k: usize) -> f64 {
    -((2 * k + 1) as f64 * std::f64::consts::PI / (2 * NODES) as f64).cos()
}

/// Chebyshev coefficients of the interpolant through `value` at the nodes.
fn coefficients(value: impl Fn(usize) -> f64) -> Series {
    let mut series = [0.0; NODES];
    for (degree, coefficient) in series.iter_mut().enumerate() {
        for k in 0..NODES {
            // T_j at node k, as nodes ascend from −1: cos(j (π − θ_k)).
            let angle =
                degree as f64 * (1.0 - (2 * k + 1) as f64 / (2 * NODES) as f64) * std::f64::consts::PI;
            *coefficient += value(k) * angle.cos();
        }
        *coefficient *= if degree == 0 { 1.0 } else { 2.0 } / NODES as f64;
    }
    series
}

/// Coefficients of the derivative with respect to t, times `scale`.
fn derivative(series: &Series, scale: f64) -> Series {
    let mut slope = [0.0; NODES];
    for degree in (1..NODES).rev() {
        let above = if degree + 1 < NODES {
            slope[degree + 1]
        } else {
            0.0
        };
        slope[degree - 1] = above + 2.0 * degree as f64 * series[degree];
    }
    slope[0] *= 0.5;
    slope.map(|coefficient| coefficient * scale)
}

/// Value of a Chebyshev series at t in [−1, 1].
fn clenshaw(series: &Series, t: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for &coefficient in series[1..].iter().rev() {
        (b1, b2) = (2.0 * t * b1 - b2 + coefficient, b1);
    }
    t * b1 - b2 + series[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_and_its_derivative_reproduce_a_polynomial() {
        let series = coefficients(|k| node(k).powi(5) - 2.0 * node(k));
        let slope = derivative(&series, 1.0);
        for t in [-1.0_f64, -0.3, 0.0, 0.77, 1.0] {
            assert!((clenshaw(&series, t) - (t.powi(5) - 2.0 * t)).abs() < 1e-14);
            assert!((clenshaw(&slope, t) - (5.0 * t.powi(4) - 2.0)).abs() < 1e-13);
        }
    }
}
