//! `creepage design`: the springs or the clamp that stay within limits of force and movement.

use serde::Serialize;

use super::design_words::{print, why_none};
use super::failure::Failure;
use super::limits::{LimitArguments, place};
use super::progress::watched;
use super::shared::{Input, Json, TrafficArguments};
use crate::Limits;
use crate::design::{Design, DesignError, DesignOptions, Place, best, design, held};
use crate::scene::{did_you_mean, nearest};
use crate::shown::exact;
use crate::words::Reader;

#[derive(Debug, clap::Args)]
#[command(
    group = clap::ArgGroup::new("limit").args(["limit_force", "limit_movement"]).multiple(true).required(true),
    after_help = "The answer is found by runs of the scene; force and movement are the largest of all passes and, where the cable is heated, of all \
hours of all days. Without a name a limit is that of both ends, free ones too. A number without a unit is SI.

A spring is as stiff as the force allows, or in the middle of its range where movement is limited too; a clamp is as soft as may be. Two \
springs at once have the same stiffness. Where nothing stays within the limits, what comes nearest is printed, with exit status 1.

Examples:
  creepage design my-duct.toml --limit-force \"3 kN\"
  creepage design my-duct.toml --limit-force 300N --limit-movement 2mm --at upstream
  creepage design my-duct.toml --limit-force downstream=2kN --limit-movement downstream=10mm
  creepage design my-duct.toml --limit-force 2kN --limit-movement 10mm --at upstream+downstream
  creepage design my-duct.toml --limit-force 3kN --limit-force clamp=2kN --at \"95 m\" --at \"120 m\"
  creepage design my-duct.toml --limit-force \"3 kN\" --years 20 --trucks-per-day 800
  creepage design my-duct.toml --limit-force \"3 kN\" --at \"95 m\" --json"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// Where the spring is: upstream, downstream (at these ends), or a position for a clamp, "95 m"; two at once with + between them,
    /// upstream+downstream. Repeated, each is designed by itself, and they are compared
    #[arg(long, value_name = "PLACE[+PLACE]", default_value = "downstream", allow_hyphen_values = true, value_parser = places)]
    at: Vec<Places>,
    #[command(flatten)]
    json: Json,
}

/// Where springs are put at once: at one place or two.
#[derive(Debug, Clone)]
struct Places(Vec<Place>);

fn places(text: &str) -> Result<Places, String> {
    let one = |text: &str| place(text.trim());
    // A number may have a plus of its own.
    let alone = one(text).map(|place| vec![place]);
    let all = alone.or_else(|| text.split('+').map(one).collect());
    all.filter(|all| all.len() <= 2).map(Places).ok_or_else(|| {
        let mut wrong = text.split('+').filter(|text| one(text).is_none());
        let meant = wrong.find_map(|text| nearest(text.trim(), ["upstream", "downstream"]));
        let meant = did_you_mean(meant);
        format!("found `{text}`{meant}; allowed: upstream, downstream or a position such as \"20 m\", or two of these with + between them")
    })
}

/// The best design, and all that were compared.
#[derive(Serialize)]
struct Compared<'a> {
    #[serde(flatten)]
    best: &'a Design,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    candidates: &'a [Design],
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    let reader = Reader::new(arguments.limits.units(input.file()), &input.scene);
    arguments.limits.warn_of_slips();
    let ways = &arguments.at;
    let everywhere: Vec<Place> = ways.iter().flat_map(|way| way.0.clone()).collect();
    let length = input.scene.duct.length;
    let outside = everywhere.iter().find_map(|place| match place {
        Place::Clamp(position) if !(0.0..=length).contains(position) => Some(*position),
        _ => None,
    });
    if let Some(position) = outside {
        return Err(Failure::Usage {
            argument: "--at",
            found: format!("{} m", exact(position)),
            allowed: format!("a position in the duct, from 0 m to {} m", exact(length)),
        });
    }
    let limits = |Places(places): &Places| -> Result<Limits, Failure> {
        // Held somehow: what is limited there counts.
        let held = input.located(held(&input.scene, places, 1.0))?;
        let limits = arguments.limits.limits_with(&held, &everywhere)?;
        if limits.all().next().is_some() {
            return Ok(limits);
        }
        Err(Failure::Usage {
            argument: "--limit-force",
            found: "no limit".into(),
            allowed: "a force or a movement, such as --limit-force 2kN or --limit-movement upstream=10mm"
                .into(),
        })
    };
    let limits = ways.iter().map(limits).collect::<Result<Vec<_>, _>>()?;
    let words = |_| "runs of the scene with one stiffness after the other".to_owned();
    let designs = watched(1.0, words, |progress| {
        let all = ways.len() as f64;
        let each = ways.iter().zip(limits).enumerate();
        let each = each.map(|(index, (Places(places), limits))| {
            let mut options = DesignOptions::new(places[0], limits);
            options.places.clone_from(places);
            options.progress = progress.part(index as f64 / all, (index + 1) as f64 / all);
            design(&input.scene, &options)
        });
        each.collect::<Result<Vec<_>, _>>()
    });
    let designs = match designs {
        Err(DesignError::Analysis(error)) => input.located(Err(error))?,
        designs => designs?,
    };
    let Some(best) = best(&designs) else {
        return Ok(());
    };
    let candidates: &[Design] = if designs.len() > 1 { &designs } else { &[] };
    let compared = Compared { best, candidates };
    let words = || print(best, &designs, &reader);
    arguments.json.print(&compared, words)?;
    match best.answer {
        Some(_) => Ok(()),
        None => Err(Failure::NotKept(why_none(best, &reader))),
    }
}
