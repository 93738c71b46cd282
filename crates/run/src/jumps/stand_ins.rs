//! What periods leave wrong that stand in for the traffic: a mix with nearly its shares, or an even
//! order in place of a random one.
//!
//! Each is compared with others that stand in for it as well, by jumps as good as its own.

use cycle_jump::Record;

use super::draws::Draws;
use super::jump_search::{Found, Search};
use super::scatter::scatter;
use crate::answer::differences::{Shares, difference, extremes_difference};
use crate::passes::Passes;
use crate::tuning::jumps::MIN_FIRST_PERIODS;
use creepage_plan::tuning::meshes::MAX_NODE_UPDATES;
use creepage_plan::{Error, Period};

/// Draws of a random order, between these numbers, as long as they take no more than a quarter of
/// the node updates of a mesh.
const MIN_DRAWS: usize = 4;
const MAX_DRAWS: usize = 24;

/// Runs with other periods than that of the plan, to be compared with its own, which were found.
pub struct StandIns<'a> {
    search: Search<'a>,
    found: &'a Found,
    /// The first passes, by which periods are not compared: those of a random order are a draw that
    /// no mix foretells, and means over periods of other lengths hold other passes. They are two
    /// periods, or half of the traffic if that is less.
    first: u64,
}

impl<'a> StandIns<'a> {
    pub fn new(search: Search<'a>, found: &'a Found) -> Self {
        let plan = search.simulator.plan;
        let first = (2 * plan.period.len() as u64).min(plan.scene.traffic.passes / 2);
        Self { search, found, first }
    }

    /// The passes of `vehicles` in place of the period of the plan, by jumps as good as those that
    /// were found.
    fn in_place(&mut self, vehicles: Vec<usize>) -> Result<Passes, Error> {
        let (mut size, period) = (self.found.size, &self.search.simulator.plan.period);
        let first = size.first_periods * period.len() as u64;
        size.first_periods = first.div_ceil(vehicles.len() as u64).max(MIN_FIRST_PERIODS);
        let period = Period {
            vehicles,
            ..period.clone()
        };
        self.search.simulate(self.found.level, size, &period)
    }

    /// What random orders of the period leave in the mean, from as many draws as the tolerance
    /// needs or as are affordable.
    pub fn draws(&mut self) -> Result<Draws, Error> {
        let (mut all, mut work) = (Vec::new(), 0);
        loop {
            let order = self.search.simulator.plan.period.shuffled(all.len() as u64);
            let passes = self.in_place(order)?;
            work += passes.statistics.work();
            all.push(passes.records);
            if all.len() >= MIN_DRAWS {
                let draws = Draws::new(
                    &self.found.passes.records,
                    &all,
                    self.first,
                    self.search.simulator.scale,
                );
                let is_enough = work > MAX_NODE_UPDATES / 4 || all.len() >= MAX_DRAWS;
                if is_enough || draws.error.is_within(self.search.allowed) {
                    return Ok(draws);
                }
            }
        }
    }

    /// What a period that stands in for the traffic changes: its share of what each other one does,
    /// forces and movements on the passes that both show, and the largest of all.
    pub fn mix_error(&mut self) -> Result<Shares, Error> {
        let (found, simulator) = (self.found, &self.search.simulator);
        let (period, scale) = (&simulator.plan.period, simulator.scale);
        let mut error = Shares::default();
        if !period.is_own() && !period.reordered {
            error = scatter(&found.passes.period, scale);
        }
        for (vehicles, share) in &period.others {
            let other = self.in_place(vehicles.clone())?;
            let [rows, other_rows] = [&found.passes, &other].map(|passes| self.later(passes));
            // Later rows may be means: the largest of a single pass may stand among the first rows.
            let [all, all_other] =
                [&found.passes, &other].map(|passes| [&passes.records[..], &passes.peaks].concat());
            // The largest of all passes are not between those of two mixes; of absent vehicles
            // single passes show them.
            let is_absent = vehicles.iter().any(|vehicle| period.absent.contains(vehicle));
            let weight = if is_absent { *share } else { 1.0 };
            let extremes = extremes_difference(&all, &all_other, scale).times(weight);
            error = error + difference(rows, other_rows, scale).times(*share).max(extremes);
        }
        Ok(error)
    }

    /// The passes by which periods are compared.
    fn later<'p>(&self, passes: &'p Passes) -> &'p [Record] {
        let records = &passes.records;
        &records[records.partition_point(|record| record.pass <= self.first)..]
    }
}
