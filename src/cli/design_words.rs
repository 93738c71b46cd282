//! What `creepage design` says.

use std::io::Write;

use super::failure::Failure;
use super::terminal;
use crate::answer::largest_movement_in_duct;
use crate::design::{Binding, ClampPeak, Design, Place, Side, Spring, TradeOff};
use crate::shown::{percent, words_if};
use crate::{Limited, Scene, Units};

/// The names of a table's columns, and its rows.
type Table = (Vec<String>, Vec<Vec<String>>);

/// The best of all `designs`: with its runs where it is alone, or beside the others.
pub fn print(best: &Design, designs: &[Design], scene: &Scene, units: &Units) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (title, held, passes) = (terminal::line(&best.title), places(&best.places), best.passes);
    let (what, (names, rows)) = if designs.len() > 1 {
        let ways = format!("{} ways to hold the cable", designs.len());
        (ways, beside(designs, units))
    } else {
        (held.clone(), curve(best, scene, units))
    };
    writeln!(out, "{title}: {what}, {passes} passes")?;
    let mut limits: Vec<String> = Vec::new();
    for (place, quantity, limit) in designs.iter().flat_map(|design| design.limits.all()) {
        let limit = format!("{} {}", quantity.at(place), quantity.given_in(units, limit));
        if !limits.contains(&limit) {
            limits.push(limit);
        }
    }
    writeln!(out, "limits: {}\n", limits.join("; "))?;
    terminal::table(&mut out, &names, &rows)?;
    writeln!(out)?;
    if designs.len() > 1 && best.answer.is_some() {
        writeln!(out, "best: {held}")?;
    }
    let lines = conclusion(best, units);
    lines.iter().try_for_each(|line| writeln!(out, "{line}"))?;
    Ok(writeln!(out, "{} runs of the scene", best.runs)?)
}

/// Words or texts with a word between them.
fn joined(texts: impl Iterator<Item = String>, between: &str) -> String {
    texts.collect::<Vec<_>>().join(between)
}

fn places(places: &[Place]) -> String {
    let name = |place: &Place| match place {
        Place::Clamp(_) => place.to_string(),
        _ => format!("spring at the {place}"),
    };
    joined(places.iter().map(name), " and ")
}

/// Force and movement at a clamp.
fn peak(clamp: &ClampPeak, units: &Units) -> [String; 2] {
    let force = Limited::Force.shown_in(units, clamp.force_n);
    [force, Limited::Movement.shown_in(units, clamp.movement_m)]
}

/// Several designs beside each other.
fn beside(all: &[Design], units: &Units) -> Table {
    #[rustfmt::skip]
    let names = ["held by", "stiffness", "largest share of a limit", "of", "on the clamp", "within limits"];
    let row = |design: &Design| {
        let found = design.found()?;
        let is_varied = |clamp: &&ClampPeak| {
            let mut places = design.places.iter();
            places.any(|place| place.is_clamp_at(clamp.position_m))
        };
        let varied = found.clamps.iter().filter(is_varied);
        let on_clamps = joined(varied.map(|clamp| peak(clamp, units).join(", ")), " and ");
        Some(vec![
            places(&design.places),
            stiffness(units, &found.springs[0]),
            percent(design.excess()),
            named(&found.tightest(&design.limits)),
            words_if(on_clamps.is_empty(), "–").to_owned() + &on_clamps,
            within(found) + words_if(is_near(design), ", nearer than the error"),
        ])
    };
    let rows = all.iter().filter_map(row).collect();
    (names.map(str::to_owned).into(), rows)
}

