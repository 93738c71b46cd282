//! One mesh of the ground, factored, with its solutions under unit loads.
//!
//! # Far boundary
//!
//! On a half-space the outer boundary (`r` = L and `z` = L) moves as the closed form of the base alone, the leading term of
//! the exact far field; what it misses is of relative order (l/L)², with l the ground's own length, tens of thousandths at
//! the L chosen. The error estimate sees it, since the meshes compared differ in L. A rigid base is held, and so is the
//! outer radius above it, where the field has died out.

use std::collections::HashMap;

use ground_field::{Base, Displacement, Soil, SoilProfile};

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
    profile: SoilProfile,
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
    /// Solutions u* under a unit load by the bits of the contact radius.
    pub solutions: HashMap<u64, Vec<f64>>,
}

/// The soil of a layer (the base comes last) at a depth.
fn soil_at(profile: &SoilProfile, lines: &Lines, layer: usize, depth: f64) -> Soil {
    match profile.base() {
        Base::HalfSpace(soil) if layer >= profile.layers().len() => soil,
        // No row of elements lies in rock.
        _ => profile.layers()[layer].soil_at(depth - lines.tops[layer]),
    }
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
        let mut prescribed = vec![false; mesh.dofs()];
        let mut far_displacement = vec![0.0; mesh.dofs()];
        for (index, &[r, z]) in mesh.nodes.iter().enumerate() {
            let (column, row) = (index % width, index / width);
            if column + 1 == width || row + 1 == rows.len() {
                prescribed[2 * index] = true;
                prescribed[2 * index + 1] = true;
                if let Some(far) = far {
                    let u = far.displacement(r, z);
                    far_displacement[2 * index] = u.radial;
                    far_displacement[2 * index + 1] = u.vertical;
                }
            } else if column == 0 {
                prescribed[2 * index] = true;
            }
        }
        let across = mesh.across;
        let system = System::new(mesh, &prescribed, |element, _, z| {
            let layer = lines.layer_of_row[element / across];
            Elasticity::new(soil_at(profile, &lines, layer, z))
        })?;
        Ok(Self {
            near: HalfSpace::new(soil_at(profile, &lines, 0, 0.0)),
            far,
            profile: profile.clone(),
            lines,
            columns,
            rows,
            system,
            rounding,
            far_displacement,
            solutions: HashMap::new(),
        })
    }

    /// The solution u* under a unit load.
    fn solve(&self, contact_radius: f64) -> Result<Vec<f64>, FemError> {
        let force = if contact_radius == 0.0 {
            load::point(&self.system, &self.lines, self.near, |z| {
                soil_at(&self.profile, &self.lines, 0, z).young_modulus()
            })
        } else {
            load::disc(&self.system.mesh, &self.lines, contact_radius)
        };
        self.system.solve(&force, &self.far_displacement, self.rounding)
    }

    /// Displacement along r at one depth under a unit load, which is solved for at its first use.
    pub(crate) fn line(&mut self, contact_radius: f64, depth: f64) -> Result<DepthLine, FemError> {
        let bottom = self.rows[self.rows.len() - 1];
        if depth >= bottom {
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
        let in_block = depth < self.lines.depths[self.lines.block_rows] && contact_radius == 0.0;
        let near = self.near;
        let last_column = 2 * self.lines.block_columns;
        let edge = if in_block {
            load::edge_displacement(&self.system.mesh, &self.lines, near)
        } else {
            Vec::new()
        };
        let values = self
            .columns
            .iter()
            .enumerate()
            .map(|(column, &r)| {
                let mut u = Displacement::ZERO;
                for &(row, weight) in &weights {
                    let node = column + row * width;
                    u += at_node(solution, node) * weight;
                    // Inside the block the unknown is the difference already; on its edge it is made one.
                    if in_block && column <= last_column {
                        u += at_node(&edge, node) * -weight;
                    }
                }
                if in_block && column > last_column {
                    u = u - near.displacement(r, depth);
                }
                u
            })
            .collect::<Vec<_>>();
        Ok(DepthLine::new(
            &self.columns,
            self.lines.scale,
            &values,
            in_block.then_some(near),
            self.far,
            depth,
        ))
    }

    /// Node rows and Lagrange weights that interpolate at `depth`, all in the layer (or the block) it lies in.
    fn depth_weights(&self, depth: f64) -> Vec<(usize, f64)> {
        let lines = &self.lines;
        let element_row = lines
            .depths
            .partition_point(|&line| line <= depth)
            .clamp(1, lines.layer_of_row.len())
            - 1;
        let same = |row: usize| {
            lines.layer_of_row[row] == lines.layer_of_row[element_row]
                && (row < lines.block_rows) == (element_row < lines.block_rows)
        };
        let first = 2
            * (0..=element_row)
                .rev()
                .take_while(|&row| same(row))
                .last()
                .unwrap_or(element_row);
        let last = 2
            * (element_row..lines.layer_of_row.len())
                .take_while(|&row| same(row))
                .last()
                .unwrap_or(element_row)
            + 2;
        let count = ROWS_IN_DEPTH.min(last - first + 1);
        let nearest = (first..=last)
            .min_by(|&a, &b| {
                (self.rows[a] - depth)
                    .abs()
                    .total_cmp(&(self.rows[b] - depth).abs())
            })
            .unwrap_or(first);
        let start = nearest.saturating_sub(count / 2).clamp(first, last + 1 - count);
        (start..start + count)
            .map(|row| {
                let weight = (start..start + count)
                    .filter(|&other| other != row)
                    .map(|other| (depth - self.rows[other]) / (self.rows[row] - self.rows[other]))
                    .product();
                (row, weight)
            })
            .collect()
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
    use crate::system::LEAST_CHANGE;
    use ground_field::Soil;

    #[test]
    fn whole_model_converges_with_the_order_of_its_elements() {
        let soil = Soil::new(80e6, 0.35).unwrap();
        let profile = SoilProfile::half_space(soil);
        let exact = HalfSpace::new(soil);
        // Largest error of u_r over depths and radii, each depth by its own peak.
        let error = |parts: usize| {
            let lines = Lines::new(&profile, 0.4, parts, usize::MAX).unwrap();
            let mut level = Level::new(&profile, LEAST_CHANGE, lines).unwrap();
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
