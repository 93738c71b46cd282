//! The ground model: meshes, answers and their error.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ground_field::{Displacement, GroundError, GroundField, SoilProfile, SurfaceLoad, check_place, checked};

use crate::FemError;
use crate::estimate::ErrorEstimate;
use crate::grading::Lines;
use crate::level::Level;
use crate::line::DepthLine;
use crate::system::MIN_CHANGE;

/// Name in errors.
const MODEL: &str = "layered finite elements";
/// Spacing of the first coarse mesh at the accuracy below (as a share of the distance to the load), and its bounds.
const ALPHA: f64 = 0.4;
const ALPHA_ACCURACY: f64 = 5e-3;
const ALPHA_RANGE: (f64, f64) = (0.1, 0.5);
/// Spacing ratio ρ from one mesh to the next. Every element is halved, so that the difference of two meshes cannot be small
/// by the chance of where their lines fall.
const RATIO: usize = 2;
/// The error falls at least by this factor from one mesh to the next.
const MIN_GAIN: f64 = 3.0;
/// The same next to the edge of a disc, where the slope of `u_r` is infinite, and the depth in contact radii down to which it
/// is taken.
const MIN_GAIN_AT_EDGE: f64 = 1.5;
const DEPTH_OF_EDGE: f64 = 0.2;
/// Order beyond which it is not hoped to fall: where even that would need too large a mesh, none is tried.
const BEST_ORDER: f64 = 4.0;
/// Minimum share of the peak of `u_z` that the peak of `u_r` is taken for, where `u_r` vanishes (incompressible soil's surface).
const MIN_RADIAL: f64 = 0.01;
/// Depth lines kept.
const MAX_ANSWERS: usize = 512;

/// Axisymmetric finite elements of a layered ground.
///
/// Static linear elasticity, ∇·σ = 0 with σ = λ(z) (tr ε) I + 2 G(z) ε, under a vertical load on the surface: the weak form is solved
/// for (`u_r`, `u_z`) per radian in the half-plane r ≥ 0 (T. J. R. Hughes, *The Finite Element Method* (1987)).
///
/// - Nine-node quadrilaterals whose dilatation is projected, so that nothing locks as ν → 1/2.
/// - Lines graded as the distance to the load, so that few elements reach hundreds of metres away; the outer boundary moves
///   as the base half-space's closed form, and beyond it that closed form answers.
/// - The point load's singularity is subtracted in a block of elements around it, and only there.
/// - Along r the nodal values are joined with continuous second derivative, because friction on a buried cable follows the
///   second difference of `u_r`.
///
/// # Error estimate
///
/// Every answer is computed on two meshes whose spacing ratio is ρ = 2, the outer boundary of the finer one being
/// ρ times as far away. The error of discretisation falls with ρ³ and more, the boundary's with ρ²; that it falls at least
/// three times is assumed, and then half the difference bounds the finer answer's error. (Just below the edge of a disc it
/// falls more slowly, and twice the difference is taken.) On the coarse meshes of a loose accuracy the estimate may fall short
/// of the truth by half. Where the estimate exceeds the accuracy asked, a finer mesh is made, up to the unknowns allowed; beyond, the
/// answer is [`GroundError::Accuracy`].
///
/// # Cost
///
/// Mesh and factorisation are made at construction; each contact radius then costs one solution, each further depth an
/// interpolation, each further point a few operations. The field is smooth along r (continuous second derivative).
#[derive(Debug)]
pub struct LayeredFem {
    mesher: Mesher,
    /// Two meshes, the coarser first.
    meshes: Mutex<[Level; 2]>,
    /// Accepted answers by the bits of contact radius and depth.
    answers: Mutex<HashMap<(u64, u64), Arc<Answer>>>,
}

#[derive(Debug)]
struct Answer {
    line: DepthLine,
    estimate: ErrorEstimate,
}

/// The ground and how it is meshed.
#[derive(Debug)]
struct Mesher {
    profile: SoilProfile,
    accuracy: f64,
    max_unknowns: usize,
    /// Spacing of the first mesh.
    alpha: f64,
}

impl Mesher {
    /// The lines of the first mesh with every interval cut into `parts`.
    fn lines(&self, parts: usize) -> Result<Lines, FemError> {
        Lines::new(&self.profile, self.alpha, parts, self.max_unknowns)
    }

    /// Their mesh, factored. A last correction may change a solution by rounding alone, a thousandth of the accuracy: where λ is
    /// large relative to a stiff layer rounding is felt long before it matters.
    fn level(&self, parts: usize) -> Result<Level, GroundError> {
        let rounding = (1e-3 * self.accuracy).max(MIN_CHANGE);
        let lines = self.lines(parts);
        let level = lines.and_then(|lines| Level::new(&self.profile, rounding, lines));
        level.map_err(in_model)
    }
}

