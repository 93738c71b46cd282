//! What a run answers. The names of the fields are those of the JSON document, units included.

use cable_dem::SlipLengths;
use cycle_jump::Record;
use serde::{Deserialize, Serialize};

use super::along_cable::{ForceProfile, Stage};
use super::differences::larger;
use super::error_estimate::ErrorEstimate;
use super::fixed_mesh::FixedMesh;
use super::heat::{DayExtremes, HeatRecord};
use creepage_plan::SavedState;
use creepage_scene::{CableEnd, Traffic};

/// Forces that differ by a smaller share are the same to a reader.
const NOTICEABLE: f64 = 0.01;

/// Answer of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The scene's title.
    pub title: String,
    /// How it was computed.
    pub plan: PlanSummary,
    /// Motion of the duct under the first vehicle.
    pub duct_motion: DuctMotionSummary,
    /// Force and movement after the passes, ascending; of very long traffic some, the first and the
    /// last among them.
    pub passes: Vec<PassRecord>,
    /// Where the force levels off, if it does.
    pub saturation: Option<Saturation>,
    /// Forces on the ends over a period of the traffic once nothing changes any more, where that is
    /// known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<ForceRange>,
    /// How far forces scatter where vehicles come in random order and not every pass is simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub random: Option<RandomSpread>,
    /// Where a period of other vehicles stands in for the traffic, its passes that show a larger
    /// force or movement than those before them; and one pass of each vehicle that comes too seldom
    /// to have a place in it, as it would follow the last pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extremes: Vec<ExtremePass>,
    /// Where the cable is heated every day, the extremes of days: the first ones, then evenly
    /// growing numbers, the last among them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub days: Vec<DayExtremes>,
    /// What heat does over all days.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<HeatRecord>,
    /// Stiffness of the spring at the upstream end \[N/m\], if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upstream_spring_n_per_m: Option<f64>,
    /// Stiffness of the spring at the downstream end \[N/m\], if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub downstream_spring_n_per_m: Option<f64>,
    /// Force along the cable after the last pass.
    pub force_profile: ForceProfile,
    /// What each clamp carries.
    pub restraints: Vec<RestraintRecord>,
    /// The cable after the passes that [`RunOptions::stages`](crate::RunOptions::stages) names; not
    /// in the JSON document where none are.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<Stage>,
    /// Lengths of dynamic friction with the vehicle over the duct's middle (Kashiro et al., Figure
    /// 7).
    pub slip_lengths: Option<SlipLengths>,
    /// How wrong the forces may be.
    pub error_estimate: ErrorEstimate,
    /// Where the run began, if not with the cable as laid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Start>,
    /// The cable after the last pass, with which another run can begin; not in the JSON document.
    #[serde(skip)]
    pub state: Option<SavedState>,
    /// What the run has shown of its mesh, for others that differ from it little: for
    /// [`RunOptions::mesh`](crate::RunOptions::mesh); not in the JSON document.
    #[serde(skip)]
    pub shown: Option<FixedMesh>,
    /// What the answer cost, in counts that do not depend on the machine.
    pub cost: Cost,
    /// What the user should know before trusting the answer.
    pub warnings: Vec<String>,
}

/// The state that a run began with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// Passes before it.
    pub passes: u64,
}

/// Which models and steps were used, and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlanSummary {
    /// Ground model.
    pub ground: String,
    /// Cable solver.
    pub cable: String,
    /// Distance between nodes \[m\].
    pub node_spacing_m: f64,
    /// Advance of the vehicle per step \[m\].
    pub vehicle_step_m: f64,
    /// Why these.
    pub reasons: Vec<String>,
}

/// Peaks of the duct's motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DuctMotionSummary {
    /// max |D_l| \[m\].
    pub peak_longitudinal_m: f64,
    /// max |D_v| \[m\].
    pub peak_vertical_m: f64,
}

/// Force and movement after one pass; forces in N, compression positive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PassRecord {
    /// Number of the pass, from 1.
    pub pass: u64,
    /// The time after it \[years of 365.25 days\], where the vehicles a day are known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub years: Option<f64>,
    /// Force on the downstream end after the pass.
    pub downstream_force_n: f64,
    /// Largest force on the downstream end during the pass.
    pub downstream_peak_n: f64,
    /// Force on the upstream end after the pass.
    pub upstream_force_n: f64,
    /// Largest force on the upstream end during the pass.
    pub upstream_peak_n: f64,
    /// Largest compression along the cable after the pass.
    pub max_compression_n: f64,
    /// Displacement of the cable at the upstream end \[m\].
    pub upstream_displacement_m: f64,
    /// Displacement of the cable at the downstream end \[m\].
    pub downstream_displacement_m: f64,
    /// Work that slip between cable and duct has turned into heat in this pass \[J\].
    pub dissipated_energy_j: Option<f64>,
    /// Minimum force on the downstream end during the pass: the largest tension where it is negative.
    pub downstream_least_n: f64,
    /// Minimum force on the upstream end during the pass.
    pub upstream_least_n: f64,
    /// Whether the pass was not simulated but lies within a jump between simulated ones.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interpolated: bool,
}

/// A pass that counts where largest forces and movements are looked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExtremePass {
    /// Its name.
    pub vehicle: String,
    /// The cable after it; the number of the pass is only about right.
    #[serde(flatten)]
    pub after: PassRecord,
    /// Force of the cable on each clamp after it \[N\].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub restraints_n: Vec<f64>,
    /// The largest in size during it and after it \[N\], with its sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub restraint_peaks_n: Vec<f64>,
}

