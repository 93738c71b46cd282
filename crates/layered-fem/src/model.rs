//! The ground model: meshes, answers and their error.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ground_field::{Displacement, GroundError, GroundField, SoilProfile, SurfaceLoad, check_place};

use crate::FemError;
use crate::grading::Lines;
use crate::level::Level;
use crate::line::DepthLine;
use crate::options::{ErrorEstimate, FemOptions, FemStatistics};

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
    options: FemOptions,
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
    /// A model of `profile` with an error of at most `accuracy` of the peak |`u_r`| and |`u_z`| at each depth; see
    /// [`FemOptions::new`].
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] for an accuracy out of range; [`GroundError::Model`] with a [`FemError`] where the
    /// mesh cannot be made or factored.
    pub fn new(profile: &SoilProfile, accuracy: f64) -> Result<Self, GroundError> {
        Self::with_options(profile, FemOptions::new(accuracy)?)
    }

    /// A model of `profile` with explicit options.
    ///
    /// # Errors
    ///
    /// As for [`LayeredFem::new`].
    pub fn with_options(profile: &SoilProfile, options: FemOptions) -> Result<Self, GroundError> {
        let (least, most) = ALPHA_RANGE;
        let mut alpha = (ALPHA * (options.accuracy() / ALPHA_ACCURACY).cbrt()).clamp(least, most);
        // Where the mesh that is likely to be needed is too large, a larger spacing may still prove accurate enough.
        while alpha < most && Lines::new(profile, alpha, RATIO, options.max_unknowns()).is_err() {
            alpha *= 1.2;
        }
        let meshes = Meshes {
            coarse: level(profile, options, alpha, 1)?,
            fine: level(profile, options, alpha, RATIO)?,
            factorisations: 2,
        };
        Ok(Self {
            profile: profile.clone(),
            options,
            alpha,
            meshes: Mutex::new(meshes),
            answers: Mutex::default(),
        })
    }

    /// The ground.
    pub fn profile(&self) -> &SoilProfile {
        &self.profile
    }

    /// The options.
    pub fn options(&self) -> FemOptions {
        self.options
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

    /// Work done and memory held so far.
    pub fn statistics(&self) -> FemStatistics {
        let meshes = locked(&self.meshes);
        let (coarse, fine) = (&meshes.coarse, &meshes.fine);
        FemStatistics {
            unknowns: fine.system.unknowns,
            factor_entries: fine.system.factor.entries(),
            factorisations: meshes.factorisations,
            solves: coarse.solutions.len() + fine.solutions.len(),
            bytes: coarse.bytes() + fine.bytes(),
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
            if estimate.largest() <= self.options.accuracy() {
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
        let excess = estimate.largest() / self.options.accuracy();
        let parts = meshes.fine.lines.parts;
        let next = RATIO * parts;
        // What the accuracy needs at least, should the error fall as fast as it can.
        let wanted = parts as f64 * excess.powf(1.0 / BEST_ORDER);
        let fits = |parts| Lines::new(&self.profile, self.alpha, parts, self.options.max_unknowns()).is_ok();
        if excess.is_nan() || !fits(next) || !fits(wanted as usize) {
            return Err(GroundError::Accuracy {
                model: MODEL,
                asked: self.options.accuracy(),
                reached: estimate.largest(),
                radius: estimate.radius,
                depth,
            });
        }
        let finer = level(&self.profile, self.options, self.alpha, next)?;
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

/// The mesh with every interval of the first cut into `parts`, factored.
fn level(profile: &SoilProfile, options: FemOptions, alpha: f64, parts: usize) -> Result<Level, GroundError> {
    let lines = Lines::new(profile, alpha, parts, options.max_unknowns());
    let level = lines.and_then(|lines| Level::new(profile, options.rounding(), lines));
    level.map_err(in_model)
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
