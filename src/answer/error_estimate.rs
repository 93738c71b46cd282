//! How wrong the forces and the movements of a run are.
//!
//! The passes are computed on meshes each twice as fine as the one before. Their differences give the error of the last:
//! a scheme of second order leaves a third of the last difference and a twelfth of the one before. Friction that turns
//! at a node or between two makes the sequence uneven, and two meshes may agree by chance. So more is counted: the largest of
//! a share of each difference seen so far, and never less than what is typical of the level.
//!
//! A force is compared with itself, or with a tenth of the largest one of the run where it is less than that, or with what
//! friction holds on a centimetre of cable; a movement of an end with the largest of the run, or with a tenth of the
//! duct's own.

use cable_dem::PassOutcome;
use cycle_jump::Record;

use super::ErrorShares;
use crate::Error;
use crate::error_source::ErrorSource;
use crate::shown::percent;

/// What counts of the differences between meshes as error: of the last one, the one before, and so on. Fitted to 200 random
/// scenes (`tests/planner/honest.rs`), so that the true error is larger in one or two of a hundred.
const WEIGHTS: [f64; 4] = [1.5, 0.35, 0.12, 0.04];
/// The same from 40 passes on, where chance agreement is unlikely.
const WEIGHTS_OF_MANY: [f64; 4] = [1.5, 0.2, 0.06, 0.02];
const MANY: usize = 40;
/// Weight of the only difference.
const WEIGHT_ALONE: f64 = 3.0;
/// What the error is beside the difference to a mesh twice as fine, at second order.
pub const VERIFIED: f64 = 4.0 / 3.0;
/// Forces below this share of the largest one count as nothing when errors are compared, and movements of an end below this
/// share of the duct's largest.
const SMALL: f64 = 0.1;
/// So does what friction holds on this length of cable \[m\].
const SHORT: f64 = 0.01;
/// A larger error than this, or the tolerance if that is larger still, is no answer.
const DOUBTFUL: f64 = 0.1;

/// A share of the forces and one of the movements.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shares {
    pub force: f64,
    pub movement: f64,
}

impl Shares {
    /// The same share of both.
    pub fn both(share: f64) -> Self {
        Self {
            force: share,
            movement: share,
        }
    }

    /// `f` of each share and that of another.
    pub fn map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            force: f(self.force, other.force),
            movement: f(self.movement, other.movement),
        }
    }

    pub fn max(self, other: Self) -> Self {
        self.map(other, f64::max)
    }

    /// What is left without `other`.
    pub fn less(self, other: Self) -> Self {
        self.map(other, |a, b| a - b)
    }

    /// Whether both are at most as large as `allowed`.
    pub fn is_within(self, allowed: Self) -> bool {
        self.force <= allowed.force && self.movement <= allowed.movement
    }

    pub fn times(self, factor: f64) -> Self {
        self.map(self, |share, _| factor * share)
    }
}

impl std::ops::Add for Shares {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.map(other, |a, b| a + b)
    }
}

/// What counts as nothing in a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// \[N\]
    pub force: f64,
    /// \[m\]
    pub movement: f64,
}

impl Scale {
    /// Of a cable with the friction `limit` \[N/m\] in a duct that moves by `peak` \[m\].
    pub fn new(limit: f64, peak: f64) -> Self {
        Self {
            force: SHORT * limit,
            movement: SMALL * peak,
        }
    }

    /// Whether nothing slips in any of these passes, or so little that the forces it leaves count as nothing: on a coarse mesh a spring at
    /// the end may move where elsewhere a finer one would show slip.
    pub fn is_still(&self, records: &[Record]) -> bool {
        records.iter().all(|record| {
            let outcome = &record.outcome;
            outcome.dissipated == 0.0 || outcome.max_compression.max(outcome.max_tension) < self.force
        })
    }
}

/// The error of a run by its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorParts {
    /// Node spacing and vehicle step.
    pub mesh: Shares,
    /// Accuracy of D_l as a share of its peak, counted in full as error of the force.
    pub ground: Shares,
    /// Inertia, where it is left out.
    pub inertia: f64,
    /// Road beyond where vehicles are followed.
    pub road: Shares,
    /// Passes that were not simulated.
    pub passes: Shares,
    /// Days of which few passes were simulated, or none.
    pub temperature: Shares,
    /// Whether a finer run was made to measure the mesh's part.
    pub measured: bool,
}

