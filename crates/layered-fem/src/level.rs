//! One mesh of the ground, factored, with its solutions under unit loads.
//!
//! # Far boundary
//!
//! On a half-space the outer boundary (`r` = L and `z` = L) moves as the closed form of the base alone, the leading term of
//! the exact far field; what it misses is of relative order (l/L)², with l the ground's own length, tens of thousandths at
//! the L chosen. The error estimate sees it, since the meshes compared differ in L. A rigid base is held, and so is the
//! outer radius above it, where the field has died out.

use std::collections::HashMap;

use ground_field::{Base, Displacement, SoilProfile};

use crate::FemError;
use crate::grading::Lines;
use crate::line::DepthLine;
use crate::load;
use crate::material::{Elasticity, HalfSpace};
use crate::mesh::{Mesh, with_midpoints};
use crate::system::System;

/// Node rows used to interpolate in depth.
const ROWS_IN_DEPTH: usize = 5;

/// A factored mesh.
#[derive(Debug)]
pub(crate) struct Level {
    pub lines: Lines,
    /// Radii of all columns of nodes.
    pub columns: Vec<f64>,
    /// Depths of all rows of nodes.
    rows: Vec<f64>,
    pub system: System,
    /// Largest change by which a solution may still be corrected.
    rounding: f64,
    /// The closed form with the soil at the surface.
    near: HalfSpace,
    /// The closed form with the base's soil; `None` over rock.
    far: Option<HalfSpace>,
    far_displacement: Vec<f64>,
    /// The closed form at the surface's soil, at the nodes on the block's boundary.
    edge: Vec<f64>,
    /// Solutions u* under a unit load by the bits of the contact radius.
    pub solutions: HashMap<u64, Vec<f64>>,
}

impl Level {
    pub(crate) fn new(profile: &SoilProfile, rounding: f64, lines: Lines) -> Result<Self, FemError> {
        let mesh = Mesh::rectangular(&lines.radii, &lines.depths);
        let (columns, rows) = (with_midpoints(&lines.radii), with_midpoints(&lines.depths));
        let far = match profile.base() {
            Base::HalfSpace(soil) => Some(HalfSpace::new(soil)),
            Base::Rigid => None,
        };
        let width = columns.len();
        let (mut prescribed, mut far_displacement) = (Vec::new(), Vec::new());
        for (index, &[r, z]) in mesh.nodes.iter().enumerate() {
            let (column, row) = (index % width, index / width);
            let is_outer = column + 1 == width || row + 1 == rows.len();
            prescribed.extend([is_outer || column == 0, is_outer]);
            let far = far.filter(|_| is_outer);
            let u = far.map_or(Displacement::ZERO, |far| far.displacement(r, z));
            far_displacement.extend([u.radial, u.vertical]);
        }
        let near = HalfSpace::new(lines.bands[0].soil_at(0.0));
        let edge = load::edge_displacement(&mesh, &lines, near);
        let across = mesh.across;
        let system = System::new(mesh, &prescribed, |element, _, z| {
            let band = lines.bands.partition_point(|band| band.end <= element / across);
            Elasticity::new(lines.bands[band].soil_at(z))
        })?;
        Ok(Self {
            lines,
            columns,
            rows,
            system,
            rounding,
            near,
            far,
            far_displacement,
            edge,
            solutions: HashMap::new(),
        })
    }

    /// The solution u* under a unit load.
    fn solve(&self, contact_radius: f64) -> Result<Vec<f64>, FemError> {
        let force = if contact_radius == 0.0 {
            load::point(&self.system, &self.lines, self.near, &self.edge)
        } else {
            load::disc(&self.system.mesh, &self.lines, contact_radius)
        };
        self.system.solve(&force, &self.far_displacement, self.rounding)
    }