/// Every run with the scene's own tolerance: at both ends, where springs are, and at limited clamps.
fn curve(design: &Design, scene: &Scene, units: &Units) -> Table {
    let limited = design.limits.clamps.iter();
    let limited = limited.map(|clamp| Place::Clamp(clamp.position_m));
    let mut places = vec![Place::Upstream, Place::Downstream];
    for place in design.places.iter().copied().chain(limited) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let quantities = [Limited::Force, Limited::Movement].into_iter();
    let columns = quantities.flat_map(|quantity| places.iter().map(move |place| (*place, quantity)));
    let columns: Vec<(Place, Limited)> = columns.collect();
    let name = |(place, quantity): &(Place, Limited)| {
        let at = match (place, place.end()) {
            (Place::Clamp(position), _) => format!("at {position} m"),
            (_, end) => end.map_or("", |end| end.name()).to_owned(),
        };
        format!("{at}, {}", quantity.symbol_in(units))
    };
    let mut names = vec![format!("stiffness, {}", units.stiffness.symbol())];
    names.extend(columns.iter().map(name).chain(["within limits".to_owned()]));
    let most = largest_movement_in_duct(scene);
    let row = |point: &TradeOff| {
        let cell = |&(place, quantity): &(Place, Limited)| {
            let mut clamps = point.clamps.iter();
            let is_there = place.end().is_some() || clamps.any(|clamp| place.is_clamp_at(clamp.position_m));
            let value = point.value(place, quantity);
            let is_out = quantity == Limited::Movement && value > most;
            let shown = quantity.number_in(units, if is_out { most } else { value });
            words_if(!is_there, "–").to_owned() + words_if(is_out, "> ") + words_if(is_there, &shown)
        };
        let first = number(units, &point.springs[0]);
        let cells = [first].into_iter().chain(columns.iter().map(cell));
        cells.chain([within(point)]).collect()
    };
    (names, design.curve.iter().map(row).collect())
}

fn within(point: &TradeOff) -> String {
    let within = if point.within_limits { "yes" } else { "no" };
    within.to_owned() + words_if(point.leaves_duct, ", leaves the duct")
}

/// The answer or what comes nearest, and which limits decide.
fn conclusion(design: &Design, units: &Units) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(nearest) = &design.nearest {
        let nearest = reached(design, nearest, units);
        lines.push(format!("{}; nearest: {nearest}", none(design)));
    }
    if let Some(answer) = &design.answer {
        let only = format!("only in these {} passes:", design.passes);
        lines.push(format!("answer: {}", reached(design, answer, units)));
        lines.extend(deciding(design, units));
        if is_near(design) {
            let error = percent(answer.error_estimate);
            let near = format!("nearer to a limit than the estimated error of {error}");
            lines.push(format!("{near}: repeat the search with limits smaller by that"));
        }
        if answer.still_growing {
            lines.push(format!("{only} the forces still grow after them"));
        }
        for later in &answer.exceeded_later {
            let (quantity, what) = (later.quantity, later.quantity.at(later.end));
            let value = quantity.shown_in(units, later.value);
            let limit = quantity.given_in(units, later.limit);
            let level = format!("levels off at {value}, above its limit of {limit}");
            lines.push(format!("{only} with more the {what} {level}"));
        }
    }
    // What each clamp comes to, whether it is limited or not.
    let clamps = design.found().map_or(&[][..], |found| &found.clamps);
    lines.extend(clamps.iter().map(|clamp| {
        let (place, [force, movement]) = (Place::Clamp(clamp.position_m), peak(clamp, units));
        let slipped = clamp.slipped_m.filter(|slipped| *slipped != 0.0);
        let slipped = slipped.map(|slipped| Limited::Movement.shown_in(units, slipped));
        let slipped = slipped.map_or_else(String::new, |slipped| {
            format!(", and it has slipped by {slipped}")
        });
        format!("{place}: force at most {force}, movement at most {movement}{slipped}")
    }));
    if !clamps.is_empty() && design.limits.clamps.is_empty() {
        let how =
            "--limit-force clamp=FORCE limits their force, --limit-movement clamp=LENGTH their movement";
        lines.push(format!("clamps are not limited; {how}"));
    }
    lines
}

/// Whether the answer's error decides.
fn is_near(design: &Design) -> bool {
    let answer = design.answer.as_ref();
    answer.is_some_and(|answer| design.excess() * (1.0 + answer.error_estimate) > 1.0)
}

/// That nothing is within the limits, and what to try.
pub fn why_none(design: &Design) -> String {
    let far = design.out_of_reach.first().map(|limit| {
        let shown = |value| limit.quantity.shown_in(&Units::default(), value);
        let (least, most) = (shown(limit.value), shown(limit.limit));
        let what = limit.quantity.at(limit.end);
        format!(", as the {what} is {least} at least, limit {most}")
    });
    format!(
        "{}{}: the nearest is on standard output, with what it exceeds; try springs at both ends (--at upstream+downstream), a clamp \
         (--at \"20 m\"), a larger limit, or less load on the duct; `creepage measures` compares them",
        none(design),
        far.unwrap_or_default()
    )
}

