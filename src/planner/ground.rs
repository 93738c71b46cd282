//! Which model of the ground a scene needs.
//!
//! The ladder climbs from closed forms to finite elements, and on each rung from wheels as points to wheels as discs. The
//! cable feels the ground only through the duct's longitudinal motion, so a rung is as good as its D_l(ξ): each is held
//! against the exact model, which for uniform layers costs a millisecond, and the cheapest whose largest
//! difference is within the tolerance is taken. What that difference does to the force is measured when the scene is run.
//!
//! A half-space in place of layers has the Poisson's ratio of one of them and the modulus that fits D_l best.

use std::borrow::Cow;

use boussinesq::{HalfSpace, Odemark};
use burmister::LayeredHalfSpace;
use ground_field::{
    Base, DuctMotion, GroundError, GroundField, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad, Vehicle,
    Wheel,
};
use layered_fem::LayeredFem;

use super::Rung;
use crate::Error;
use crate::analysis::motion::{self, Ground};
use crate::analysis::road;
use crate::scene::{GroundModel, Scene};

/// Accuracy of the duct's motion as a share of its peak where the ground has a closed form. The cable feels the motion's
/// second derivative, and the closed forms give it away for a few hundred evaluations.
const CLOSED_FORM_ACCURACY: f64 = 1e-9;
/// The same for layers by Hankel transform; asked of the transform itself is a tenth of it.
const TRANSFORM_ACCURACY: f64 = 1e-7;
/// The same for a model of unknown smoothness.
const OWN_ACCURACY: f64 = 1e-6;
/// Tightest and loosest accuracy asked of finite elements, and the share of the tolerance they get.
const ELEMENTS_ACCURACY: (f64, f64) = (2e-4, 5e-3);
const ELEMENTS_SHARE: f64 = 0.25;
/// Uniform sublayers that stand for a layer whose modulus varies, to see whether that matters.
const SUBLAYERS: usize = 8;
/// Points at which two motions are compared, this far on either side of the vehicle \[depths\].
const COMPARED: (usize, f64) = (241, 12.0);
/// Measured time of one evaluation \[s\] on one core of about 3 GHz.
const HALF_SPACE_SECONDS: f64 = 3e-7;
const ODEMARK_SECONDS: f64 = 1e-6;
const TRANSFORM_SECONDS: f64 = 6e-6;
/// Measured time of a finite-element solution at 0.5 % \[s\]; it grows with the inverse of the accuracy.
const ELEMENTS_SECONDS: f64 = 0.07;

/// The ground that was chosen.
pub struct GroundChoice<'a> {
    pub name: &'static str,
    pub reason: String,
    /// Largest |ΔD_l| as a share of its peak, against the exact model or by the model's own accuracy.
    pub error: f64,
    pub rungs: Vec<Rung>,
    /// Name of the exact model.
    pub exact_name: &'static str,
    /// Motion under every vehicle.
    motions: Motions<'a>,
    /// The exact one, where the chosen one leaves something out.
    exact: Option<Vec<DuctMotion>>,
}

enum Motions<'a> {
    Known(Vec<DuctMotion>),
    /// Too costly to plan with.
    Later(Box<dyn GroundField + 'a>, f64),
}

impl GroundChoice<'_> {
    /// Motion of the duct under every vehicle.
    pub fn motions(&self, scene: &Scene) -> Result<Cow<'_, [DuctMotion]>, Error> {
        match &self.motions {
            Motions::Known(motions) => Ok(Cow::Borrowed(motions)),
            Motions::Later(field, accuracy) => Ok(Cow::Owned(motion::motions(
                scene,
                &Ground::new(&**field, *accuracy),
                road::reach(scene),
            )?)),
        }
    }

    /// The motions, where they are known without much work.
    pub fn known(&self) -> Option<&[DuctMotion]> {
        match &self.motions {
            Motions::Known(motions) => Some(motions),
            Motions::Later(..) => None,
        }
    }

    /// Motions that leave nothing out, where [`GroundChoice::motions`] do.
    pub fn exact(&self) -> Option<&[DuctMotion]> {
        self.exact.as_deref()
    }
}

