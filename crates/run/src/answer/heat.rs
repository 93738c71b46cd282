//! What heat and traffic do to the cable, day by day. The names of the fields are those of the JSON
//! document, units included.

use cycle_jump::days::Extremes;
use serde::{Deserialize, Serialize};

use super::along_cable::ForceProfile;
use super::differences::larger;
use creepage_scene::CableEnd;

/// Largest and least forces and movements over a day, with the cable at rest: after every pass and
/// every change of temperature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DayExtremes {
    /// Number of the day, from 1.
    pub day: u64,
    /// Largest force on the downstream end \[N\].
    pub downstream_max_n: f64,
    /// Minimum force on the downstream end \[N\]: the largest tension where it is negative.
    pub downstream_min_n: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_max_n: f64,
    /// Minimum force on the upstream end \[N\].
    pub upstream_min_n: f64,
    /// Largest compression along the cable \[N\].
    pub max_compression_n: f64,
    /// Largest tension along the cable \[N\].
    pub max_tension_n: f64,
    /// Farthest place of the upstream end toward growing x \[m\].
    pub upstream_displacement_max_m: f64,
    /// Farthest place of the upstream end toward falling x \[m\].
    pub upstream_displacement_min_m: f64,
    /// Farthest place of the downstream end toward growing x \[m\].
    pub downstream_displacement_max_m: f64,
    /// Farthest place of the downstream end toward falling x \[m\].
    pub downstream_displacement_min_m: f64,
    /// Force on each clamp, in the order of [`Run::restraints`](crate::Run::restraints).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub restraints: Vec<RestraintRange>,
}

/// The largest and the least force of the cable on a clamp \[N\], positive toward growing x.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RestraintRange {
    /// The largest.
    pub max_n: f64,
    /// The least.
    pub min_n: f64,
}

/// The cable at one time of a day, after a pass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DayPoint {
    /// Time since the day began \[h\].
    pub hour: f64,
    /// Temperature of the cable above that at laying \[K\].
    pub warming_k: f64,
    /// Force on the upstream end \[N\].
    pub upstream_force_n: f64,
    /// Force on the downstream end \[N\].
    pub downstream_force_n: f64,
    /// Displacement at the upstream end \[m\].
    pub upstream_displacement_m: f64,
    /// Displacement at the downstream end \[m\].
    pub downstream_displacement_m: f64,
}

/// The cable over all days.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatRecord {
    /// Largest and least values of all days; its `day` is their number.
    pub all_days: DayExtremes,
    /// Passes of a day.
    pub passes_per_day: u64,
    /// The day from which on every day is like the one before but for a drift, if there is one.
    pub periodic_from_day: Option<u64>,
    /// How far the cable moves from one such day to the next \[m\].
    pub drift_per_day_m: Option<f64>,
    /// The same in a year of 365.25 days \[m\].
    pub drift_per_year_m: Option<f64>,
    /// The last day, hour by hour.
    pub cycle: Vec<DayPoint>,
    /// Force along the cable when that day is hottest.
    pub hot_profile: ForceProfile,
    /// Force along the cable when it is coldest.
    pub cold_profile: ForceProfile,
}

impl HeatRecord {
    /// The last of `days` that all of its passes were computed of, if `passes` end within one; else
    /// the last.
    pub fn last_whole<'d>(&self, days: &'d [DayExtremes], passes: u64) -> Option<&'d DayExtremes> {
        let whole = days.iter().rfind(|day| day.day * self.passes_per_day <= passes);
        whole.or(days.last())
    }
}

impl DayExtremes {
    /// By how much the force on an end changes at most over the day \[N\], and how far an end moves
    /// \[m\]: the cyclic load of joints.
    pub fn largest_range(&self) -> (f64, f64) {
        let [a, b] = CableEnd::ALL.map(|end| self.of(end).map(|[least, most]| most - least));
        (a[0].max(b[0]), a[1].max(b[1]))
    }

    /// The least and the largest force on an end \[N\], and displacement of it \[m\].
    pub fn of(&self, end: CableEnd) -> [[f64; 2]; 2] {
        let of = |least: [f64; 2], most: [f64; 2]| [end.of(least), end.of(most)];
        let (least, most) = (self.upstream_displacement_min_m, self.upstream_displacement_max_m);
        [
            of(
                [self.upstream_min_n, self.downstream_min_n],
                [self.upstream_max_n, self.downstream_max_n],
            ),
            of(
                [least, self.downstream_displacement_min_m],
                [most, self.downstream_displacement_max_m],
            ),
        ]
    }

    /// The force on the end that is largest in size \[N\].
    pub fn largest_force(&self, end: CableEnd) -> f64 {
        let [least, most] = self.of(end)[0];
        larger(most, least)
    }

    /// How far the end is from where it was laid, whichever way \[m\].
    pub fn movement(&self, end: CableEnd) -> f64 {
        let [least, most] = self.of(end)[1];
        least.abs().max(most.abs())
    }

    pub fn new(day: u64, extremes: &Extremes) -> Self {
        let [upstream, downstream] = extremes.force;
        let [upstream_end, downstream_end] = extremes.displacement;
        let on_clamp = |&[min_n, max_n]: &[f64; 2]| RestraintRange { max_n, min_n };
        Self {
            day,
            downstream_max_n: downstream[1],
            downstream_min_n: downstream[0],
            upstream_max_n: upstream[1],
            upstream_min_n: upstream[0],
            max_compression_n: extremes.compression,
            max_tension_n: extremes.tension,
            upstream_displacement_max_m: upstream_end[1],
            upstream_displacement_min_m: upstream_end[0],
            downstream_displacement_max_m: downstream_end[1],
            downstream_displacement_min_m: downstream_end[0],
            restraints: extremes.restraints.iter().map(on_clamp).collect(),
        }
    }
}
