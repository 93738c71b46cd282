//! Springs, and what a scene answers with them: force against movement.

use serde::{Deserialize, Serialize};

use super::options::DesignOptions;
use creepage_run::{Error, Limited, Limits, Place, Run, Verdict, answer::largest_movement_in_duct};
use creepage_scene::{CableEnd, End, Restraint, Scene};

/// Where something is limited, what, and how much \[N or m\].
pub type Limit = (Place, Limited, f64);

/// Limits bind whose share is this near to the largest.
const BINDS: f64 = 0.95;

/// A spring at one of the places.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Where it is.
    pub place: Place,
    /// Its stiffness \[N/m\]: 0 where the end is free or there is no clamp; `None` if the end is
    /// fixed.
    pub stiffness_n_per_m: Option<f64>,
}

/// What one clamp comes to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ClampPeak {
    /// Its position along the duct \[m\].
    pub position_m: f64,
    /// Largest force on it in size, during passes and over all days \[N\].
    pub force_n: f64,
    /// Largest displacement of the cable there \[m\].
    pub movement_m: f64,
    /// How far a clamp that slips has slipped in the end \[m\], positive toward growing x; none if
    /// it never slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slipped_m: Option<f64>,
}

/// A scene's answer with springs of one stiffness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TradeOff {
    /// Stiffness of the springs \[N/m\]; `None` if the end is fixed.
    pub stiffness_n_per_m: Option<f64>,
    /// Where they are.
    pub springs: Vec<Spring>,
    /// Largest force on either end \[N\].
    pub force_n: f64,
    /// Largest displacement of either end \[m\].
    pub movement_m: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_force_n: f64,
    /// Largest force on the downstream end \[N\].
    pub downstream_force_n: f64,
    /// Largest displacement of the upstream end \[m\].
    pub upstream_movement_m: f64,
    /// Largest displacement of the downstream end \[m\].
    pub downstream_movement_m: f64,
    /// Force on the last clamp that was varied after the last pass \[N\], if there is one.
    pub clamp_force_n: Option<f64>,
    /// All clamps.
    pub clamps: Vec<ClampPeak>,
    /// Whether an end moves by more than a hundredth of the duct's length: the cable leaves the
    /// duct, and its movement is only that it does.
    pub leaves_duct: bool,
    /// Limits that these passes keep and more of them would not: at each the force after a pass
    /// that they level off at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exceeded_later: Vec<Binding>,
    /// Whether forces still grow after these passes, and how far is not known.
    #[serde(default)]
    pub still_growing: bool,
    /// Estimated relative error of the forces; but for the answer, and the nearest, with the mesh's
    /// part of the run with fixed ends.
    pub error_estimate: f64,
    /// Whether it is within all limits.
    pub within_limits: bool,
}

/// A limit that decides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Binding {
    /// The end or clamp.
    pub end: Place,
    /// What is limited there.
    pub quantity: Limited,
    /// The limit \[N or m\].
    pub limit: f64,
    /// What the answer, or the nearest, comes to \[N or m\].
    pub value: f64,
    /// Where springs are within the limits: which others exceed it.
    pub exceeded_by: Option<Side>,
}

/// Springs outside a range of stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Softer ones than the softest in it.
    Softer,
    /// Stiffer ones than the stiffest in it.
    Stiffer,
}

/// The `limits`, and last what no end may exceed whatever is limited: the cable is to stay in the
/// duct.
pub(super) fn with_duct(limits: &Limits, scene: &Scene) -> Vec<Limit> {
    let most = largest_movement_in_duct(scene);
    let in_duct = CableEnd::ALL.map(|end| (end.into(), Limited::Movement, most));
    limits.all().chain(in_duct).collect()
}

/// A limit is out of reach if every spring exceeds it by more than this share: a rough run is off by a quarter of it.
const OUT_OF_REACH: f64 = 0.2;

/// The limits that none of `points` comes near, each with the least that one comes to.
pub(super) fn out_of_reach(points: &[TradeOff], limits: &Limits) -> Vec<Binding> {
    let nearest = |limit| {
        let by_share = |a: &&TradeOff, b: &&TradeOff| a.share(limit).total_cmp(&b.share(limit));
        let nearest = points.iter().min_by(by_share)?;
        (nearest.share(limit) > 1.0 + OUT_OF_REACH).then(|| nearest.binding(limit, None))
    };
    limits.all().filter_map(nearest).collect()
}

/// The valid scene with springs of this stiffness \[N/m\] at `places`: 0 is a free end or no clamp,
/// infinity a fixed end.
///
/// # Errors
///
/// [`Error`] if that has no meaning there.
pub fn held(scene: &Scene, places: &[Place], stiffness: f64) -> Result<Scene, Error> {
    let mut scene = scene.clone();
    let held = match stiffness {
        0.0 => End::Free,
        f64::INFINITY => End::Fixed,
        _ => End::Spring(stiffness),
    };
    for place in places {
        match *place {
            Place::Upstream => scene.ends.upstream = held,
            Place::Downstream => scene.ends.downstream = held,
            Place::Clamp(_) if held == End::Free => {}
            Place::Clamp(position) => scene.restraints.push(Restraint::new(position, stiffness)),
        }
    }
    scene.validate()?;
    Ok(scene)
}

