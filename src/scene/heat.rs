//! `[heat]`: the temperature of the cable over the day.

use super::data::{Heat, Warming};
use super::error::SceneError;
use super::range::{EXPANSION, OFFSET, SWING, TEMPERATURE, TIME_OF_DAY};
use super::table::Table;
use super::value::Value;

/// The section, where there is one.
pub fn heat(root: &Table) -> Result<Option<Heat>, SceneError> {
    let Some(section) = root.optional("heat") else {
        return Ok(None);
    };
    let table = Table::new(section)?;
    let expansion = table.quantity("expansion", EXPANSION)?;
    let offset = table.optional_quantity("offset", OFFSET)?.unwrap_or(0.0);
    let warming = match table.alternatives("daily_swing", "profile")? {
        [Some(swing), _] => Warming::Swing(swing.quantity(SWING)?),
        [None, Some(points)] => Warming::Profile(profile(&points)?),
        [None, None] => {
            let allowed = "one of the two: daily_swing = \"20 K\" or profile = [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]";
            return Err(table
                .value
                .inconsistent("neither `daily_swing` nor `profile`", allowed));
        }
    };
    Ok(Some(Heat {
        expansion,
        warming,
        offset,
    }))
}

/// Points of the day.
fn profile(list: &Value) -> Result<Vec<(f64, f64)>, SceneError> {
    const ALLOWED: &str = "two points of the day or more, such as [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]], their times ascending";
    let items = list.some_items(ALLOWED)?;
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(items.len());
    for item in &items {
        let [time, kelvin] = &item.items(ALLOWED)?[..] else {
            return Err(item.inconsistent(item.written(), "a point of the day: [\"15 h\", \"20 K\"]"));
        };
        points.push((time.quantity(TIME_OF_DAY)?, kelvin.quantity(TEMPERATURE)?));
    }
    Ok(points)
}
