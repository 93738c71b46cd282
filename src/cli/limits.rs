//! Limits of force and movement on the command line.

use super::failure::Failure;
use super::terminal;
use crate::scene::{Dimension, Unit, did_you_mean, nearest};
use crate::shown::exact;
use crate::{CableEnd, ClampLimits, EndLimits, Limits, Place, Scene, SceneFile, Units, Verdict};

#[derive(Debug, Clone, clap::Args)]
pub struct LimitArguments {
    /// Largest force allowed on both ends, 2kN, on one end, downstream=2kN, on the clamp at a position, "20 m=2kN", or on every clamp,
    /// clamp=2kN; may be repeated
    #[arg(long, value_name = "[PLACE=]FORCE", allow_hyphen_values = true, value_parser = |text: &str| limit(text, Dimension::Force))]
    limit_force: Vec<Limit>,
    /// Largest movement allowed of both ends, free ones too, 10mm, or at a place as above, upstream=10mm; may be repeated
    #[arg(long, value_name = "[PLACE=]LENGTH", allow_hyphen_values = true, value_parser = |text: &str| limit(text, Dimension::Length))]
    limit_movement: Vec<Limit>,
}

#[derive(Debug, clap::Args)]
pub struct CheckArgument {
    /// End with exit status 3 if a limit is exceeded, once everything is written
    #[arg(long)]
    check: bool,
}

impl CheckArgument {
    /// Refuses to check what has no limits.
    pub fn needs(&self, limits: &LimitArguments) -> Result<(), Failure> {
        if !self.check || limits.are_given() {
            return Ok(());
        }
        Err(Failure::Usage {
            argument: "--check",
            found: "no limit".into(),
            allowed: "--check with limits, such as --limit-force 2kN".into(),
        })
    }

    /// Fails if limits are exceeded and that is to be a failure.
    pub fn judge(&self, verdicts: &[Verdict]) -> Result<(), Failure> {
        let exceeded = self.check && verdicts.iter().any(Verdict::is_exceeded);
        let failure = exceeded.then(|| Failure::Exceeded(Verdict::summary(verdicts)));
        failure.map_or(Ok(()), Err)
    }
}

/// A limit, what it is for, and the unit it was typed in.
#[derive(Debug, Clone, Copy)]
struct Limit {
    of: Named,
    value: f64,
    unit: Option<Unit>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Named {
    /// The ends, where nothing is named.
    Ends,
    /// Every clamp.
    Clamps,
    One(Place),
}

fn limit(text: &str, dimension: Dimension) -> Result<Limit, String> {
    let (of, value) = match text.split_once('=') {
        None => match text.split_once(':') {
            Some((place, value)) if named(place).is_ok() => {
                return Err(format!("a place stands before `=`: {place}={value}"));
            }
            _ => (Named::Ends, text),
        },
        Some((name, value)) => (named(name.trim())?, value),
    };
    let unit = dimension.unit_of(value);
    let value = dimension.parse_argument(value).map_err(|error| {
        let units: Vec<&str> = dimension.units().collect();
        format!(
            "{error}; allowed: {} (units: {}); another limit is another option",
            dimension.noun(),
            units.join(", ")
        )
    })?;
    if value > 0.0 && value.is_finite() {
        return Ok(Limit { of, value, unit });
    }
    Err("a limit is positive; allowed: a finite value greater than 0".to_owned())
}

fn named(name: &str) -> Result<Named, String> {
    if name == "clamp" {
        return Ok(Named::Clamps);
    }
    let place = place(name).map(Named::One);
    place.ok_or_else(|| {
        let meant = did_you_mean(nearest(name, ["upstream", "downstream", "clamp"]));
        format!(
            "found `{name}`{meant}; allowed before `=`: upstream, downstream, clamp, or the position of a clamp such as \"20 m\""
        )
    })
}

/// An end by its name, or a clamp by its position.
pub fn place(text: &str) -> Option<Place> {
    match text {
        "upstream" => Some(Place::Upstream),
        "downstream" => Some(Place::Downstream),
        _ => Dimension::Length.parse_argument(text).ok().map(Place::Clamp),
    }
}

/// Smallest force \[N\] and largest movement \[m\] that a limit is likely to be.
const LEAST_FORCE: f64 = 10.0;
const MOST_MOVEMENT: f64 = 1.0;
/// What a bare number would say that is hardly meant.
type Slip = fn(f64) -> Option<String>;

impl LimitArguments {
    /// Limits of force and of movement that were typed elsewhere, as the options take them; or which one is wrong, and why.
    #[cfg(feature = "explore")]
    pub fn typed(force: &[String], movement: &[String]) -> Result<Self, (&'static str, String)> {
        let limits = |texts: &[String], dimension, option| {
            let limits = texts.iter().map(|text| limit(text, dimension));
            limits.collect::<Result<_, String>>().map_err(|why| (option, why))
        };
        Ok(Self {
            limit_force: limits(force, Dimension::Force, "--limit-force")?,
            limit_movement: limits(movement, Dimension::Length, "--limit-movement")?,
        })
    }

