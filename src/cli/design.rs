//! `creepage design`: the springs or the clamp that stay within limits of force and movement.

use serde::Serialize;

use super::design_words::{compared, print, why_none};
use super::failure::Failure;
use super::limits::{LimitArguments, place};
use super::progress::watched;
use super::shared::{Input, Json, TrafficArguments};
use crate::design::{Design, DesignError, DesignOptions, Place, best, design};
use crate::scene::{End, Restraint, did_you_mean, nearest};
use crate::shown::exact;
use crate::{Limits, Scene};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The answer is found by runs of the scene; force and movement are the largest of all passes and, where the cable is heated, of all \
hours of all days. A free end's movement is limited only by its name. A number without a unit is SI.

One spring is as stiff as the force allows, or in the middle of its range where movement is limited too; a clamp is as soft as may be. Two \
springs at once have the largest margin: the largest share of a limit is the smallest. Where only forces are limited, the ends move least. \
Where nothing stays within the limits, what comes nearest is printed, with exit status 1.

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
#[derive(Debug, Clone, Copy)]
struct Places(Place, Option<Place>);

fn places(text: &str) -> Result<Places, String> {
    let one = |text: &str| place(text.trim());
    let two = || {
        // A number may have a plus of its own.
        let mut pluses = text.match_indices('+');
        pluses.find_map(|(at, _)| Some(Places(one(&text[..at])?, Some(one(&text[at + 1..])?))))
    };
    let alone = one(text).map(|place| Places(place, None));
    alone.or_else(two).ok_or_else(|| {
        let mut wrong = text.split('+').filter(|text| one(text).is_none());
        let meant = wrong.find_map(|text| nearest(text.trim(), ["upstream", "downstream"]));
        let meant = did_you_mean(meant);
        format!("found `{text}`{meant}; allowed: upstream, downstream or a position such as \"20 m\", or two of these with + between them")
    })
}

impl Places {
    fn all(self) -> impl Iterator<Item = Place> {
        std::iter::once(self.0).chain(self.1)
    }

    /// `scene` with these places held somehow: what is limited there counts.
    fn held(self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        for place in self.all() {
            match place {
                Place::Upstream => scene.ends.upstream = End::Fixed,
                Place::Downstream => scene.ends.downstream = End::Fixed,
                Place::Clamp(position) => scene.restraints.push(Restraint::new(position, 1.0)),
            }
        }
        scene
    }
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
    let units = arguments.limits.units(input.file());
    arguments.limits.warn_of_slips();
    let ways = &arguments.at;
    let everywhere: Vec<Place> = ways.iter().flat_map(|way| way.all()).collect();
    let length = input.scene.duct.length;
    for place in &everywhere {
        if let Place::Clamp(position) = place
            && !(0.0..=length).contains(position)
        {
            return Err(Failure::Usage {
                argument: "--at",
                found: format!("{} m", exact(*position)),
                allowed: format!("a position in the duct, from 0 m to {} m", exact(length)),
            });
        }
    }
    let limits = |way: &Places| -> Result<Limits, Failure> {
        let limits = arguments
            .limits
            .limits_beside(&way.held(&input.scene), &everywhere)?;
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
    let units = units.for_springs();
    let words = |_| "runs of the scene with one stiffness after the other".to_owned();
    let designs = watched(1.0, words, |progress| {
        let all = ways.len() as f64;
        let each = ways.iter().zip(&limits).enumerate();
        each.map(|(index, (way, limits))| {
            let mut options = DesignOptions::new(way.0, limits.clone());
            options.second = way.1;
            options.progress = progress.part(index as f64 / all, (index + 1) as f64 / all);
            design(&input.scene, &options)
        })
        .collect::<Result<Vec<_>, _>>()
    });
    let designs = match designs {
        Err(DesignError::Analysis(error)) => input.located(Err(error))?,
        designs => designs?,
    };
    let Some(best) = best(&designs) else {
        return Ok(());
    };
    let candidates: &[Design] = if designs.len() > 1 { &designs } else { &[] };
    arguments.json.print(&Compared { best, candidates }, || {
        if candidates.is_empty() {
            print(best, &input.scene, &units)
        } else {
            compared(best, candidates, &units)
        }
    })?;
    match best.answer {
        Some(_) => Ok(()),
        None => Err(Failure::NotKept(why_none(best, &units))),
    }
}