impl LayeredFem {
    /// Unknowns allowed unless [`LayeredFem::with_max_unknowns`] says otherwise: within a gigabyte and a few seconds.
    pub const DEFAULT_MAX_UNKNOWNS: usize = 500_000;
    /// Maximum number of unknowns that can be allowed: some hundred gigabytes.
    pub const MAX_UNKNOWNS: usize = 50_000_000;

    /// A model of `profile` with an error of at most `accuracy`, as a share of the largest |`u_r`| and of the largest |`u_z`| at each
    /// depth. (The largest |`u_r`| counts as at least a hundredth of the largest |`u_z`|.)
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the accuracy lies between 1e-6 and 0.1; [`GroundError::Model`] with a [`FemError`]
    /// where the mesh cannot be made or factored.
    pub fn new(profile: &SoilProfile, accuracy: f64) -> Result<Self, GroundError> {
        Self::with_max_unknowns(profile, accuracy, Self::DEFAULT_MAX_UNKNOWNS)
    }

    /// The same with another limit on the unknowns of one mesh, [`MAX_UNKNOWNS`](Self::MAX_UNKNOWNS) at most.
    /// Where the accuracy would need more, the answer is [`GroundError::Accuracy`].
    ///
    /// # Errors
    ///
    /// As for [`LayeredFem::new`].
    pub fn with_max_unknowns(
        profile: &SoilProfile,
        accuracy: f64,
        max_unknowns: usize,
    ) -> Result<Self, GroundError> {
        let is_possible = |accuracy| (1e-6..=0.1).contains(&accuracy);
        checked("accuracy", accuracy, "between 1e-6 and 0.1", is_possible)?;
        let (least, most) = ALPHA_RANGE;
        let mut mesher = Mesher {
            profile: profile.clone(),
            accuracy,
            max_unknowns: max_unknowns.min(Self::MAX_UNKNOWNS),
            alpha: (ALPHA * (accuracy / ALPHA_ACCURACY).cbrt()).clamp(least, most),
        };
        // Where the mesh that is likely to be needed is too large, a larger spacing may still prove accurate enough.
        while mesher.alpha < most && mesher.lines(RATIO).is_err() {
            mesher.alpha *= 1.2;
        }
        Ok(Self {
            meshes: Mutex::new([mesher.level(1)?, mesher.level(RATIO)?]),
            mesher,
            answers: Mutex::default(),
        })
    }

    /// Estimated error of the displacements under `load` at `depth`; at most the accuracy asked.
    ///
    /// # Errors
    ///
    /// As for [`GroundField::displacement`].
    pub fn error_estimate(&self, load: SurfaceLoad, depth: f64) -> Result<ErrorEstimate, GroundError> {
        check_place(0.0, depth)?;
        Ok(self.answer(load.contact_radius(), depth)?.estimate)
    }

    /// Unknowns of the finest mesh so far.
    pub fn unknowns(&self) -> usize {
        locked(&self.meshes)[1].system.unknowns.len()
    }

    /// The line at `depth` under a unit load, accepted by the estimate.
    fn answer(&self, contact_radius: f64, depth: f64) -> Result<Arc<Answer>, GroundError> {
        let key = (contact_radius.to_bits(), depth.to_bits());
        if let Some(found) = locked(&self.answers).get(&key) {
            return Ok(Arc::clone(found));
        }
        let at_edge = depth < DEPTH_OF_EDGE * contact_radius;
        let gain = if at_edge { MIN_GAIN_AT_EDGE } else { MIN_GAIN };
        let mut meshes = locked(&self.meshes);
        loop {
            let [coarse, fine] = &mut *meshes;
            let coarse = coarse.line(contact_radius, depth).map_err(in_model)?;
            let line = fine.line(contact_radius, depth).map_err(in_model)?;
            let estimate = compare(&coarse, &line, &fine.columns, gain);
            if estimate.largest() <= self.mesher.accuracy {
                let answer = Arc::new(Answer { line, estimate });
                let mut answers = locked(&self.answers);
                if answers.len() >= MAX_ANSWERS {
                    answers.clear();
                }
                answers.insert(key, Arc::clone(&answer));
                return Ok(answer);
            }
            self.refine(&mut meshes, estimate, depth)?;
        }
    }

