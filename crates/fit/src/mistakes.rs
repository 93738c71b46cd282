//! Mistakes of sign and unit: forces that no friction explains, but a sign or a thousand would.

use crate::instrument::instruments;
use crate::model::MeshOf;
use crate::noise::median;
use crate::problem::Problem;
use crate::readings::{Measured, Place};
use creepage_run::Error;

/// Share of the forces of one sign that makes it the sign of all: a few near zero may have either
/// by noise.
const NEARLY_ALL: f64 = 0.9;
/// Ratios of measured to expected force that mean a thousand: from 0.03 to 1, friction moves the
/// force by less than 30.
const THOUSAND: (f64, f64) = (1e3 / 12.0, 12e3);

/// What looks mistaken compared with what the scenes' own values predict.
pub fn mistakes(problem: &Problem<'_>) -> Result<Vec<String>, Error> {
    let expected = problem.predict(MeshOf::Guess, 1.0, &[])?;
    let mut mistakes = Vec::new();
    for instrument in instruments(problem.rows) {
        if let Measured::Force(Place::End(end)) = instrument.1 {
            // The zero reading has no sign and no size.
            let pairs = problem.rows.iter().zip(&expected);
            let own = pairs.filter(|(row, _)| row.instrument() == instrument && row.passes > 0);
            let both: Vec<(f64, f64)> = own.map(|(row, force)| (row.value, *force)).collect();
            mistakes.extend(of_forces(end.name(), &both));
        }
    }
    Ok(mistakes)
}

/// What looks mistaken of the forces on the end `place` after passes, each measured and expected.
pub fn of_forces(place: &str, both: &[(f64, f64)]) -> Vec<String> {
    let negative = |of: fn(&(f64, f64)) -> f64| {
        both.iter().filter(|pair| of(pair) < 0.0).count() as f64 / both.len().max(1) as f64
    };
    let (found, wanted) = (negative(|pair| pair.0), negative(|pair| pair.1));
    let all = if found == 1.0 { "all" } else { "nearly all" };
    let ratio = median(both.iter().map(|pair| pair.0.abs())) / median(both.iter().map(|pair| pair.1.abs()));
    let is_thousand = |ratio: f64| (THOUSAND.0..THOUSAND.1).contains(&ratio);
    let at = format!("forces at the {place} end are");
    let mut mistakes = Vec::new();
    if both.len() > 2 && found >= NEARLY_ALL && wanted <= 1.0 - NEARLY_ALL {
        mistakes.push(format!(
            "{all} {at} negative where the scene presses on the cell: does the cell count tension as positive? \
             --tension-positive turns the sign"
        ));
    } else if both.len() > 2 && found <= 1.0 - NEARLY_ALL && wanted >= NEARLY_ALL {
        mistakes.push(format!(
            "{all} {at} positive where the scene pulls at the cell: tension is negative here"
        ));
    }
    for (ratio, size, unit) in [(ratio.recip(), "small", "kN"), (ratio, "large", "N")] {
        if is_thousand(ratio) {
            mistakes.push(format!(
                "the {at} about a thousand times too {size} for this scene: are they {unit}? --unit {unit} reads them so"
            ));
        }
    }
    mistakes
}