    /// Both options, each with what was given and with how a bare number that it hardly means would be meant.
    fn options(&self) -> [(&'static str, &[Limit], Slip); 2] {
        let force: Slip =
            |value| (value < LEAST_FORCE).then(|| format!("{value} N: did you mean {value}kN?"));
        let movement: Slip =
            |value| (value > MOST_MOVEMENT).then(|| format!("{value} m: did you mean {value}mm?"));
        [
            ("--limit-force", &self.limit_force, force),
            ("--limit-movement", &self.limit_movement, movement),
        ]
    }

    /// Warns of bare numbers that were probably meant in another unit.
    pub fn warn_of_slips(&self) {
        for (option, given, slip) in self.options() {
            let bare = given.iter().filter(|limit| limit.unit.is_none());
            for slip in bare.filter_map(|limit| slip(limit.value)) {
                terminal::warn(format_args!("{option} is {slip}"));
            }
        }
    }

    pub fn are_given(&self) -> bool {
        self.options().iter().any(|(_, given, _)| !given.is_empty())
    }

    /// The units that were typed here and in the scene.
    pub fn units(&self, file: &SceneFile) -> Units {
        let first = |given: &[Limit]| given.iter().find_map(|limit| limit.unit);
        Units::typed(file, first(&self.limit_force), first(&self.limit_movement))
    }

    /// The limits of the cable of `scene`. Without a name a limit is that of both ends; what is named counts before what is not, and a
    /// clamp's own limit before that of all clamps.
    pub fn limits(&self, scene: &Scene) -> Result<Limits, Failure> {
        self.warn_of_slips();
        self.limits_beside(scene, &[])
    }

    /// The limits of every point of a sweep. A limit of all clamps is none where there is no clamp.
    pub fn of_points(&self) -> crate::sweep::PointLimits {
        let own = self.clone();
        crate::sweep::PointLimits::new(format!("{self:?}"), move |scene| {
            let mut limits = own.clone();
            for given in [&mut limits.limit_force, &mut limits.limit_movement] {
                given.retain(|limit| limit.of != Named::Clamps || !scene.restraints.is_empty());
            }
            let limits = limits.limits_beside(scene, &[]);
            limits.map_err(|failure| failure.to_string())
        })
    }

    /// The same without warnings; there may also be limits of clamps `elsewhere`, which are left out.
    pub fn limits_beside(&self, scene: &Scene, elsewhere: &[Place]) -> Result<Limits, Failure> {
        let clamps = scene.restraints.iter();
        let clamps: Vec<Place> = clamps.map(|clamp| Place::Clamp(clamp.position)).collect();
        let there = || clamps.iter().chain(elsewhere).copied();
        for (argument, given, _) in self.options() {
            let found = given.iter().find_map(|limit| match limit.of {
                Named::One(Place::Clamp(position)) if !there().any(|place| limit.of.is(place)) => {
                    Some(format!("a clamp at {} m", exact(position)))
                }
                Named::Clamps if there().all(|place| place.end().is_some()) => Some("clamp".to_owned()),
                _ => None,
            });
            let Some(found) = found else { continue };
            let all: Vec<String> = clamps.iter().map(Place::to_string).collect();
            let allowed = match all.join(", ") {
                none if none.is_empty() => "upstream or downstream, as the scene has no clamps".to_owned(),
                all => format!("upstream, downstream, or the position of a clamp: {all}"),
            };
            return Err(Failure::Usage {
                argument,
                found: format!("{found}, where there is none"),
                allowed,
            });
        }
        Ok(self.wherever_they_are(scene))
    }

    /// The limits of whatever ends and clamps `scene` has; those of other places are left out.
    pub fn wherever_they_are(&self, scene: &Scene) -> Limits {
        let mut limits = Limits::default();
        for end in CableEnd::ALL {
            *limits.of_mut(end) = self.at(end.into(), Named::Ends);
        }
        for position_m in scene.restraints.iter().map(|clamp| clamp.position) {
            let place = Place::Clamp(position_m);
            let own = self.at(place, Named::Clamps);
            let mut known = limits.clamps.iter();
            let is_known = known.any(|known| place.is_clamp_at(known.position_m));
            if own != EndLimits::default() && !is_known {
                let limits_of_clamp = ClampLimits {
                    position_m,
                    limits: own,
                };
                limits.clamps.push(limits_of_clamp);
            }
        }
        limits
    }

    /// The limits at one place, which is among `all` of its kind.
    fn at(&self, place: Place, all: Named) -> EndLimits {
        let of = |given: &[Limit]| {
            let own = given.iter().rfind(|limit| limit.of.is(place));
            let limit = own.or_else(|| given.iter().rfind(|limit| limit.of == all));
            limit.map(|limit| limit.value)
        };
        EndLimits {
            force_n: of(&self.limit_force),
            movement_m: of(&self.limit_movement),
        }
    }
}

impl Named {
    /// Whether it is this place.
    fn is(self, place: Place) -> bool {
        match self {
            Self::One(Place::Clamp(position)) => place.is_clamp_at(position),
            named => named == Self::One(place),
        }
    }
}