impl ErrorParts {
    /// The `accuracy` of the ground and what leaving `inertia` out may cost, as yet nothing else.
    pub fn new(accuracy: f64, inertia: f64) -> Self {
        Self {
            mesh: Shares::default(),
            ground: Shares::both(accuracy),
            inertia,
            road: Shares::default(),
            passes: Shares::default(),
            temperature: Shares::default(),
            measured: false,
        }
    }

    /// The part that comes from `source`.
    pub fn of(&self, source: ErrorSource) -> Shares {
        match source {
            ErrorSource::Mesh => self.mesh,
            ErrorSource::Ground => self.ground,
            ErrorSource::Inertia => Shares::both(self.inertia),
            ErrorSource::Road => self.road,
            ErrorSource::Passes => self.passes,
            ErrorSource::Days => self.temperature,
        }
    }

    pub fn total(&self) -> Shares {
        let parts = ErrorSource::ALL.map(|source| self.of(source));
        parts.into_iter().fold(Shares::default(), |sum, part| sum + part)
    }

    /// The same for a reader.
    pub fn shares(&self) -> ErrorShares {
        let total = self.total();
        ErrorShares {
            mesh: self.mesh.force,
            ground: self.ground.force,
            inertia: self.inertia,
            road: self.road.force,
            passes: self.passes.force,
            temperature: self.temperature.force,
            law: self.passes.force,
            movement: total.movement,
        }
    }

    /// What keeps the forces from being an answer: passes or days that could be simulated, if that would do, else the largest part.
    fn cause(&self, tolerance: f64) -> ErrorSource {
        let simulated = self.total().less(self.passes).less(self.temperature);
        let is_skipped = |source: &ErrorSource| matches!(source, ErrorSource::Passes | ErrorSource::Days);
        let skipping = !is_doubtful(simulated.force, tolerance);
        let sources = ErrorSource::ALL
            .into_iter()
            .filter(|source| is_skipped(source) == skipping);
        let largest = sources.max_by(|a, b| self.of(*a).force.total_cmp(&self.of(*b).force));
        largest.unwrap_or(ErrorSource::Mesh)
    }
}

impl std::fmt::Display for ErrorParts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.measured {
            "measured by a run on a mesh twice as fine: "
        } else {
            "from runs on coarser meshes: "
        })?;
        let is_shown = |source: &ErrorSource| {
            !matches!(source, ErrorSource::Passes | ErrorSource::Days)
                || self.of(*source) != Shares::default()
        };
        let shown = ErrorSource::ALL.into_iter().filter(is_shown);
        let parts = shown.map(|source| format!("{} {}", source.name(), percent(self.of(source).force)));
        let parts = parts.collect::<Vec<_>>().join(", ");
        write!(
            f,
            "{parts}; movement of the ends {}",
            percent(self.total().movement)
        )
    }
}

/// Error of the last of `levels`, the same passes on two or more meshes from coarse to fine; at least `typical`.
pub fn of_mesh(levels: &[&[Record]], typical: f64, scale: Scale) -> Shares {
    let differences: Vec<Shares> = levels
        .windows(2)
        .rev()
        .map(|pair| difference(pair[1], pair[0], scale))
        .collect();
    let passes = levels.last().map_or(0, |finest| finest.len());
    of_differences(&differences, passes, typical)
}

/// The same from the differences between neighbouring levels, the finest first, of so many `passes`.
pub fn of_differences(differences: &[Shares], passes: usize, typical: f64) -> Shares {
    let least = Shares::both(typical);
    if let [only] = differences {
        return only.times(WEIGHT_ALONE).max(least);
    }
    let shares = if passes < MANY { WEIGHTS } else { WEIGHTS_OF_MANY };
    shares
        .iter()
        .zip(differences)
        .map(|(&share, difference)| difference.times(share))
        .fold(least, Shares::max)
}

/// Error of `passes`, measured against a run twice as fine.
pub fn measured(passes: &[Record], finer: &[Record], scale: Scale) -> Shares {
    difference(passes, finer, scale).times(VERIFIED)
}

/// Whether an error of the force is too large for an answer.
pub fn is_doubtful(reached: f64, tolerance: f64) -> bool {
    reached.is_nan() || reached > tolerance.max(DOUBTFUL)
}

/// Refuses an answer whose error of the force is too large to be one.
pub fn judge(error: &ErrorParts, tolerance: f64) -> Result<(), Error> {
    let reached = error.total().force;
    if is_doubtful(reached, tolerance) {
        return Err(Error::Inaccurate {
            reached,
            asked: tolerance,
            cause: error.cause(tolerance),
        });
    }
    Ok(())
}

/// Largest difference of a force after a pass, as a share of the largest force or tension after that pass, or of a tenth of
/// the largest in the run; and largest difference of a movement.
pub fn difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    differences(a, b, scale)
        .into_iter()
        .fold(Shares::default(), Shares::max)
}

