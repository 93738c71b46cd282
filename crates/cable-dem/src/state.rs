//! What the cable keeps from one pass to the next.

use crate::ends::{Balance, EndReader};
use crate::error::checked;
use crate::{CableError, DuctedCable, EndForces, Mesh};

/// The cable at rest: displacement and friction of every node, with no vehicle near.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CableState {
    /// Displacement u \[m\], positive toward growing x.
    pub(crate) displacement: Vec<f64>,
    /// Friction f on the cable per metre \[N/m\], positive toward growing x.
    pub(crate) friction: Vec<f64>,
}

impl CableState {
    /// A cable as laid: no displacement, no friction.
    pub fn at_rest(mesh: &Mesh) -> Self {
        Self {
            displacement: vec![0.0; mesh.nodes()],
            friction: vec![0.0; mesh.nodes()],
        }
    }

    /// A cable at rest with `displacement` u \[m\] and `friction` f \[N/m\] at every node. Whether they balance each other is
    /// for the solver to see: what is out of balance moves as soon as a vehicle passes.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] unless there is a value of each for every node of `mesh`,
    /// [`CableError::InvalidParameter`] unless all are finite.
    pub fn from_parts(mesh: &Mesh, displacement: Vec<f64>, friction: Vec<f64>) -> Result<Self, CableError> {
        for (name, values) in [("displacement", &displacement), ("friction", &friction)] {
            if values.len() != mesh.nodes() {
                return Err(CableError::StateMismatch {
                    found: values.len(),
                    expected: mesh.nodes(),
                });
            }
            for &value in values {
                checked(name, value, "finite", |_| true)?;
            }
        }
        Ok(Self {
            displacement,
            friction,
        })
    }

    /// Displacement u of every node \[m\].
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Friction f on the cable at every node \[N/m\].
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// Force in every element \[N\], compression positive: F = −EA u′.
    pub fn element_forces<'a>(&'a self, cable: &DuctedCable, mesh: &Mesh) -> impl Iterator<Item = f64> + 'a {
        let stiffness = cable.axial_stiffness() / mesh.spacing();
        self.displacement
            .windows(2)
            .map(move |pair| stiffness * (pair[0] - pair[1]))
    }

    /// Force \[N\] on what holds each end, compression positive: the reading of a load cell there. What clamps on the same
    /// node carry is not part of it.
    pub fn end_forces(&self, cable: &DuctedCable, mesh: &Mesh) -> EndForces {
        EndReader::new(cable, mesh).read(Balance::AtRest, |i| self.displacement[i], |i| self.friction[i])
    }

    /// Force \[N\] of the cable on each of its clamps, positive toward growing x, in the order of
    /// [`DuctedCable::restraints`].
    pub fn restraint_forces(&self, cable: &DuctedCable, mesh: &Mesh) -> Vec<f64> {
        cable
            .restraints()
            .iter()
            .map(|restraint| {
                let springs = restraint.by_node(mesh).into_iter();
                springs
                    .map(|(node, stiffness)| stiffness * self.displacement[node])
                    .sum()
            })
            .collect()
    }

    /// Lets go of all friction: the cable returns to where its ends and clamps want it, or, held by none, keeps its mean
    /// position.
    pub(crate) fn release(&mut self, cable: &DuctedCable) {
        let held = [cable.upstream(), cable.downstream()]
            .iter()
            .any(|end| end.stiffness() != Some(0.0))
            || cable
                .restraints()
                .iter()
                .any(|restraint| restraint.stiffness > 0.0);
        let rest = if held {
            0.0
        } else {
            self.displacement.iter().sum::<f64>() / self.displacement.len() as f64
        };
        self.displacement.fill(rest);
        self.friction.fill(0.0);
    }

    pub(crate) fn check(&self, mesh: &Mesh) -> Result<(), CableError> {
        if self.displacement.len() == mesh.nodes() && self.friction.len() == mesh.nodes() {
            Ok(())
        } else {
            Err(CableError::StateMismatch {
                found: self.displacement.len(),
                expected: mesh.nodes(),
            })
        }
    }

    /// The same state seen in a mirror across the duct's middle.
    pub(crate) fn mirror(&mut self) {
        for values in [&mut self.displacement, &mut self.friction] {
            values.reverse();
            for value in values.iter_mut() {
                *value = -*value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_given_state_must_fit_its_mesh_and_be_finite() -> Result<(), CableError> {
        let mesh = Mesh::new(1.0, 0.5, 0.5)?;
        let state = CableState::from_parts(&mesh, vec![0.0, 1.0, 2.0], vec![3.0; 3])?;
        assert_eq!((state.displacement()[2], state.friction()[0]), (2.0, 3.0));
        let short = CableState::from_parts(&mesh, vec![0.0; 2], vec![0.0; 3]);
        assert_eq!(
            short,
            Err(CableError::StateMismatch {
                found: 2,
                expected: 3
            })
        );
        assert!(CableState::from_parts(&mesh, vec![0.0; 3], vec![0.0, f64::NAN, 0.0]).is_err());
        Ok(())
    }
}
