//! What the cable keeps from one pass to the next.

use crate::ends::{Balance, EndReader};
use crate::error::checked;
use crate::{CableError, DuctedCable, EndForces, Mesh, Restraint};

/// A clamp nearer to a node than this share of the spacing counts as on it.
const AT_NODE: f64 = 1e-6;

/// The cable at rest: displacement and friction of every node, with no vehicle near.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Parts"))]
pub struct CableState {
    /// Displacement u \[m\], positive toward growing x.
    pub(crate) displacement: Vec<f64>,
    /// Friction f on the cable per metre \[N/m\], positive toward growing x.
    pub(crate) friction: Vec<f64>,
}

/// A state as it is stored, before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Parts {
    displacement: Vec<f64>,
    friction: Vec<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for CableState {
    type Error = CableError;

    fn try_from(parts: Parts) -> Result<Self, CableError> {
        let nodes = parts.displacement.len();
        Self::of_nodes(nodes, parts.displacement, parts.friction)
    }
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
        Self::of_nodes(mesh.nodes(), displacement, friction)
    }

    fn of_nodes(expected: usize, displacement: Vec<f64>, friction: Vec<f64>) -> Result<Self, CableError> {
        for (name, values) in [("displacement", &displacement), ("friction", &friction)] {
            let found = values.len();
            if found != expected {
                return Err(CableError::StateMismatch { found, expected });
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
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] for a mesh of another size, [`CableError::InvalidParameter`] unless it is as long as the cable.
    pub fn element_forces<'a>(
        &'a self,
        cable: &DuctedCable,
        mesh: &Mesh,
    ) -> Result<impl Iterator<Item = f64> + 'a, CableError> {
        self.check_beside(cable, mesh)?;
        Ok(self.elements(cable, mesh))
    }

    /// Force \[N\] on what holds each end, compression positive: the reading of a load cell there. What clamps on the same
    /// node carry is not part of it.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn end_forces(&self, cable: &DuctedCable, mesh: &Mesh) -> Result<EndForces, CableError> {
        self.check_beside(cable, mesh)?;
        Ok(self.ends(cable, mesh))
    }

    /// Force \[N\] of the cable on each of its clamps, positive toward growing x, in the order of
    /// [`DuctedCable::restraints`].
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn restraint_forces(&self, cable: &DuctedCable, mesh: &Mesh) -> Result<Vec<f64>, CableError> {
        self.check_beside(cable, mesh)?;
        let on = |restraint: &Restraint| {
            let springs = restraint.by_node(mesh).into_iter();
            springs
                .map(|(node, stiffness)| stiffness * self.displacement[node])
                .sum()
        };
        Ok(cable.restraints().iter().map(on).collect())
    }

    /// Largest friction per metre \[N/m\] that the forces in the cable ask for: what is left of the difference between two
    /// neighbouring elements once clamps and end springs have taken their part, over the node's length of cable. More than the
    /// friction limit q is impossible at rest: then between any two points the force differs by at most q times their distance
    /// and what clamps between them carry.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn friction_needed(&self, cable: &DuctedCable, mesh: &Mesh) -> Result<f64, CableError> {
        self.check_beside(cable, mesh)?;
        let last = mesh.elements();
        let mut held = vec![0.0; mesh.nodes()];
        for (node, end) in [(0, cable.upstream()), (last, cable.downstream())] {
            held[node] += end.stiffness().unwrap_or(0.0);
        }
        for (node, stiffness) in cable.restraints().iter().flat_map(|clamp| clamp.by_node(mesh)) {
            held[node] += stiffness;
        }
        let mut before = 0.0;
        let after = self.elements(cable, mesh).chain([0.0]);
        let mut worst = 0.0_f64;
        for (node, after) in after.enumerate() {
            let fixed = (node == 0 && cable.upstream().stiffness().is_none())
                || (node == last && cable.downstream().stiffness().is_none());
            if !fixed {
                let friction =
                    (after - before + held[node] * self.displacement[node]) / mesh.tributary_length(node);
                worst = worst.max(friction.abs());
            }
            before = after;
        }
        Ok(worst)
    }

    /// Least and largest force along the cable \[N\]. Friction lets the force change evenly on either half of an element, so that it
    /// is largest in its middle, at a node, or beside a clamp, where it jumps. An element with a clamp within it is pulled from both sides: what its
    /// neighbours say of the force beside the clamp counts.
    pub(crate) fn extremes(&self, cable: &DuctedCable, mesh: &Mesh) -> (f64, f64) {
        let (h, f) = (mesh.spacing(), &self.friction);
        let stiffness = cable.axial_stiffness() / h;
        let force =
            |element: usize| stiffness * (self.displacement[element] - self.displacement[element + 1]);
        let before = |node: usize| force(node - 1) + 0.5 * h * f[node];
        let after = |node: usize| force(node) - 0.5 * h * f[node];
        let clamps = cable.restraints().iter().filter(|clamp| clamp.stiffness > 0.0);
        let places: Vec<(usize, f64)> = clamps
            .map(|clamp| mesh.place(clamp.position))
            .filter(|(_, share)| (AT_NODE..1.0 - AT_NODE).contains(share))
            .collect();
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut note = |force: f64| {
            least = least.min(force);
            largest = largest.max(force);
        };
        for element in 0..mesh.elements() {
            if !places.iter().any(|(clamped, _)| *clamped == element) {
                note(after(element));
                note(force(element));
                note(before(element + 1));
            }
        }
        for (element, share) in places {
            if element > 0 {
                note(before(element) + share * h * f[element]);
            }
            if element + 1 < mesh.elements() {
                note(after(element + 1) - (1.0 - share) * h * f[element + 1]);
            }
        }
        (least, largest)
    }

    /// [`CableState::element_forces`] on the mesh that this state is known to have.
    pub(crate) fn elements<'a>(&'a self, cable: &DuctedCable, mesh: &Mesh) -> impl Iterator<Item = f64> + 'a {
        let stiffness = cable.axial_stiffness() / mesh.spacing();
        self.displacement
            .windows(2)
            .map(move |pair| stiffness * (pair[0] - pair[1]))
    }

    /// [`CableState::end_forces`] on the mesh that this state is known to have.
    pub(crate) fn ends(&self, cable: &DuctedCable, mesh: &Mesh) -> EndForces {
        EndReader::new(cable, mesh).read(Balance::AtRest, |i| self.displacement[i], |i| self.friction[i])
    }

    fn check_beside(&self, cable: &DuctedCable, mesh: &Mesh) -> Result<(), CableError> {
        self.check(mesh)?;
        mesh.check_length(cable)
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
    use crate::{Friction, FrictionLaw};

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

    #[test]
    fn forces_are_read_on_the_state_s_own_mesh_alone() -> Result<(), CableError> {
        let friction = Friction::new(FrictionLaw::Coulomb, 1.0)?;
        let clamp = Restraint {
            position: 0.9,
            stiffness: 1.0,
        };
        let cable = DuctedCable::new(1.0, 1.0, friction)?.with_restraints(vec![clamp])?;
        let (coarse, fine) = (Mesh::new(1.0, 0.5, 0.5)?, Mesh::new(1.0, 0.125, 0.125)?);
        let mismatch = CableError::StateMismatch {
            found: 3,
            expected: 9,
        };
        let state = CableState::at_rest(&coarse);
        assert_eq!(state.end_forces(&cable, &fine), Err(mismatch.clone()));
        assert_eq!(state.restraint_forces(&cable, &fine), Err(mismatch.clone()));
        assert_eq!(state.element_forces(&cable, &fine).err(), Some(mismatch));
        // As many nodes, at another spacing.
        let longer = Mesh::new(2.0, 1.0, 1.0)?;
        assert!(state.element_forces(&cable, &longer).is_err());
        assert_eq!(state.element_forces(&cable, &coarse)?.count(), 2);
        Ok(())
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_stored_state_is_checked_as_it_is_read() -> Result<(), Box<dyn std::error::Error>> {
        let mesh = Mesh::new(1.0, 0.5, 0.5)?;
        let state = CableState::from_parts(&mesh, vec![0.0, 1.0, 2.0], vec![3.0; 3])?;
        let text = serde_json::to_string(&state)?;
        assert_eq!(serde_json::from_str::<CableState>(&text)?, state);
        for bad in [
            r#"{"displacement":[0,0,0,0,0],"friction":[]}"#,
            r#"{"displacement":[0,0],"friction":[0,0,0]}"#,
            r#"{"displacement":[0]}"#,
        ] {
            assert!(serde_json::from_str::<CableState>(bad).is_err(), "{bad}");
        }
        Ok(())
    }
}
