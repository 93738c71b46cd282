//! Clamps: springs between a node and the ground, which may slip.
//!
//! A spring of stiffness s that has slipped by p bears F = s (u − p) while |F| is at most its holding force, and ± that force while it
//! slips, u the displacement of its node. The first makes it a spring of the chain, the second a load.

/// A clamp slips if its force exceeds the holding force by more than this share: rounding does not.
const EXCEEDED: f64 = 1e-9;
/// Rounding of a displacement that was solved for, as a share of it. The spring multiplies it: it may be all that a weak clamp holds.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A clamp on one node.
#[derive(Debug, Clone, Copy)]
pub struct Clamp {
    /// Its node.
    pub node: usize,
    /// s \[N/m\].
    pub stiffness: f64,
    /// Holding force \[N\]; infinite if it never slips.
    pub holds: f64,
    /// How far it has slipped before the step \[m\].
    pub slip: f64,
    /// 0 while it sticks, else the sign of the force of the cable on it.
    slides: f64,
}

impl Clamp {
    /// A clamp on `node` of `stiffness` s \[N/m\] that bears up to `holds` \[N\]; it sticks, and has not slipped. [`crate::Chain::new`] refuses
    /// one that cannot be.
    pub fn new(node: usize, stiffness: f64, holds: f64) -> Self {
        Self {
            node,
            stiffness,
            holds,
            slip: 0.0,
            slides: 0.0,
        }
    }

    /// The same after its slip has gone from `before` to `slip` \[m\]: it slides on, or sticks if both are the same.
    #[must_use]
    pub fn slid(self, before: f64, slip: f64) -> Self {
        let slides = if slip == before {
            0.0
        } else {
            (slip - before).signum()
        };
        Self { slip, slides, ..self }
    }

    /// Whether it sticks; else it slides with its holding force.
    pub fn is_stuck(&self) -> bool {
        self.slides == 0.0
    }

    /// Bears what it can where its node is displaced by `u` \[m\], and slips if that is not enough. Returned: the force of the cable on
    /// it \[N\], and the heat of the slip \[J\].
    pub fn bear(&mut self, u: f64) -> [f64; 2] {
        let force = self.force(u);
        if force.abs() <= self.holds {
            return [force, 0.0];
        }
        self.slides = force.signum();
        let heat = self.settle(u);
        [self.holds * std::mem::take(&mut self.slides), heat]
    }

    /// Force of the cable on its spring \[N\] where its node is displaced by `u` \[m\], whatever it holds.
    pub fn force(&self, u: f64) -> f64 {
        self.stiffness * (u - self.slip)
    }

    /// Load on its node \[N\], apart from its spring if it sticks, in a frame that has moved by `frame` \[m\] there.
    pub(crate) fn load(&self, frame: f64) -> f64 {
        if self.is_stuck() {
            -self.force(frame)
        } else {
            -self.holds * self.slides
        }
    }

    /// Whether it sticks or slides otherwise than was assumed where its node moves to `u` \[m\]; then it does so from now on.
    pub(crate) fn correct(&mut self, u: f64) -> bool {
        let before = self.slides;
        if self.is_stuck() {
            let force = self.force(u);
            let rounded = ROUNDING * self.stiffness * u.abs();
            if force.abs() > (1.0 + EXCEEDED) * self.holds + rounded {
                self.slides = force.signum();
            }
        } else if (self.slipped(u) - self.slip) * self.slides < 0.0 {
            self.slides = 0.0;
        }
        self.slides != before
    }

    /// How far it has slipped where its node is displaced by `u` \[m\], if it slides.
    fn slipped(&self, u: f64) -> f64 {
        u - self.slides * self.holds / self.stiffness
    }

    /// Ends a step that moved its node to `u` \[m\]. Returned: the heat of the slip \[J\].
    pub(crate) fn settle(&mut self, u: f64) -> f64 {
        if self.is_stuck() {
            return 0.0;
        }
        let (before, after) = (self.slip, self.slipped(u));
        self.slip = after;
        self.holds * (after - before).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clamp_that_bears_all_it_holds_is_not_released_by_the_rounding_of_a_displacement() {
        // It has slipped by 12 mm; rounding of the last digits times its stiffness is some 1e-7 of what it holds.
        let (stiffness, holds, slip) = (3e7_f64, 1e-3, 12e-3);
        let mut clamp = Clamp {
            slip,
            ..Clamp::new(5, stiffness, holds)
        };
        let borne = slip + holds / stiffness;
        let rounded = borne * (1.0 + 3.0 * f64::EPSILON);
        assert!(clamp.force(rounded) > (1.0 + EXCEEDED) * holds);
        assert!(!clamp.correct(rounded) && clamp.is_stuck());
        assert!(clamp.correct(slip + 1.001 * holds / stiffness) && !clamp.is_stuck());
    }
}
