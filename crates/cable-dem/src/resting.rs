//! The cable between two passes, when duct and cable are at rest.

use friction_chain::tridiagonal::Row;
use friction_chain::{Chain, ChainError, Clamp, ImplicitStep, Load};

use crate::chain::{Bends, MAX_ROUNDS, PRESSED, chain};
use crate::clamps::{ClampShares, ClampState};
use crate::error::checked;
use crate::fixed_end_friction::FixedEndFriction;
use crate::{CableError, CableState, DuctedCable, Mesh};

/// One cable on one mesh, at rest in a duct at rest.
///
/// Where it rests friction balances the chain's force at every node,
///
/// w (f + p) + θ = K u,
///
/// with K the stiffness of the chain of springs EA/h with its ends and clamps, w a node's length of cable, p the body force and θ what heat
/// does: the force Θ = EA α T ([`CableState::thermal_force`]) pushes the first node back and the last one forward. So the
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
/// assert!(state.friction_share(&cable)? < 1.000001);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RestingCable {
    step: ImplicitStep,
    bends: Bends,
    clamps: ClampShares,
    cable: DuctedCable,
    held: FixedEndFriction,
    anchor: Vec<f64>,
    nothing: Vec<f64>,
    /// Body force w p of every node \[N\]; and with what heat does to the ends.
    body: Vec<f64>,
    load: Vec<f64>,
    /// Clamps as the last change released them.
    released: Vec<Clamp>,
    mesh: Mesh,
}

