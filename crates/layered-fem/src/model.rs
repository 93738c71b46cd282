//! The ground model: meshes, answers and their error.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ground_field::{Displacement, GroundError, GroundField, SoilProfile, SurfaceLoad, check_place, checked};

use crate::FemError;
use crate::estimate::{ErrorEstimate, FemStatistics};
use crate::grading::Lines;
use crate::level::Level;
use crate::line::DepthLine;
use crate::system::LEAST_CHANGE;

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
const LEAST_GAIN: f64 = 3.0;
/// The same next to the edge of a disc, where the slope of `u_r` is infinite, and the depth in contact radii down to which it
/// is taken.
const LEAST_GAIN_AT_EDGE: f64 = 1.5;
const DEPTH_OF_EDGE: f64 = 0.2;
/// Order beyond which it is not hoped to fall: where even that would need too large a mesh, none is tried.
const BEST_ORDER: f64 = 4.0;
/// Least share of the peak of `u_z` that the peak of `u_r` is taken for, where `u_r` vanishes (incompressible soil's surface).
const LEAST_RADIAL: f64 = 0.01;
/// Depth lines kept.
const MOST_ANSWERS: usize = 512;

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
    profile: SoilProfile,
    accuracy: f64,
    max_unknowns: usize,
    /// Spacing of the first mesh.
    alpha: f64,
    meshes: Mutex<Meshes>,
    /// Accepted answers by the bits of contact radius and depth.
    answers: Mutex<HashMap<(u64, u64), Arc<Answer>>>,
}

#[derive(Debug)]
struct Meshes {
    coarse: Level,
    fine: Level,
    factorisations: usize,
}

#[derive(Debug)]
struct Answer {
    line: DepthLine,
    estimate: ErrorEstimate,
}

impl LayeredFem {
    /// Unknowns allowed unless [`LayeredFem::with_max_unknowns`] says otherwise: within a gigabyte and a few seconds.
    pub const DEFAULT_MAX_UNKNOWNS: usize = 500_000;
    /// Most unknowns that can be allowed: some hundred gigabytes.
    pub const MOST_UNKNOWNS: usize = 50_000_000;

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

    /// The same with another limit on the unknowns of one mesh, [`MOST_UNKNOWNS`](Self::MOST_UNKNOWNS) at most.
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
        checked("accuracy", accuracy, "between 1e-6 and 0.1", |v| {
            (1e-6..=0.1).contains(&v)
        })?;
        let max_unknowns = max_unknowns.min(Self::MOST_UNKNOWNS);
        let (least, most) = ALPHA_RANGE;
        let mut alpha = (ALPHA * (accuracy / ALPHA_ACCURACY).cbrt()).clamp(least, most);
        // Where the mesh that is likely to be needed is too large, a larger spacing may still prove accurate enough.
        while alpha < most && Lines::new(profile, alpha, RATIO, max_unknowns).is_err() {
            alpha *= 1.2;
        }
        let lines = |parts| Lines::new(profile, alpha, parts, max_unknowns);
        let meshes = Meshes {
            coarse: level(profile, accuracy, lines(1))?,
            fine: level(profile, accuracy, lines(RATIO))?,
            factorisations: 2,
        };
        Ok(Self {
            profile: profile.clone(),
            accuracy,
            max_unknowns,
            alpha,
            meshes: Mutex::new(meshes),
            answers: Mutex::default(),
        })
    }

    /// The ground.
    pub fn profile(&self) -> &SoilProfile {
        &self.profile
    }

    /// Asked error, as a share of the peak at a depth.
    pub fn accuracy(&self) -> f64 {
        self.accuracy
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

    /// Work done so far.
    pub fn statistics(&self) -> FemStatistics {
        let meshes = locked(&self.meshes);
        let (coarse, fine) = (&meshes.coarse, &meshes.fine);
        FemStatistics {
            unknowns: fine.system.unknowns,
            factor_entries: fine.system.factor.entries(),
            factorisations: meshes.factorisations,
            solves: coarse.solutions.len() + fine.solutions.len(),
        }
    }

    /// The line at `depth` under a unit load, accepted by the estimate.
    fn answer(&self, contact_radius: f64, depth: f64) -> Result<Arc<Answer>, GroundError> {
        let key = (contact_radius.to_bits(), depth.to_bits());
        if let Some(found) = locked(&self.answers).get(&key) {
            return Ok(Arc::clone(found));
        }
        let at_edge = depth < DEPTH_OF_EDGE * contact_radius;
        let gain = if at_edge { LEAST_GAIN_AT_EDGE } else { LEAST_GAIN };
        let mut meshes = locked(&self.meshes);
        loop {
            let coarse = meshes.coarse.line(contact_radius, depth).map_err(in_model)?;
            let fine = meshes.fine.line(contact_radius, depth).map_err(in_model)?;
            let estimate = compare(&coarse, &fine, &meshes.fine.columns, gain);
            if estimate.largest() <= self.accuracy {
                let answer = Arc::new(Answer { line: fine, estimate });
                let mut answers = locked(&self.answers);
                if answers.len() >= MOST_ANSWERS {
                    answers.clear();
                }
                answers.insert(key, Arc::clone(&answer));
                return Ok(answer);
            }
            self.refine(&mut meshes, estimate, depth)?;
        }
    }

    /// Puts a finer mesh in place of the coarse one, or says that the accuracy is out of reach.
    fn refine(&self, meshes: &mut Meshes, estimate: ErrorEstimate, depth: f64) -> Result<(), GroundError> {
        let excess = estimate.largest() / self.accuracy;
        let parts = meshes.fine.lines.parts;
        let next = RATIO * parts;
        // What the accuracy needs at least, should the error fall as fast as it can.
        let wanted = parts as f64 * excess.powf(1.0 / BEST_ORDER);
        let lines = |parts| Lines::new(&self.profile, self.alpha, parts, self.max_unknowns);
        if excess.is_nan() || lines(next).is_err() || lines(wanted as usize).is_err() {
            return Err(GroundError::Accuracy {
                model: MODEL,
                asked: self.accuracy,
                reached: estimate.largest(),
                radius: estimate.radius,
                depth,
            });
        }
        let finer = level(&self.profile, self.accuracy, lines(next))?;
        meshes.coarse = std::mem::replace(&mut meshes.fine, finer);
        meshes.factorisations += 1;
        Ok(())
    }
}

