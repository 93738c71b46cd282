//! What `creepage design` says.

use std::io::Write;

use super::failure::Failure;
use super::terminal;
use crate::Limited;
use crate::design::{Binding, ClampPeak, Design, Place, Side, Spring, TradeOff};
use crate::shown::{percent, words_if};
use crate::words::Reader;

/// The names of a table's columns, and its rows.
type Table = (Vec<String>, Vec<Vec<String>>);

/// The best of all `designs`: with its runs if it is alone, or next to the others.
pub fn print(best: &Design, designs: &[Design], reader: &Reader) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (title, held, passes) = (terminal::line(&best.title), places(&best.places), best.passes);
    let (what, (names, rows)) = if designs.len() > 1 {
        let ways = format!("{} ways to hold the cable", designs.len());
        (ways, comparison(designs, reader))
    } else {
        (held.clone(), curve(best, reader))
    };
    writeln!(out, "{title}: {what}, {passes} passes")?;
    let mut limits: Vec<String> = Vec::new();
    for (place, quantity, limit) in designs.iter().flat_map(|design| design.limits.all()) {
        let limit = format!(
            "{} {}",
            quantity.at(place),
            quantity.given_in(&reader.units, limit)
        );
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
    let lines = conclusion(best, reader);
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

/// What limits are of: "force on the upstream end, movement at the clamp at 20 m".
fn named<'a>(limits: impl IntoIterator<Item = &'a Binding>) -> String {
    let names = limits.into_iter().map(|limit| limit.quantity.at(limit.end));
    joined(names, ", ")
}

/// A stiffness with its unit, or in a word.
fn stiffness(spring: &Spring, reader: &Reader) -> String {
    match (spring.stiffness_n_per_m, spring.place) {
        (None, _) => "fixed".to_owned(),
        (Some(0.0), Place::Clamp(_)) => "no clamp".to_owned(),
        (Some(0.0), _) => "free".to_owned(),
        (Some(stiffness), _) => reader.stiffness(stiffness),
    }
}

/// Several designs side by side.
fn comparison(all: &[Design], reader: &Reader) -> Table {
    #[rustfmt::skip]
    let names = ["held by", "stiffness", "largest share of a limit", "of", "on the clamp", "within limits"];
    let row = |design: &Design| {
        let found = design.found()?;
        let varied = design.places.iter().filter_map(|place| found.clamp_at(*place));
        let peak = |clamp: &ClampPeak| {
            let (force, movement) = (reader.force(clamp.force_n), reader.movement(clamp.movement_m));
            format!("{force}, {movement}")
        };
        let on_clamps = joined(varied.map(peak), " and ");
        Some(vec![
            places(&design.places),
            stiffness(&found.springs[0], reader),
            percent(design.excess()),
            named(&found.tightest(&design.limits)),
            words_if(on_clamps.is_empty(), "–").to_owned() + &on_clamps,
            verdict(found) + words_if(is_near(design), ", nearer than the error"),
        ])
    };
    let rows = all.iter().filter_map(row).collect();
    (names.map(str::to_owned).into(), rows)
}

/// Every run with the scene's own tolerance: at both ends, where springs are, and at limited clamps.
fn curve(design: &Design, reader: &Reader) -> Table {
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
        reader.head(&at, *quantity)
    };
    let names = columns.iter().map(name).chain(["within limits".to_owned()]);
    let row = |point: &TradeOff| {
        let cell = |&(place, quantity): &(Place, Limited)| {
            let is_there = place.end().is_some() || point.clamp_at(place).is_some();
            let value = is_there.then(|| reader.number(quantity, point.value(place, quantity)));
            value.unwrap_or_else(|| "–".to_owned())
        };
        let first = stiffness(&point.springs[0], reader);
        let cells = [first].into_iter().chain(columns.iter().map(cell));
        cells.chain([verdict(point)]).collect()
    };
    let names = ["stiffness".to_owned()].into_iter().chain(names).collect();
    (names, design.curve.iter().map(row).collect())
}

fn verdict(point: &TradeOff) -> String {
    let within = if point.within_limits { "yes" } else { "no" };
    within.to_owned() + words_if(point.leaves_duct, ", leaves the duct")
}

/// The answer or what comes nearest, and which limits decide.
fn conclusion(design: &Design, reader: &Reader) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(nearest) = &design.nearest {
        let nearest = reached(design, nearest, reader);
        lines.push(format!("{}; nearest: {nearest}", none(design)));
    }
    if let Some(answer) = &design.answer {
        let only = format!("only in these {} passes:", design.passes);
        lines.push(format!("answer: {}", reached(design, answer, reader)));
        lines.extend(deciding(design, reader));
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
            let value = reader.amount(quantity, later.value);
            let limit = quantity.given_in(&reader.units, later.limit);
            let level = format!("levels off at {value}, above its limit of {limit}");
            lines.push(format!("{only} with more the {what} {level}"));
        }
    }
    // What each clamp comes to, whether it is limited or not.
    let clamps = design.found().map_or(&[][..], |found| &found.clamps);
    lines.extend(clamps.iter().map(|clamp| {
        let (force, movement) = (reader.force(clamp.force_n), reader.movement(clamp.movement_m));
        let slipped = clamp.slipped_m.filter(|slipped| *slipped != 0.0);
        let slipped = slipped.map(|slipped| format!(", and it has slipped by {}", reader.movement(slipped)));
        let (place, slipped) = (Place::Clamp(clamp.position_m), slipped.unwrap_or_default());
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
pub fn why_none(design: &Design, reader: &Reader) -> String {
    let far = design.out_of_reach.first().map(|limit| {
        let (what, least) = (
            limit.quantity.at(limit.end),
            reader.amount(limit.quantity, limit.value),
        );
        let most = limit.quantity.given_in(&reader.units, limit.limit);
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
    match design.doubt() {
        None => "no stiffness stays within the limits".to_owned(),
        Some(error) => format!(
            "none found within the limits, but the nearest exceeds them by less than the error of the search, {}",
            percent(error)
        ),
    }
}

/// Where the range of stiffness ends and why, or which limits decide.
fn deciding(design: &Design, reader: &Reader) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some((from, to)) = design.range_n_per_m {
        let place = design.place;
        let with = |stiffness_n_per_m| Spring {
            place,
            stiffness_n_per_m,
        };
        let [from, to] = [Some(from), to].map(|end| stiffness(&with(end), reader));
        match design.range_n_per_m {
            Some((_, None)) => lines.push(format!("within the limits: {from} and everything stiffer")),
            _ if to != from => lines.push(format!("within the limits: {from} to {to}")),
            _ => {}
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

/// Springs, and what they make of the limits.
fn reached(design: &Design, point: &TradeOff, reader: &Reader) -> String {
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
        format!("{kind}{}{at}", stiffness(spring, reader))
    };
    let mut words = vec![joined(point.springs.iter().map(spring), " and ")];
    for (place, quantity, limit) in design.limits.all() {
        let value = point.value(place, quantity);
        let (times, allowed) = (value / limit, quantity.given_in(&reader.units, limit));
        let exceeds = format!(", {times:.2} times its limit of {allowed}");
        let what = format!("{} {}", quantity.at(place), reader.amount(quantity, value));
        words.push(what + words_if(times > 1.0, &exceeds));
    }
    if point.leaves_duct {
        words.push("the cable leaves the duct".to_owned());
    }
    words.push(format!("estimated error {}", percent(point.error_estimate)));
    words.join("; ")
}
