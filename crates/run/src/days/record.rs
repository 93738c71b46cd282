//! What days of heat show a reader.

use cable_dem::Mesh;
use cycle_jump::days::Days;

use super::day_simulator::{DaySimulator, a_day};
use crate::answer::{DayExtremes, DayPoint, ForceProfile, HeatRecord};
use crate::passes::Task;
use creepage_plan::{Error, shown::words_if};
use creepage_scene::DAYS_PER_YEAR;

impl DaySimulator<'_> {
    /// How many days were simulated, and how.
    pub fn reason(&self, days: &Days) -> Result<String, Error> {
        let real = if self.day()?.is_simulated() {
            "all passes".to_owned()
        } else {
            format!("{} periods of the traffic", self.periods_a_day)
        };
        let lasting = days.periodic_from.map_or_else(String::new, |day| {
            format!("; from day {day} on every day is like the one before")
        });
        let (simulated, count) = (days.simulated_days, self.count());
        let others = words_if(simulated < count, ", the others follow from them");
        Ok(format!(
            "days: {simulated} of {count} were simulated with {real} each{others}{lasting}"
        ))
    }

    /// What heat does over all days.
    pub fn record(&self, mesh: Mesh, days: &Days) -> Result<HeatRecord, Error> {
        let cable = Task::of(self.plan, self.plan.scene, mesh).cable()?;
        let passes_per_day = a_day(self.plan.scene);
        let cycle = days.last_day.iter().map(|row| DayPoint {
            hour: 24.0 * (row.passes as f64 - 0.5) / passes_per_day as f64,
            warming_k: row.thermal_force / self.per_kelvin(),
            upstream_force_n: row.outcome.force.upstream,
            downstream_force_n: row.outcome.force.downstream,
            upstream_displacement_m: row.outcome.upstream_displacement,
            downstream_displacement_m: row.outcome.downstream_displacement,
        });
        let drift = days.periodic_from.map(|_| days.drift);
        Ok(HeatRecord {
            cycle: cycle.collect(),
            passes_per_day,
            all_days: DayExtremes::new(self.count(), &days.extremes),
            periodic_from_day: days.periodic_from,
            drift_per_day_m: drift,
            drift_per_year_m: drift.map(|drift| DAYS_PER_YEAR * drift),
            hot_profile: ForceProfile::new(&cable, &days.hot)?,
            cold_profile: ForceProfile::new(&cable, &days.cold)?,
        })
    }

    /// Days of the plan's traffic.
    fn count(&self) -> u64 {
        self.plan.scene.traffic.passes.div_ceil(a_day(self.plan.scene))
    }
}