/// The model the scene names, or the cheapest that keeps its tolerance; `own` is a model that the caller brings along.
pub fn choose<'a>(scene: &Scene, own: Option<&'a dyn GroundField>) -> Result<GroundChoice<'a>, Error> {
    if let Some(field) = own {
        return Ok(named(
            "own",
            "the caller's own model",
            Motions::Later(Box::new(field), OWN_ACCURACY),
            OWN_ACCURACY,
        ));
    }
    match scene.ground.model {
        GroundModel::Auto => {
            let ladder = Ladder {
                scene,
                points: with_points(scene)?,
                candidates: Vec::new(),
            };
            let profile = &scene.ground.profile;
            match profile.homogeneous() {
                Some(soil) => ladder.homogeneous(soil),
                None if is_graded(profile) => ladder.graded(profile),
                None => ladder.layered(profile),
            }
        }
        model => {
            let (name, field, accuracy) = build(scene, model)?;
            Ok(named(
                name,
                "the scene asks for it",
                Motions::Later(field, accuracy),
                accuracy,
            ))
        }
    }
}

/// The exact model of the scene's ground, for looking at the ground itself: its name, field and accuracy.
pub fn exact(scene: &Scene) -> Result<(&'static str, Box<dyn GroundField>, f64), Error> {
    let model = match scene.ground.model {
        GroundModel::Auto if scene.ground.profile.homogeneous().is_some() => GroundModel::Boussinesq,
        GroundModel::Auto if is_graded(&scene.ground.profile) => GroundModel::FiniteElements,
        GroundModel::Auto => GroundModel::Burmister,
        model => model,
    };
    build(scene, model)
}

fn named<'a>(name: &'static str, reason: &str, motions: Motions<'a>, error: f64) -> GroundChoice<'a> {
    GroundChoice {
        name,
        reason: reason.into(),
        error,
        rungs: vec![Rung::chosen("ground", name, error, None, reason)],
        exact_name: name,
        motions,
        exact: None,
    }
}

fn build(scene: &Scene, model: GroundModel) -> Result<(&'static str, Box<dyn GroundField>, f64), Error> {
    let profile = &scene.ground.profile;
    Ok(match model {
        GroundModel::Boussinesq => {
            let soil = profile.homogeneous().ok_or(Error::Unfit {
                key: "ground.model",
                found: "boussinesq",
                reason:
                    "its ground has layers or a rigid base, and this closed form knows one half-space only"
                        .into(),
            })?;
            ("boussinesq", Box::new(HalfSpace::new(soil)), CLOSED_FORM_ACCURACY)
        }
        GroundModel::Odemark => {
            let unfit = |error: GroundError| Error::Unfit {
                key: "ground.model",
                found: "odemark",
                reason: error.to_string().into(),
            };
            (
                "odemark",
                Box::new(Odemark::new(profile).map_err(unfit)?),
                TRANSFORM_ACCURACY,
            )
        }
        GroundModel::Auto | GroundModel::Burmister => {
            ("burmister", Box::new(transform(profile)?), TRANSFORM_ACCURACY)
        }
        GroundModel::FiniteElements => {
            let accuracy = elements_accuracy(scene);
            ("fem", Box::new(LayeredFem::new(profile, accuracy)?), accuracy)
        }
    })
}

fn transform(profile: &SoilProfile) -> Result<LayeredHalfSpace, Error> {
    Ok(LayeredHalfSpace::new(profile)?.with_accuracy(0.1 * TRANSFORM_ACCURACY)?)
}

fn elements_accuracy(scene: &Scene) -> f64 {
    let (tightest, loosest) = ELEMENTS_ACCURACY;
    (ELEMENTS_SHARE * scene.solver.tolerance).clamp(tightest, loosest)
}

fn is_graded(profile: &SoilProfile) -> bool {
    profile.layers().iter().any(|layer| layer.soil().is_none())
}

