//! `creepage design`: the end spring or clamp that stays within limits of force and movement.

use std::io::Write;

use super::failure::Failure;
use super::progress::{PER_MILLE, PERCENT, with_bar};
use super::shared::{Input, Json, TrafficArguments};
use super::terminal;
use crate::design::{Design, DesignError, DesignOptions, Limits, Place, design};
use crate::scene::Dimension;
use crate::shown::percent;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The answer is found by runs of the scene; the force is the largest on either end, during and after the passes, the movement \
the largest of either end. A number without a unit is SI.

Examples:
  creepage design my-duct.toml --limit-force \"3 kN\"
  creepage design my-duct.toml --limit-force 300N --limit-movement 2mm --at upstream
  creepage design my-duct.toml --limit-force \"3 kN\" --years 20 --trucks-per-day 800
  creepage design my-duct.toml --limit-force \"3 kN\" --at \"95 m\" --json"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// Largest force allowed on either end
    #[arg(long, value_name = "FORCE", value_parser = |text: &str| Dimension::Force.parse_argument(text))]
    limit_force: f64,
    /// Largest movement allowed of either end
    #[arg(long, value_name = "LENGTH", value_parser = |text: &str| Dimension::Length.parse_argument(text))]
    limit_movement: Option<f64>,
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
    let limits = Limits {
        force_n: arguments.limit_force,
        movement_m: arguments.limit_movement,
    };
    let answer = with_bar(PERCENT, PER_MILLE, |progress| {
        let mut options = DesignOptions::new(arguments.at, limits);
        options.progress = progress;
        design(&input.scene, &options)
    });
    let answer = match answer {
        Err(DesignError::Analysis(error)) => input.located(Err(error))?,
        answer => answer?,
    };
    arguments.json.print(&answer, || print(&answer))
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
    write!(out, "limits: {} N", design.limits.force_n)?;
    if let Some(movement) = design.limits.movement_m {
        write!(out, ", {} mm", 1e3 * movement)?;
    }
    writeln!(out, "\n")?;
    writeln!(
        out,
        "{:>16} {:>14} {:>16} {:>14}",
        "stiffness, N/m", "force, N", "movement, mm", "within limits"
    )?;
    for point in &design.curve {
        writeln!(
            out,
            "{:>16} {:>14.1} {:>16.4} {:>14}",
            stiffness(design.place, point.stiffness_n_per_m),
            point.force_n,
            1e3 * point.movement_m,
            if point.within_limits { "yes" } else { "no" }
        )?;
    }
    writeln!(out)?;
    let (Some(answer), Some((from, to))) = (&design.answer, design.range_n_per_m) else {
        writeln!(out, "no stiffness stays within the limits")?;
        return Ok(());
    };
    let taken = stiffness(design.place, answer.stiffness_n_per_m);
    let taken = match design.place {
        _ if taken.parse::<f64>().is_err() => taken,
        Place::Clamp(_) => format!("a clamp of {taken} N/m"),
        _ => format!("a spring of {taken} N/m"),
    };
    writeln!(
        out,
        "answer: {taken}; force {:.1} N, movement {:.4} mm, estimated error {}",
        answer.force_n,
        1e3 * answer.movement_m,
        percent(answer.error_estimate)
    )?;
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