impl RestingCable {
    /// `cable` on `mesh`.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mesh is as long as the cable,
    /// [`CableError::NoRest`] for a law without memory, which has no state of rest.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Result<Self, CableError> {
        cable.friction().check_memory("resting")?;
        mesh.check_length(cable.length())?;
        Self::with_memory(cable, mesh)
    }

    /// The same on a mesh that is known to be as long as the cable, and for any law: in the place
    /// of the sigmoid stands the elastic-plastic law with its slope.
    pub(crate) fn with_memory(cable: &DuctedCable, mesh: &Mesh) -> Result<Self, CableError> {
        let cable = cable.with_memory();
        let clamps = ClampShares::new(&cable, mesh);
        let zeros = || vec![0.0; mesh.nodes()];
        Ok(Self {
            step: ImplicitStep::new(chain(&cable, mesh, clamps.stuck(&[]))?),
            bends: Bends::new(&cable, mesh),
            held: FixedEndFriction::new(&cable, mesh),
            anchor: zeros(),
            nothing: zeros(),
            body: cable.loads(mesh, 0.0),
            load: cable.loads(mesh, 0.0),
            released: clamps.stuck(&[]),
            clamps,
            mesh: *mesh,
            cable,
        })
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.cable
    }

    /// Its nodes: which are free, their lengths of cable, their friction limits under the force that the cable had in its last step, and
    /// whether an end spring, a clamp or a fixed end holds them: otherwise the cable may be moved as a whole.
    pub fn chain(&self) -> &Chain {
        &self.step.chain
    }

    /// Takes clamps that slip and have slid from `before` to `after` as ones that bear a force and are no springs, and the others as
    /// springs: what the cable answers to a small change then. It holds until the next call, whatever comes to rest in between.
    pub fn release(&mut self, before: &CableState, after: &CableState) {
        self.released = self.clamps.slid(&before.clamp_slips, &after.clamp_slips);
        self.release_again();
    }

    fn release_again(&mut self) {
        self.step.chain.set_clamps(&self.released);
    }

    /// The cable of `state` with its nodes displaced by `displacement` \[m\] and clamps that slide ([`RestingCable::release`]) taken along;
    /// not yet at rest.
    ///
    /// # Errors
    ///
    /// As for [`CableState::from_parts`].
    pub fn moved(&self, state: &CableState, displacement: Vec<f64>) -> Result<CableState, CableError> {
        let friction = state.friction.clone();
        let mut moved = CableState::from_parts(&self.mesh, displacement, friction)?;
        moved.thermal_force = state.thermal_force;
        moved.clamp_slips.clone_from(&state.clamp_slips);
        let clamps = self.step.chain.clamps();
        self.clamps
            .update(clamps, &mut moved.clamp_slips, |_, clamp, slip| {
                let advance = moved.displacement[clamp.node] - state.displacement[clamp.node];
                (!clamp.is_stuck()).then_some(slip + advance)
            });
        Ok(moved)
    }

    /// The cable's clamps in `state`, of which one between two nodes has a share on either of them.
    pub fn clamps(&self, state: &CableState) -> Vec<ClampState> {
        let of_share = |clamp: Clamp| ClampState {
            slip: clamp.slip,
            force: clamp.force(state.displacement[clamp.node]),
        };
        let clamps = self.clamps.stuck(&state.clamp_slips);
        clamps.into_iter().map(of_share).collect()
    }

    /// Lets the clamps of `state` slip as between two other states, of which the later has this `share`: those that have slipped from the one
    /// to the other bear a force between theirs.
    pub fn clamp_between(&self, state: &mut CableState, [before, after]: [&[ClampState]; 2], share: f64) {
        self.clamps
            .update(self.step.chain.clamps(), &mut state.clamp_slips, |k, clamp, _| {
                let force = (1.0 - share) * before[k].force + share * after[k].force;
                let slid = state.displacement[clamp.node] - force / clamp.stiffness;
                let is_stuck = before[k].slip == after[k].slip;
                let slip = if is_stuck { after[k].slip } else { slid };
                clamp.holds.is_finite().then_some(slip)
            });
    }

    /// Friction K u/w \[N/m\] that balances a change `u` \[m\] of the displacements, in addition to that which balances the body force, at every
    /// node that can move; the others are left.
    pub fn balance(&self, u: &[f64], friction: &mut [f64]) {
        for i in self.step.chain.free().nodes() {
            friction[i] = self.step.chain.balancing_friction(u, &self.nothing, i);
        }
    }

    /// Friction \[N/m\] that a cable displaced by `u` \[m\] needs to be at rest at the heat `thermal_force` \[N\], at every node that can move; the
    /// others are left.
    pub fn needed(&mut self, u: &[f64], thermal_force: f64, friction: &mut [f64]) {
        self.heat(thermal_force);
        for i in self.step.chain.free().nodes() {
            friction[i] = self.step.chain.balancing_friction(u, &self.load, i);
        }
    }

    /// Largest force \[N\] in the chain, its end springs and clamps where the nodes are displaced by `u` \[m\].
    pub fn largest_force(&self, u: &[f64]) -> f64 {
        let chain = &self.step.chain;
        let elements = u
            .windows(2)
            .map(|pair| chain.stiffness() * (pair[0] - pair[1]).abs());
        let springs = chain.free().nodes().map(|i| chain.spring(i) * u[i].abs());
        elements.chain(springs).fold(0.0, f64::max)
    }

    /// Solves (1 + s K/w) y = b for slopes s ≥ 0 \[m²/N\] at every node: what diffuses b along the cable. `y` holds b before and
    /// the answer after; it is zero at fixed ends.
    pub fn diffuse(&self, slope: impl Fn(usize) -> f64, y: &mut [f64]) {
        let chain = &self.step.chain;
        let row = |i: usize| {
            let node = &chain.nodes()[i];
            let off = slope(i) * chain.stiffness() * node.per_tributary;
            let per_pivot = 1.0 / (1.0 + off * node.diagonal);
            Row {
                share: off * per_pivot,
                value: y[i] * per_pivot,
            }
        };
        let solved = chain.solve(row);
        y.copy_from_slice(&solved);
    }

    /// Lets the cable come to rest: friction beyond its limit yields, and the cable moves as little as equilibrium needs.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] and [`CableError::InvalidParameter`] for a state of another
    /// mesh; [`CableError::NoConvergence`] if no equilibrium is found.
    pub fn settle(&mut self, state: &mut CableState) -> Result<(), CableError> {
        state.check(&self.mesh)?;
        self.step.chain.set_clamps(&self.clamps.stuck(&state.clamp_slips));
        self.heat(state.thermal_force);
        self.press(state, state.thermal_force);
        let chain = &self.step.chain;
        let mut at_rest = true;
        for i in chain.free().nodes() {
            let needed = chain.balancing_friction(&state.displacement, &self.load, i);
            let limit = chain.nodes()[i].limit;
            at_rest &= needed.abs() <= limit;
            state.friction[i] = needed.clamp(-limit, limit);
        }
        if at_rest {
            self.release_again();
        } else {
            self.follow(state, None, state.thermal_force, 0.0)?;
        }
        Ok(())
    }

    /// Brings the cable to another temperature, at which its heat has the force `thermal_force` Θ = EA α T \[N\], in one step with the
    /// ground at rest,
    ///
    /// K u = w (f + p) + θ,  f from the slip −Δu by the [friction law](crate::FrictionLaw).
    ///
    /// Any number of steps gives the same answer as long as no node turns back on the way. The ends of a free cable that is long relative to
    /// Θ/q move by Θ²/(2 q EA).
    ///
    /// ```
    /// use cable_dem::{CableState, DuctedCable, Friction, FrictionLaw, Mesh, RestingCable};
    ///
    /// let friction = Friction::new(FrictionLaw::Coulomb, 27.2)?;
    /// let cable = DuctedCable::new(200.0, 8.01e6, friction)?;
    /// let mesh = Mesh::for_depth(200.0, 1.2, 6.0)?;
    /// let mut resting = RestingCable::new(&cable, &mesh)?;
    /// let mut state = CableState::at_rest(&mesh);
    /// // Copper, warmer by 10 K.
    /// let thermal_force = 8.01e6 * 17e-6 * 10.0;
    /// resting.warm(&mut state, thermal_force)?;
    /// let moved = -state.displacement()[0];
    /// assert!((moved / (thermal_force * thermal_force / (2.0 * 27.2 * 8.01e6)) - 1.0).abs() < 1e-4);
    /// # Ok::<(), cable_dem::CableError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`RestingCable::settle`], and [`CableError::InvalidParameter`] for a force that is not finite.
    pub fn warm(&mut self, state: &mut CableState, thermal_force: f64) -> Result<(), CableError> {
        checked("thermal_force", thermal_force, "finite", |_| true)?;
        state.check(&self.mesh)?;
        let stretch = self.cable.length() / self.cable.axial_stiffness();
        let movement = (thermal_force - state.thermal_force).abs() * stretch;
        self.follow(state, None, thermal_force, movement)?;
        Ok(())
    }

    /// Heat pushes the two ends apart and nothing between them; clamps that slip bear their part.
    fn heat(&mut self, thermal_force: f64) {
        let (body, load, last) = (&self.body, &mut self.load, self.body.len() - 1);
        load.copy_from_slice(body);
        (load[0], load[last]) = (body[0] - thermal_force, body[last] + thermal_force);
        self.step.chain.add_clamp_loads(load, |_| 0.0);
    }

    /// Lets the cable in `state` press on the bends of the duct, as warm as it will be: that is the force before anything moves.
    fn press(&mut self, state: &CableState, thermal_force: f64) {
        let u = &state.displacement;
        self.bends.press(&mut self.step.chain, |i| u[i], thermal_force);
    }

    /// One step of the whole cable from `state` to the heat `thermal_force` \[N\], in which the
    /// duct at every node moves by `duct` \[m\], if at all, and the cable by `movement` \[m\] at
    /// most. Returns the heat of the slip \[J\]; when it fails, `state` is as it was.
    pub(crate) fn follow(
        &mut self,
        state: &mut CableState,
        duct: Option<&[f64]>,
        thermal_force: f64,
        movement: f64,
    ) -> Result<f64, CableError> {
        self.step.chain.set_clamps(&self.clamps.stuck(&state.clamp_slips));
        self.heat(thermal_force);
        self.press(state, thermal_force);
        let moved = |i: usize| duct.map_or(0.0, |duct| duct[i]);
        let compliance = self.cable.friction().compliance();
        let (u, f) = (&mut state.displacement, &mut state.friction);
        for (i, anchor) in self.anchor.iter_mut().enumerate() {
            *anchor = u[i] + moved(i) + compliance * f[i];
        }
        self.step.begin(u, movement);
        if let Err(error) = self.equilibrate(thermal_force) {
            self.release_again();
            return Err(CableError::of_step(error, f64::INFINITY));
        }
        let ImplicitStep { chain, trial, .. } = &mut self.step;
        let mut heat = 0.0;
        chain.settle_clamps(chain.free(), |i| trial.r[i], &mut heat);
        self.clamps.store(chain.clamps(), &mut state.clamp_slips);
        let (u, f) = (&mut state.displacement, &mut state.friction);
        for (i, node) in chain.nodes().iter().enumerate() {
            let is_free = chain.free().nodes().contains(&i);
            let after = if is_free {
                trial.g[i]
            } else {
                self.held.after_slip(f[i], moved(i), node.limit)
            };
            let slip = moved(i) - (trial.r[i] - u[i]) - compliance * (after - f[i]);
            heat += node.tributary * after * slip;
            (u[i], f[i]) = (trial.r[i], after);
        }
        state.thermal_force = thermal_force;
        self.release_again();
        Ok(heat)
    }

    /// Solves the step from its anchors: with the force before it where the duct bends, and then with the force that it leads to; with
    /// clamps that stick, and then with those that slide.
    fn equilibrate(&mut self, thermal_force: f64) -> Result<(), ChainError> {
        let mut change = f64::INFINITY;
        for _ in 0..=MAX_ROUNDS {
            let load = Load {
                adhesion: &self.nothing,
                support: &self.load,
                anchor: &self.anchor,
            };
            self.step.solve(&load, self.step.chain.free())?;
            let ImplicitStep { chain, trial, .. } = &mut self.step;
            change = self.bends.press(chain, |i| trial.r[i], thermal_force);
            if chain.correct_clamps(chain.free(), |i| trial.r[i]) {
                change = f64::INFINITY;
            }
            if change <= PRESSED {
                return Ok(());
            }
            self.heat(thermal_force);
        }
        Err(ChainError::NoEquilibrium { violation: change })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{End, Friction, FrictionLaw};

    #[test]
    fn what_is_diffused_solves_its_equation_with_any_ends_and_number_of_nodes() {
        let friction = Friction::new(FrictionLaw::Coulomb, 30.0).expect("friction");
        for (ends, elements) in [
            ((End::Free, End::Fixed), 40),
            ((End::Fixed, End::Fixed), 41),
            ((End::Spring(2e6), End::Free), 41),
            ((End::Fixed, End::Fixed), 2),
        ] {
            let length = 0.2 * f64::from(elements);
            let cable = DuctedCable::new(length, 8e6, friction)
                .and_then(|cable| cable.with_ends(ends.0, ends.1))
                .expect("a cable");
            let mesh = Mesh::new(length, 0.2, 0.1).expect("a mesh");
            let resting = RestingCable::new(&cable, &mesh).expect("a cable at rest");
            // Any numbers.
            let noise = |i: usize| ((i * 7919 + 13) % 1009) as f64 / 1009.0;
            let slope = |i: usize| 1e-7 * noise(i);
            let b: Vec<f64> = (0..mesh.nodes()).map(|i| noise(i + 500) - 0.5).collect();
            let mut y = b.clone();
            resting.diffuse(slope, &mut y);
            let mut friction = vec![0.0; mesh.nodes()];
            resting.balance(&y, &mut friction);
            let free = resting.chain().free().nodes();
            assert!((0..mesh.nodes()).all(|i| free.contains(&i) || y[i] == 0.0));
            for i in free {
                let missed = y[i] + slope(i) * friction[i] - b[i];
                assert!(missed.abs() < 1e-12, "row {i} of {elements}: {missed:e}");
            }
        }
    }
}