/// A model on its rung.
struct Candidate {
    name: &'static str,
    /// What it leaves out beside the model's own simplification, for the reader.
    wheels: &'static str,
    motions: Vec<DuctMotion>,
    seconds: f64,
}

/// The scene, and what its ladder is made of.
struct Ladder<'s> {
    scene: &'s Scene,
    /// The scene with every wheel a point; `None` where they are points anyhow.
    points: Option<Scene>,
    candidates: Vec<Candidate>,
}

/// The highest rung: taken where no other will do.
struct Top<'a> {
    name: &'static str,
    reason: &'static str,
    motions: Motions<'a>,
    error: f64,
    seconds: f64,
}

impl Ladder<'_> {
    /// A closed form, whatever the wheels are.
    fn homogeneous<'a>(mut self, soil: Soil) -> Result<GroundChoice<'a>, Error> {
        let field = HalfSpace::new(soil);
        let exact = motions(self.scene, &field, CLOSED_FORM_ACCURACY)?;
        self.add_points("boussinesq", HALF_SPACE_SECONDS, |scene| {
            motions(scene, &field, CLOSED_FORM_ACCURACY)
        })?;
        let top = Top {
            name: "boussinesq",
            reason: "the ground is one half-space, whose displacement has a closed form",
            seconds: HALF_SPACE_SECONDS * samples(&exact),
            motions: Motions::Known(exact.clone()),
            error: CLOSED_FORM_ACCURACY,
        };
        Ok(self.climb(top, &exact))
    }

    fn layered<'a>(mut self, profile: &SoilProfile) -> Result<GroundChoice<'a>, Error> {
        let field = transform(profile)?;
        let exact = motions(self.scene, &field, TRANSFORM_ACCURACY)?;
        // Points would spare the transform nothing.
        self.add_closed_forms(profile, &exact)?;
        let top = Top {
            name: "burmister",
            reason: "its layers or its base matter, and the Hankel transform is exact for them",
            seconds: TRANSFORM_SECONDS * samples(&exact),
            motions: Motions::Known(exact.clone()),
            error: TRANSFORM_ACCURACY,
        };
        Ok(self.climb(top, &exact))
    }

    fn graded<'a>(mut self, profile: &SoilProfile) -> Result<GroundChoice<'a>, Error> {
        let exact = motions(
            self.scene,
            &transform(&sublayered(profile, SUBLAYERS)?)?,
            TRANSFORM_ACCURACY,
        )?;
        let means = sublayered(profile, 1)?;
        self.add_closed_forms(&means, &exact)?;
        let field = transform(&means)?;
        self.add("burmister", TRANSFORM_SECONDS, |scene| {
            motions(scene, &field, TRANSFORM_ACCURACY)
        })?;
        let accuracy = elements_accuracy(self.scene);
        let top = Top {
            name: "fem",
            reason: "a modulus that varies with depth needs finite elements",
            motions: Motions::Later(Box::new(LayeredFem::new(profile, accuracy)?), accuracy),
            error: accuracy,
            seconds: ELEMENTS_SECONDS * ELEMENTS_ACCURACY.1 / accuracy,
        };
        Ok(self.climb(top, &exact))
    }

    fn add_closed_forms(&mut self, profile: &SoilProfile, exact: &[DuctMotion]) -> Result<(), Error> {
        let depth = self.scene.duct.depth;
        // Points cost less than discs, and tell the soils apart as well.
        let soil = best_soil(self.points.as_ref().unwrap_or(self.scene), profile, exact)?;
        self.add("boussinesq", HALF_SPACE_SECONDS, |scene| {
            fitted(scene, soil, exact, depth)
        })?;
        if profile.layers().len() > Odemark::MOST_LAYERS {
            return Ok(());
        }
        let field = Odemark::new(profile)?;
        self.add("odemark", ODEMARK_SECONDS, |scene| {
            motions(scene, &field, TRANSFORM_ACCURACY)
        })
    }

    /// Adds a model, with points where the wheels are discs.
    fn add(
        &mut self,
        name: &'static str,
        per_sample: f64,
        motions: impl Fn(&Scene) -> Result<Vec<DuctMotion>, Error>,
    ) -> Result<(), Error> {
        // Where points are too rough, so is a simpler ground: discs are left to the exact model.
        if self.points.is_some() {
            return self.add_points(name, per_sample, motions);
        }
        let motions = motions(self.scene)?;
        self.candidates.push(Candidate {
            name,
            wheels: "",
            seconds: per_sample * samples(&motions),
            motions,
        });
        Ok(())
    }

    fn add_points(
        &mut self,
        name: &'static str,
        per_sample: f64,
        motions: impl Fn(&Scene) -> Result<Vec<DuctMotion>, Error>,
    ) -> Result<(), Error> {
        if let Some(points) = &self.points {
            let motions = motions(points)?;
            self.candidates.push(Candidate {
                name,
                wheels: ", wheels as points",
                seconds: per_sample * samples(&motions),
                motions,
            });
        }
        Ok(())
    }

    /// Takes the lowest rung that is within the tolerance of the exact motions.
    fn climb<'a>(self, top: Top<'a>, exact: &[DuctMotion]) -> GroundChoice<'a> {
        let tolerance = self.scene.solver.tolerance;
        let depth = self.scene.duct.depth;
        let mut rungs = Vec::new();
        let mut taken: Option<(Candidate, f64)> = None;
        for candidate in self.candidates {
            let error = difference(&candidate.motions, exact, depth);
            let off = format!(
                "{:.2} % of the peak off the exact longitudinal motion{}",
                100.0 * error,
                candidate.wheels
            );
            let fits = error <= tolerance && taken.is_none();
            let mut rung = Rung::rejected(
                "ground",
                candidate.name,
                Some(error),
                Some(candidate.seconds),
                &off,
            );
            rung.chosen = fits;
            rungs.push(rung);
            if fits {
                taken = Some((candidate, error));
            }
        }
        let mut rung = Rung::rejected("ground", top.name, Some(top.error), Some(top.seconds), top.reason);
        if let Some((candidate, error)) = taken {
            rung.reason = "more than the tolerance needs".into();
            rungs.push(rung);
            return GroundChoice {
                name: candidate.name,
                reason: format!(
                    "the cheapest within the tolerance, {:.2} % of the peak off the exact longitudinal motion{}",
                    100.0 * error,
                    candidate.wheels
                ),
                error,
                rungs,
                exact_name: top.name,
                motions: Motions::Known(candidate.motions),
                exact: Some(exact.to_vec()),
            };
        }
        rung.chosen = true;
        rungs.push(rung);
        GroundChoice {
            name: top.name,
            reason: top.reason.into(),
            error: top.error,
            rungs,
            exact_name: top.name,
            motions: top.motions,
            exact: None,
        }
    }
}

