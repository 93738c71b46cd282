//! The temperature of the cable over a day.

use std::f64::consts::TAU;

use crate::JumpError;
use crate::error::check;

/// The force Θ = EA α T \[N\] that heat would make in a cable which cannot move, over a day that
/// repeats; times are shares of the day.
#[derive(Debug, Clone, PartialEq)]
pub enum DailyHeat {
    /// A cosine, lowest at the day's ends and highest at noon.
    Cosine {
        /// Θ at its lowest.
        lowest: f64,
        /// Θ at its highest.
        highest: f64,
    },
    /// Straight lines between points (time, Θ), whose times ascend from 0 on and stay below 1; the
    /// last is joined to the first.
    Profile(Vec<(f64, f64)>),
}

impl DailyHeat {
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] for a force that is not finite, a profile without points, or
    /// points that are not in the order of one day.
    pub(super) fn check(&self) -> Result<(), JumpError> {
        let points = match self {
            Self::Cosine { lowest, highest } => &vec![(0.0, *lowest), (0.5, *highest)],
            Self::Profile(points) => points,
        };
        let is_in_day = points.iter().all(|(time, _)| (0.0..1.0).contains(time));
        let ascends = points.is_sorted_by(|a, b| a.0 < b.0);
        check(
            "points of a day's temperature",
            !points.is_empty(),
            "at least one",
        )?;
        check(
            "times of a day's temperature",
            is_in_day && ascends,
            "ascending, from 0 to below 1",
        )?;
        let is_finite = points.iter().all(|(_, force)| force.is_finite());
        check("thermal force", is_finite, "finite")
    }

    /// Θ at `time` \[N\].
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Cosine { lowest, highest } => {
                lowest + 0.5 * (highest - lowest) * (1.0 - (TAU * time).cos())
            }
            Self::Profile(points) => {
                let time = time.rem_euclid(1.0);
                let (first, last) = (points[0], points[points.len() - 1]);
                let next = points.partition_point(|point| point.0 <= time);
                let before = next.checked_sub(1).map_or((last.0 - 1.0, last.1), |k| points[k]);
                let after = points.get(next).copied().unwrap_or((first.0 + 1.0, first.1));
                before.1 + (after.1 - before.1) * (time - before.0) / (after.0 - before.0)
            }
        }
    }

    /// Times within the day at which it turns, ascending: its extremes, and the corners of a
    /// profile.
    pub(super) fn turns(&self) -> Vec<f64> {
        match self {
            Self::Cosine { .. } => vec![0.5],
            Self::Profile(points) => {
                let times = points.iter().map(|point| point.0);
                times.filter(|time| *time > 0.0).collect()
            }
        }
    }

    /// Whether it has corners, at which its rate of change jumps.
    pub(super) fn has_corners(&self) -> bool {
        matches!(self, Self::Profile(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_is_joined_by_straight_lines_and_repeats() {
        let profile = DailyHeat::Profile(vec![(0.25, 10.0), (0.75, 30.0)]);
        for (time, expected) in [
            (0.25, 10.0),
            (0.5, 20.0),
            (0.75, 30.0),
            (1.0, 20.0),
            (0.0, 20.0),
            (0.875, 25.0),
        ] {
            assert!((profile.at(time) - expected).abs() < 1e-12, "{time}");
        }
    }

    #[test]
    fn what_is_no_day_is_refused() {
        let is_refused = |heat: DailyHeat| heat.check().is_err();
        for points in [
            vec![],
            vec![(0.5, 1.0), (0.25, 2.0)],
            vec![(0.5, 1.0), (0.5, 2.0)],
            vec![(1.0, 1.0)],
            vec![(f64::NAN, 1.0)],
            vec![(0.5, f64::INFINITY)],
        ] {
            assert!(is_refused(DailyHeat::Profile(points.clone())), "{points:?}");
        }
        assert!(is_refused(DailyHeat::Cosine {
            lowest: f64::NAN,
            highest: 1.0
        }));
        assert!(!is_refused(DailyHeat::Profile(vec![(0.0, 1.0), (0.5, 2.0)])));
    }

    #[test]
    fn a_cosine_is_highest_at_noon() {
        let day = DailyHeat::Cosine {
            lowest: -3.0,
            highest: 7.0,
        };
        assert!((day.at(0.0) + 3.0).abs() < 1e-12 && (day.at(0.5) - 7.0).abs() < 1e-12);
    }
}