/// That nothing is within the limits, as surely as it is known.
fn none(design: &Design) -> String {
    let none =
        "none found within the limits, but the nearest exceeds them by less than the error of the search";
    design.doubt().map_or_else(
        || "no stiffness stays within the limits".to_owned(),
        |error| format!("{none}, {}", percent(error)),
    )
}

fn named<'a>(limits: impl IntoIterator<Item = &'a Binding>) -> String {
    let names = limits.into_iter().map(|limit| limit.quantity.at(limit.end));
    joined(names, ", ")
}

/// Where the range of stiffness ends and why, or which limits decide.
fn deciding(design: &Design, units: &Units) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some((from, to)) = design.range_n_per_m {
        let with = |k| {
            let stiffness_n_per_m = Some(k);
            let place = design.place;
            stiffness(
                units,
                &Spring {
                    place,
                    stiffness_n_per_m,
                },
            )
        };
        let from = with(from);
        match to.map(with) {
            None => lines.push(format!("within the limits: {from} and everything stiffer")),
            Some(to) if to != from => lines.push(format!("within the limits: {from} to {to}")),
            Some(_) => {}
        }
    }
    let share = format!(", at {} of it", percent(design.excess()));
    let of = |side| named(design.binding.iter().filter(|limit| limit.exceeded_by == side));
    for (limits, words, more) in [
        (of(Some(Side::Softer)), "a softer one exceeds", ""),
        (of(Some(Side::Stiffer)), "a stiffer one exceeds", ""),
        (of(None), "governing limit", &*share),
    ] {
        if !limits.is_empty() {
            lines.push(format!("{words}: {limits}{more}"));
        }
    }
    lines
}

/// A stiffness without its unit, to four digits, or in a word.
fn number(units: &Units, spring: &Spring) -> String {
    let Some(stiffness) = spring.stiffness_n_per_m else {
        return "fixed".to_owned();
    };
    let value = units.stiffness.of_si(stiffness);
    let whole = value.log10().floor();
    match spring.place {
        Place::Clamp(_) if value == 0.0 => "no clamp".to_owned(),
        _ if value == 0.0 => "free".to_owned(),
        _ if (-3.0..5.0).contains(&whole) => format!("{value:.*}", (3.0 - whole).max(0.0) as usize),
        _ => format!("{value:.3e}"),
    }
}

/// The same with its unit.
fn stiffness(units: &Units, spring: &Spring) -> String {
    let is_number = spring.stiffness_n_per_m.is_some_and(|value| value > 0.0);
    let unit = format!(" {}", units.stiffness.symbol());
    number(units, spring) + words_if(is_number, &unit)
}

/// Springs, and what they make of the limits.
fn reached(design: &Design, point: &TradeOff, units: &Units) -> String {
    let spring = |spring: &Spring| {
        let kind = match (spring.stiffness_n_per_m, spring.place) {
            (None | Some(0.0), _) => "",
            (_, Place::Clamp(_)) => "a clamp of ",
            _ => "a spring of ",
        };
        let at = match spring.place {
            Place::Clamp(position) => format!(" at {position} m"),
            place => format!(" at the {place}"),
        };
        let at = words_if(point.springs.len() > 1, &at);
        format!("{kind}{}{at}", stiffness(units, spring))
    };
    let mut words = vec![joined(point.springs.iter().map(spring), " and ")];
    for (place, quantity, limit) in design.limits.all() {
        let value = point.value(place, quantity);
        let (times, allowed) = (value / limit, quantity.given_in(units, limit));
        let exceeds = format!(", {times:.2} times its limit of {allowed}");
        let what = format!("{} {}", quantity.at(place), quantity.shown_in(units, value));
        words.push(what + words_if(times > 1.0, &exceeds));
    }
    if point.leaves_duct {
        words.push("the cable leaves the duct".to_owned());
    }
    words.push(format!("estimated error {}", percent(point.error_estimate)));
    words.join("; ")
}
