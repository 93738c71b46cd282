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

/// The steps per node spacing on fine meshes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum VehicleSteps {
    /// Not yet looked at.
    #[default]
    Unknown,
    /// As many as on coarse meshes.
    Usual,
    /// Half as many from a level on, where they leave an `error` that the difference between levels does not show.
    Half { from: usize, error: Shares },
}

impl VehicleSteps {
    /// For the levels beyond `level`: the one [`SEEN_BELOW`] it differs from the next by `levels`, and half the step changes it by `step`.
    pub fn new(level: usize, levels: Shares, step: Shares) -> Self {
        let largest = |shares: Shares| shares.force.max(shares.movement);
        // False where nothing moves on either level.
        if largest(step) / largest(levels) < NEGLIGIBLE {
            // On the next level the step is then a quarter of the one that was halved. At first order it leaves half of what that changed.
            Self::Half {
                from: level + 1,
                error: step.times(0.5),
            }
        } else {
            Self::Usual
        }
    }

    /// What the step leaves on `level` beside what the difference between levels shows.
    pub fn hidden_error(self, level: usize) -> Shares {
        match self {
            Self::Half { from, error } if level >= from => error.times(0.5_f64.powi((level - from) as i32)),
            _ => Shares::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_follow_what_they_change() {
        let levels = Shares::both(1e-2);
        let chosen = |step: f64| VehicleSteps::new(3, levels, Shares::both(step));
        assert_eq!(chosen(3e-3), VehicleSteps::Usual);
        assert!(matches!(chosen(9e-4), VehicleSteps::Half { from: 4, .. }));
        // Nothing moves on either level.
        let still = VehicleSteps::new(3, Shares::default(), Shares::default());
        assert_eq!(still, VehicleSteps::Usual);
    }

    #[test]
    fn what_half_as_many_steps_leave_is_counted() {
        // At first order a step h leaves 8e-4 on level 1. Half of it changes that by 4e-4. Level 4 has the steps of level 3, h/4.
        let half = VehicleSteps::new(3, Shares::both(1e-2), Shares::both(4e-4));
        assert!((half.hidden_error(4).force / 2e-4 - 1.0).abs() < 1e-12);
        assert!((half.hidden_error(5).movement / 1e-4 - 1.0).abs() < 1e-12);
        assert_eq!(half.hidden_error(3), Shares::default());
        let usual = VehicleSteps::new(3, Shares::both(1e-2), Shares::both(8e-3));
        assert_eq!(usual.hidden_error(4), Shares::default());
    }
}
