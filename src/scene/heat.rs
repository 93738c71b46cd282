//! `[heat]`: the temperature of the cable over the day.

use super::data::{Heat, Scene, SolverMethod, Warming};
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
    let traffic = root.table("traffic")?;
    if traffic.optional("per_day").is_none() {
        let allowed = "`per_day` in [traffic] beside [heat]: how many vehicles meet each hour's temperature";
        return Err(table.value.inconsistent("no `traffic.per_day`", allowed));
    }
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
        let seconds = time.quantity(TIME_OF_DAY)?;
        if points.last().is_some_and(|(before, _)| seconds <= *before) {
            return Err(time.inconsistent(time.written(), "a time after that of the point before"));
        }
        points.push((seconds, kelvin.quantity(TEMPERATURE)?));
    }
    if points.len() < 2 {
        return Err(list.inconsistent("one point", ALLOWED));
    }
    Ok(points)
}

/// Refuses what heat is not computed with.
pub fn is_possible(root: &Table, scene: &Scene) -> Result<(), SceneError> {
    let (Some(_), Some(section)) = (scene.warming(), root.optional("heat")) else {
        return Ok(());
    };
    let refused = |found: String, allowed: &str| Err(section.inconsistent(found, allowed));
    if !scene.friction.law.has_memory() {
        return refused(
            format!("[heat] with `friction.law` = \"{}\"", scene.friction.law.name()),
            "\"coulomb\" or \"elastic-plastic\" beside [heat]: temperature steps need a state of rest",
        );
    }
    if scene.friction_limit() == 0.0 {
        return refused(
            "[heat] without friction".to_owned(),
            "a `friction.dynamic_coefficient` greater than 0 beside [heat]",
        );
    }
    if scene.solver.method == SolverMethod::Explicit {
        return refused(
            "[heat] with `solver.method` = \"explicit\"".to_owned(),
            "\"auto\", \"quasi-static\" or \"pass-law\" beside [heat]: it is computed without inertia",
        );
    }
    Ok(())
}