    /// Displacement along r at one depth under a unit load, which is solved for at its first use.
    pub(crate) fn line(&mut self, contact_radius: f64, depth: f64) -> Result<DepthLine, FemError> {
        if self.rows.last().is_none_or(|&bottom| depth >= bottom) {
            // Below the mesh.
            return Ok(DepthLine::new(&[], 1.0, &[], None, self.far, depth));
        }
        let key = contact_radius.to_bits();
        if !self.solutions.contains_key(&key) {
            self.solutions.insert(key, self.solve(contact_radius)?);
        }
        let solution = &self.solutions[&key];
        let weights = self.depth_weights(depth);
        let width = self.columns.len();
        let in_block = depth < self.lines.depths[self.lines.bands[0].end] && contact_radius == 0.0;
        let value = |(column, &r): (usize, &f64)| {
            let mut u = Displacement::ZERO;
            for &(row, weight) in &weights {
                let node = column + row * width;
                u += at_node(solution, node) * weight;
                // Inside the block the unknown is the difference already; on its edge it is made one.
                if in_block {
                    u += at_node(&self.edge, node) * -weight;
                }
            }
            if in_block && column > 2 * self.lines.block_columns {
                u = u - self.near.displacement(r, depth);
            }
            u
        };
        let values: Vec<Displacement> = self.columns.iter().enumerate().map(value).collect();
        let near = in_block.then_some(self.near);
        let (columns, scale) = (&self.columns, self.lines.scale);
        Ok(DepthLine::new(columns, scale, &values, near, self.far, depth))
    }

    /// Node rows and Lagrange weights that interpolate at `depth`, all in the band it lies in.
    fn depth_weights(&self, depth: f64) -> Vec<(usize, f64)> {
        let (lines, rows) = (&self.lines, &self.rows);
        let here = lines.bands.partition_point(|band| rows[2 * band.end] <= depth);
        let (above, rest) = lines.bands.split_at(here);
        let [first, last] = [above.last(), rest.first()].map(|band| band.map_or(0, |band| 2 * band.end));
        let count = ROWS_IN_DEPTH.min(last - first + 1);
        let distance = |row: &usize| (rows[*row] - depth).abs();
        let nearest = (first..=last).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let start = nearest.map_or(first, |nearest| nearest.saturating_sub(count / 2));
        let stencil = (start.clamp(first, last + 1 - count)..).take(count);
        let weight = |row: usize| {
            let others = stencil.clone().filter(|&other| other != row);
            let factor = |other: usize| (depth - rows[other]) / (rows[row] - rows[other]);
            others.map(factor).product()
        };
        stencil.clone().map(|row| (row, weight(row))).collect()
    }
}

/// A node's entries of a vector over the degrees of freedom.
fn at_node(values: &[f64], node: usize) -> Displacement {
    Displacement {
        radial: values[2 * node],
        vertical: values[2 * node + 1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::MIN_CHANGE;
    use ground_field::Soil;

    #[test]
    fn whole_model_converges_with_the_order_of_its_elements() {
        let soil = Soil::new(80e6, 0.35).unwrap();
        let profile = SoilProfile::half_space(soil);
        let exact = HalfSpace::new(soil);
        // Largest error of u_r over depths and radii, each depth by its own peak.
        let error = |parts: usize| {
            let lines = Lines::new(&profile, 0.4, parts, usize::MAX).unwrap();
            let mut level = Level::new(&profile, MIN_CHANGE, lines).unwrap();
            let depths = (0..15).map(|k| 0.6 + 0.1 * f64::from(k));
            let shares = depths.map(|depth| {
                let line = level.line(0.0, depth).unwrap();
                let pairs = (0..100).map(|k| {
                    let r = 0.1 * f64::from(k);
                    (line.at(r).radial, exact.displacement(r, depth).radial)
                });
                let (gap, peak) = pairs.fold((0.0_f64, 0.0_f64), |(gap, peak), (found, truth)| {
                    (gap.max((found - truth).abs()), peak.max(truth.abs()))
                });
                gap / peak
            });
            shares.fold(0.0, f64::max)
        };
        let errors = [1, 2, 4].map(error);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 2.7, "order {order} of {errors:?}");
        }
    }
}
