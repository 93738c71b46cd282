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
    let (title, held) = (terminal::line(&best.title), places(&best.places));
    let (what, (names, rows)) = if designs.len() > 1 {
        let ways = format!("{} ways to hold the cable", designs.len());
        (ways, beside(designs, units))
    } else {
        (held.clone(), curve(best, scene, units))
    };
    writeln!(out, "{title}: {what}, {} passes", best.passes)?;
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
    conclusion(&mut out, best, units)
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
        let on_clamps = found.clamps.iter().filter(is_varied).map(|clamp| {
            let force = Limited::Force.shown_in(units, clamp.force_n);
            format!("{force}, {}", Limited::Movement.shown_in(units, clamp.movement_m))
        });
        let on_clamps = on_clamps.reduce(|one, other| format!("{one} and {other}"));
        Some(vec![
            places(&design.places),
            stiffness(units, &found.springs[0]),
            percent(design.excess()),
            named(&found.tightest(&design.limits)),
            on_clamps.unwrap_or_else(|| "–".to_owned()),
            within(found) + words_if(is_near(design), ", nearer than the error"),
        ])
    };
    let rows = all.iter().filter_map(row).collect();
    (names.map(str::to_owned).into(), rows)
}

fn places(places: &[Place]) -> String {
    let name = |place: &Place| match place {
        Place::Clamp(_) => place.to_string(),
        _ => format!("spring at the {place}"),
    };
    places.iter().map(name).collect::<Vec<_>>().join(" and ")
}

/// Every run with the scene's own tolerance.
fn curve(design: &Design, scene: &Scene, units: &Units) -> Table {
    let short = |place: Place| match (place, place.end()) {
        (Place::Clamp(position), _) => format!("at {position} m"),
        (_, end) => end.map_or_else(String::new, |end| end.name().to_owned()),
    };
    let mut names = vec![format!("stiffness, {}", units.stiffness.symbol())];
    let limited = design.limits.clamps.iter();
    let limited = limited.map(|clamp| Place::Clamp(clamp.position_m));
    let mut places = vec![Place::Upstream, Place::Downstream];
    for place in design.places.iter().copied().chain(limited) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let quantities = [Limited::Force, Limited::Movement];
    let columns = quantities.map(|quantity| places.iter().map(move |place| (*place, quantity)));
    let columns: Vec<(Place, Limited)> = columns.into_iter().flatten().collect();
    let name =
        |(place, quantity): &(Place, Limited)| format!("{}, {}", short(*place), quantity.symbol_in(units));
    names.extend(columns.iter().map(name));
    names.push("within limits".to_owned());
    let most = largest_movement_in_duct(scene);
    let row = |point: &TradeOff| {
        let cell = |&(place, quantity): &(Place, Limited)| {
            let mut clamps = point.clamps.iter();
            let is_there = place.end().is_some() || clamps.any(|clamp| place.is_clamp_at(clamp.position_m));
            match point.value(place, quantity) {
                _ if !is_there => "–".to_owned(),
                value if quantity == Limited::Movement && value > most => {
                    format!("> {}", quantity.number_in(units, most))
                }
                value => quantity.number_in(units, value),
            }
        };
        let mut cells = vec![number(units, &point.springs[0])];
        cells.extend(columns.iter().map(cell).chain([within(point)]));
        cells
    };
    (names, design.curve.iter().map(row).collect())
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
        let only = format!("only in these {} passes:", design.passes);
        writeln!(out, "answer: {}", reached(design, answer, units))?;
        deciding(out, design, answer, units)?;
        if is_near(design) {
            let error = percent(answer.error_estimate);
            let near = format!("nearer to a limit than the estimated error of {error}");
            writeln!(out, "{near}: repeat the search with limits smaller by that")?;
        }
        if answer.still_growing {
            writeln!(out, "{only} the forces still grow after them")?;
        }
        for later in &answer.exceeded_later {
            let (quantity, what) = (later.quantity, later.quantity.at(later.end));
            let value = quantity.shown_in(units, later.value);
            let limit = quantity.given_in(units, later.limit);
            let level = format!("levels off at {value}, above its limit of {limit}");
            writeln!(out, "{only} with more the {what} {level}")?;
        }
    }
    clamps(out, design, units)?;
    writeln!(out, "{} runs of the scene", design.runs)?;
    Ok(())
}

