//! The temperature of the cable over a day.

use std::f64::consts::TAU;

use cable_dem::CableError;

/// The force Θ = EA α T \[N\] that heat would make in a cable which cannot move, over a day that repeats; times are shares of the day.
#[derive(Debug, Clone, PartialEq)]
pub enum DailyHeat {
    /// A cosine, lowest at the day's ends and highest at noon.
    Cosine {
        /// Θ at its lowest.
        lowest: f64,
        /// Θ at its highest.
        highest: f64,
    },
    /// Straight lines between points (time, Θ), whose times ascend from 0 on and stay below 1; the last is joined to the first.
    Profile(Vec<(f64, f64)>),
}

impl DailyHeat {
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] where a force is not finite, or a profile has no points or none in the order of one day.
    pub(super) fn check(&self) -> Result<(), CableError> {
        let points = match self {
            Self::Cosine { lowest, highest } => &vec![(0.0, *lowest), (0.5, *highest)],
            Self::Profile(points) => points,
        };
        let invalid = |name, value, allowed| Err(CableError::InvalidParameter { name, value, allowed });
        if points.is_empty() {
            return invalid("points of the day", 0.0, "at least one");
        }
        let mut before = None;
        for (time, force) in points {
            if !(0.0..1.0).contains(time) || before.is_some_and(|before| before >= time) {
                return invalid(
                    "time of the day",
                    *time,
                    "from 0 to below 1 and after the one before",
                );
            }
            if !force.is_finite() {
                return invalid("thermal force", *force, "finite");
            }
            before = Some(time);
        }
        Ok(())
    }

    /// Θ at `time`.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Cosine { lowest, highest } => {
                lowest + 0.5 * (highest - lowest) * (1.0 - (TAU * time).cos())
            }
            Self::Profile(points) => {
                let time = time.rem_euclid(1.0);
                let next = points.partition_point(|point| point.0 <= time);
                let before = if next == 0 {
                    let last = points[points.len() - 1];
                    (last.0 - 1.0, last.1)
                } else {
                    points[next - 1]
                };
                let after = points
                    .get(next)
                    .copied()
                    .unwrap_or((points[0].0 + 1.0, points[0].1));
                before.1 + (after.1 - before.1) * (time - before.0) / (after.0 - before.0)
            }
        }
    }

    /// Times within the day at which it turns, ascending: its extremes, and the corners of a profile.
    pub fn turns(&self) -> Vec<f64> {
        match self {
            Self::Cosine { .. } => vec![0.5],
            Self::Profile(points) => points
                .iter()
                .map(|point| point.0)
                .filter(|time| *time > 0.0)
                .collect(),
        }
    }

    /// Whether it has corners, at which its rate of change jumps.
    pub fn has_corners(&self) -> bool {
        matches!(self, Self::Profile(_))
    }

    /// Times of the day's highest and lowest Θ.
    pub fn extremes(&self) -> (f64, f64) {
        let mut times = self.turns();
        times.insert(0, 0.0);
        let by_heat = |a: &f64, b: &f64| self.at(*a).total_cmp(&self.at(*b));
        let hottest = times.iter().copied().max_by(by_heat).unwrap_or(0.0);
        let coldest = times.iter().copied().min_by(by_heat).unwrap_or(0.0);
        (hottest, coldest)
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
        assert_eq!(profile.extremes(), (0.75, 0.25));
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
        assert_eq!(day.extremes(), (0.5, 0.0));
    }
}
