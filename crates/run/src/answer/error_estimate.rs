//! How wrong the forces and the movements of a run are.
//!
//! The passes are computed on meshes each twice as fine as the one before, and their differences
//! give the error of the last.

use serde::{Deserialize, Serialize};

use super::differences::Shares;
use creepage_plan::{Error, ErrorSource, shown::percent};

/// How wrong the forces may be: how well the equations are solved, not how well they describe a
/// duct.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Largest error of a force, after a pass and during it, on an end, inside the cable or on a
    /// clamp: as a share of the largest at its place, or of a tenth of the largest force of the run
    /// if that is more.
    pub relative: f64,
    /// How that was found.
    pub method: String,
    /// Its parts: `relative` is the sum of these without `law` and `movement`.
    pub parts: ErrorShares,
}

/// Error by its causes, each as a share of the force but the movement's own.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ErrorShares {
    /// Node spacing and vehicle step.
    pub mesh: f64,
    /// What the ground model leaves out.
    pub ground: f64,
    /// Inertia of the cable, where it is left out: a bound.
    pub inertia: f64,
    /// Road beyond where vehicles are followed.
    pub road: f64,
    /// Passes that were not simulated.
    pub passes: f64,
    /// Heat and traffic of days of which few passes were simulated, or none.
    pub temperature: f64,
    /// The same as `passes`.
    pub law: f64,
    /// Largest error of an end's movement from all causes, as a share of the largest movement.
    pub movement: f64,
}

impl ErrorShares {
    /// The part that comes from `source`: those of all sources sum to the whole error of the
    /// forces.
    pub fn of(&self, source: ErrorSource) -> f64 {
        let first = [self.mesh, self.ground, self.inertia];
        let others = [self.road, self.passes, self.temperature];
        [first, others].as_flattened()[source as usize]
    }
}

/// A larger error than this, or the tolerance if that is larger still, is no answer.
const DOUBTFUL: f64 = 0.1;

/// The error of a run by its parts: shares of the forces and of the movements.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ErrorParts {
    pub mesh: Shares,
    pub ground: Shares,
    pub inertia: Shares,
    pub road: Shares,
    pub passes: Shares,
    pub days: Shares,
    /// Whether a finer run was made to measure the mesh's part.
    pub measured: bool,
}

impl ErrorParts {
    /// The `accuracy` of D_l as a share of its peak, counted in full as error of the force, and
    /// what leaving `inertia` out may cost; as yet nothing else.
    pub fn new(accuracy: f64, inertia: f64) -> Self {
        Self {
            ground: Shares::both(accuracy),
            inertia: Shares::both(inertia),
            ..Self::default()
        }
    }

    /// What comes from each of [`ErrorSource::ALL`].
    fn parts(&self) -> impl Iterator<Item = (ErrorSource, Shares)> {
        let (first, others) = (
            [self.mesh, self.ground, self.inertia],
            [self.road, self.passes, self.days],
        );
        ErrorSource::ALL.into_iter().zip(first.into_iter().chain(others))
    }

    pub fn total(&self) -> Shares {
        let sum = |sum, (_, part)| sum + part;
        self.parts().fold(Shares::default(), sum)
    }

    /// The same for a reader.
    pub fn estimate(&self) -> ErrorEstimate {
        let total = self.total();
        ErrorEstimate {
            relative: total.force,
            method: self.to_string(),
            parts: ErrorShares {
                mesh: self.mesh.force,
                ground: self.ground.force,
                inertia: self.inertia.force,
                road: self.road.force,
                passes: self.passes.force,
                temperature: self.days.force,
                law: self.passes.force,
                movement: total.movement,
            },
        }
    }

    /// The largest part of those that are `eligible`, by the share that `of` gives.
    pub fn largest(&self, eligible: impl Fn(ErrorSource) -> bool, of: fn(Shares) -> f64) -> ErrorSource {
        let parts = self.parts().filter(|(source, _)| eligible(*source));
        let largest = parts.max_by(|(_, a), (_, b)| of(*a).total_cmp(&of(*b)));
        largest.map_or(ErrorSource::Mesh, |(source, _)| source)
    }

    /// The refusal of an answer with so large an error of the forces. Its cause are passes or days
    /// that could be simulated, if that would do, else the largest part.
    pub fn refusal(&self, tolerance: f64) -> Error {
        let skipped = self.passes + self.days;
        let skipping = !is_doubtful(self.total().less(skipped).force, tolerance);
        Error::Inaccurate {
            reached: self.total().force,
            asked: tolerance,
            cause: self.largest(|source| source.is_skipping() == skipping, |share| share.force),
        }
    }
}

impl std::fmt::Display for ErrorParts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let found = if self.measured {
            "measured by a run on a mesh twice as fine"
        } else {
            "from runs on coarser meshes"
        };
        let shown = (self.parts())
            .filter(|(source, part)| !source.is_skipping() || *part != Shares::default())
            .map(|(source, part)| format!("{} {}", source.name(), percent(part.force)));
        let (parts, moved) = (
            shown.collect::<Vec<_>>().join(", "),
            percent(self.total().movement),
        );
        write!(f, "{found}: {parts}; movement of the ends {moved}")
    }
}

/// Whether an error of the force is too large for an answer.
pub fn is_doubtful(reached: f64, tolerance: f64) -> bool {
    reached.is_nan() || reached > tolerance.max(DOUBTFUL)
}

/// Refuses an answer whose error of the force is too large to be one.
pub fn judge(error: &ErrorParts, tolerance: f64) -> Result<(), Error> {
    if is_doubtful(error.total().force, tolerance) {
        return Err(error.refusal(tolerance));
    }
    Ok(())
}
