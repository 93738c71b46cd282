//! `creepage design`: the end spring or clamp that stays within limits of force and movement.

use std::io::Write;
use std::sync::{Mutex, PoisonError};

use serde::Serialize;

use super::failure::Failure;
use super::limits::LimitArguments;
use super::progress::{HowFar, stopped, watched};
use super::shared::{Input, Json, TrafficArguments};
use super::terminal;
use crate::design::{Design, DesignError, DesignOptions, Place, TradeOff, design};
use crate::scene::{Dimension, End};
use crate::shown::percent;
use crate::{CableEnd, Limited};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The answer is found by runs of the scene; the force is the largest on an end, during and after the passes, the movement the \
largest of an end. A free end's movement is limited only by its name. A number without a unit is SI. Where no stiffness keeps the limits, the \
nearest is printed, with exit status 1.

Examples:
  creepage design my-duct.toml --limit-force \"3 kN\"
  creepage design my-duct.toml --limit-force 300N --limit-movement 2mm --at upstream
  creepage design my-duct.toml --limit-force downstream=2kN --limit-movement downstream=10mm
  creepage design my-duct.toml --limit-force \"3 kN\" --years 20 --trucks-per-day 800
  creepage design my-duct.toml --limit-force \"3 kN\" --at \"95 m\" --json"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// Where the spring is: upstream, downstream (at these ends), or a position for a clamp
    #[arg(long, value_name = "PLACE", default_value = "downstream", value_parser = place)]
    at: Place,
    #[command(flatten)]
    json: Json,
}

fn place(text: &str) -> Result<Place, String> {
    match text {
        "upstream" => Ok(Place::Upstream),
        "downstream" => Ok(Place::Downstream),
        _ => Dimension::Length
            .parse_argument(text)
            .map(Place::Clamp)
            .map_err(|_| "allowed: upstream, downstream or a position such as \"20 m\"".to_owned()),
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    // The end that is designed is held.
    let mut ends = input.scene.ends;
    match arguments.at {
        Place::Upstream => ends.upstream = End::Fixed,
        Place::Downstream => ends.downstream = End::Fixed,
        Place::Clamp(_) => {}
    }
    let limits = arguments.limits.limits(ends)?;
    if limits.all().next().is_none() {
        return Err(Failure::Usage {
            argument: "--limit-force",
            found: "no limit of an end that is held".into(),
            allowed: "a force or a movement, such as --limit-force 2kN or --limit-movement upstream=10mm"
                .into(),
        });
    }
    let tried = Mutex::new(Vec::new());
    let how_far = |now| HowFar::new(now, "runs of the scene with one stiffness after the other");
    let keep = |_| keep(arguments, &tried.lock().unwrap_or_else(PoisonError::into_inner));
    let answer = watched(how_far, keep, |progress| {
        let mut options = DesignOptions::new(arguments.at, limits);
        options.progress = progress;
        options.tried = Some(&tried);
        design(&input.scene, &options)
    });
    let answer = match answer {
        Err(DesignError::Analysis(error)) => input.located(Err(error))?,
        answer => answer?,
    };
    arguments.json.print(&answer, || print(&answer))?;
    match answer.answer {
        Some(_) => Ok(()),
        None => Err(Failure::NotKept),
    }
}

/// The stiffnesses that were tried before the search was stopped.
#[derive(Serialize)]
struct CutShort<'a> {
    cut_short: bool,
    curve: &'a [TradeOff],
}

fn keep(arguments: &Arguments, tried: &[TradeOff]) -> Result<(), Failure> {
    let cut = format!("cut short after {} stiffnesses: no answer", tried.len());
    let mut curve = tried.to_vec();
    curve.sort_by(|a, b| {
        let key = |point: &TradeOff| point.stiffness_n_per_m.unwrap_or(f64::INFINITY);
        key(a).total_cmp(&key(b))
    });
    let answer = CutShort {
        cut_short: true,
        curve: &curve,
    };
    arguments.json.print(&answer, || {
        let mut out = terminal::out();
        writeln!(out, "{cut}")?;
        Ok(table(&mut out, arguments.at, &curve)?)
    })?;
    stopped(cut)
}