/// What a clamp carries.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestraintRecord {
    /// Position along the duct \[m\].
    pub position_m: f64,
    /// Stiffness \[N/m\].
    pub stiffness_n_per_m: f64,
    /// Force of the cable on it after the last pass \[N\], positive toward growing x.
    pub force_n: f64,
    /// The same after each of [`Run::passes`] \[N\].
    pub after_passes_n: Vec<f64>,
    /// The largest in size during each of them and after it \[N\], with its sign.
    pub during_passes_n: Vec<f64>,
    /// How far it has slipped after each of them \[m\]; left out if it never slips.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slipped_after_passes_m: Vec<f64>,
    /// How far it has slipped \[m\], positive toward growing x; none if it never slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slipped_m: Option<f64>,
}

/// Where the force levels off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Saturation {
    /// The force that is largest in size of those that an end shows after any pass of a period,
    /// once nothing changes any more \[N\]; inside the cable where no end is held.
    pub force_n: f64,
    /// Passes to 95 % of it; of the mean where other vehicles stand in for them.
    pub passes_to_95_percent: u64,
    /// The same of the downstream end alone \[N\].
    pub downstream_force_n: f64,
    /// The same of the upstream end alone \[N\].
    pub upstream_force_n: f64,
}

/// Forces on the ends over a period of the traffic once nothing changes any more.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[allow(clippy::struct_field_names, reason = "units stand in the names")]
pub struct ForceRange {
    /// Minimum force on the downstream end \[N\].
    pub downstream_min_n: f64,
    /// Largest force on the downstream end \[N\].
    pub downstream_max_n: f64,
    /// Minimum force on the upstream end \[N\].
    pub upstream_min_n: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_max_n: f64,
}

impl Run {
    /// The ends on which vehicles that differ leave noticeably different forces once nothing else
    /// changes: the least and the largest \[N\]. In random order, where their scatter is known,
    /// what one pass in twenty leaves less and more than.
    pub fn by_turns(&self) -> Vec<(CableEnd, f64, f64)> {
        let extremes = |end: CableEnd| {
            let [least, most] = match (self.random, self.range) {
                (Some(random), _) => [random.of(end).q05_n, random.of(end).q95_n],
                (None, Some(range)) => [
                    end.of([range.upstream_min_n, range.downstream_min_n]),
                    end.of([range.upstream_max_n, range.downstream_max_n]),
                ],
                (None, None) => return None,
            };
            (most - least > NOTICEABLE * larger(most, least).abs()).then_some((end, least, most))
        };
        CableEnd::ALL.into_iter().filter_map(extremes).collect()
    }

    /// How much larger single passes may be than the mean of many that `record` shows, on one end
    /// \[N\]: zero but in random order.
    pub fn scatter(&self, end: CableEnd, record: &PassRecord) -> f64 {
        let random = self.random.filter(|_| record.interpolated);
        random.map_or(0.0, |random| {
            let Quantiles { q50_n, max_n, .. } = random.of(end);
            (max_n.abs() - q50_n.abs()).max(0.0)
        })
    }
}

impl Saturation {
    /// Whether it is noticeably larger than all of `passes` leave.
    pub fn is_beyond(&self, passes: &[PassRecord]) -> bool {
        let on_ends = |record: &PassRecord| larger(record.upstream_force_n, record.downstream_force_n);
        let forces = passes
            .iter()
            .map(|record| larger(on_ends(record), record.max_compression_n));
        self.force_n.abs() > (1.0 + NOTICEABLE) * forces.fold(0.0, larger).abs()
    }
}

/// How far forces scatter around their mean where vehicles come in random order.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RandomSpread {
    /// Of the downstream end.
    pub downstream: Quantiles,
    /// Of the upstream end.
    pub upstream: Quantiles,
}

impl RandomSpread {
    /// That of one end.
    pub fn of(&self, end: CableEnd) -> Quantiles {
        end.of([self.upstream, self.downstream])
    }
}

/// Forces after passes in random order.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[allow(clippy::struct_field_names, reason = "units stand in the names")]
pub struct Quantiles {
    /// One in twenty is below this \[N\].
    pub q05_n: f64,
    /// The median \[N\].
    pub q50_n: f64,
    /// One in twenty is above this \[N\].
    pub q95_n: f64,
    /// The largest in size of those that were simulated \[N\].
    pub max_n: f64,
}

/// Work of the cable solver, on all meshes together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cost {
    /// Passes simulated on the mesh of the answer.
    pub simulated_passes: u64,
    /// Vehicle positions, or steps of time.
    pub steps: u64,
    /// Linear solves.
    pub sweeps: u64,
    /// Nodes eliminated in these, or advanced in time.
    pub node_updates: u64,
}

impl PassRecord {
    pub fn new(record: &Record, traffic: &Traffic) -> Self {
        let outcome = &record.outcome;
        // No minus before zero.
        let plain = |value: f64| value + 0.0;
        Self {
            pass: record.pass,
            years: traffic.years_after(record.pass),
            downstream_force_n: plain(outcome.force.downstream),
            downstream_peak_n: plain(outcome.peak.downstream),
            upstream_force_n: plain(outcome.force.upstream),
            upstream_peak_n: plain(outcome.peak.upstream),
            max_compression_n: plain(outcome.max_compression),
            upstream_displacement_m: plain(outcome.upstream_displacement),
            downstream_displacement_m: plain(outcome.downstream_displacement),
            dissipated_energy_j: Some(outcome.dissipated),
            downstream_least_n: plain(outcome.lowest.downstream),
            upstream_least_n: plain(outcome.lowest.upstream),
            interpolated: record.interpolated,
        }
    }
}
