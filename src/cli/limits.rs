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

impl LimitArguments {
    /// Warns of bare numbers that were probably meant in another unit.
    pub fn warn_of_slips(&self) {
        let bare = |limits: &[Limit]| -> Vec<f64> {
            let bare = limits.iter().filter(|limit| limit.unit.is_none());
            bare.map(|limit| limit.value).collect()
        };
        for value in bare(&self.limit_force)
            .iter()
            .filter(|value| **value < LEAST_FORCE)
        {
            terminal::warn(format_args!(
                "--limit-force is {value} N: did you mean {value}kN?"
            ));
        }
        for value in bare(&self.limit_movement)
            .iter()
            .filter(|value| **value > MOST_MOVEMENT)
        {
            terminal::warn(format_args!(
                "--limit-movement is {value} m: did you mean {value}mm?"
            ));
        }
    }

    pub fn are_given(&self) -> bool {
        !self.limit_force.is_empty() || !self.limit_movement.is_empty()
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
    #[cfg(feature = "sweep")]
    pub fn of_points(&self) -> crate::sweep::PointLimits {
        let own = self.clone();
        crate::sweep::PointLimits::new(format!("{self:?}"), move |scene| {
            let mut limits = own.clone();
            if scene.restraints.is_empty() {
                for given in [&mut limits.limit_force, &mut limits.limit_movement] {
                    given.retain(|limit| limit.of != Named::Clamps);
                }
            }
            limits
                .limits_beside(scene, &[])
                .map_err(|failure| failure.to_string())
        })
    }

    /// The same without warnings; there may also be limits of clamps `elsewhere`, which are left out.
    pub fn limits_beside(&self, scene: &Scene, elsewhere: &[Place]) -> Result<Limits, Failure> {
        let of = |given: &[Limit], wanted: Named| {
            let limit = given.iter().rfind(|limit| limit.of == wanted);
            limit.map(|limit| limit.value)
        };
        let mut limits = Limits::default();
        for end in CableEnd::ALL {
            let of = |given: &[Limit]| of(given, Named::One(end.into())).or_else(|| of(given, Named::Ends));
            *limits.of_mut(end) = EndLimits {
                force_n: of(&self.limit_force),
                movement_m: of(&self.limit_movement),
            };
        }
        limits.clamps = self.of_clamps(scene);
        self.check_clamps(scene, elsewhere)?;
        Ok(limits)
    }

    fn of_clamps(&self, scene: &Scene) -> Vec<ClampLimits> {
        let mut clamps: Vec<ClampLimits> = Vec::new();
        for position_m in scene.restraints.iter().map(|clamp| clamp.position) {
            let own = |limit: &&Limit| matches!(limit.of, Named::One(place) if place.is_clamp_at(position_m));
            let of = |given: &[Limit]| {
                let all = |limit: &&Limit| limit.of == Named::Clamps;
                let limit = given.iter().rfind(own).or_else(|| given.iter().rfind(all));
                limit.map(|limit| limit.value)
            };
            let limits = EndLimits {
                force_n: of(&self.limit_force),
                movement_m: of(&self.limit_movement),
            };
            let known = clamps.iter();
            let is_known = known
                .map(|clamp| Place::Clamp(clamp.position_m))
                .any(|clamp| clamp.is_clamp_at(position_m));
            if limits != EndLimits::default() && !is_known {
                clamps.push(ClampLimits { position_m, limits });
            }
        }
        clamps
    }

    /// Refuses limits of clamps that are not there.
    fn check_clamps(&self, scene: &Scene, elsewhere: &[Place]) -> Result<(), Failure> {
        let own = || scene.restraints.iter().map(|clamp| Place::Clamp(clamp.position));
        let clamps = || own().chain(elsewhere.iter().copied().filter(|place| place.end().is_none()));
        let is_there = |limit: &&Limit| match limit.of {
            Named::Clamps => clamps().next().is_some(),
            Named::One(Place::Clamp(position)) => clamps().any(|clamp| clamp.is_clamp_at(position)),
            _ => true,
        };
        let options = [
            ("--limit-force", &self.limit_force),
            ("--limit-movement", &self.limit_movement),
        ];
        for (argument, given) in options {
            let Some(limit) = given.iter().find(|limit| !is_there(limit)) else {
                continue;
            };
            let found = match limit.of {
                Named::One(Place::Clamp(position)) => format!("a clamp at {} m", exact(position)),
                _ => "clamp".to_owned(),
            };
            let all: Vec<String> = own().map(|clamp| clamp.to_string()).collect();
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
        Ok(())
    }
}
