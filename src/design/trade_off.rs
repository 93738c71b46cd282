//! What a design answers: force against movement.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::answer::largest_movement_in_duct;
use crate::{CableEnd, Limited, Limits, Place, Run, Scene, finite};

/// Limits bind whose share is this near to the largest.
const BINDS: f64 = 0.95;

/// A spring at one place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Where it is.
    pub place: Place,
    /// Its stiffness \[N/m\]: 0 where the end is free or there is no clamp; `None` where the end is fixed.
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
    /// How far a clamp that slips has slipped in the end \[m\], positive toward growing x; none if it never slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slipped_m: Option<f64>,
}

/// A scene's answer with one stiffness, or with two.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TradeOff {
    /// Stiffness of the first spring \[N/m\]; `None` where the end is fixed.
    pub stiffness_n_per_m: Option<f64>,
    /// All springs that were varied.
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
    /// Force on the last clamp that was varied after the last pass \[N\], where there is one.
    pub clamp_force_n: Option<f64>,
    /// All clamps.
    pub clamps: Vec<ClampPeak>,
    /// Whether an end moves by more than a hundredth of the duct's length: the cable leaves the duct, and its movement is only that it does.
    pub leaves_duct: bool,
    /// Limits that these passes keep and more of them would not: at each the force after a pass that they level off at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exceeded_later: Vec<Binding>,
    /// Whether forces still grow after these passes, and how far is not known.
    #[serde(default)]
    pub still_growing: bool,
    /// Estimated relative error of the forces; but for the answer, and the nearest, with the mesh's part of the run with fixed ends.
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
    /// Of one spring within the limits: which others exceed it.
    pub exceeded_by: Option<Side>,
}

/// Springs beside a range of stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Softer ones than the softest in it.
    Softer,
    /// Stiffer ones than the stiffest in it.
    Stiffer,
}

/// What holds the cable best.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Design {
    /// The scene's title.
    pub title: String,
    /// What was varied: the first place of two.
    pub place: Place,
    /// All places where springs were varied.
    pub places: Vec<Place>,
    /// Number of passes.
    pub passes: u64,
    /// The limits.
    pub limits: Limits,
    /// Of one spring, the stiffnesses within all limits \[N/m\], from and to; no upper one where a fixed end is within them too. `None` where only a
    /// fixed end or no stiffness is.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the limits, with margins to them. `None` where nothing stays within them.
    pub answer: Option<TradeOff>,
    /// Where nothing stays within the limits, what comes nearest to them.
    pub nearest: Option<TradeOff>,
    /// The limits that bind: of one spring those at the ends of its range, else those that the answer, or the nearest, is nearest to or
    /// exceeds most.
    pub binding: Vec<Binding>,
    /// Everything that was computed with the scene's own tolerance, by growing stiffness, from a free end or no clamp on.
    pub curve: Vec<TradeOff>,
    /// How many runs of the scene it took.
    pub runs: usize,
}

/// What no end may exceed, whatever is limited: the cable is to stay in the duct.
pub(super) fn in_duct(scene: &Scene) -> impl Iterator<Item = (Place, Limited, f64)> {
    let most = largest_movement_in_duct(scene);
    CableEnd::ALL
        .into_iter()
        .map(move |end| (end.into(), Limited::Movement, most))
}

finite::numbers! {
    ClampPeak: position_m force_n movement_m slipped_m;
    TradeOff: stiffness_n_per_m force_n movement_m upstream_force_n downstream_force_n upstream_movement_m downstream_movement_m
        clamp_force_n clamps error_estimate;
}

impl Design {
    /// The answer, or what comes nearest to the limits.
    pub fn found(&self) -> Option<&TradeOff> {
        self.answer.as_ref().or(self.nearest.as_ref())
    }

    /// The largest share of a limit that it comes to, at most 1 within the limits.
    pub fn excess(&self) -> f64 {
        let found = self.found();
        found.map_or(f64::INFINITY, |found| found.excess(&self.limits))
    }
}

/// The best of several designs: of those that keep their limits that with the largest margin, or the softest where all are clamps,
/// which are as soft as their limits allow; else the one nearest to its limits.
pub fn best(designs: &[Design]) -> Option<&Design> {
    let kept = || designs.iter().filter(|design| design.answer.is_some());
    let clamp = |design: &Design| match (&design.answer, &design.places[..]) {
        (Some(answer), [Place::Clamp(_)]) => answer.stiffness_n_per_m,
        _ => None,
    };
    let by_excess = |a: &&Design, b: &&Design| a.excess().total_cmp(&b.excess());
    if kept().all(|design| clamp(design).is_some()) {
        kept().min_by(|a, b| clamp(a).partial_cmp(&clamp(b)).unwrap_or(Ordering::Equal))
    } else {
        kept().min_by(by_excess)
    }
    .or_else(|| designs.iter().min_by(by_excess))
}

