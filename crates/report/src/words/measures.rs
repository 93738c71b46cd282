//! Measures side by side, for a reader.

use super::number::{passes, quantity, significant};
use super::reader::Reader;
use super::table::Table;
use creepage_plan::shown::{percent, words_if};
use creepage_run::{Reached, answer::after};
use creepage_scene::{Cost, End, Restraint, Uncertain, si_unit};
use creepage_study::measures::{Combination, Comparison, FRICTION_KEY, MeasureAnswer, Outcome};

/// Keys that have a shorter name.
const NAMES: [(&str, &str); 5] = [
    (FRICTION_KEY, "friction"),
    ("ground.vertical_peak", "deflection"),
    ("ground.longitudinal_peak", "motion of the duct"),
    ("friction.shape_factor", "shape factor"),
    ("cable.axial_stiffness", "EA"),
];
const HEAD: [&str; 10] = [
    "measure",
    "fitted",
    "holds for",
    "nearest limit, or exceeded most",
    "worst of limit",
    "where",
    "in the middle",
    "on clamps",
    "moved",
    "exceeded after",
];
const NONE: &str = "–";

/// What an uncertain key is called.
pub fn key_name(key: &str) -> &str {
    let known = NAMES.iter().find(|(known, _)| *known == key);
    known.map_or(key, |(_, name)| name)
}

fn key_value(key: &str, value: f64) -> String {
    si_unit(key).map_or_else(|| significant(value), |unit| quantity(value, unit))
}

/// An unknown with its interval: "friction 0.2 to 0.5".
pub fn interval(unknown: &Uncertain) -> String {
    let [low, high] = [unknown.low, unknown.high].map(|value| key_value(&unknown.key, value));
    format!("{} {low} to {high}", key_name(&unknown.key))
}

/// A combination: "friction 0.5, deflection 600 µm".
fn combination(at: &Combination) -> String {
    let each = at
        .iter()
        .map(|(key, value)| format!("{} {}", key_name(key), key_value(key, *value)));
    each.collect::<Vec<_>>().join(", ")
}

/// What is not known, and from where.
pub fn uncertain(comparison: &Comparison) -> String {
    let all = comparison
        .uncertain
        .iter()
        .map(interval)
        .collect::<Vec<_>>()
        .join(", ");
    let assumed = words_if(comparison.assumed, " (assumed: the scene has no [uncertain])");
    let (combinations, runs) = (comparison.combinations, comparison.runs);
    format!("{all}{assumed}; {combinations} combinations, {runs} runs")
}

/// What a measure changes of the scene as it is.
fn fitted(measure: &MeasureAnswer, scene: &MeasureAnswer, reader: &Reader) -> String {
    let held = |held: End| match held {
        End::Free => "free".to_owned(),
        End::Fixed => "fixed".to_owned(),
        End::Spring(stiffness) => reader.stiffness(stiffness),
    };
    let clamp = |clamp: &Restraint| {
        let place = reader.length(clamp.position);
        format!("{} at {place}", reader.stiffness(clamp.stiffness))
    };
    let (own, before) = (measure.ends, scene.ends);
    let mut words = Vec::new();
    if own.upstream == own.downstream
        && own.upstream != before.upstream
        && own.downstream != before.downstream
    {
        words.push(format!("both {}", held(own.upstream)));
    } else {
        let ends = [
            ("upstream", own.upstream, before.upstream),
            ("downstream", own.downstream, before.downstream),
        ];
        let changed = ends.into_iter().filter(|(_, own, before)| own != before);
        words.extend(changed.map(|(name, own, _)| format!("{name} {}", held(own))));
    }
    let [added, removed] = [(measure, scene), (scene, measure)].map(|(one, other)| {
        let only = one
            .restraints
            .iter()
            .filter(|clamp| !other.restraints.contains(clamp));
        only.map(clamp).collect::<Vec<_>>()
    });
    words.extend(added);
    words.extend(removed.iter().map(|removed| format!("without {removed}")));
    words.join(", ")
}

