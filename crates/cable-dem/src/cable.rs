//! The cable in its duct: length, stiffness, friction, and what holds it.

use crate::error::{checked, not_negative, positive};
use crate::section::{self, Section};
use crate::{CableError, Friction, Mesh};

/// What holds an end of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
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

/// A clamp somewhere along the duct: a spring between cable and ground, which may slip.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Restraint {
    /// Position along the duct \[m\].
    #[cfg_attr(feature = "serde", serde(rename = "position_m"))]
    pub position: f64,
    /// Stiffness \[N/m\].
    #[cfg_attr(feature = "serde", serde(rename = "stiffness_n_per_m"))]
    pub stiffness: f64,
    /// Force above which it slips \[N\]; none if it never does.
    #[cfg_attr(feature = "serde", serde(rename = "holds_n"))]
    pub holds: Option<f64>,
}

impl Restraint {
    /// A clamp at `position` \[m\] with a `stiffness` \[N/m\] that never slips.
    pub fn new(position: f64, stiffness: f64) -> Self {
        Self {
            position,
            stiffness,
            holds: None,
        }
    }
}

/// A cable in a duct from x = 0 (upstream) to x = length (downstream), level and straight unless its
/// [sections](Section) say otherwise.
///
/// ```
/// use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Restraint};
///
/// let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
/// let clamp = Restraint { holds: Some(2e3), ..Restraint::new(12.0, 1e6) };
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
    /// Where the ends stand that are fixed, and where the springs of others bear nothing \[m\].
    end_positions: [f64; 2],
    /// At least one, from x = 0 on; neighbours differ.
    sections: Vec<Section>,
}

impl DuctedCable {
    /// A cable of `length` \[m\] and `axial_stiffness` EA \[N\] with `friction` against its duct; both ends free.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless length and stiffness are finite and positive.
    pub fn new(length: f64, axial_stiffness: f64, friction: Friction) -> Result<Self, CableError> {
        Ok(Self {
            sections: vec![Section::new(length, friction.limit())],
            length: positive("length", length)?,
            axial_stiffness: positive("axial_stiffness", axial_stiffness)?,
            friction,
            upstream: End::Free,
            downstream: End::Free,
            restraints: Vec::new(),
            end_positions: [0.0; 2],
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
                not_negative("spring stiffness", stiffness)?;
            }
        }
        (self.upstream, self.downstream) = (upstream, downstream);
        Ok(self)
    }

    /// The same cable whose upstream and downstream ends are held where they are displaced by `positions` \[m\]: there a fixed one
    /// stands, and a spring bears nothing. It is what holds a cable that has crept before it was held.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless they are finite.
    pub fn with_end_positions(mut self, positions: [f64; 2]) -> Result<Self, CableError> {
        for position in positions {
            checked("position of an end", position, "finite", |_| true)?;
        }
        self.end_positions = positions;
        Ok(self)
    }

    /// The same cable with clamps along it.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless positions lie on the duct, stiffnesses are finite and not negative and holding forces
    /// finite and positive.
    pub fn with_restraints(mut self, restraints: Vec<Restraint>) -> Result<Self, CableError> {
        for restraint in &restraints {
            checked("restraint position", restraint.position, "on the duct", |v| {
                (0.0..=self.length).contains(&v)
            })?;
            not_negative("restraint stiffness", restraint.stiffness)?;
            if let Some(holds) = restraint.holds {
                positive("holding force", holds)?;
            }
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
        checked("body_force", body_force, "finite", |_| true)?;
        for section in &mut self.sections {
            section.body_force = body_force;
        }
        Ok(self)
    }

    /// The same cable in a duct of these `sections`, one after the other from x = 0 on. The slope of the friction law is
    /// everywhere that of the cable's own friction, q b/2: it is the sheath's, and not the surface's.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless they are as long as the cable together and their values are finite, lengths and limits
    /// positive and bends not negative; the limit of a cable without friction is 0 everywhere.
    pub fn with_sections(mut self, sections: &[Section]) -> Result<Self, CableError> {
        for section in sections {
            section.check(self.friction.limit())?;
        }
        let length: f64 = sections.iter().map(|section| section.length).sum();
        checked("length of all sections", length, "the cable's length", |v| {
            (v / self.length - 1.0).abs() < 1e-9
        })?;
        self.sections.clear();
        for section in sections {
            match self.sections.last_mut() {
                Some(last) if last.is_like(section) => last.length += section.length,
                _ => self.sections.push(*section),
            }
        }
        Ok(self)
    }

    /// The same cable with a law that remembers slip: in the place of the sigmoid the
    /// elastic-plastic one with its slope.
    pub(crate) fn with_memory(&self) -> Self {
        let mut cable = self.clone();
        cable.friction = self.friction.with_memory();
        cable
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

    /// Displacements at which its ends are held \[m\], upstream and downstream.
    pub fn end_positions(&self) -> [f64; 2] {
        self.end_positions
    }

    /// The sections of the duct from x = 0 on; equal neighbours are one.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The smallest friction limit of a cable without force \[N/m\].
    pub(crate) fn least_limit(&self) -> f64 {
        let limits = self.sections.iter().map(|section| section.limit);
        limits.fold(f64::INFINITY, f64::min)
    }

    /// The force along the duct on the nodes of `mesh` \[N\].
    pub(crate) fn body_loads(&self, mesh: &Mesh) -> Vec<f64> {
        if self.sections.iter().all(|section| section.body_force == 0.0) {
            return vec![0.0; mesh.nodes()];
        }
        (0..mesh.nodes()).map(|node| self.body_load(mesh, node)).collect()
    }

    /// The same on one `node` \[N\].
    pub(crate) fn body_load(&self, mesh: &Mesh, node: usize) -> f64 {
        let shares = section::shares(&self.sections, mesh, node);
        let force: f64 = shares.map(|(share, section)| share * section.body_force).sum();
        force * mesh.tributary_length(node)
    }

    /// Loads on the nodes of `mesh` \[N\]: the force along the duct, springs of ends that are held elsewhere than as laid, and the
    /// `thermal_force` \[N\], which pushes the two ends apart and nothing between them.
    pub(crate) fn loads(&self, mesh: &Mesh, thermal_force: f64) -> Vec<f64> {
        let mut loads = self.body_loads(mesh);
        let pull = |end: End, position: f64| end.stiffness().map_or(0.0, |spring| spring * position);
        loads[0] += pull(self.upstream, self.end_positions[0]) - thermal_force;
        loads[mesh.elements()] += pull(self.downstream, self.end_positions[1]) + thermal_force;
        loads
    }

    /// Length \[m\] over which a stuck cable smooths the motion of its duct: λ = √(EA γ), with γ the shear compliance
    /// of the contact ([`Friction::compliance`]). 0 for Coulomb's law.
    pub fn screening_length(&self) -> f64 {
        (self.axial_stiffness * self.friction.compliance()).sqrt()
    }
}
