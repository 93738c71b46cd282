//! Clamps: springs between cable and ground, which may slip.
//!
//! A spring of stiffness s that has slipped by p bears F = s (u − p) while |F| is at most its holding force, and ± that force while it
//! slips, u the displacement of its node. The first makes it a spring of the chain, the second a load. A clamp between two nodes is a
//! spring on each of them, by the lever rule, which bears its share of the clamp's holding force.

use crate::{DuctedCable, Mesh, Restraint};

/// A holding force is exceeded from this share beyond it on: rounding is not.
const ROUNDING: f64 = 1e-9;
/// A clamp nearer to a node than this share of the spacing is on it alone.
const ON_NODE: f64 = 1e-9;

/// A clamp, or its share on one of two nodes.
#[derive(Debug, Clone)]
pub(crate) struct Grip {
    /// The clamp's place among the cable's restraints, and its side: 0 before it, 1 after it; 2 for both where it is on its node.
    place: (usize, usize),
    pub node: usize,
    /// \[N/m\]
    pub stiffness: f64,
    /// Diagonal of its node's row without clamps.
    pub diagonal: f64,
    /// Holding force \[N\]; infinite if it never slips.
    holds: f64,
    /// How far it has slipped before the step \[m\].
    slip: f64,
    /// 0 while it sticks, else the sign of the force of the cable on it.
    slides: f64,
}

impl Grip {
    /// Those of `cable` on `mesh`, stuck.
    pub fn of(cable: &DuctedCable, mesh: &Mesh) -> Vec<Self> {
        let mut grips = Vec::new();
        for (restraint, clamp) in cable.restraints().iter().enumerate() {
            let holds = clamp.holds.unwrap_or(f64::INFINITY);
            let (left, share) = mesh.place(clamp.position);
            for (side, node, share) in [(0, left, 1.0 - share), (1, left + 1, share)] {
                if share > ON_NODE && clamp.stiffness > 0.0 {
                    grips.push(Self {
                        place: (restraint, if share < 1.0 - ON_NODE { side } else { 2 }),
                        node,
                        stiffness: share * clamp.stiffness,
                        diagonal: f64::NAN,
                        holds: share * holds,
                        slip: 0.0,
                        slides: 0.0,
                    });
                }
            }
        }
        grips
    }

    /// Forces of the cable on all `clamps` \[N\], positive toward growing x, from the displacement \[m\] of any node.
    pub fn forces(grips: &[Self], clamps: &[Restraint], u: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut forces = vec![0.0; clamps.len()];
        for grip in grips {
            forces[grip.place.0] += grip.stiffness * (u(grip.node) - grip.slip);
        }
        for (force, clamp) in forces.iter_mut().zip(clamps) {
            let holds = clamp.holds.unwrap_or(f64::INFINITY);
            *force = force.clamp(-holds, holds);
        }
        forces
    }

    pub fn is_stuck(&self) -> bool {
        self.slides == 0.0
    }

    /// Goes on from the `slips` of all clamps \[m\], stuck.
    pub fn start(&mut self, slips: &[[f64; 2]]) {
        (self.slip, self.slides) = (self.slip_in(slips), 0.0);
    }

    /// Slides, whatever acts on it.
    pub fn let_go(&mut self) {
        self.slides = 1.0;
    }

    /// How far it has slipped in the `slips` of all clamps, before and after each \[m\].
    fn slip_in(&self, slips: &[[f64; 2]]) -> f64 {
        let (restraint, side) = self.place;
        slips.get(restraint).map_or(0.0, |slips| slips[side.min(1)])
    }

    /// Slides if it has slid since the slips `before`; whether it has.
    pub fn slide(&mut self, before: &[[f64; 2]]) -> bool {
        let slid = self.slip - self.slip_in(before);
        self.slides = if slid == 0.0 { 0.0 } else { slid.signum() };
        slid != 0.0
    }

    /// Slips in `slips` by the `advance` of its node \[m\] if it slides.
    pub fn follow(&self, advance: f64, slips: &mut Vec<[f64; 2]>) {
        if !self.is_stuck() {
            self.store_slip(self.slip_in(slips) + advance, slips);
        }
    }

    /// If it slides, slips in `slips` until its clamp bears its part of these `forces` on all `clamps` \[N\], where its node is displaced
    /// by `u` \[m\].
    pub fn bear_in(&self, slips: &mut Vec<[f64; 2]>, u: f64, forces: &[f64], clamps: &[Restraint]) {
        if !self.is_stuck() {
            let (restraint, _) = self.place;
            self.store_slip(u - forces[restraint] / clamps[restraint].stiffness, slips);
        }
    }

    /// Load on its node \[N\], apart from its spring if it sticks, in a frame that has moved by `frame` \[m\] there.
    pub fn load(&self, frame: f64) -> f64 {
        if self.is_stuck() {
            self.stiffness * (self.slip - frame)
        } else {
            -self.holds * self.slides
        }
    }

    /// Whether it sticks or slides otherwise than was assumed where its node moves to `u` \[m\]; then it does so from now on.
    pub fn correct(&mut self, u: f64) -> bool {
        let before = self.slides;
        if self.is_stuck() {
            let force = self.stiffness * (u - self.slip);
            if force.abs() > (1.0 + ROUNDING) * self.holds {
                self.slides = force.signum();
            }
        } else if (self.slipped(u) - self.slip) * self.slides < 0.0 {
            self.slides = 0.0;
        }
        self.slides != before
    }

    /// How far it has slipped where its node is displaced by `u` \[m\].
    fn slipped(&self, u: f64) -> f64 {
        if self.is_stuck() {
            self.slip
        } else {
            u - self.slides * self.holds / self.stiffness
        }
    }

    /// Ends a step that moved its node to `u` \[m\]. Returned: the heat of the slip \[J\].
    pub fn settle(&mut self, u: f64) -> f64 {
        if self.is_stuck() {
            return 0.0;
        }
        let slipped = self.slipped(u);
        let heat = self.holds * (slipped - self.slip).abs();
        self.slip = slipped;
        heat
    }

    /// Bears what it can where its node is displaced by `u` \[m\], and slips if that is not enough. Returned: the force of the cable on
    /// it \[N\], and the heat of the slip \[J\].
    pub fn bear(&mut self, u: f64) -> (f64, f64) {
        let force = self.stiffness * (u - self.slip);
        if force.abs() <= self.holds {
            return (force, 0.0);
        }
        self.slides = force.signum();
        let heat = self.settle(u);
        (self.holds * std::mem::take(&mut self.slides), heat)
    }

    /// Its elastic energy \[J\] where its node is displaced by `u` \[m\].
    pub fn energy(&self, u: f64) -> f64 {
        0.5 * self.stiffness * (u - self.slip).powi(2)
    }

    /// Writes how far it has slipped to the `slips` of all clamps.
    pub fn store(&self, slips: &mut Vec<[f64; 2]>) {
        if self.holds.is_finite() {
            self.store_slip(self.slip, slips);
        }
    }

    fn store_slip(&self, slip: f64, slips: &mut Vec<[f64; 2]>) {
        let (restraint, side) = self.place;
        slips.resize(slips.len().max(restraint + 1), [0.0; 2]);
        match side {
            2 => slips[restraint] = [slip; 2],
            side => slips[restraint][side] = slip,
        }
    }
}
