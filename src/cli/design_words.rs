//! What `creepage design` says.

use std::io::Write;

use super::design_clamps::{clamps, has, on_clamp};
use super::failure::Failure;
use super::terminal;
use crate::answer::largest_movement_in_duct;
use crate::design::{Binding, Design, Place, Side, Spring, TradeOff};
use crate::shown::{percent, words_if};
use crate::{Limited, Limits, Scene, Units};

/// One design in full.
pub fn print(design: &Design, scene: &Scene, units: &Units) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (title, held) = (terminal::line(&design.title), places(&design.places));
    writeln!(out, "{title}: {held}, {} passes", design.passes)?;
    limited(&mut out, std::slice::from_ref(design), units)?;
    let (names, rows) = curve(&design.places, &design.limits, &design.curve, scene, units);
    terminal::table(&mut out, &names, &rows)?;
    writeln!(out)?;
    conclusion(&mut out, design, units)
}

/// The limits of all designs, each once.
fn limited(out: &mut impl Write, designs: &[Design], units: &Units) -> std::io::Result<()> {
    let mut limits: Vec<String> = Vec::new();
    for (place, quantity, limit) in designs.iter().flat_map(|design| design.limits.all()) {
        let limit = format!("{} {}", quantity.at(place), quantity.given_in(units, limit));
        if !limits.contains(&limit) {
            limits.push(limit);
        }
    }
    writeln!(out, "limits: {}\n", limits.join("; "))
}

/// Several beside each other, and the best.
pub fn compared(best: &Design, all: &[Design], units: &Units) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (title, ways) = (terminal::line(&best.title), all.len());
    writeln!(
        out,
        "{title}: {ways} ways to hold the cable, {} passes",
        best.passes
    )?;
    limited(&mut out, all, units)?;
    #[rustfmt::skip]
    let names = ["held by", "stiffness", "largest share of a limit", "of", "on the clamp", "within limits"];
    let mut rows = Vec::new();
    for design in all {
        let Some(found) = design.found() else { continue };
        let springs = found.springs.iter().map(|spring| stiffness(units, spring));
        let tightest = found.tightest(&design.limits);
        let of = tightest.iter().map(|limit| limit.quantity.at(limit.end));
        rows.push(vec![
            places(&design.places),
            springs.collect::<Vec<_>>().join(" and "),
            percent(design.excess()),
            of.collect::<Vec<_>>().join(", "),
            on_clamp(design, found, units),
            within(found) + words_if(is_near(design), ", nearer than the error"),
        ]);
    }
    terminal::table(&mut out, &names.map(str::to_owned), &rows)?;
    writeln!(out)?;
    if best.answer.is_some() {
        writeln!(out, "best: {}", places(&best.places))?;
    }
    conclusion(&mut out, best, units)
}

fn places(places: &[Place]) -> String {
    let name = |place: &Place| match place {
        Place::Clamp(_) => place.to_string(),
        _ => format!("spring at the {place}"),
    };
    let names: Vec<String> = places.iter().map(name).collect();
    names.join(" and ")
}

