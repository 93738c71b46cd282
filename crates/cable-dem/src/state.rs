//! What the cable keeps from one pass to the next.

use friction_chain::Chain;

use crate::chain::{Bends, chain};
use crate::clamps::ClampShares;
use crate::ends::EndReader;
use crate::error::checked;
use crate::{CableError, DuctedCable, EndForces, Mesh, Restraint};

/// Rounding of the force in an element, as a share of the largest.
const ROUNDING: f64 = 1e-9;

/// Friction within this share of its limit counts as slipping.
const AT_LIMIT: f64 = 1e-6;

/// Lengths of cable over which the duct slips past it (Kashiro et al., Figure 7).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SlipLengths {
    /// Friction at its limit toward growing x \[m\].
    #[cfg_attr(feature = "serde", serde(rename = "forward_m"))]
    pub forward: f64,
    /// Friction at its limit toward falling x \[m\].
    #[cfg_attr(feature = "serde", serde(rename = "backward_m"))]
    pub backward: f64,
}

/// The cable at rest: displacement and friction of every node of its mesh, with no vehicle near.
///
/// ```
/// use cable_dem::{CableState, DuctedCable, Friction, FrictionLaw, Mesh};
///
/// let cable = DuctedCable::new(10.0, 8.01e6, Friction::new(FrictionLaw::Coulomb, 27.2)?)?;
/// let mesh = Mesh::for_depth(10.0, 1.2, 6.0)?;
/// // Pushed evenly by 1 mm over its length: F = −EA u′ everywhere.
/// let displacement = (0..mesh.nodes()).map(|i| -1e-4 * mesh.spacing() * i as f64).collect();
/// let state = CableState::from_parts(&mesh, displacement, vec![0.0; mesh.nodes()])?;
/// assert!(state.element_forces(&cable)?.all(|force| (force - 801.0).abs() < 1e-6));
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Stored"))]
pub struct CableState {
    /// The nodes, without the vehicle's steps.
    #[cfg_attr(feature = "serde", serde(rename = "node_spacing", serialize_with = "spacing"))]
    mesh: Mesh,
    /// Displacement u \[m\], positive toward growing x.
    pub(crate) displacement: Vec<f64>,
    /// Friction f on the cable per metre \[N/m\], positive toward growing x.
    pub(crate) friction: Vec<f64>,
    /// Θ = EA α T \[N\].
    pub(crate) thermal_force: f64,
    /// How far each clamp has slipped on the nodes before and after it \[m\], positive toward growing x; those that are missing have not.
    pub(crate) clamp_slips: Vec<[f64; 2]>,
}

/// A state as it is read, not yet checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Stored {
    node_spacing: f64,
    displacement: Vec<f64>,
    friction: Vec<f64>,
    #[serde(default)]
    thermal_force: f64,
    #[serde(default)]
    clamp_slips: Vec<[f64; 2]>,
}

/// A state names the distance between its nodes.
#[cfg(feature = "serde")]
fn spacing<S: serde::Serializer>(mesh: &Mesh, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(mesh.spacing())
}

#[cfg(feature = "serde")]
impl TryFrom<Stored> for CableState {
    type Error = CableError;

    fn try_from(stored: Stored) -> Result<Self, CableError> {
        let mesh = Mesh::of_elements(stored.displacement.len().saturating_sub(1), stored.node_spacing)?;
        Self::from_parts(&mesh, stored.displacement, stored.friction)?
            .with_thermal_force(stored.thermal_force)?
            .with_clamp_slips(stored.clamp_slips)
    }
}

impl CableState {
    /// A cable as laid in a level duct: no displacement, no friction. In one that slopes it lies as [`crate::laid`] says.
    pub fn at_rest(mesh: &Mesh) -> Self {
        Self {
            mesh: mesh.nodes_alone(),
            displacement: vec![0.0; mesh.nodes()],
            friction: vec![0.0; mesh.nodes()],
            thermal_force: 0.0,
            clamp_slips: Vec::new(),
        }
    }

