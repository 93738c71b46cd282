//! The cable between two passes, when duct and cable are at rest.

use crate::step::{Chain, Load, StepSolver, Support, largest};
use crate::{CableError, CableState, DuctedCable, Mesh};

/// One cable on one mesh, at rest in a duct at rest.
///
/// Where it rests friction balances the chain's force at every node,
///
/// w (f + p) = K u,
///
/// with K the stiffness of the chain of springs EA/h with its ends and clamps, w a node's length of cable and p the body force. So the
/// displacements alone say how the cable lies; only at a fixed end, whose node does not move, friction is its own.
///
/// ```
/// use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, RestingCable};
///
/// let cable = DuctedCable::new(10.0, 8.01e6, Friction::new(FrictionLaw::Coulomb, 27.2)?)?.with_ends(End::Free, End::Fixed)?;
/// let mesh = Mesh::for_depth(10.0, 1.2, 6.0)?;
/// let mut resting = RestingCable::new(&cable, &mesh)?;
/// // Pushed at its free end by more than friction holds there.
/// let displacement: Vec<f64> = (0..mesh.nodes()).map(|i| 1e-4 * (1.0 - 0.1 * mesh.spacing() * i as f64)).collect();
/// let mut state = CableState::from_parts(&mesh, displacement, vec![0.0; mesh.nodes()])?;
/// resting.settle(&mut state)?;
/// assert!(state.friction_needed(&cable)? < 27.2 * 1.000001);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RestingCable {
    step: StepSolver,
    cable: DuctedCable,
    supports: Vec<Support>,
    anchor: Vec<f64>,
    nothing: Vec<f64>,
    /// Body force w p of every node \[N\].
    load: Vec<f64>,
    /// What elimination leaves above the diagonal.
    factor: Vec<f64>,
}

impl RestingCable {
    /// `cable` on `mesh`.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mesh is as long as the cable, [`CableError::UnsupportedLaw`] for a law
    /// without memory, which has no state of rest.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Result<Self, CableError> {
        cable.friction().check_memory("resting")?;
        mesh.check_length(cable.length())?;
        let zeros = || vec![0.0; mesh.nodes()];
        Ok(Self {
            step: StepSolver::new(Chain::new(cable, mesh, 0.0)),
            cable: cable.clone(),
            supports: Support::of(cable, mesh),
            anchor: zeros(),
            nothing: zeros(),
            load: cable.body_loads(mesh),
            factor: zeros(),
        })
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.cable
    }

    /// Nodes that can move: all but fixed ends.
    pub fn free(&self) -> std::ops::RangeInclusive<usize> {
        self.step.chain.free.nodes()
    }

    /// Whether an end spring, a clamp or a fixed end holds the cable: otherwise it may be moved as a whole.
    pub fn is_held(&self) -> bool {
        self.supports.iter().any(|support| support.stiffness != Some(0.0))
    }

    /// Friction K u/w \[N/m\] that balances a change `u` \[m\] of the displacements, beside that which balances the body force, at every
    /// node that can move; the others are left.
    pub fn balance(&self, u: &[f64], friction: &mut [f64]) {
        for i in self.free() {
            friction[i] = self.step.chain.balancing_friction(u, &self.nothing, i);
        }
    }

    /// Largest force \[N\] in the chain, its end springs and clamps where the nodes are displaced by `u` \[m\].
    pub fn largest_force(&self, u: &[f64]) -> f64 {
        let chain = &self.step.chain;
        let elements = u
            .windows(2)
            .map(|pair| chain.stiffness * (pair[0] - pair[1]).abs());
        let springs = self.supports.iter().map(|support| {
            let stiffness = support.stiffness.unwrap_or(0.0);
            stiffness * u[support.node].abs()
        });
        elements.chain(springs).fold(0.0, f64::max)
    }

    /// Solves (1 + s K/w) y = b for slopes s ≥ 0 \[m²/N\] at every node: what diffuses b along the cable. `y` holds b before and
    /// the answer after; it is zero at fixed ends.
    pub fn diffuse(&mut self, slope: impl Fn(usize) -> f64, y: &mut [f64]) {
        let Self { step, factor, .. } = self;
        let chain = &step.chain;
        let (lo, hi) = (chain.free.lo, chain.free.hi);
        y[..lo].fill(0.0);
        y[hi + 1..].fill(0.0);
        let (mut above, mut before) = (0.0, 0.0);
        for i in lo..=hi {
            let off = slope(i) * chain.stiffness / chain.tributary[i];
            let inverse = 1.0 / (1.0 + off * (chain.diagonal[i] - above));
            above = off * inverse;
            before = y[i] * inverse + above * before;
            factor[i] = above;
            y[i] = before;
        }
        for i in (lo..hi).rev() {
            y[i] += factor[i] * y[i + 1];
        }
    }

    /// Lets the cable come to rest: friction beyond its limit yields, and the cable moves as little as equilibrium needs.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] for a state of another mesh; [`CableError::NoConvergence`] where no equilibrium is found.
    pub fn settle(&mut self, state: &mut CableState) -> Result<(), CableError> {
        let (found, expected) = (state.displacement.len(), self.anchor.len());
        if found != expected {
            return Err(CableError::StateMismatch { found, expected });
        }
        let StepSolver { chain, trial, .. } = &mut self.step;
        let free = chain.free;
        let mut at_rest = true;
        for i in free.nodes() {
            let needed = chain.balancing_friction(&state.displacement, &self.load, i);
            at_rest &= needed.abs() <= chain.limit;
            state.friction[i] = needed.clamp(-chain.limit, chain.limit);
            self.anchor[i] = state.displacement[i] + chain.compliance * state.friction[i];
        }
        if at_rest {
            return Ok(());
        }
        trial.r.copy_from_slice(&state.displacement);
        self.step.start(largest(&state.displacement, 0.0));
        let load = Load {
            adhesion: &self.nothing,
            support: &self.load,
            anchor: &self.anchor,
            friction: &state.friction,
        };
        let solved = self.step.solve(&load, free);
        solved.map_err(|violation| CableError::NoConvergence {
            vehicle_position: f64::INFINITY,
            violation,
        })?;
        let trial = &self.step.trial;
        state.displacement[free.nodes()].copy_from_slice(&trial.r[free.nodes()]);
        state.friction[free.nodes()].copy_from_slice(&trial.g[free.nodes()]);
        Ok(())
    }
}