/// In which combinations it holds.
pub fn holds_for(measure: &MeasureAnswer, combinations: usize) -> String {
    match measure.kept {
        _ if measure.within_limits => "every combination".to_owned(),
        // All that were asked for hold, and one between them does not.
        kept if kept == combinations => format!("all {kept} combinations, but not between them"),
        kept => format!("{kept} of {combinations} combinations"),
    }
}

/// Every measure with its worst combination.
pub fn measures(comparison: &Comparison, reader: &Reader) -> Table {
    let is_priced = comparison.measures.iter().any(|measure| measure.cost.is_some());
    let row = |measure: &MeasureAnswer| {
        let amount = |outcome: &Outcome| {
            let tightest = outcome.verdicts.first()?;
            Some(reader.amount(tightest.quantity, tightest.largest))
        };
        let mut row = vec![
            // With a soft hyphen.
            measure.name.replace("stream", "\u{ad}stream"),
            fitted(measure, &comparison.measures[0], reader),
            holds_for(measure, comparison.combinations),
        ];
        let worst = measure
            .worst
            .as_ref()
            .and_then(|worst| Some((worst, worst.verdicts.first()?)));
        row.extend(worst.into_iter().flat_map(|(worst, tightest)| {
            let limit = tightest.quantity.given_in(&reader.units, tightest.limit);
            let exceeded = worst.verdicts.iter().filter_map(|verdict| verdict.reached_after);
            let exceeded = exceeded.min_by_key(|reached| reached.pass);
            let time = |reached: Reached| reached.years.map_or_else(|| passes(reached.pass), after);
            [
                tightest.quantity.at(tightest.end),
                format!(
                    "{} of {limit}",
                    reader.amount(tightest.quantity, tightest.largest)
                ),
                combination(&worst.at),
                measure.nominal.as_ref().and_then(amount).unwrap_or_default(),
                worst
                    .clamp_force_n
                    .map(|force| reader.force(force))
                    .unwrap_or_default(),
                reader.movement(worst.movement_m),
                exceeded.map(time).unwrap_or_default(),
            ]
        }));
        row.resize(HEAD.len(), String::new());
        row.extend(is_priced.then(|| match &measure.cost {
            None => String::new(),
            Some(Cost::Number(cost)) => significant(*cost),
            Some(Cost::Text(text)) => text.clone(),
        }));
        let shown = |cell: String| if cell.is_empty() { NONE.to_owned() } else { cell };
        row.into_iter().map(shown).collect()
    };
    let head = HEAD.into_iter().chain(is_priced.then_some("cost"));
    Table {
        head: head.map(str::to_owned).collect(),
        rows: comparison.measures.iter().map(row).collect(),
        words: 6,
    }
}

/// Runs that failed, each with its reason.
pub fn failures(comparison: &Comparison) -> Vec<String> {
    let of = |measure: &'_ MeasureAnswer| {
        let failed = measure.failures.iter();
        let words = |(at, reason): &(Combination, String)| {
            format!("failed: {} with {}: {reason}", measure.name, combination(at))
        };
        failed.map(words).collect::<Vec<_>>()
    };
    comparison.measures.iter().flat_map(of).collect()
}

/// What to take, or what comes nearest and what decides.
pub fn recommendation(comparison: &Comparison, reader: &Reader) -> String {
    let Some(best) = comparison.best() else {
        return "No measure could be computed.".to_owned();
    };
    let fitted = fitted(best, &comparison.measures[0], reader);
    let fitted = if fitted.is_empty() {
        fitted
    } else {
        format!(" ({fitted})")
    };
    let (name, share) = (&best.name, percent(best.share()));
    if comparison.recommended.is_some() {
        let why = match best.cost {
            _ if best.parts == 0 => "nothing needs to be fitted",
            Some(Cost::Number(_)) => "the cheapest that holds",
            _ => "of those that hold the one with the fewest parts",
        };
        return format!(
            "Recommended: {name}{fitted}: {why}; it holds in every combination, with at most {share} of a limit."
        );
    }
    let decides = comparison.decides.as_ref().map_or_else(String::new, |key| {
        format!(
            " What decides most is {}: measure it, or limit it.",
            key_name(key)
        )
    });
    format!(
        "No measure holds in every combination. {name}{fitted} comes nearest, with {share} of a limit in the worst.{decides}"
    )
}