    /// A cable at rest with `displacement` u \[m\] and `friction` f \[N/m\] at every node. They are not checked against each
    /// other: what is out of balance moves as soon as a vehicle passes.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] unless there is a value of each for every node of `mesh`,
    /// [`CableError::InvalidParameter`] unless all are finite.
    pub fn from_parts(mesh: &Mesh, displacement: Vec<f64>, friction: Vec<f64>) -> Result<Self, CableError> {
        for (name, values) in [("displacement", &displacement), ("friction", &friction)] {
            let (found, expected) = (values.len(), mesh.nodes());
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
            ..Self::at_rest(mesh)
        })
    }

    /// The same nodes in a cable of which heat has made the force `thermal_force` Θ = EA α T \[N\], positive where it is warmer by T than as
    /// laid (α its expansion per length and degree). [`crate::RestingCable::warm`] is what heat does to a cable.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless it is finite.
    pub fn with_thermal_force(mut self, thermal_force: f64) -> Result<Self, CableError> {
        self.thermal_force = checked("thermal_force", thermal_force, "finite", |_| true)?;
        Ok(self)
    }

    /// The same cable in clamps that have slipped by these lengths on the nodes before and after them \[m\].
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless all are finite.
    pub fn with_clamp_slips(mut self, slips: Vec<[f64; 2]>) -> Result<Self, CableError> {
        for &slip in slips.as_flattened() {
            checked("slip of a clamp", slip, "finite", |_| true)?;
        }
        self.clamp_slips = slips;
        Ok(self)
    }

    /// The same with this friction on the two end nodes \[N/m\]: at a fixed end it does not follow from the displacements.
    #[must_use]
    pub fn with_end_friction(mut self, [upstream, downstream]: [f64; 2]) -> Self {
        let last = self.mesh.elements();
        (self.friction[0], self.friction[last]) = (upstream, downstream);
        self
    }

    /// How far each clamp of `cable` has slipped \[m\], positive toward growing x, in the order of [`DuctedCable::restraints`].
    pub fn clamp_slips(&self, cable: &DuctedCable) -> Vec<f64> {
        let of = |(index, restraint): (usize, &Restraint)| {
            let share = self.mesh.place(restraint.position).1;
            let [before, after] = self.slips(index);
            (1.0 - share) * before + share * after
        };
        cable.restraints().iter().enumerate().map(of).collect()
    }

    /// How far a clamp has slipped on the nodes before and after it \[m\].
    fn slips(&self, restraint: usize) -> [f64; 2] {
        self.clamp_slips.get(restraint).copied().unwrap_or_default()
    }

    /// Θ = EA α T \[N\]: the compression that heat makes in a cable that cannot move.
    pub fn thermal_force(&self) -> f64 {
        self.thermal_force
    }

    /// Its nodes.
    pub(crate) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Distance between nodes \[m\].
    pub fn node_spacing(&self) -> f64 {
        self.mesh.spacing()
    }

    /// Displacement u of every node \[m\].
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Friction f on the cable at every node \[N/m\].
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// Force in every element \[N\], compression positive: F = −EA u′ + Θ.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the cable is as long as the state's mesh.
    pub fn element_forces<'a>(
        &'a self,
        cable: &DuctedCable,
    ) -> Result<impl Iterator<Item = f64> + 'a, CableError> {
        self.mesh.check_length(cable.length())?;
        let stiffness = cable.axial_stiffness() / self.mesh.spacing();
        let force = move |pair: &[f64]| stiffness * (pair[0] - pair[1]) + self.thermal_force;
        Ok(self.displacement.windows(2).map(force))
    }

    /// Force \[N\] on what holds each end, compression positive: the reading of a load cell there. What clamps on the same
    /// node carry is not part of it.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn end_forces(&self, cable: &DuctedCable) -> Result<EndForces, CableError> {
        self.mesh.check_length(cable.length())?;
        Ok(EndReader::new(cable, &self.mesh, false).read(
            self.thermal_force,
            |i| self.displacement[i],
            |i| self.friction[i],
        ))
    }

    /// Force \[N\] of the cable on each of its clamps, positive toward growing x, in the order of
    /// [`DuctedCable::restraints`].
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn restraint_forces(&self, cable: &DuctedCable) -> Result<Vec<f64>, CableError> {
        self.mesh.check_length(cable.length())?;
        let shares = ClampShares::new(cable, &self.mesh);
        let clamps = shares.stuck(&self.clamp_slips);
        Ok(shares.forces(&clamps, cable.restraints(), |node| self.displacement[node]))
    }

    /// The largest friction \[N/m\] that every node can bear with the force in `cable` as it is; it depends on that in bends alone.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn friction_limits(&self, cable: &DuctedCable) -> Result<Vec<f64>, CableError> {
        let chain = self.pressing(cable)?;
        Ok(chain.nodes().iter().map(|node| node.limit).collect())
    }

    /// Lengths of `cable` whose friction is at the limit that its force makes; none without friction.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn slip_lengths(&self, cable: &DuctedCable) -> Result<SlipLengths, CableError> {
        let mut lengths = SlipLengths::default();
        for (&friction, node) in self.friction.iter().zip(self.pressing(cable)?.nodes()) {
            let at_limit = (1.0 - AT_LIMIT) * node.limit;
            if node.limit > 0.0 && friction >= at_limit {
                lengths.forward += node.tributary;
            } else if node.limit > 0.0 && friction <= -at_limit {
                lengths.backward += node.tributary;
            }
        }
        Ok(lengths)
    }

    /// Largest friction that equilibrium needs at any node, as a share of its limit: the difference of the forces in both elements, less
    /// what clamps, end springs and the body force carry, over the node's length of cable. In a state at rest it is at most 1.
    ///
    /// # Errors
    ///
    /// As for [`CableState::element_forces`].
    pub fn friction_share(&self, cable: &DuctedCable) -> Result<f64, CableError> {
        let chain = self.pressing(cable)?;
        let mut load = cable.loads(&self.mesh, self.thermal_force);
        chain.add_clamp_loads(&mut load, |_| 0.0);
        let forces = self.element_forces(cable)?;
        let rounding =
            ROUNDING * forces.fold(0.0, |most: f64, force| most.max(force.abs())) / self.node_spacing();
        let share = |i: usize| {
            let needed = chain.balancing_friction(&self.displacement, &load, i).abs();
            if needed <= rounding {
                0.0
            } else {
                needed / (chain.nodes()[i].limit + rounding)
            }
        };
        Ok(chain.free().nodes().map(share).fold(0.0, f64::max))
    }

    /// The chain of `cable` as this state presses on its bends.
    fn pressing(&self, cable: &DuctedCable) -> Result<Chain, CableError> {
        self.mesh.check_length(cable.length())?;
        let clamps = ClampShares::new(cable, &self.mesh).stuck(&self.clamp_slips);
        let mut chain = chain(cable, &self.mesh, clamps)?;
        Bends::new(cable, &self.mesh).press(&mut chain, |i| self.displacement[i], self.thermal_force);
        Ok(chain)
    }

    /// Refuses a state of another mesh.
    pub(crate) fn check(&self, mesh: &Mesh) -> Result<(), CableError> {
        let (found, expected) = (self.mesh.nodes(), mesh.nodes());
        if found != expected {
            return Err(CableError::StateMismatch { found, expected });
        }
        let (spacing, wanted) = (self.mesh.spacing(), mesh.spacing());
        let same = |v: f64| (v / wanted - 1.0).abs() < 1e-9;
        checked("node spacing of the state", spacing, "the mesh's", same).map(|_| ())
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
        let clamp = Restraint::new(0.9, 1.0);
        let cable = DuctedCable::new(1.0, 1.0, friction)?.with_restraints(vec![clamp])?;
        let (coarse, fine) = (Mesh::new(1.0, 0.5, 0.5)?, Mesh::new(1.0, 0.125, 0.125)?);
        let mismatch = CableError::StateMismatch {
            found: 3,
            expected: 9,
        };
        let state = CableState::at_rest(&coarse);
        assert_eq!(state.check(&fine), Err(mismatch));
        assert_eq!(state.element_forces(&cable)?.count(), 2);
        // As many nodes, at another spacing.
        let longer = CableState::at_rest(&Mesh::new(2.0, 1.0, 1.0)?);
        assert!(longer.check(&coarse).is_err());
        assert!(longer.element_forces(&cable).is_err());
        assert!(longer.end_forces(&cable).is_err());
        assert!(longer.restraint_forces(&cable).is_err());
        // The same nodes under another vehicle.
        assert_eq!(state.check(&Mesh::new(1.0, 0.5, 0.1)?), Ok(()));
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
            r#"{"node_spacing":1,"displacement":[0,0,0,0,0],"friction":[]}"#,
            r#"{"node_spacing":1,"displacement":[0,0],"friction":[0,0,0]}"#,
            r#"{"node_spacing":1,"displacement":[],"friction":[]}"#,
            r#"{"node_spacing":0,"displacement":[0,0,0],"friction":[0,0,0]}"#,
            r#"{"displacement":[0]}"#,
        ] {
            assert!(serde_json::from_str::<CableState>(bad).is_err(), "{bad}");
        }
        Ok(())
    }
}
