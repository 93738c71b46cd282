//! How many steps the vehicle takes per node spacing on fine meshes.
//!
//! Each level halves the spacing and the step together, so that two levels differ by the errors of both. One more run on a coarse
//! level, with half the step, shows the step's part alone. Where that is next to nothing, half as many steps do, at half the work; then the
//! levels no longer show what the step leaves, and it is counted as what the run has shown, halved with every further level.
//!
//! Of 23 random scenes over the whole range that need 48 nodes per length scale and more, the step's part on 12 nodes is below 0.1 in
//! thirteen; of the eleven that need 96 and more in ten.

use crate::answer::error_estimate::Shares;

/// Share of the difference between two levels below which the step does not count.
const NEGLIGIBLE: f64 = 0.1;

/// How many levels below the last one the step is looked at: there a run costs a thirtieth of that on the next level.
pub const SEEN_BELOW: usize = 2;

/// Steps beside the usual number per node spacing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Steps {
    /// As many.
    #[default]
    Usual,
    /// Half as many.
    Half,
}

/// The choice, once it is made.
#[derive(Debug, Clone, Copy, Default)]
pub struct VehicleSteps {
    chosen: Option<Steps>,
    /// What half as many leave on a level \[share\] that the difference between levels does not show.
    hidden: (usize, Shares),
}

impl VehicleSteps {
    /// For the levels beyond `level`: the one [`SEEN_BELOW`] it differs from the next by `levels`, and half the step changes it by `step`.
    pub fn new(level: usize, levels: Shares, step: Shares) -> Self {
        let largest = |shares: Shares| shares.force.max(shares.movement);
        let steps = match largest(step) / largest(levels) {
            share if share < NEGLIGIBLE => Steps::Half,
            _ => Steps::Usual,
        };
        // On the next level half as many steps are an eighth of those that were seen to change so much. At first order that change is half of what
        // the step left there.
        let hidden = match steps {
            Steps::Half => step.times(0.5),
            Steps::Usual => Shares::default(),
        };
        Self {
            chosen: Some(steps),
            hidden: (level + 1, hidden),
        }
    }

    /// The choice, if it is made.
    pub fn chosen(self) -> Option<Steps> {
        self.chosen
    }

    /// Steps beside the usual number.
    pub fn per_usual(self) -> f64 {
        match self.chosen.unwrap_or_default() {
            Steps::Usual => 1.0,
            Steps::Half => 0.5,
        }
    }

    /// What the step leaves on `level` beside what the difference between levels shows.
    pub fn hidden_error(self, level: usize) -> Shares {
        let (from, error) = self.hidden;
        error.times(0.5_f64.powi(level.saturating_sub(from) as i32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_follow_what_they_change() {
        let levels = Shares::both(1e-2);
        for (step, expected, per_usual) in [(3e-3, Steps::Usual, 1.0), (9e-4, Steps::Half, 0.5)] {
            let steps = VehicleSteps::new(3, levels, Shares::both(step));
            assert_eq!((steps.chosen(), steps.per_usual()), (Some(expected), per_usual));
        }
        // Nothing moves on either level.
        let still = VehicleSteps::new(3, Shares::default(), Shares::default());
        assert_eq!(still.chosen(), Some(Steps::Usual));
    }

    #[test]
    fn what_half_as_many_steps_leave_is_counted() {
        // At first order a step h leaves 8e-4 on level 1. Half of it changes that by 4e-4. Level 4 has the steps of level 3, h/4.
        let half = VehicleSteps::new(3, Shares::both(1e-2), Shares::both(4e-4));
        assert!((half.hidden_error(4).force / 2e-4 - 1.0).abs() < 1e-12);
        assert!((half.hidden_error(5).movement / 1e-4 - 1.0).abs() < 1e-12);
        let usual = VehicleSteps::new(3, Shares::both(1e-2), Shares::both(8e-3));
        assert_eq!(usual.hidden_error(4), Shares::default());
    }
}
