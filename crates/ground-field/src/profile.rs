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
/// Cells in one round after which the field counts as not smooth.
const MAX_CELLS: usize = 20_000;

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
    /// Ascending from the axis, each beginning where the last one ends.
    cells: Vec<Cell>,
    samples: usize,
}

/// Chebyshev coefficients between two radii.
#[derive(Debug, Clone)]
struct Cell {
    start: f64,
    stop: f64,
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

impl ProfilePoint {
    fn displacement(self, radius: f64) -> Displacement {
        Displacement {
            radial: self.ratio * radius,
            vertical: self.vertical,
        }
    }
}

impl RadialProfile {
    /// Samples `field` under a unit load (1 N) on a disc of `contact_radius` \[m\] at `depth` \[m\], for radii up to
    /// `reach` \[m\], to `accuracy` as a share of the largest |u_r| and |u_z| at that depth.
    ///
    /// Beyond `reach`, and at least two depths, the profile is zero.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] for an argument out of range, [`GroundError::Accuracy`] if the field is not
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
        let edges = initial_edges(depth, end);
        let mut pending: Vec<(f64, f64)> = edges.windows(2).map(|pair| (pair[0], pair[1])).collect();
        let (mut cells, mut samples, mut peak) = (Vec::new(), 0, Displacement::ZERO);
        let mut worst = (0.0_f64, 0.0);
        for _ in 0..=MAX_LEVEL {
            // All new radii of one round go to the model in one call, which may share work among them.
            let shares = || (0..NODES).map(node).chain(CHECKS);
            let radii: Vec<f64> = pending
                .iter()
                .flat_map(|(start, stop)| {
                    shares().map(move |t| 0.5 * (start + stop) + 0.5 * (stop - start) * t)
                })
                .collect();
            let values = field.displacements(load, &radii, depth)?;
            samples += radii.len();
            for value in &values {
                peak = peak.zip(*value, |peak, value| peak.max(value.abs()));
            }
            worst = (0.0, 0.0);
            let size = NODES + CHECKS.len();
            let asked = radii.chunks(size).zip(values.chunks(size));
            for ((start, stop), (radii, values)) in std::mem::take(&mut pending).into_iter().zip(asked) {
                let cell = Cell::fit(start, stop, radii, values);
                let error = cell.error(&radii[NODES..], &values[NODES..], peak);
                if error <= accuracy {
                    cells.push(cell);
                    continue;
                }
                if error > worst.0 {
                    worst = (error, start);
                }
                let middle = 0.5 * (start + stop);
                pending.extend([(start, middle), (middle, stop)]);
            }
            if pending.is_empty() {
                cells.sort_by(|a, b| a.start.total_cmp(&b.start));
                return Ok(Self { cells, samples });
            }
            if pending.len() > MAX_CELLS {
                break;
            }
        }
        Err(GroundError::Accuracy {
            model: "radial profile",
            asked: accuracy,
            reached: worst.0,
            radius: worst.1,
            depth,
        })
    }

    /// Displacement under the unit load at `radius` \[m\].
    pub fn displacement(&self, radius: f64) -> Displacement {
        // Across the axis lies the field of the other side.
        self.at(radius.abs()).displacement(radius)
    }

    /// How many radii the ground model was asked for.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Radii, a few in every cell, between which the profile has at most one bump; the axis is one.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        let share = |k: usize| k as f64 / PLACES as f64;
        self.cells
            .iter()
            .flat_map(move |cell| (0..PLACES).map(move |k| cell.start + (cell.stop - cell.start) * share(k)))
    }

    pub(crate) fn at(&self, radius: f64) -> ProfilePoint {
        let index = self.cells.partition_point(|cell| cell.stop <= radius);
        let cell = self.cells.get(index);
        cell.map_or_else(ProfilePoint::default, |cell| cell.at(radius))
    }
}

impl Cell {
    fn fit(start: f64, stop: f64, radii: &[f64], values: &[Displacement]) -> Self {
        let ratio = coefficients(|k| values[k].radial / radii[k]);
        Self {
            start,
            stop,
            ratio_slope: derivative(&ratio).map(|slope| slope * 2.0 / (stop - start)),
            ratio,
            vertical: coefficients(|k| values[k].vertical),
        }
    }

    fn at(&self, radius: f64) -> ProfilePoint {
        let t = (2.0 * radius - self.start - self.stop) / (self.stop - self.start);
        ProfilePoint {
            ratio: clenshaw(&self.ratio, t),
            ratio_slope: clenshaw(&self.ratio_slope, t),
            vertical: clenshaw(&self.vertical, t),
        }
    }

    /// Largest difference to `values` at `radii`, as a share of the `peak`.
    fn error(&self, radii: &[f64], values: &[Displacement], peak: Displacement) -> f64 {
        // `f64::max` would drop a NaN, which must count as an error.
        let share = |difference: f64, peak: f64| match (difference / peak).abs() {
            _ if difference == 0.0 => 0.0,
            share if share.is_finite() => share,
            _ => f64::INFINITY,
        };
        radii
            .iter()
            .zip(values)
            .fold(0.0, |worst: f64, (&radius, value)| {
                let shares = (self.at(radius).displacement(radius) - *value).zip(peak, share);
                worst.max(shares.radial).max(shares.vertical)
            })
    }
}

/// Cells that grow with their distance from the axis.
fn initial_edges(depth: f64, end: f64) -> Vec<f64> {
    let mut edges = vec![0.0];
    // A depth that is nothing relative to the reach is left to bisection.
    let mut edge = (0.5 * depth).max(1e-12 * end);
    // Lengths too small to be added up make one cell.
    while edge > edges[edges.len() - 1] && edge < 0.999 * end {
        edges.push(edge);
        edge += (0.5 * depth).max(0.5 * edge);
    }
    edges.push(end);
    edges
}

/// The angle whose cosine is the `k`-th Chebyshev node of the first kind, which ascend from −1.
fn angle(k: usize) -> f64 {
    std::f64::consts::PI * (1.0 - (2 * k + 1) as f64 / (2 * NODES) as f64)
}

fn node(k: usize) -> f64 {
    angle(k).cos()
}

/// Chebyshev coefficients of the interpolant through `value` at the nodes.
fn coefficients(value: impl Fn(usize) -> f64) -> Series {
    std::array::from_fn(|degree| {
        let term = |k| value(k) * (degree as f64 * angle(k)).cos();
        let sum: f64 = (0..NODES).map(term).sum();
        sum * if degree == 0 { 1.0 } else { 2.0 } / NODES as f64
    })
}

/// Chebyshev coefficients of the derivative: d_(k−1) = d_(k+1) + 2 k c_k.
fn derivative(series: &Series) -> Series {
    let mut slope = [0.0; NODES];
    let (mut next, mut last) = (0.0, 0.0);
    for k in (1..NODES).rev() {
        (next, last) = (last, next + 2.0 * k as f64 * series[k]);
        slope[k - 1] = last;
    }
    slope[0] *= 0.5;
    slope
}

/// Value of a Chebyshev series at t in [−1, 1].
fn clenshaw(series: &Series, t: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for &coefficient in series[1..].iter().rev() {
        (b1, b2) = (2.0 * t * b1 - b2 + coefficient, b1);
    }
    t * b1 - b2 + series[0]
}
