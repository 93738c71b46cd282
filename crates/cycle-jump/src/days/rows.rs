//! What passes of a day did: those that were simulated, and the others from their neighbours.

use cable_dem::PassOutcome;

use crate::period::phase_of;

/// The cable after a pass or a change of temperature.
#[derive(Debug, Clone)]
pub struct Row {
    /// Passes of the day done.
    pub passes: u64,
    /// Θ \[N\].
    pub thermal_force: f64,
    /// The cable then.
    pub outcome: PassOutcome,
    /// Whether the passes around it are simulated.
    pub simulated: bool,
    /// Whether only the temperature has changed since the last pass.
    pub heat: bool,
}

/// What the passes of a simulated period did beside a straight line over it.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Passes of the day before it.
    begin: u64,
    passes: Vec<PassOutcome>,
}

impl Shape {
    /// Of the period whose rows begin with `rows[first]`.
    pub fn of(rows: &[Row], first: usize) -> Self {
        let before = &rows[first.max(1) - 1];
        let passes: Vec<&Row> = rows[first..].iter().filter(|row| !row.heat).collect();
        let count = passes.len() as f64;
        let before_them = at_rest(&before.outcome);
        let last = passes
            .last()
            .map_or_else(|| before.outcome.clone(), |row| at_rest(&row.outcome));
        let shape = |(done, row): (usize, &&Row)| {
            let share = (done + 1) as f64 / count;
            PassOutcome::combined(&[(1.0, &row.outcome), (share - 1.0, &before_them), (-share, &last)])
        };
        Self {
            begin: before.passes,
            passes: passes.iter().enumerate().map(shape).collect(),
        }
    }
}

/// What the pass did that is the `pass`-th of the day, from 1, and whether it was not simulated: from the day's `rows`, and from the `shapes` of
/// periods of `period` passes.
pub fn of_pass(rows: &[Row], shapes: &[Shape], pass: u64, period: usize) -> Option<(PassOutcome, bool)> {
    let passes = || rows.iter().filter(|row| !row.heat);
    if let Some(row) = passes().find(|row| row.simulated && row.passes == pass) {
        return Some((row.outcome.clone(), false));
    }
    // Ends of periods on both sides.
    let last = rows.last()?.passes;
    let ends = |row: &&Row| row.passes % period as u64 == 0 || row.passes == last;
    let after = passes().filter(ends).find(|row| row.passes >= pass)?;
    let before = passes()
        .filter(ends)
        .rfind(|row| row.passes < pass)
        .or(rows.first())?;
    let share = (pass - before.passes) as f64 / (after.passes - before.passes) as f64;
    let phase = phase_of(pass, period);
    let distance = |shape: &&Shape| shape.begin.abs_diff(pass);
    let complete = shapes.iter().filter(|shape| shape.passes.len() >= period);
    let shape = complete.min_by_key(distance)?;
    let outcome = PassOutcome::combined(&[
        (1.0 - share, &at_rest(&before.outcome)),
        (share, &at_rest(&after.outcome)),
        (1.0, &shape.passes[phase]),
    ]);
    Some((outcome, true))
}

/// The same cable after the pass: without its peaks and its heat.
fn at_rest(outcome: &PassOutcome) -> PassOutcome {
    let mut rest = outcome.clone();
    (rest.peak, rest.lowest, rest.dissipated) = (rest.force, rest.force, 0.0);
    rest
}