/// Difference of the largest and least forces and movements in two sets of passes, as shares of the largest.
pub fn extremes_difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    let apart = |values: fn(&PassOutcome) -> Vec<f64>, least: f64| {
        let (a, b) = (extremes(a, values), extremes(b, values));
        let whole = a.iter().fold(least, |most, value| most.max(value.abs()));
        let pairs = a.iter().zip(&b);
        share(
            pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())),
            whole,
        )
    };
    Shares {
        force: apart(largest_forces, scale.force),
        movement: apart(largest_movements, scale.movement),
    }
}

/// The largest of each of these values.
fn extremes(records: &[Record], values: fn(&PassOutcome) -> Vec<f64>) -> Vec<f64> {
    let mut extremes = Vec::new();
    for record in records {
        let values = values(&record.outcome);
        extremes.resize(values.len(), 0.0);
        for (most, value) in extremes.iter_mut().zip(values) {
            *most = f64::max(*most, value);
        }
    }
    extremes
}

/// Forces of which the largest counts.
fn largest_forces(outcome: &PassOutcome) -> Vec<f64> {
    let PassOutcome { peak, lowest, .. } = outcome;
    let ends = [
        peak.upstream,
        peak.downstream,
        -lowest.upstream,
        -lowest.downstream,
    ];
    let inside = [outcome.max_compression, outcome.max_tension];
    let clamps = outcome.restraints.iter().flat_map(|force| [*force, -force]);
    ends.into_iter().chain(inside).chain(clamps).collect()
}

/// Movements of which the largest counts.
fn largest_movements(outcome: &PassOutcome) -> Vec<f64> {
    let ends = [outcome.upstream_displacement, outcome.downstream_displacement];
    ends.into_iter().flat_map(|moved| [moved, -moved]).collect()
}

/// The same of every pass that both have.
pub fn differences(a: &[Record], b: &[Record], scale: Scale) -> Vec<Shares> {
    let of_both = a.iter().filter_map(|record| {
        let same = b.binary_search_by_key(&record.pass, |other| other.pass).ok()?;
        Some((&record.outcome, &b[same].outcome))
    });
    let a: Vec<&PassOutcome> = a.iter().map(|record| &record.outcome).collect();
    let forces = |outcome: &PassOutcome| {
        [
            outcome.force.upstream,
            outcome.force.downstream,
            outcome.max_compression,
        ]
    };
    let movements = |outcome: &PassOutcome| [outcome.upstream_displacement, outcome.downstream_displacement];
    let largest = |outcome: &PassOutcome| {
        [
            outcome.peak.upstream,
            outcome.peak.downstream,
            outcome.lowest.upstream,
            outcome.lowest.downstream,
            outcome.max_tension,
        ]
        .into_iter()
        .chain(forces(outcome))
        .map(f64::abs)
        .fold(0.0, f64::max)
    };
    let floor = (SMALL * a.iter().copied().map(largest).fold(0.0, f64::max)).max(scale.force);
    let moved = a
        .iter()
        .copied()
        .flat_map(movements)
        .fold(scale.movement, |largest, u| largest.max(u.abs()));
    // Clamps move in proportion to their force.
    let clamped = a
        .iter()
        .flat_map(|outcome| &outcome.restraints)
        .fold(scale.force, |largest, force| largest.max(force.abs()));
    let of_pass = |(a, b): (&PassOutcome, &PassOutcome)| {
        // A clamp may hold a cable whose ends are free: what is compressed is then small beside what is stretched.
        let scale = forces(a)
            .into_iter()
            .chain([a.max_tension])
            .map(f64::abs)
            .fold(floor, f64::max);
        let largest = |a: &[f64], b: &[f64], scale| {
            let pairs = a.iter().zip(b);
            pairs.fold(0.0, |most: f64, (a, b)| most.max(share((a - b).abs(), scale)))
        };
        // A clamp may carry what presses from both sides: the errors of the ends are not small beside that.
        let on_clamps = a
            .restraints
            .iter()
            .fold(scale, |largest, force| largest.max(force.abs()));
        Shares {
            force: f64::max(
                largest(&forces(a), &forces(b), scale),
                largest(&a.restraints, &b.restraints, on_clamps),
            ),
            movement: f64::max(
                largest(&movements(a), &movements(b), moved),
                largest(&a.restraints, &b.restraints, clamped),
            ),
        }
    };
    of_both.map(of_pass).collect()
}

/// part/whole; nothing of nothing is nothing.
fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}
