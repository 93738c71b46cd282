//! How wrong the forces and the movements of a run are.
//!
//! The passes are computed on meshes each twice as fine as the one before. Their differences give
//! the error of the last: a scheme of second order leaves a third of the last difference and a
//! twelfth of the one before. Friction that turns at a node or between two makes the sequence
//! uneven, and two meshes may agree by chance. So more is counted: the largest of a share of each
//! difference seen so far, and never less than what is typical of the level.

use super::ErrorShares;
use super::differences::Shares;
use crate::Error;
use crate::error_source::ErrorSource;
use crate::shown::percent;
use crate::tuning::meshes::{DOUBTFUL, MANY, WEIGHT_ALONE, WEIGHTS, WEIGHTS_OF_MANY};

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

    /// What keeps the forces from being an answer: passes or days that could be simulated, if that
    /// would do, else the largest part.
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

/// Error of the passes on a mesh from the `differences` between it and the coarser ones, its own
/// first; at least `typical`.
pub fn mesh_error(differences: &[Shares], passes: usize, typical: f64) -> Shares {
    let weights = match differences.len() {
        1 => &[WEIGHT_ALONE][..],
        _ if passes < MANY => &WEIGHTS,
        _ => &WEIGHTS_OF_MANY,
    };
    let weighted = weights.iter().zip(differences);
    let error: Shares = weighted
        .map(|(&weight, difference)| difference.times(weight))
        .collect();
    error.max(Shares::both(typical))
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
