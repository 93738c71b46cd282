//! The cable in its duct: length, stiffness, friction, and what holds it.

use crate::error::checked;
use crate::{CableError, Friction, Mesh};

/// What holds an end of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum End {
    /// Nothing.
    #[default]
    Free,
    /// A joint that does not move; its reaction is the force on a load cell there.
    Fixed,
    /// A spring to the ground with this stiffness \[N/m\].
    Spring(f64),
}

impl End {
    /// Stiffness \[N/m\] of a sprung end, 0 for a free one; `None` for a fixed one.
    pub fn stiffness(self) -> Option<f64> {
        match self {
            Self::Free => Some(0.0),
            Self::Fixed => None,
            Self::Spring(stiffness) => Some(stiffness),
        }
    }
}

/// A clamp somewhere along the duct: a spring between cable and ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restraint {
    /// Position along the duct \[m\].
    pub position: f64,
    /// Stiffness \[N/m\].
    pub stiffness: f64,
}

impl Restraint {
    /// The clamp as springs \[N/m\] on the two nodes around it, by the lever rule.
    pub(crate) fn by_node(&self, mesh: &Mesh) -> [(usize, f64); 2] {
        let (left, share) = mesh.place(self.position);
        [
            (left, (1.0 - share) * self.stiffness),
            (left + 1, share * self.stiffness),
        ]
    }
}

/// A straight cable in a duct from x = 0 (upstream) to x = length (downstream).
///
/// ```
/// use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Restraint};
///
/// let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
/// let clamp = Restraint { position: 12.0, stiffness: 1e6 };
/// let cable = DuctedCable::new(30.0, 8.01e6, friction)?
///     .with_ends(End::Spring(5e6), End::Fixed)?
///     .with_restraints(vec![clamp])?;
/// assert_eq!(cable.upstream().stiffness(), Some(5e6));
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DuctedCable {
    length: f64,
    axial_stiffness: f64,
    friction: Friction,
    upstream: End,
    downstream: End,
    restraints: Vec<Restraint>,
    body_force: f64,
}

impl DuctedCable {
    /// A cable of `length` \[m\] and `axial_stiffness` EA \[N\] with `friction` against its duct; both ends free.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless length and stiffness are finite and positive.
    pub fn new(length: f64, axial_stiffness: f64, friction: Friction) -> Result<Self, CableError> {
        let allowed = "finite and positive";
        Ok(Self {
            length: checked("length", length, allowed, |v| v > 0.0)?,
            axial_stiffness: checked("axial_stiffness", axial_stiffness, allowed, |v| v > 0.0)?,
            friction,
            upstream: End::Free,
            downstream: End::Free,
            restraints: Vec::new(),
            body_force: 0.0,
        })
    }

    /// The same cable with its ends held.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless spring stiffnesses are finite and not negative.
    pub fn with_ends(mut self, upstream: End, downstream: End) -> Result<Self, CableError> {
        for end in [upstream, downstream] {
            if let End::Spring(stiffness) = end {
                checked("spring stiffness", stiffness, "finite and not negative", |v| {
                    v >= 0.0
                })?;
            }
        }
        (self.upstream, self.downstream) = (upstream, downstream);
        Ok(self)
    }

    /// The same cable with clamps along it.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless positions lie on the duct and stiffnesses are finite and not negative.
    pub fn with_restraints(mut self, restraints: Vec<Restraint>) -> Result<Self, CableError> {
        for restraint in &restraints {
            checked("restraint position", restraint.position, "on the duct", |v| {
                (0.0..=self.length).contains(&v)
            })?;
            checked(
                "restraint stiffness",
                restraint.stiffness,
                "finite and not negative",
                |v| v >= 0.0,
            )?;
        }
        self.restraints = restraints;
        Ok(self)
    }

    /// The same cable with a force `body_force` p \[N/m\] along the duct on every metre, positive toward growing x: that of its weight w in
    /// a duct that rises with x at an angle θ, p = −w sin θ. It is a load and no law: every step stays convex.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless it is finite.
    pub fn with_body_force(mut self, body_force: f64) -> Result<Self, CableError> {
        self.body_force = checked("body_force", body_force, "finite", |_| true)?;
        Ok(self)
    }

    /// The same cable with a law that remembers slip: in the place of the sigmoid the
    /// elastic-plastic one with its slope.
    pub(crate) fn with_memory(&self) -> Self {
        let mut cable = self.clone();
        cable.friction = self.friction.with_memory();
        cable
    }

    /// The cable seen in a mirror across the duct's middle.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        std::mem::swap(&mut mirrored.upstream, &mut mirrored.downstream);
        for restraint in &mut mirrored.restraints {
            restraint.position = self.length - restraint.position;
        }
        mirrored.body_force = -self.body_force;
        mirrored
    }

    /// Length \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// EA \[N\].
    pub fn axial_stiffness(&self) -> f64 {
        self.axial_stiffness
    }

    /// Friction against the duct.
    pub fn friction(&self) -> Friction {
        self.friction
    }

    /// What holds the end at x = 0.
    pub fn upstream(&self) -> End {
        self.upstream
    }

    /// What holds the end at x = length.
    pub fn downstream(&self) -> End {
        self.downstream
    }

    /// Clamps along the cable.
    pub fn restraints(&self) -> &[Restraint] {
        &self.restraints
    }

    /// Force p along the duct on every metre of the cable \[N/m\].
    pub fn body_force(&self) -> f64 {
        self.body_force
    }

    /// Loads on the nodes of `mesh` \[N\]: the force along the duct, and the `thermal_force` \[N\],
    /// which pushes the two ends apart and nothing between them.
    pub(crate) fn loads(&self, mesh: &Mesh, thermal_force: f64) -> Vec<f64> {
        let body = |node| self.body_force * mesh.tributary_length(node);
        let mut loads: Vec<f64> = (0..mesh.nodes()).map(body).collect();
        loads[0] -= thermal_force;
        loads[mesh.elements()] += thermal_force;
        loads
    }

    /// Length \[m\] over which a stuck cable smooths the motion of its duct: λ = √(EA γ), with γ the shear compliance
    /// of the contact ([`Friction::compliance`]). 0 for Coulomb's law.
    pub fn screening_length(&self) -> f64 {
        (self.axial_stiffness * self.friction.compliance()).sqrt()
    }
}
