//! How wrong the forces of a run are.
//!
//! The passes are computed on meshes each twice as fine as the one before. Their differences tell the error of the last:
//! a scheme of second order leaves a third of the last difference and a twelfth of the one before. Friction that turns
//! at a node or between two makes the sequence uneven, two meshes may agree by chance, and so more than that is counted:
//! the larger of a share of both, and never less than what is typical of so many nodes a depth.
//!
//! A force is compared with itself, or with a tenth of the largest one of the run where it is less than that.

use cable_dem::PassOutcome;

use super::passes::Passes;

/// Shares of the last difference between two meshes and of the one before that count as error.
const LAST: f64 = 0.8;
const BEFORE: f64 = 0.27;
/// With two meshes only.
const ALONE: f64 = 1.3;
/// Error that is counted at least on meshes of 3, 6, 12, … nodes a depth: a little less than what is typical.
const LEAST: [f64; 7] = [2e-2, 1e-2, 3e-3, 8e-4, 2e-4, 5e-5, 1.2e-5];
/// What the error is beside the difference to a mesh twice as fine, at second order.
const VERIFIED: f64 = 4.0 / 3.0;
/// Forces below this share of the largest one count as nothing when errors are compared.
const SMALL_FORCE: f64 = 0.1;

/// The error of a run by its parts, each a share of the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorParts {
    /// Node spacing and vehicle step; `None` where there is no mesh to compare with.
    pub mesh: Option<f64>,
    /// What the ground model leaves out, as it comes through in the force.
    pub ground: f64,
    /// Inertia, where it is left out.
    pub inertia: f64,
    /// Whether a finer run was made to measure mesh and ground.
    pub measured: bool,
}

impl ErrorParts {
    pub fn total(&self) -> f64 {
        self.mesh.map_or(1.0, |mesh| mesh + self.ground + self.inertia)
    }
}

impl std::fmt::Display for ErrorParts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Some(mesh) = self.mesh else {
            return write!(f, "none: the duct is too short for a mesh twice as coarse");
        };
        let percent = |share: f64| {
            if share < 5e-5 {
                "< 0.01 %".to_owned()
            } else {
                format!("{:.2} %", 100.0 * share)
            }
        };
        write!(
            f,
            "{}: mesh {}, ground {}, inertia {}",
            if self.measured {
                "measured by a run one rung finer"
            } else {
                "from runs on coarser meshes"
            },
            percent(mesh),
            percent(self.ground),
            percent(self.inertia)
        )
    }
}

/// Error of the finest of `levels`, which are ascending; `None` where there is only one.
pub fn of_mesh(levels: &[&Passes], finest: usize) -> Option<f64> {
    let least = LEAST[finest.min(LEAST.len() - 1)];
    match levels {
        [.., first, second, third] => Some(
            (LAST * difference(third, second))
                .max(BEFORE * difference(second, first))
                .max(least),
        ),
        [first, second] => Some((ALONE * difference(second, first)).max(least)),
        _ => None,
    }
}

/// Error of `passes`, measured against a run twice as fine.
pub fn measured(passes: &Passes, finer: &Passes) -> f64 {
    VERIFIED * difference(passes, finer)
}

/// Largest difference of a force after a pass, as a share of the largest force or tension after that pass, or of a tenth of
/// the largest in the run.
pub fn difference(a: &Passes, b: &Passes) -> f64 {
    let forces = |outcome: &PassOutcome| {
        [
            outcome.force.upstream,
            outcome.force.downstream,
            outcome.max_compression,
        ]
    };
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
    let floor = SMALL_FORCE * a.outcomes.iter().map(largest).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for (a, b) in a.outcomes.iter().zip(&b.outcomes) {
        // A clamp may hold a cable whose ends are free: what is compressed is then small beside what is stretched.
        let scale = forces(a)
            .into_iter()
            .chain([a.max_tension])
            .map(f64::abs)
            .fold(floor, f64::max);
        for (a, b) in forces(a).into_iter().zip(forces(b)) {
            if a != b {
                worst = worst.max((a - b).abs() / scale);
            }
        }
    }
    worst
}