/// Every run with the scene's own tolerance.
fn curve(
    held: &[Place],
    limits: &Limits,
    points: &[TradeOff],
    scene: &Scene,
    units: &Units,
) -> (Vec<String>, Vec<Vec<String>>) {
    let one = held.len() == 1;
    let stiffness = units.stiffness.symbol();
    let short = |place: &Place| match place {
        Place::Clamp(position) => format!("at {position} m"),
        end => end.end().map_or_else(String::new, |end| end.name().to_owned()),
    };
    let of_springs = held.iter().map(|place| match place {
        _ if one => format!("stiffness, {stiffness}"),
        place => format!("{}, {stiffness}", short(place)),
    });
    let clamped = held
        .iter()
        .copied()
        .chain(limits.clamps.iter().map(|clamp| Place::Clamp(clamp.position_m)));
    let mut places = vec![Place::Upstream, Place::Downstream];
    for place in clamped {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let columns: Vec<(Place, Limited)> = [Limited::Force, Limited::Movement]
        .into_iter()
        .flat_map(|quantity| places.iter().map(move |place| (*place, quantity)))
        .collect();
    let name =
        |(place, quantity): &(Place, Limited)| format!("{}, {}", short(place), quantity.symbol_in(units));
    let last = std::iter::once("within limits".to_owned());
    let names = of_springs.chain(columns.iter().map(name)).chain(last).collect();
    let mut rows = Vec::new();
    let most = largest_movement_in_duct(scene);
    for point in points {
        let value = |&(place, quantity): &(Place, Limited)| match point.value(place, quantity) {
            _ if matches!(place, Place::Clamp(_)) && !has(point, place) => "–".to_owned(),
            value if quantity == Limited::Movement && value > most => {
                format!("> {}", quantity.number_in(units, most))
            }
            value => quantity.number_in(units, value),
        };
        let springs = point.springs.iter().map(|spring| number(units, spring));
        let last = std::iter::once(within(point));
        rows.push(springs.chain(columns.iter().map(value)).chain(last).collect());
    }
    (names, rows)
}

fn within(point: &TradeOff) -> String {
    let within = if point.within_limits { "yes" } else { "no" };
    let leaves = words_if(point.leaves_duct, ", leaves the duct");
    format!("{within}{leaves}")
}

/// The answer or what comes nearest, and which limits decide.
fn conclusion(out: &mut impl Write, design: &Design, units: &Units) -> Result<(), Failure> {
    if let Some(nearest) = &design.nearest {
        let nearest = reached(design, nearest, units);
        writeln!(out, "{}; nearest: {nearest}", none(design))?;
    }
    if let Some(answer) = &design.answer {
        let passes = design.passes;
        writeln!(out, "answer: {}", reached(design, answer, units))?;
        for line in deciding(design, answer, units) {
            writeln!(out, "{line}")?;
        }
        if is_near(design) {
            let error = percent(answer.error_estimate);
            writeln!(
                out,
                "nearer to a limit than the estimated error of {error}: repeat the search with limits smaller by that"
            )?;
        }
        if answer.still_growing {
            writeln!(
                out,
                "only in these {passes} passes: the forces still grow after them"
            )?;
        }
        for later in &answer.exceeded_later {
            let (what, value) = (
                later.quantity.at(later.end),
                later.quantity.shown_in(units, later.value),
            );
            let limit = later.quantity.given_in(units, later.limit);
            writeln!(
                out,
                "only in these {passes} passes: with more the {what} levels off at {value}, above its limit of {limit}"
            )?;
        }
    }
    clamps(out, design, units)?;
    writeln!(out, "{} runs of the scene", design.runs)?;
    Ok(())
}

/// Whether the answer's error decides.
fn is_near(design: &Design) -> bool {
    let answer = design.answer.as_ref();
    answer.is_some_and(|answer| design.excess() * (1.0 + answer.error_estimate) > 1.0)
}

/// Which limits nothing keeps, and by how much the nearest exceeds them.
pub fn why_none(design: &Design, units: &Units) -> String {
    let fails = |(place, quantity, limit): (Place, Limited, f64)| {
        let value = design.nearest.as_ref()?.value(place, quantity);
        let (what, excess) = (quantity.at(place), quantity.shown_in(units, value - limit));
        let share = percent(value / limit - 1.0);
        (value > limit).then(|| format!("the {what} exceeds its limit by {excess} ({share})"))
    };
    let fails: Vec<String> = design.limits.all().filter_map(fails).collect();
    format!(
        "{}: at the nearest, which is on standard output, {}; try springs at both ends or a clamp (--at), a larger limit, or less load on the \
         duct",
        none(design),
        fails.join(" and ")
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

/// Where the range of stiffness ends and why, or what leaves least room.
fn deciding(design: &Design, answer: &TradeOff, units: &Units) -> Vec<String> {
    let named = |limits: &mut dyn Iterator<Item = &Binding>| {
        let names: Vec<String> = limits.map(|limit| limit.quantity.at(limit.end)).collect();
        names.join(", ")
    };
    let mut lines = Vec::new();
    if let (Some((from, to)), [spring]) = (design.range_n_per_m, &answer.springs[..]) {
        let with = |stiffness| Spring::new(spring.place, stiffness);
        let from = stiffness(units, &with(from));
        match to.map(|to| stiffness(units, &with(to))) {
            None => lines.push(format!("within the limits: {from} and everything stiffer")),
            Some(to) if to != from => lines.push(format!("within the limits: {from} to {to}")),
            Some(_) => {}
        }
    }
    for (side, name) in [(Side::Softer, "softer"), (Side::Stiffer, "stiffer")] {
        let mut limits = design.binding.iter();
        let exceeded = named(&mut limits.by_ref().filter(|limit| limit.exceeded_by == Some(side)));
        if !exceeded.is_empty() {
            lines.push(format!("a {name} one exceeds: {exceeded}"));
        }
    }
    let tightest = named(&mut design.binding.iter().filter(|limit| limit.exceeded_by.is_none()));
    if !tightest.is_empty() {
        let share = percent(design.excess());
        lines.push(format!("least room: {tightest}: {share} of the limit"));
    }
    lines
}

/// A stiffness without its unit, to four digits, or in a word.
fn number(units: &Units, spring: &Spring) -> String {
    match (spring.stiffness_n_per_m, spring.place) {
        (None, _) => "fixed".to_owned(),
        (Some(0.0), Place::Clamp(_)) => "no clamp".to_owned(),
        (Some(0.0), _) => "free".to_owned(),
        (Some(value), _) => {
            let value = units.stiffness.of_si(value);
            let whole = value.log10().floor();
            if (-3.0..5.0).contains(&whole) {
                format!("{value:.*}", (3.0 - whole).max(0.0) as usize)
            } else {
                format!("{value:.3e}")
            }
        }
    }
}

/// The same with its unit.
fn stiffness(units: &Units, spring: &Spring) -> String {
    let taken = number(units, spring);
    match spring.stiffness_n_per_m {
        Some(value) if value > 0.0 => format!("{taken} {}", units.stiffness.symbol()),
        _ => taken,
    }
}

/// Springs, and what they make of the limits.
fn reached(design: &Design, point: &TradeOff, units: &Units) -> String {
    let several = point.springs.len() > 1;
    let spring = |spring: &Spring| {
        let taken = stiffness(units, spring);
        let at = match spring.place {
            Place::Clamp(position) if several => format!(" at {position} m"),
            place if several => format!(" at the {place}"),
            _ => String::new(),
        };
        match (spring.stiffness_n_per_m, spring.place) {
            (None | Some(0.0), _) => taken + &at,
            (_, Place::Clamp(_)) => format!("a clamp of {taken}{at}"),
            _ => format!("a spring of {taken}{at}"),
        }
    };
    let springs: Vec<String> = point.springs.iter().map(spring).collect();
    let of = |(place, quantity, limit): (Place, Limited, f64)| {
        let value = point.value(place, quantity);
        let (times, allowed) = (value / limit, quantity.given_in(units, limit));
        let exceeds = format!(", {times:.2} times its limit of {allowed}");
        let what = format!("{} {}", quantity.at(place), quantity.shown_in(units, value));
        what + words_if(times > 1.0, &exceeds)
    };
    let all: Vec<String> = design.limits.all().map(of).collect();
    let leaves = words_if(point.leaves_duct, "; the cable leaves the duct");
    let error = percent(point.error_estimate);
    format!(
        "{}; {}{leaves}; estimated error {error}",
        springs.join(" and "),
        all.join("; ")
    )
}