fn motions(scene: &Scene, field: &dyn GroundField, accuracy: f64) -> Result<Vec<DuctMotion>, Error> {
    motion::motions(scene, &Ground::new(field, accuracy), road::reach(scene))
}

fn samples(motions: &[DuctMotion]) -> f64 {
    motions.iter().map(DuctMotion::samples).sum::<usize>() as f64
}

/// Largest |ΔD_l| of any vehicle, as a share of the peak of its exact D_l.
fn difference(motions: &[DuctMotion], exact: &[DuctMotion], depth: f64) -> f64 {
    motions
        .iter()
        .zip(exact)
        .map(|(motion, exact)| {
            let worst = compared(exact, depth)
                .map(|xi| (motion.longitudinal(xi) - exact.longitudinal(xi)).abs())
                .fold(0.0, f64::max);
            share(worst, exact.peak_longitudinal())
        })
        .fold(0.0, f64::max)
}

fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// Positions ξ \[m\] at which motions are compared.
fn compared(motion: &DuctMotion, depth: f64) -> impl Iterator<Item = f64> {
    let (count, depths) = COMPARED;
    let half = motion.half_length() + depths * depth;
    (0..count).map(move |k| half * (2.0 * k as f64 / (count - 1) as f64 - 1.0))
}

/// The soil of `profile` whose half-space comes nearest to the exact motions.
fn best_soil(scene: &Scene, profile: &SoilProfile, exact: &[DuctMotion]) -> Result<Soil, Error> {
    let layers = profile.layers().iter().filter_map(SoilLayer::soil);
    let base = match profile.base() {
        Base::HalfSpace(soil) => Some(soil),
        Base::Rigid => None,
    };
    let mut best: Option<(f64, Soil)> = None;
    for soil in layers.chain(base) {
        let depth = scene.duct.depth;
        let error = difference(&fitted(scene, soil, exact, depth)?, exact, depth);
        if best.is_none_or(|(least, _)| error < least) {
            best = Some((error, soil));
        }
    }
    best.map(|(_, soil)| soil).ok_or(Error::Unfit {
        key: "ground.layers",
        found: "no uniform layer",
        reason: "a half-space needs the Poisson's ratio of one".into(),
    })
}

