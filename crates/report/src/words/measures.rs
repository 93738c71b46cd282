//! Measures side by side, for a reader.

use std::collections::BTreeMap;

use super::number::{passes, quantity, significant};
use super::reader::Reader;
use super::table::Table;
use creepage_plan::shown::words_if;
use creepage_run::Limited;
use creepage_run::answer::after;
use creepage_scene::{Cost, si_unit};
use creepage_study::measures::{Comparison, Extreme, FRICTION_KEY, Held, HeldClamp, MeasureAnswer};

/// Keys that have a shorter name.
const NAMES: [(&str, &str); 5] = [
    (FRICTION_KEY, "friction"),
    ("ground.vertical_peak", "deflection"),
    ("ground.longitudinal_peak", "motion of the duct"),
    ("friction.shape_factor", "shape factor"),
    ("cable.axial_stiffness", "EA"),
];
const NONE: &str = "–";

/// What an uncertain key is called.
pub fn key_name(key: &str) -> &str {
    NAMES
        .iter()
        .find(|(known, _)| *known == key)
        .map_or(key, |(_, name)| name)
}

/// A value of it.
pub fn key_value(key: &str, value: f64) -> String {
    si_unit(key).map_or_else(|| significant(value), |unit| quantity(value, unit))
}

/// A combination: "friction 0.5, deflection 600 µm".
fn combination(at: &BTreeMap<String, f64>) -> String {
    let each = at
        .iter()
        .map(|(key, value)| format!("{} {}", key_name(key), key_value(key, *value)));
    each.collect::<Vec<_>>().join(", ")
}

/// What is not known, and from where.
pub fn uncertain(comparison: &Comparison) -> String {
    let each = comparison.uncertain.iter().map(|unknown| {
        let [low, high] = [unknown.low, unknown.high].map(|value| key_value(&unknown.key, value));
        format!("{} {low} to {high}", key_name(&unknown.key))
    });
    let all = each.collect::<Vec<_>>().join(", ");
    let assumed = comparison.uncertain.iter().any(|unknown| unknown.assumed);
    let assumed = words_if(assumed, " (assumed: the scene has no [uncertain])");
    format!(
        "{all}{assumed}; {} combinations, {} runs",
        comparison.combinations, comparison.runs
    )
}

/// What a measure changes of the scene as it is.
fn fitted(measure: &MeasureAnswer, scene: &MeasureAnswer, reader: &Reader) -> String {
    let held = |held: Held| match held {
        Held::Free => "free".to_owned(),
        Held::Fixed => "fixed".to_owned(),
        Held::Spring(stiffness) => reader.stiffness(stiffness),
    };
    let ends = [
        ("upstream", measure.ends.upstream, scene.ends.upstream),
        ("downstream", measure.ends.downstream, scene.ends.downstream),
    ];
    let changed = ends.into_iter().filter(|(_, own, of_scene)| own != of_scene);
    let mut words: Vec<String> = changed
        .map(|(name, own, _)| format!("{name} {}", held(own)))
        .collect();
    if words.len() == 2 && measure.ends.upstream == measure.ends.downstream {
        words = vec![format!("both {}", held(measure.ends.upstream))];
    }
    let clamp = |clamp: &HeldClamp| {
        let [stiffness, place] = [
            reader.stiffness(clamp.stiffness_n_per_m),
            reader.length(clamp.position_m),
        ];
        format!("{stiffness} at {place}")
    };
    let added = measure
        .restraints
        .iter()
        .filter(|clamp| !scene.restraints.contains(clamp));
    words.extend(added.map(clamp));
    let removed = scene
        .restraints
        .iter()
        .filter(|clamp| !measure.restraints.contains(clamp));
    words.extend(removed.map(|removed| format!("without {}", clamp(removed))));
    if words.is_empty() {
        NONE.to_owned()
    } else {
        words.join(", ")
    }
}

/// In how many combinations it holds.
pub fn holds(measure: &MeasureAnswer, combinations: usize) -> String {
    match measure.kept {
        _ if measure.within_limits => "yes".to_owned(),
        // All that were asked for hold, and one between them does not.
        kept if kept == combinations => format!("no, not between the {combinations}"),
        kept => format!("no, {kept} of {combinations}"),
    }
}