impl GroundField for LayeredFem {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        check_place(radius, depth)?;
        Ok(self.displacements(load, &[radius], depth)?[0])
    }

    fn displacements(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<Vec<Displacement>, GroundError> {
        check_place(0.0, depth)?;
        let answer = self.answer(load.contact_radius(), depth)?;
        radii
            .iter()
            .map(|&radius| evaluate(&answer.line, load, radius, depth))
            .collect()
    }
}

/// The mesh of `lines`, factored. A last correction may change a solution by rounding alone, a thousandth of the accuracy: where λ is large
/// relative to a stiff layer rounding is felt long before it matters.
fn level(profile: &SoilProfile, accuracy: f64, lines: Result<Lines, FemError>) -> Result<Level, GroundError> {
    let rounding = (1e-3 * accuracy).max(LEAST_CHANGE);
    lines
        .and_then(|lines| Level::new(profile, rounding, lines))
        .map_err(in_model)
}

/// Estimated error of `fine` from its difference to `coarse`, whose error is at least `gain` times as large.
fn compare(coarse: &DepthLine, fine: &DepthLine, radii: &[f64], gain: f64) -> ErrorEstimate {
    let mut peak = [0.0_f64; 2];
    // Largest difference, and where it is.
    let mut worst = [(0.0, 0.0); 2];
    for &r in radii {
        let (u, other) = (fine.at(r), coarse.at(r));
        // The singular point of a point load has no value to compare.
        if !u.is_finite() && r == 0.0 {
            continue;
        }
        for (c, (u, other)) in [(u.radial, other.radial), (u.vertical, other.vertical)]
            .into_iter()
            .enumerate()
        {
            peak[c] = peak[c].max(u.abs());
            let gap = (u - other).abs();
            if gap > worst[c].0 || gap.is_nan() {
                worst[c] = (gap, r);
            }
        }
    }
    let share = |difference: f64, peak: f64| match difference {
        0.0 => 0.0,
        _ => difference / peak / (gain - 1.0),
    };
    let radial = share(worst[0].0, peak[0].max(LEAST_RADIAL * peak[1]));
    let vertical = share(worst[1].0, peak[1]);
    ErrorEstimate {
        radial,
        vertical,
        radius: if radial >= vertical {
            worst[0].1
        } else {
            worst[1].1
        },
    }
}

/// The displacement under `load` from the line of a unit load.
fn evaluate(
    line: &DepthLine,
    load: SurfaceLoad,
    radius: f64,
    depth: f64,
) -> Result<Displacement, GroundError> {
    check_place(radius, depth)?;
    let value = line.at(radius) * load.force();
    if value.is_finite() {
        return Ok(value);
    }
    Err(GroundError::Singular {
        model: MODEL,
        radius,
        depth,
    })
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