impl Spring {
    pub(super) fn new(place: Place, stiffness: f64) -> Self {
        Self {
            place,
            stiffness_n_per_m: stiffness.is_finite().then_some(stiffness),
        }
    }

    /// Its stiffness \[N/m\], infinite where the end is fixed.
    pub fn stiffness(&self) -> f64 {
        self.stiffness_n_per_m.unwrap_or(f64::INFINITY)
    }
}

impl TradeOff {
    /// What `run` gives for `scene` with `springs`.
    pub(crate) fn of(scene: &Scene, run: &Run, springs: &[Spring], limits: &Limits) -> Self {
        let forces = CableEnd::ALL.map(|end| run.largest(end, Limited::Force));
        let movements = CableEnd::ALL.map(|end| run.largest(end, Limited::Movement));
        let movement_m = movements[0].max(movements[1]);
        let clamped = springs
            .iter()
            .any(|spring| matches!(spring.place, Place::Clamp(_)) && spring.stiffness() > 0.0);
        let clamp = run.restraints.last().filter(|_| clamped);
        let clamps = run.restraints.iter().map(|clamp| {
            let place = Place::Clamp(clamp.position_m);
            ClampPeak {
                position_m: clamp.position_m,
                force_n: run.largest(place, Limited::Force),
                movement_m: run.largest(place, Limited::Movement),
                slipped_m: clamp.slipped_m,
            }
        });
        let mut point = Self {
            stiffness_n_per_m: springs.first().and_then(|spring| spring.stiffness_n_per_m),
            springs: springs.to_vec(),
            force_n: forces[0].max(forces[1]),
            movement_m,
            upstream_force_n: forces[0],
            downstream_force_n: forces[1],
            upstream_movement_m: movements[0],
            downstream_movement_m: movements[1],
            clamp_force_n: clamp.map(|clamp| clamp.force_n),
            clamps: clamps.collect(),
            leaves_duct: movement_m > largest_movement_in_duct(scene),
            exceeded_later: Vec::new(),
            still_growing: run.saturation.is_none() && run.range.is_none() && run.heat.is_none(),
            error_estimate: run.error_estimate.relative,
            within_limits: true,
        };
        let verdicts = limits.verdicts(run).into_iter();
        point.exceeded_later = verdicts
            .filter_map(|verdict| {
                let limit = (verdict.end, verdict.quantity, verdict.limit);
                Some(Binding {
                    value: verdict.levels_off_above?,
                    ..point.binding(limit, None)
                })
            })
            .collect();
        point.within_limits = point.excess(limits) <= 1.0;
        point
    }

    /// The largest of what is limited, as a share of its limit; infinite where the cable leaves the duct, which no limit allows.
    pub fn excess(&self, limits: &Limits) -> f64 {
        if self.leaves_duct {
            return f64::INFINITY;
        }
        let shares = limits.all().map(|limit| self.share(limit));
        shares.fold(0.0, f64::max)
    }

    /// What is limited, as this point has it \[N or m\]; zero at a clamp that is not there.
    pub fn value(&self, place: impl Into<Place>, quantity: Limited) -> f64 {
        match (quantity, place.into()) {
            (Limited::Force, Place::Upstream) => self.upstream_force_n,
            (Limited::Force, Place::Downstream) => self.downstream_force_n,
            (Limited::Movement, Place::Upstream) => self.upstream_movement_m,
            (Limited::Movement, Place::Downstream) => self.downstream_movement_m,
            (_, place) => {
                let mut clamps = self.clamps.iter();
                let clamp = clamps.find(|clamp| place.is_clamp_at(clamp.position_m));
                clamp.map_or(0.0, |clamp| match quantity {
                    Limited::Force => clamp.force_n,
                    Limited::Movement => clamp.movement_m,
                })
            }
        }
    }

    /// What of it is beside a limit, at most 1 within the limit.
    pub(super) fn share(&self, (place, quantity, limit): (Place, Limited, f64)) -> f64 {
        self.value(place, quantity) / limit
    }

    /// A limit that binds here.
    pub(super) fn binding(&self, limit: (Place, Limited, f64), exceeded_by: Option<Side>) -> Binding {
        let (end, quantity, limit) = limit;
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
