//! One mesh of the ground, factored, with its solutions under unit loads.
//!
//! # Far boundary
//!
//! On a half-space the outer boundary (`r` = L and `z` = L) moves as the closed form of the base alone, the leading term of
//! the exact far field; what it misses is of relative order (l/L)², with l the ground's own length, tens of thousandths at
//! the L chosen. The error estimate sees it, since the meshes compared differ in L. A rigid base is held, and so is the
//! outer radius above it, where the field has died out.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use ground_field::{Base, SoilProfile};

use crate::FemError;
use crate::element::{Quadrilateral, Volumetric};
use crate::grading::Lines;
use crate::half_space::HalfSpace;
use crate::line::DepthLine;
use crate::load;
use crate::material::Elasticity;
use crate::mesh::{Mesh, with_midpoints};
use crate::system::{System, SystemSize, prescribed_force};

/// Node rows used to interpolate in depth.
const ROWS_IN_DEPTH: usize = 5;

/// Young's modulus and Poisson's ratio by layer index (the base is the last) and depth.
#[derive(Debug, Clone)]
struct Ground {
    profile: SoilProfile,
    tops: Vec<f64>,
}

impl Ground {
    fn new(profile: &SoilProfile) -> Self {
        let mut depth = 0.0;
        let tops = profile
            .layers()
            .iter()
            .map(|layer| {
                let top = depth;
                depth += layer.thickness();
                top
            })
            .collect();
        Self {
            profile: profile.clone(),
            tops,
        }
    }

    fn at(&self, layer: usize, depth: f64) -> (f64, f64) {
        match (self.profile.layers().get(layer), self.profile.base()) {
            (Some(soil), _) => (
                soil.young_modulus_at(depth - self.tops[layer]),
                soil.poisson_ratio(),
            ),
            (None, Base::HalfSpace(soil)) => (soil.young_modulus(), soil.poisson_ratio()),
            // No row of elements lies in rock.
            (None, Base::Rigid) => (f64::NAN, f64::NAN),
        }
    }

    /// The closed form with the soil at the surface.
    fn near(&self) -> HalfSpace {
        let (young_modulus, poisson_ratio) = self.at(0, 0.0);
        HalfSpace::new(young_modulus, poisson_ratio)
    }

    /// The closed form with the base's soil; `None` over rock.
    fn far(&self) -> Option<HalfSpace> {
        match self.profile.base() {
            Base::HalfSpace(soil) => Some(HalfSpace::new(soil.young_modulus(), soil.poisson_ratio())),
            Base::Rigid => None,
        }
    }
}

/// Moduli in `element` of a rectangular mesh of `kind` at depth `z`.
fn elasticity(ground: &Ground, lines: &Lines, kind: Quadrilateral, element: usize, z: f64) -> Elasticity {
    let across = (lines.radii.len() - 1) * kind.per_interval();
    let row = element / across / kind.per_interval();
    let (young_modulus, poisson_ratio) = ground.at(lines.layer_of_row[row], z);
    Elasticity::new(young_modulus, poisson_ratio)
}

/// A factored mesh.
#[derive(Debug)]
pub(crate) struct Level {
    ground: Ground,
    lines: Lines,
    mesh: Mesh,
    /// Radii of all columns of nodes.
    columns: Vec<f64>,
    /// Depths of all rows of nodes.
    rows: Vec<f64>,
    system: System,
    /// Largest change by which a solution may still be corrected.
    rounding: f64,
    far_displacement: Vec<f64>,
    far_force: Vec<f64>,
    /// Solutions u* under a unit load by the bits of the contact radius.
    solutions: Mutex<HashMap<u64, Arc<Vec<f64>>>>,
}

impl Level {
    pub(crate) fn new(
        profile: &SoilProfile,
        kind: Quadrilateral,
        rounding: f64,
        lines: Lines,
    ) -> Result<Self, FemError> {
        let ground = Ground::new(profile);
        let mesh = Mesh::rectangular(kind, &lines.radii, &lines.depths);
        let (columns, rows) = (with_midpoints(&lines.radii), with_midpoints(&lines.depths));
        let width = columns.len();
        let mut prescribed = vec![false; mesh.dofs()];
        let mut far_displacement = vec![0.0; mesh.dofs()];
        for (index, &[r, z]) in mesh.nodes().iter().enumerate() {
            let (column, row) = (index % width, index / width);
            if column + 1 == width || row + 1 == rows.len() {
                prescribed[2 * index] = true;
                prescribed[2 * index + 1] = true;
                if let Some(far) = ground.far() {
                    let u = far.displacement(r, z);
                    far_displacement[2 * index] = u[0];
                    far_displacement[2 * index + 1] = u[1];
                }
            } else if column == 0 {
                prescribed[2 * index] = true;
            }
        }
        let elasticity = |element: usize, _: f64, z: f64| elasticity(&ground, &lines, kind, element, z);
        let system = System::new(&mesh, Volumetric::Projected, &prescribed, elasticity)?;
        let across = (lines.radii.len() - 1) * kind.per_interval();
        let last_row = lines.layer_of_row.len() * kind.per_interval() - 1;
        let far_force = prescribed_force(
            &mesh,
            Volumetric::Projected,
            &far_displacement,
            |e| e % across == across - 1 || e / across == last_row,
            elasticity,
        )?;
        Ok(Self {
            ground,
            lines,
            mesh,
            columns,
            rows,
            system,
            rounding,
            far_displacement,
            far_force,
            solutions: Mutex::default(),
        })
    }