fn print(design: &Design) -> Result<(), Failure> {
    let mut out = terminal::out();
    let place = match design.place {
        Place::Upstream => "spring at the upstream end".to_owned(),
        Place::Downstream => "spring at the downstream end".to_owned(),
        Place::Clamp(position) => format!("clamp at {position} m"),
    };
    writeln!(
        out,
        "{}: {place}, {} passes",
        terminal::line(&design.title),
        design.passes
    )?;
    let limit = |(end, quantity, limit): (CableEnd, Limited, f64)| {
        format!("{} {}", quantity.at(end), quantity.shown(limit))
    };
    let limits: Vec<String> = design.limits.all().map(limit).collect();
    writeln!(out, "limits: {}\n", limits.join("; "))?;
    table(&mut out, design.place, &design.curve)?;
    if let Some(nearest) = &design.nearest {
        writeln!(
            out,
            "no stiffness stays within the limits; nearest: {}",
            reached(design, nearest)
        )?;
    }
    if let Some(answer) = &design.answer {
        writeln!(out, "answer: {}", reached(design, answer))?;
    }
    let Some((from, to)) = design.range_n_per_m.filter(|_| design.answer.is_some()) else {
        return Ok(());
    };
    let softest = stiffness(design.place, Some(from));
    match to {
        None => writeln!(out, "within the limits: {softest} and everything stiffer")?,
        Some(to) if to > from => writeln!(
            out,
            "within the limits: {softest} to {} N/m",
            stiffness(design.place, Some(to))
        )?,
        Some(_) => {}
    }
    Ok(())
}

fn stiffness(place: Place, value: Option<f64>) -> String {
    match (value, place) {
        (None, _) => "fixed".to_owned(),
        (Some(0.0), Place::Clamp(_)) => "no clamp".to_owned(),
        (Some(0.0), _) => "free".to_owned(),
        (Some(value), _) => format!("{value:.3e}"),
    }
}

/// Every stiffness that was computed.
fn table(out: &mut impl Write, place: Place, curve: &[TradeOff]) -> std::io::Result<()> {
    writeln!(out, "{:>16} {:>23} {:>23}", "", "force, N", "movement, mm")?;
    writeln!(
        out,
        "{:>16} {:>11} {:>11} {:>11} {:>11} {:>14}",
        "stiffness, N/m", "upstream", "downstream", "upstream", "downstream", "within limits"
    )?;
    for point in curve {
        writeln!(
            out,
            "{:>16} {:>11.1} {:>11.1} {:>11.4} {:>11.4} {:>14}",
            stiffness(place, point.stiffness_n_per_m),
            point.upstream_force_n,
            point.downstream_force_n,
            1e3 * point.upstream_movement_m,
            1e3 * point.downstream_movement_m,
            if point.within_limits { "yes" } else { "no" }
        )?;
    }
    writeln!(out)
}

/// A spring or a clamp, and what it makes of the limits.
fn reached(design: &Design, point: &TradeOff) -> String {
    let taken = stiffness(design.place, point.stiffness_n_per_m);
    let taken = match design.place {
        _ if taken.parse::<f64>().is_err() => taken,
        Place::Clamp(_) => format!("a clamp of {taken} N/m"),
        _ => format!("a spring of {taken} N/m"),
    };
    let of = |(end, quantity, limit): (CableEnd, Limited, f64)| {
        let value = point.value(end, quantity);
        let beside = match value / limit {
            times if times > 1.0 => format!(", {times:.2} times its limit"),
            _ => String::new(),
        };
        format!("{} {}{beside}", quantity.at(end), quantity.shown(value))
    };
    let all: Vec<String> = design.limits.all().map(of).collect();
    let error = percent(point.error_estimate);
    format!("{taken}; {}; estimated error {error}", all.join("; "))
}
