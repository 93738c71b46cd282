//! A day of traffic and heat: when vehicles come, how warm the cable is then, which periods are simulated.

use cable_dem::CableError;

use super::heat::DailyHeat;

/// Periods that are simulated one by one on the first morning, and growth of the steps after them.
const MORNING: u64 = 8;
const MORNING_GROWTH: f64 = 1.5;
/// Knots beyond this share of all periods: every one is simulated.
const NEARLY_ALL: f64 = 0.5;
/// Periods after a corner of the temperature at which one is simulated: the cable turns within a few.
const AFTER_A_CORNER: [u64; 6] = [0, 1, 2, 4, 8, 16];

/// A day of traffic and heat.
#[derive(Debug, Clone)]
pub struct Day {
    /// Passes of a day, at least as many as a period has; evenly over the day, the first after half an interval. The last period of the day
    /// takes those along that are too few for another one.
    pub passes: u64,
    /// Vehicles after which the traffic repeats, every day anew.
    pub period: usize,
    /// Temperature over the day.
    pub heat: DailyHeat,
    /// Times of the day at which a period is simulated, evenly.
    pub knots: u64,
}

impl Day {
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] where it has no whole period, no knot, or a profile without points or whose times are not those
    /// of one day in their order.
    pub(super) fn check(&self) -> Result<(), CableError> {
        let invalid = |name, value, allowed| Err(CableError::InvalidParameter { name, value, allowed });
        if self.period == 0 {
            return invalid("period of the traffic", 0.0, "at least one vehicle");
        }
        if self.passes < self.period as u64 {
            return invalid("passes a day", self.passes as f64, "at least those of a period");
        }
        if self.knots == 0 {
            return invalid("real periods a day", 0.0, "at least one");
        }
        self.heat.check()
    }

    /// Periods of a day.
    pub fn periods(&self) -> u64 {
        self.passes / self.period as u64
    }

    /// Time when `periods` of the day are done, as a number of periods: the last one is longer.
    pub(super) fn time(&self, periods: u64) -> f64 {
        if periods == self.periods() {
            self.passes as f64 / self.period as f64
        } else {
            periods as f64
        }
    }

    /// Passes done when `periods` of the day are.
    pub(super) fn passes_of(&self, periods: u64) -> u64 {
        if periods == self.periods() {
            self.passes
        } else {
            periods * self.period as u64
        }
    }

    /// Θ when `passes` of the day are done, which need not be whole \[N\].
    pub(super) fn thermal_force(&self, passes: f64) -> f64 {
        self.heat.at(passes / self.passes as f64)
    }

    /// Θ at the last pass before `periods` are done.
    pub(super) fn before(&self, periods: f64) -> f64 {
        self.thermal_force((periods * self.period as f64 - 0.5).max(0.0))
    }

    /// Θ at the turns of the temperature between the pass `next` of the day and the one before.
    pub(super) fn turns_before(&self, next: u64) -> Vec<f64> {
        let all = self.passes as f64;
        let (from, to) = ((next as f64 - 0.5) / all, (next as f64 + 0.5) / all);
        let between = |time: &f64| from < *time && *time < to.min(1.0);
        self.heat
            .turns()
            .into_iter()
            .filter(between)
            .map(|time| self.heat.at(time))
            .collect()
    }

    /// Whether every period of a day is simulated.
    pub fn is_simulated(&self) -> bool {
        self.knots as f64 >= NEARLY_ALL * self.periods() as f64
    }

    /// Periods of a day that are simulated, ascending; `first` of the first day.
    pub(super) fn simulated(&self, first: bool) -> Vec<u64> {
        let all = self.periods();
        if self.is_simulated() {
            return (0..all).collect();
        }
        let mut knots: Vec<u64> = (0..self.knots)
            .map(|k| (k as f64 * all as f64 / self.knots as f64).round() as u64)
            .collect();
        for time in self.heat.turns() {
            let turn = (time * all as f64).round() as u64;
            let after: &[u64] = if self.heat.has_corners() {
                &AFTER_A_CORNER
            } else {
                &[0]
            };
            knots.extend(after.iter().map(|after| turn + after));
        }
        if self.heat.has_corners() {
            knots.extend(AFTER_A_CORNER);
        }
        if first {
            let mut step = 1.0;
            let mut next = 0.0;
            while step < all as f64 / self.knots as f64 {
                knots.push(next as u64);
                step = if next < MORNING as f64 {
                    1.0
                } else {
                    MORNING_GROWTH * step
                };
                next += step;
            }
        }
        knots.push(all - 1);
        knots.retain(|knot| *knot < all);
        knots.sort_unstable();
        knots.dedup();
        knots
    }
}