    /// Size of the factored system.
    pub(crate) fn size(&self) -> SystemSize {
        self.system.size()
    }

    /// Loads solved so far.
    pub(crate) fn solves(&self) -> usize {
        self.solutions
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .len()
    }

    /// Bytes held: matrix, factor, their indices, mesh and solutions.
    pub(crate) fn bytes(&self) -> usize {
        let size = self.size();
        16 * size.matrix_entries + 8 * size.factor_entries + self.mesh.dofs() * (8 * (4 + self.solves()) + 18)
    }

    /// The solution u* under a unit load, solved at its first use.
    fn solution(&self, contact_radius: f64) -> Result<Arc<Vec<f64>>, FemError> {
        let mut solutions = self.solutions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = solutions.get(&contact_radius.to_bits()) {
            return Ok(Arc::clone(found));
        }
        let mut force = if contact_radius == 0.0 {
            load::point(
                &self.mesh,
                &self.lines,
                Volumetric::Projected,
                self.ground.near(),
                |element, _, z| elasticity(&self.ground, &self.lines, self.mesh.kind(), element, z),
                |z| self.ground.at(0, z).0,
            )?
        } else {
            load::disc(&self.mesh, &self.lines, contact_radius)
        };
        for (value, far) in force.iter_mut().zip(&self.far_force) {
            *value += far;
        }
        let solved = Arc::new(
            self.system
                .solve_within(&force, &self.far_displacement, self.rounding)?,
        );
        solutions.insert(contact_radius.to_bits(), Arc::clone(&solved));
        Ok(solved)
    }

    /// Displacement along r at one depth under a unit load.
    pub(crate) fn line(&self, contact_radius: f64, depth: f64) -> Result<DepthLine, FemError> {
        let bottom = self.rows[self.rows.len() - 1];
        if depth >= bottom {
            return Ok(DepthLine::beyond(self.ground.far(), depth));
        }
        let solution = self.solution(contact_radius)?;
        let weights = self.depth_weights(depth);
        let width = self.columns.len();
        let in_block = depth < self.lines.depths[self.lines.block_rows] && contact_radius == 0.0;
        let near = self.ground.near();
        let last_column = 2 * self.lines.block_columns;
        let edge = if in_block {
            load::edge_displacement(&self.mesh, &self.lines, near)
        } else {
            Vec::new()
        };
        let values = self
            .columns
            .iter()
            .enumerate()
            .map(|(column, &r)| {
                let mut u = [0.0; 2];
                for &(row, weight) in &weights {
                    for (c, value) in u.iter_mut().enumerate() {
                        let dof = 2 * (column + row * width) + c;
                        // Inside the block the unknown is the difference already; on its edge it is made one.
                        let known = if in_block && column <= last_column {
                            edge[dof]
                        } else {
                            0.0
                        };
                        *value += weight * (solution[dof] - known);
                    }
                }
                if in_block && column > last_column {
                    let known = near.displacement(r, depth);
                    u = [u[0] - known[0], u[1] - known[1]];
                }
                u
            })
            .collect::<Vec<_>>();
        Ok(DepthLine::new(
            &self.columns,
            self.lines.scale,
            &values,
            in_block.then_some(near),
            self.ground.far(),
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

    /// Radii of the columns of nodes \[m\].
    pub(crate) fn columns(&self) -> &[f64] {
        &self.columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::LARGEST_CHANGE;
    use ground_field::Soil;

    #[test]
    fn whole_model_converges_with_the_order_of_its_elements() {
        let soil = Soil::new(80e6, 0.35).unwrap();
        let profile = SoilProfile::half_space(soil);
        let exact = HalfSpace::new(80e6, 0.35);
        // Largest error of u_r over depths and radii, each depth by its own peak.
        let error = |kind, parts: usize| {
            let lines = Lines::new(&profile, 0.4, parts, usize::MAX).unwrap();
            let level = Level::new(&profile, kind, LARGEST_CHANGE, lines).unwrap();
            let depths = (0..15).map(|k| 0.6 + 0.1 * f64::from(k));
            let shares = depths.map(|depth| {
                let line = level.line(0.0, depth).unwrap();
                let pairs = (0..100).map(|k| {
                    let r = 0.1 * f64::from(k);
                    (line.at(r).radial, exact.displacement(r, depth)[0])
                });
                let (gap, peak) = pairs.fold((0.0_f64, 0.0_f64), |(gap, peak), (found, truth)| {
                    (gap.max((found - truth).abs()), peak.max(truth.abs()))
                });
                gap / peak
            });
            shares.fold(0.0, f64::max)
        };
        for (kind, least) in [(Quadrilateral::Quadratic9, 2.7), (Quadrilateral::Linear4, 1.7)] {
            let errors = [1, 2, 4].map(|parts| error(kind, parts));
            for pair in errors.windows(2) {
                let order = (pair[0] / pair[1]).log2();
                assert!(order > least, "{kind:?}: order {order} of {errors:?}");
            }
        }
    }
}