    /// Puts a finer mesh in place of the coarse one, or says that the accuracy is out of reach.
    fn refine(&self, meshes: &mut [Level; 2], reached: ErrorEstimate, depth: f64) -> Result<(), GroundError> {
        let mesher = &self.mesher;
        let excess = reached.largest() / mesher.accuracy;
        let parts = meshes[1].lines.parts;
        // What the accuracy needs at least, should the error fall as fast as it can.
        let wanted = parts as f64 * excess.powf(1.0 / BEST_ORDER);
        let is_too_large = |parts| mesher.lines(parts).is_err();
        if excess.is_nan() || is_too_large(RATIO * parts) || is_too_large(wanted as usize) {
            return Err(GroundError::Accuracy {
                model: MODEL,
                asked: mesher.accuracy,
                reached: reached.largest(),
                radius: reached.radius,
                depth,
            });
        }
        meshes[0] = mesher.level(RATIO * parts)?;
        meshes.swap(0, 1);
        Ok(())
    }
}

impl GroundField for LayeredFem {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        Ok(self.displacements(load, &[radius], depth)?[0])
    }

    fn displacements(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<Vec<Displacement>, GroundError> {
        for &radius in radii.iter().chain(&[0.0]) {
            check_place(radius, depth)?;
        }
        let answer = self.answer(load.contact_radius(), depth)?;
        let value = |&radius: &f64| {
            let value = answer.line.at(radius) * load.force();
            let singular = GroundError::Singular {
                model: MODEL,
                radius,
                depth,
            };
            value.is_finite().then_some(value).ok_or(singular)
        };
        radii.iter().map(value).collect()
    }
}

/// Estimated error of `fine` from its difference to `coarse`, whose error is at least `gain` times as large.
fn compare(coarse: &DepthLine, fine: &DepthLine, radii: &[f64], gain: f64) -> ErrorEstimate {
    // The singular point of a point load has no value to compare.
    let places = radii.iter().map(|&r| (r, fine.at(r), coarse.at(r)));
    let places: Vec<_> = places.filter(|(r, u, _)| u.is_finite() || *r > 0.0).collect();
    // The largest value, the largest difference, and where the latter is.
    let largest = |of: fn(Displacement) -> f64| {
        let (mut peak, mut gap, mut at) = (0.0_f64, 0.0, 0.0);
        for &(r, u, other) in &places {
            let here = of(u - other).abs();
            peak = peak.max(of(u).abs());
            if here > gap || here.is_nan() {
                (gap, at) = (here, r);
            }
        }
        (peak, gap, at)
    };
    let share = |difference: f64, peak: f64| match difference {
        0.0 => 0.0,
        _ => difference / peak / (gain - 1.0),
    };
    let ((peak_r, gap_r, at_r), (peak_z, gap_z, at_z)) = (largest(|u| u.radial), largest(|u| u.vertical));
    let radial = share(gap_r, peak_r.max(MIN_RADIAL * peak_z));
    let vertical = share(gap_z, peak_z);
    ErrorEstimate {
        radial,
        vertical,
        radius: if radial >= vertical { at_r } else { at_z },
    }
}

fn locked<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

fn in_model(error: FemError) -> GroundError {
    GroundError::Model {
        model: MODEL,
        source: Box::new(error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One factorisation on each of two meshes, and one solution for each of three contact radii, serve every load and depth.
    ///
    /// Work at the default accuracy on the paper's road: the mesh has (2n+1)(2m+1) nodes for n and m intervals that grow with the
    /// distance to the load, about 60 each; the Cholesky factor of such a plane mesh fills in by less than a factor of
    /// ten over the stiffness, whose lower triangle has 16 entries an unknown. A finer mesh than that means that the estimate has become worse.
    #[test]
    fn the_work_stays_within_bounds() {
        let ground = LayeredFem::new(&testkit::layered::system("task3").0, 5e-3).unwrap();
        for (force, depth) in [(1e3, 0.6), (1e5, 0.6), (1e5, 1.2), (1e5, 1.7)] {
            for contact_radius in [0.0, 0.1, 0.15] {
                let load = SurfaceLoad::new(force, contact_radius).unwrap();
                ground.displacements(load, &[0.0, 0.5, 2.0, 10.0], depth).unwrap();
            }
        }
        let meshes = locked(&ground.meshes);
        let solutions: usize = meshes.iter().map(|mesh| mesh.solutions.len()).sum();
        assert_eq!((meshes[1].lines.parts, solutions), (RATIO, 6));
        let unknowns = meshes[1].system.unknowns.len();
        assert!(unknowns <= 25_000, "{unknowns}");
        let entries = meshes[1].system.factor.entries();
        assert!(
            (unknowns..=160 * unknowns).contains(&entries),
            "{unknowns}, {entries}"
        );
    }
}
