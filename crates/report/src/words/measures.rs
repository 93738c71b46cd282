//! Measures side by side, for a reader.

use super::number::{passes, quantity, significant};
use super::reader::Reader;
use super::scene::held_by;
use super::table::Table;
use creepage_plan::shown::{percent, words_if};
use creepage_run::answer::after;
use creepage_scene::{Cost, End, Uncertain, si_unit};
use creepage_study::measures::{Combination, Comparison, FRICTION_KEY, MeasureAnswer, Nearest};

/// Keys that have a shorter name.
const NAMES: [(&str, &str); 5] = [
    (FRICTION_KEY, "friction"),
    ("ground.vertical_peak", "deflection"),
    ("ground.longitudinal_peak", "motion of the duct"),
    ("friction.shape_factor", "shape factor"),
    ("cable.axial_stiffness", "EA"),
];
/// What an uncertain key is called.
fn key_name(key: &str) -> &str {
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
    let each = |(key, value): (&String, &f64)| format!("{} {}", key_name(key), key_value(key, *value));
    at.iter().map(each).collect::<Vec<_>>().join(", ")
}

/// What is not known, and from where.
pub fn uncertain(comparison: &Comparison) -> String {
    let all: Vec<String> = comparison.uncertain.iter().map(interval).collect();
    let assumed = words_if(comparison.assumed, " (assumed: the scene has no [uncertain])");
    let (combinations, runs) = (comparison.combinations, comparison.runs);
    format!(
        "{}{assumed}; {combinations} combinations, {runs} runs",
        all.join(", ")
    )
}

/// What a measure changes of the scene as it is, if anything.
fn fitted(measure: &MeasureAnswer, scene: &MeasureAnswer, reader: &Reader) -> Option<String> {
    let held = |held: End| held_by(held, reader).replace("spring of ", "");
    let ends = [
        ("upstream", measure.ends.upstream, scene.ends.upstream),
        ("downstream", measure.ends.downstream, scene.ends.downstream),
    ];
    let changed = ends.into_iter().filter(|(_, own, before)| own != before);
    let mut words = match changed.collect::<Vec<_>>()[..] {
        [(_, one, _), (_, other, _)] if one == other => vec![format!("both {}", held(one))],
        ref changed => changed
            .iter()
            .map(|(name, own, _)| format!("{name} {}", held(*own)))
            .collect(),
    };
    let (own, before) = (&measure.restraints, &scene.restraints);
    for (clamps, others, without) in [(own, before, ""), (before, own, "without ")] {
        for clamp in clamps.iter().filter(|clamp| !others.contains(clamp)) {
            let (stiffness, place) = (reader.stiffness(clamp.stiffness), reader.length(clamp.position));
            words.push(format!("{without}{stiffness} at {place}"));
        }
    }
    (!words.is_empty()).then(|| words.join(", "))
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

/// The row of a measure: the names of its columns, and what stands in them; nothing if it is not known.
fn row(
    measure: &MeasureAnswer,
    comparison: &Comparison,
    reader: &Reader,
) -> [(&'static str, Option<String>); 11] {
    let amount = |nearest: &Nearest| reader.amount(nearest.quantity, nearest.value);
    let given = |worst: &Nearest| worst.quantity.given_in(&reader.units, worst.limit);
    let worst = measure.worst.as_ref();
    let outcome = worst.map(|worst| &worst.outcome);
    let exceeded = outcome.iter().flat_map(|outcome| &outcome.verdicts);
    let first = exceeded.filter_map(|verdict| verdict.reached_after);
    let first = first.min_by_key(|first| first.pass);
    let after = first.map(|first| first.years.map_or_else(|| passes(first.pass), after));
    let of_limit = worst.map(|worst| format!("{} of {}", amount(worst), given(worst)));
    let on_clamps = outcome.and_then(|outcome| outcome.clamp_force_n);
    let cost = measure.cost.as_ref().map(|cost| match cost {
        Cost::Number(cost) => significant(*cost),
        Cost::Text(text) => text.clone(),
    });
    let nearest = worst.map(|worst| worst.quantity.at(worst.end));
    [
        // With a soft hyphen.
        ("measure", Some(measure.name.replace("stream", "\u{ad}stream"))),
        ("fitted", fitted(measure, &comparison.measures[0], reader)),
        ("holds for", Some(holds_for(measure, comparison.combinations))),
        ("nearest limit, or exceeded most", nearest),
        ("worst of limit", of_limit),
        ("where", outcome.map(|outcome| combination(&outcome.at))),
        ("in the middle", measure.nominal.as_ref().map(amount)),
        ("on clamps", on_clamps.map(|force| reader.force(force))),
        (
            "moved",
            outcome.map(|outcome| reader.movement(outcome.movement_m)),
        ),
        ("exceeded after", after),
        ("cost", cost),
    ]
}

/// Every measure with its worst combination; costs where any is known.
pub fn measures(comparison: &Comparison, reader: &Reader) -> Table {
    let is_priced = comparison.measures.iter().any(|measure| measure.cost.is_some());
    let cells = |measure| {
        let row = row(measure, comparison, reader).into_iter();
        row.filter(|(name, _)| is_priced || *name != "cost")
    };
    let names = cells(&comparison.measures[0]).map(|(name, _)| name.to_owned());
    let shown = |(_, cell): (_, Option<String>)| cell.unwrap_or_else(|| "–".to_owned());
    let rows = comparison.measures.iter();
    let rows = rows.map(|measure| cells(measure).map(shown).collect());
    Table {
        head: names.collect(),
        rows: rows.collect(),
        words: 6,
    }
}

/// Runs that failed, each with its reason.
pub fn failures(comparison: &Comparison) -> Vec<String> {
    let of = |measure: &MeasureAnswer| {
        let failed = |(at, reason): &(Combination, String)| {
            let (name, at) = (&measure.name, combination(at));
            format!("failed: {name} with {at}: {reason}")
        };
        measure.failures.iter().map(failed).collect::<Vec<_>>()
    };
    comparison.measures.iter().flat_map(of).collect()
}

/// What to take, or what comes nearest and what decides.
pub fn recommendation(comparison: &Comparison, reader: &Reader) -> String {
    let Some(best) = comparison.best() else {
        return "No measure could be computed.".to_owned();
    };
    let fitted = fitted(best, &comparison.measures[0], reader);
    let fitted = fitted.map_or_else(String::new, |fitted| format!(" ({fitted})"));
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
    let named = |key: &String| {
        format!(
            " What decides most is {}: measure it, or limit it.",
            key_name(key)
        )
    };
    let decides = comparison.decides.as_ref().map(named);
    format!(
        "No measure holds in every combination. {name}{fitted} comes nearest, with {share} of a limit in the worst.{}",
        decides.unwrap_or_default()
    )
}
