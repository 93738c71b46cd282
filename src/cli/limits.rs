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
    #[arg(long, requires = "LimitArguments")]
    check: bool,
}

impl CheckArgument {
    /// Fails if limits are exceeded and that is to be a failure.
    pub fn judge(&self, verdicts: &[Verdict]) -> Result<(), Failure> {
        if self.check && verdicts.iter().any(Verdict::is_exceeded) {
            return Err(Failure::Exceeded(Verdict::summary(verdicts)));
        }
        Ok(())
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
    /// The ends, if nothing is named.
    Ends,
    /// Every clamp.
    Clamps,
    One(Place),
}

impl Named {
    /// Whether a limit of this is one of a `place`.
    fn holds(self, place: Place) -> bool {
        match self {
            Self::Ends => place.end().is_some(),
            Self::Clamps => place.end().is_none(),
            Self::One(Place::Clamp(position)) => place.is_clamp_at(position),
            Self::One(end) => end == place,
        }
    }
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
        let (noun, units) = (dimension.noun(), dimension.units().collect::<Vec<_>>().join(", "));
        format!("{error}; allowed: {noun} (units: {units}); another limit is another option")
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
const MIN_FORCE: f64 = 10.0;
const MAX_MOVEMENT: f64 = 1.0;

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

    /// Both options with what was given.
    fn options(&self) -> [(&'static str, &[Limit]); 2] {
        [
            ("--limit-force", &self.limit_force),
            ("--limit-movement", &self.limit_movement),
        ]
    }

    /// Warns of bare numbers that were probably meant in another unit.
    pub fn warn_of_slips(&self) {
        let bare = |given: &[Limit]| -> Vec<f64> {
            let bare = given.iter().filter(|limit| limit.unit.is_none());
            bare.map(|limit| limit.value).collect()
        };
        for force in bare(&self.limit_force) {
            if force < MIN_FORCE {
                terminal::warn(format_args!(
                    "--limit-force is {force} N: did you mean {force}kN?"
                ));
            }
        }
        for movement in bare(&self.limit_movement) {
            if movement > MAX_MOVEMENT {
                let meant = format!("did you mean {movement}mm?");
                terminal::warn(format_args!("--limit-movement is {movement} m: {meant}"));
            }
        }
    }

    pub fn are_given(&self) -> bool {
        self.options().iter().any(|(_, given)| !given.is_empty())
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
        self.limits_with(scene, &[])
    }

    /// The limits of every point of a sweep. A limit of all clamps is none if there is no clamp.
    pub fn of_points(&self) -> crate::sweep::PointLimits {
        let own = self.clone();
        crate::sweep::PointLimits::new(format!("{self:?}"), move |scene| {
            // A clamp of other points, wherever it is.
            let limits = own.limits_with(scene, &[Place::Clamp(f64::NAN)]);
            limits.map_err(|failure| failure.to_string())
        })
    }

    /// The same without warnings; there may also be limits of clamps `elsewhere`, which are left out.
    pub fn limits_with(&self, scene: &Scene, elsewhere: &[Place]) -> Result<Limits, Failure> {
        let clamps = scene.restraints.iter();
        let clamps: Vec<Place> = clamps.map(|clamp| Place::Clamp(clamp.position)).collect();
        let all = [&[Place::Upstream, Place::Downstream], &clamps[..], elsewhere].concat();
        for (option, given) in self.options() {
            let is_there = |limit: &Limit| all.iter().any(|place| limit.of.holds(*place));
            let Some(limit) = given.iter().find(|limit| !is_there(limit)) else {
                continue;
            };
            let found = match limit.of {
                Named::One(Place::Clamp(position)) => format!("a clamp at {} m", exact(position)),
                _ => "clamp".to_owned(),
            };
            let clamps: Vec<String> = clamps.iter().map(Place::to_string).collect();
            let allowed = match clamps.join(", ") {
                none if none.is_empty() => "upstream or downstream, as the scene has no clamps".to_owned(),
                clamps => format!("upstream, downstream, or the position of a clamp: {clamps}"),
            };
            return Err(Failure::usage(
                option,
                format!("{found}, where there is none"),
                allowed,
            ));
        }
        Ok(self.wherever_they_are(scene))
    }

    /// The limits of whatever ends and clamps `scene` has; those of other places are left out.
    pub fn wherever_they_are(&self, scene: &Scene) -> Limits {
        let mut limits = Limits::default();
        for end in CableEnd::ALL {
            *limits.of_mut(end) = self.at(end.into());
        }
        for position_m in scene.restraints.iter().map(|clamp| clamp.position) {
            let place = Place::Clamp(position_m);
            let own = self.at(place);
            let mut known = limits.clamps.iter();
            let is_known = known.any(|known| place.is_clamp_at(known.position_m));
            if own != EndLimits::default() && !is_known {
                limits.clamps.push(ClampLimits {
                    position_m,
                    limits: own,
                });
            }
        }
        limits
    }

    /// The limits at one place: the last that names it, or else the last that holds there.
    fn at(&self, place: Place) -> EndLimits {
        let of = |given: &[Limit]| {
            let there = given.iter().filter(|limit| limit.of.holds(place));
            let own = there.max_by_key(|limit| matches!(limit.of, Named::One(_)));
            own.map(|limit| limit.value)
        };
        EndLimits {
            force_n: of(&self.limit_force),
            movement_m: of(&self.limit_movement),
        }
    }
}