/// The same in a sentence.
pub fn held_in(measure: &MeasureAnswer, combinations: usize) -> String {
    match measure.kept {
        _ if measure.within_limits => "holds for every combination".to_owned(),
        kept if kept == combinations => format!("holds for all {kept} combinations, but not between them"),
        kept => format!("holds for {kept} of {combinations} combinations"),
    }
}

/// Every measure with its worst combination.
pub fn measures(comparison: &Comparison, reader: &Reader) -> Table {
    let is_priced = comparison.measures.iter().any(|measure| measure.cost.is_some());
    let mut head = vec![
        "measure",
        "fitted",
        "holds",
        "nearest limit, or exceeded most",
        "worst of limit",
        "where",
        "in the middle",
        "on clamps",
        "moved",
        "exceeded after",
    ];
    head.extend(is_priced.then_some("cost"));
    let row = |measure: &MeasureAnswer| {
        let amount = |extreme: &Extreme| reader.amount(extreme.quantity, extreme.value);
        let of = |of: &dyn Fn(&Extreme) -> Option<String>| {
            measure
                .worst
                .as_ref()
                .and_then(of)
                .unwrap_or_else(|| NONE.to_owned())
        };
        let cost = match &measure.cost {
            None => NONE.to_owned(),
            Some(Cost::Number(cost)) => significant(*cost),
            Some(Cost::Text(text)) => text.clone(),
        };
        let mut row = vec![
            // With a soft hyphen.
            measure.name.replace("stream", "\u{ad}stream"),
            fitted(measure, &comparison.measures[0], reader),
            holds(measure, comparison.combinations),
            of(&|worst| Some(worst.quantity.at(worst.end))),
            of(&|worst| {
                let limit = worst.quantity.given_in(&reader.units, worst.limit);
                Some(format!("{} of {limit}", amount(worst)))
            }),
            of(&|worst| Some(combination(&worst.at))),
            measure.nominal.as_ref().map_or_else(|| NONE.to_owned(), amount),
            of(&|worst| Some(reader.amount(Limited::Force, worst.clamp_force_n?))),
            of(&|worst| Some(reader.amount(Limited::Movement, worst.movement_m))),
            of(&|worst| {
                let reached = worst.reached_after?;
                Some(reached.years.map_or_else(|| passes(reached.pass), after))
            }),
        ];
        row.extend(is_priced.then_some(cost));
        row
    };
    Table {
        head: head.into_iter().map(str::to_owned).collect(),
        rows: comparison.measures.iter().map(row).collect(),
        words: 4,
    }
}

/// Runs that failed, each with its reason.
pub fn failures(comparison: &Comparison) -> Vec<String> {
    let of = |measure: &MeasureAnswer| {
        let name = measure.name.clone();
        let failed = measure.failures.clone().into_iter();
        failed.map(move |(at, reason)| format!("failed: {name} with {}: {reason}", combination(&at)))
    };
    comparison.measures.iter().flat_map(of).collect()
}

/// What to take, or what comes nearest and what decides.
pub fn recommendation(comparison: &Comparison, reader: &Reader) -> String {
    let Some(best) = comparison.best() else {
        return "No measure could be computed.".to_owned();
    };
    let fitted = fitted(best, &comparison.measures[0], reader);
    let fitted = if fitted == NONE {
        String::new()
    } else {
        format!(" ({fitted})")
    };
    let share = creepage_plan::shown::percent(best.share());
    if comparison.recommended.is_some() {
        let why = match best.cost {
            _ if best.parts == 0 => "nothing needs to be fitted",
            Some(Cost::Number(_)) => "the cheapest that holds",
            _ => "of those that hold the one with the fewest parts",
        };
        return format!(
            "Recommended: {}{fitted}: {why}; it holds in every combination, with at most {share} of a limit.",
            best.name
        );
    }
    let decides = comparison.decides.as_ref().map_or_else(String::new, |key| {
        format!(
            " What decides most is {}: measure it, or limit it.",
            key_name(key)
        )
    });
    format!(
        "No measure holds in every combination. {}{fitted} comes nearest, with {share} of a limit in the worst.{decides}",
        best.name
    )
}