/// What each clamp comes to, whether it is limited or not.
fn clamps(out: &mut impl Write, design: &Design, units: &Units) -> Result<(), Failure> {
    let clamps = design.found().map_or(&[][..], |found| &found.clamps);
    for clamp in clamps {
        let place = Place::Clamp(clamp.position_m);
        let force = Limited::Force.shown_in(units, clamp.force_n);
        let movement = Limited::Movement.shown_in(units, clamp.movement_m);
        write!(out, "{place}: force at most {force}, movement at most {movement}")?;
        if let Some(slipped) = clamp.slipped_m.filter(|slipped| *slipped != 0.0) {
            let slipped = Limited::Movement.shown_in(units, slipped);
            write!(out, ", and it has slipped by {slipped}")?;
        }
        writeln!(out)?;
    }
    if !clamps.is_empty() && design.limits.clamps.is_empty() {
        writeln!(
            out,
            "clamps are not limited; --limit-force clamp=FORCE limits their force, --limit-movement clamp=LENGTH their movement"
        )?;
    }
    Ok(())
}

/// Whether the answer's error decides.
fn is_near(design: &Design) -> bool {
    let answer = design.answer.as_ref();
    answer.is_some_and(|answer| design.excess() * (1.0 + answer.error_estimate) > 1.0)
}

/// That nothing is within the limits, and what to try.
pub fn why_none(design: &Design) -> String {
    let far = design.out_of_reach.first().map_or_else(String::new, |limit| {
        let [least, limit_of] =
            [limit.value, limit.limit].map(|value| limit.quantity.shown_in(&Units::default(), value));
        format!(
            ", as the {} is {least} at least, limit {limit_of}",
            limit.quantity.at(limit.end)
        )
    });
    format!(
        "{}{far}: the nearest is on standard output, with what it exceeds; try springs at both ends (--at upstream+downstream), a clamp \
         (--at \"20 m\"), a larger limit, or less load on the duct; `creepage measures` compares them",
        none(design)
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

fn named<'a>(limits: impl IntoIterator<Item = &'a Binding>) -> String {
    let names = limits.into_iter().map(|limit| limit.quantity.at(limit.end));
    names.collect::<Vec<_>>().join(", ")
}

/// Where the range of stiffness ends and why, or which limits decide.
fn deciding(out: &mut impl Write, design: &Design, answer: &TradeOff, units: &Units) -> Result<(), Failure> {
    if let Some((from, to)) = design.range_n_per_m {
        let with = |k| {
            let spring = Spring {
                stiffness_n_per_m: Some(k),
                ..answer.springs[0]
            };
            stiffness(units, &spring)
        };
        let from = with(from);
        match to.map(with) {
            None => writeln!(out, "within the limits: {from} and everything stiffer")?,
            Some(to) if to != from => writeln!(out, "within the limits: {from} to {to}")?,
            Some(_) => {}
        }
    }
    let by = |side| named(design.binding.iter().filter(|limit| limit.exceeded_by == side));
    for (side, name) in [(Side::Softer, "softer"), (Side::Stiffer, "stiffer")] {
        let exceeded = by(Some(side));
        if !exceeded.is_empty() {
            writeln!(out, "a {name} one exceeds: {exceeded}")?;
        }
    }
    let tightest = by(None);
    if !tightest.is_empty() {
        let share = percent(design.excess());
        writeln!(out, "governing limit: {tightest}, at {share} of it")?;
    }
    Ok(())
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
    let is_number = spring.stiffness_n_per_m.is_some_and(|value| value > 0.0);
    let unit = format!(" {}", units.stiffness.symbol());
    number(units, spring) + words_if(is_number, &unit)
}

/// Springs, and what they make of the limits.
fn reached(design: &Design, point: &TradeOff, units: &Units) -> String {
    let several = point.springs.len() > 1;
    let spring = |spring: &Spring| {
        let at = match spring.place {
            Place::Clamp(position) => format!(" at {position} m"),
            place => format!(" at the {place}"),
        };
        let kind = match (spring.stiffness_n_per_m, spring.place) {
            (None | Some(0.0), _) => "",
            (_, Place::Clamp(_)) => "a clamp of ",
            _ => "a spring of ",
        };
        format!("{kind}{}{}", stiffness(units, spring), words_if(several, &at))
    };
    let springs: Vec<String> = point.springs.iter().map(spring).collect();
    let mut words = vec![springs.join(" and ")];
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