impl TradeOff {
    /// What `run` gives for `scene` with springs of this stiffness \[N/m\].
    pub(super) fn of(scene: &Scene, run: &Run, stiffness: f64, options: &DesignOptions<'_>) -> Self {
        let (places, stiffness_n_per_m) = (&options.places, Some(stiffness).filter(|k| k.is_finite()));
        let spring = |&place: &Place| Spring {
            place,
            stiffness_n_per_m,
        };
        let of_ends = |quantity| CableEnd::ALL.map(|end| run.largest(end, quantity));
        let [upstream_force_n, downstream_force_n] = of_ends(Limited::Force);
        let [upstream_movement_m, downstream_movement_m] = of_ends(Limited::Movement);
        let movement_m = upstream_movement_m.max(downstream_movement_m);
        let is_clamped = stiffness > 0.0 && places.iter().any(|place| place.end().is_none());
        let clamp = run.restraints.last().filter(|_| is_clamped);
        let clamps = run.restraints.iter().map(|clamp| ClampPeak {
            position_m: clamp.position_m,
            force_n: run.largest(Place::Clamp(clamp.position_m), Limited::Force),
            movement_m: run.largest(Place::Clamp(clamp.position_m), Limited::Movement),
            slipped_m: clamp.slipped_m,
        });
        let later = |verdict: Verdict| {
            Some(Binding {
                end: verdict.end,
                quantity: verdict.quantity,
                limit: verdict.limit,
                value: verdict.levels_off_above?,
                exceeded_by: None,
            })
        };
        let mut point = Self {
            stiffness_n_per_m,
            springs: places.iter().map(spring).collect(),
            force_n: upstream_force_n.max(downstream_force_n),
            movement_m,
            upstream_force_n,
            downstream_force_n,
            upstream_movement_m,
            downstream_movement_m,
            clamp_force_n: clamp.map(|clamp| clamp.force_n),
            clamps: clamps.collect(),
            leaves_duct: movement_m > largest_movement_in_duct(scene),
            exceeded_later: options
                .limits
                .verdicts(run)
                .into_iter()
                .filter_map(later)
                .collect(),
            still_growing: run.saturation.is_none() && run.range.is_none() && run.heat.is_none(),
            error_estimate: run.error_estimate.relative,
            within_limits: true,
        };
        point.within_limits = point.excess(&options.limits) <= 1.0;
        point
    }

    /// The same stiffness, infinite if the end is fixed.
    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness_n_per_m.unwrap_or(f64::INFINITY)
    }

    /// The largest of what is limited, as a share of its limit; infinite if the cable leaves the
    /// duct, which no limit allows.
    pub fn excess(&self, limits: &Limits) -> f64 {
        let shares = limits.all().map(|limit| self.share(limit));
        let out = if self.leaves_duct { f64::INFINITY } else { 0.0 };
        shares.fold(out, f64::max)
    }

    /// What is limited, as this point has it \[N or m\]; zero at a clamp that is not there.
    pub fn value(&self, place: impl Into<Place>, quantity: Limited) -> f64 {
        let place = place.into();
        let clamp = self.clamp_at(place);
        quantity.of(match place {
            Place::Upstream => [self.upstream_force_n, self.upstream_movement_m],
            Place::Downstream => [self.downstream_force_n, self.downstream_movement_m],
            Place::Clamp(_) => clamp.map_or([0.0; 2], |clamp| [clamp.force_n, clamp.movement_m]),
        })
    }

    /// The clamp at this place, if there is one.
    pub fn clamp_at(&self, place: Place) -> Option<&ClampPeak> {
        let mut clamps = self.clamps.iter();
        clamps.find(|clamp| place.is_clamp_at(clamp.position_m))
    }

    /// Its value relative to a limit: at most 1 within the limit.
    pub(super) fn share(&self, (place, quantity, limit): Limit) -> f64 {
        self.value(place, quantity) / limit
    }

    /// A limit that binds here.
    pub(super) fn binding(&self, (end, quantity, limit): Limit, exceeded_by: Option<Side>) -> Binding {
        Binding {
            end,
            quantity,
            limit,
            value: self.value(end, quantity),
            exceeded_by,
        }
    }

    /// The limits that it is nearest to, or exceeds most.
    pub fn tightest(&self, limits: &Limits) -> Vec<Binding> {
        let most = self.excess(limits);
        let near = limits.all().filter(|limit| self.share(*limit) >= BINDS * most);
        near.map(|limit| self.binding(limit, None)).collect()
    }
}