/// Motions over a half-space with the Poisson's ratio of `soil` and the modulus that comes nearest to `exact`.
fn fitted(scene: &Scene, soil: Soil, exact: &[DuctMotion], depth: f64) -> Result<Vec<DuctMotion>, Error> {
    let motions = motions(scene, &HalfSpace::new(soil), CLOSED_FORM_ACCURACY)?;
    if scene.ground.scaling.is_some() {
        // Fitted already, to each vehicle's peak or to the first one's vertical peak.
        return Ok(motions);
    }
    Ok(motions
        .into_iter()
        .zip(exact)
        .map(|(motion, exact)| {
            let factor = fit(&motion, exact, depth);
            motion.scaled(factor)
        })
        .collect::<Result<_, _>>()?)
}

/// The factor by which `motion` comes nearest to `exact`, in the least squares of D_l.
fn fit(motion: &DuctMotion, exact: &DuctMotion, depth: f64) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for xi in compared(exact, depth) {
        let d = motion.longitudinal(xi);
        product += d * exact.longitudinal(xi);
        square += d * d;
    }
    if square > 0.0 { product / square } else { 1.0 }
}

/// The profile with every layer whose modulus varies cut into `count` uniform ones.
fn sublayered(profile: &SoilProfile, count: usize) -> Result<SoilProfile, Error> {
    let mut layers = Vec::new();
    for layer in profile.layers() {
        if layer.soil().is_some() {
            layers.push(*layer);
            continue;
        }
        let thickness = layer.thickness() / count as f64;
        for k in 0..count {
            let middle = layer.young_modulus_at((k as f64 + 0.5) * thickness);
            layers.push(SoilLayer::new(
                thickness,
                Modulus::Uniform(middle),
                layer.poisson_ratio(),
            )?);
        }
    }
    Ok(SoilProfile::new(layers, profile.base())?)
}

/// The scene with every wheel a point; `None` where they all are.
fn with_points(scene: &Scene) -> Result<Option<Scene>, Error> {
    let discs = scene
        .vehicles
        .iter()
        .flat_map(|traffic| traffic.vehicle.wheels())
        .any(|wheel| wheel.load.contact_radius() > 0.0);
    if !discs {
        return Ok(None);
    }
    let mut scene = scene.clone();
    for traffic in &mut scene.vehicles {
        let vehicle = &traffic.vehicle;
        let wheels = vehicle
            .wheels()
            .iter()
            .map(|wheel| {
                Ok(Wheel {
                    load: SurfaceLoad::point(wheel.load.force())?,
                    ..*wheel
                })
            })
            .collect::<Result<Vec<_>, Error>>()?;
        traffic.vehicle = Vehicle::new(vehicle.name(), wheels, vehicle.speed(), vehicle.direction())?;
    }
    Ok(Some(scene))
}
