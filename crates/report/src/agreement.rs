//! Computed force against readings of a load cell.

use creepage_fit::readings::{Measured, Place, Reading, Readings};
use creepage_fit::{Series, held_end, located, of_forces, within_reach};
use creepage_run::{Error, PassRecord, Run};
use creepage_scene::{CableEnd, Scene};

/// Readings and the force computed at the same passes.
#[derive(Debug)]
pub struct Agreement {
    /// The end that pressed on the load cell.
    pub end: CableEnd,
    pub readings: Vec<Reading>,
    /// Number of readings whose pass was computed.
    pub compared: usize,
    /// Root of the mean square of measured minus computed force over these \[N\].
    pub rms_n: f64,
    /// Mean of measured minus computed force \[N\].
    pub mean_n: f64,
    /// Largest measured force \[N\].
    pub largest_n: f64,
    /// What looks mistaken: sign or unit.
    pub mistakes: Vec<String>,
}

impl Agreement {
    /// Compares the readings with the run.
    ///
    /// # Errors
    ///
    /// [`Error`] if no end of the cable is held.
    pub fn new(scene: &Scene, run: &Run, readings: &Readings) -> Result<Self, Error> {
        let (readings, beyond) = within_reach(&Series { scene, readings });
        // One cell is drawn: of two, the one that the scene holds.
        let end = held_end(scene)?;
        let located = |reading: &Reading| Ok((*reading, located(scene, reading.measured)?));
        let located = readings.list.iter().map(located);
        let mut located = located.collect::<Result<Vec<(Reading, Measured)>, Error>>()?;
        located.retain(|(_, measured)| *measured == Measured::Force(Place::End(end)));
        let readings: Vec<Reading> = located.into_iter().map(|(reading, _)| reading).collect();
        let computed = |reading: &Reading| {
            let force = force_at(&run.passes, end, reading.passes)?;
            Some((reading.passes, (reading.value, force)))
        };
        let compared: Vec<_> = readings.iter().filter_map(computed).collect();
        // The zero reading has no sign and no size.
        let loaded = compared.iter().filter(|(passes, _)| *passes > 0);
        let loaded: Vec<(f64, f64)> = loaded.map(|(_, both)| *both).collect();
        let mean = |of: fn(f64) -> f64| {
            let differences = compared.iter().map(|(_, (measured, force))| of(measured - force));
            differences.sum::<f64>() / compared.len().max(1) as f64
        };
        let sizes = readings.iter().map(|reading| reading.value.abs());
        let mistakes = of_forces(end.name(), &loaded);
        Ok(Self {
            end,
            compared: compared.len(),
            rms_n: mean(|d| d * d).sqrt(),
            mean_n: mean(|d| d),
            largest_n: sizes.fold(0.0, f64::max),
            mistakes: mistakes.into_iter().chain(beyond).collect(),
            readings,
        })
    }
}

/// Force on the end after `pass` \[N\]; between listed passes along a straight line, `None` beyond the last.
fn force_at(passes: &[PassRecord], end: CableEnd, pass: u64) -> Option<f64> {
    if pass == 0 {
        return Some(0.0);
    }
    let force = |record: &PassRecord| end.of([record.upstream_force_n, record.downstream_force_n]);
    let next = passes.partition_point(|record| record.pass < pass);
    let after = passes.get(next)?;
    if after.pass == pass || next == 0 {
        return Some(force(after));
    }
    let before = &passes[next - 1];
    let share = (pass - before.pass) as f64 / (after.pass - before.pass) as f64;
    Some(force(before) + share * (force(after) - force(before)))
}
