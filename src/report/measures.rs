//! Ways to hold the cable, each by a run of the scene.

use std::sync::Arc;

use super::quantity::Shown;
use crate::design::compare::compare_over;
use crate::design::{DesignError, Place, Spring, TradeOff};
use crate::ground::Ground;
use crate::scene::End;
use crate::{CableEnd, Error, Limits, PassRecord, Progress, Run, Scene};

/// Tolerance of these runs, unless the scene's is looser: they are compared with each other, on one mesh.
const TOLERANCE: f64 = 0.05;
/// Stiffnesses of end springs, as shares of the cable's own EA/L.
const SPRINGS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
/// The same beside the scene's own spring where that is beyond these, as shares of it.
const BESIDE: [f64; 2] = [0.3, 3.0];
/// Clamps: place from the end that is held, as a share of the duct's length, and stiffness as a share of EA/L.
const CLAMPS: [(f64, f64); 3] = [(0.5, 1.0), (0.5, 10.0), (0.1, 10.0)];

/// Ways to hold the cable, and what each of them does.
#[derive(Debug)]
pub struct Comparison {
    /// The end that is varied.
    pub end: Place,
    /// Tolerance of the runs.
    pub tolerance: f64,
    pub ways: Vec<Way>,
    /// EA/L of the whole cable \[N/m\], of which the stiffnesses are shares; `None` where they were given.
    pub own_stiffness: Option<f64>,
    /// Why there are none.
    pub failure: Option<String>,
}

#[derive(Debug)]
pub struct Way {
    pub spring: Spring,
    /// Whether that is how the scene holds it.
    pub is_scene: bool,
    pub answer: Result<TradeOff, DesignError>,
}

impl Comparison {
    /// Runs `scene`, over its `ground`, with each of `measures`, or with those that suit it. The way in which the scene holds its end is `run` itself, so that
    /// one scene has one force.
    ///
    /// # Errors
    ///
    /// [`Error::Stopped`] where `progress` stops it.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        run: &Run,
        measures: Option<&[Spring]>,
        progress: Progress<'_>,
    ) -> Result<Self, Error> {
        let mut scene = scene.clone();
        let tolerance = scene.solver.tolerance.max(TOLERANCE);
        scene.solver.tolerance = tolerance;
        let end = run
            .passes
            .last()
            .map_or(Place::Downstream, |last| end(&scene, last));
        let own_stiffness = measures.is_none().then(|| own_stiffness(&scene));
        let measures = measures.map_or_else(|| suitable(&scene, end), <[Spring]>::to_vec);
        let held = held(&scene, end);
        let is_scene = |spring: &Spring| *spring == Spring::new(end, held);
        let others: Vec<Spring> = measures.iter().copied().filter(|way| !is_scene(way)).collect();
        let compared = if others.is_empty() {
            Ok(Vec::new())
        } else {
            compare_over(&scene, ground, &others, progress)
        };
        let (answers, failure) = match compared {
            Ok(answers) => (answers, None),
            Err(DesignError::Analysis(Error::Stopped)) => return Err(Error::Stopped),
            Err(error) => (Vec::new(), Some(error.to_string())),
        };
        let mut answers = answers.into_iter();
        let ways = measures.into_iter().filter_map(|spring| {
            let is_scene = is_scene(&spring);
            let answer = if is_scene {
                Ok(TradeOff::of(&scene, run, &[spring], &Limits::default()))
            } else {
                answers.next()?
            };
            Some(Way {
                spring,
                is_scene,
                answer,
            })
        });
        Ok(Self {
            end,
            tolerance,
            ways: ways.collect(),
            own_stiffness,
            failure,
        })
    }
}

impl Way {
    pub fn is_clamp(&self) -> bool {
        matches!(self.spring.place, Place::Clamp(_))
    }

    /// Whether nothing holds the end.
    pub fn is_free_end(&self) -> bool {
        !self.is_clamp() && self.spring.stiffness() == 0.0
    }

    /// What it is, in words.
    pub fn name(&self, shown: &Shown) -> String {
        let (place, stiffness) = (self.spring.place, self.spring.stiffness());
        let spring = shown.stiffness(stiffness);
        let name = match place {
            Place::Clamp(position) => format!("clamp of {spring} at {}", shown.length(position)),
            _ if stiffness == 0.0 => "free end".to_owned(),
            _ if stiffness.is_infinite() => "fixed end".to_owned(),
            _ => format!("spring of {spring}"),
        };
        let scene = if self.is_scene { ", as in the scene" } else { "" };
        name + scene
    }
}

/// The held end that is pressed harder after the `last` pass; `None` where both are free.
pub fn pressed_end(scene: &Scene, last: &PassRecord) -> Option<Place> {
    match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => None,
        (_, End::Free) => Some(Place::Upstream),
        (End::Free, _) => Some(Place::Downstream),
        _ if last.upstream_force_n.abs() > last.downstream_force_n.abs() => Some(Place::Upstream),
        _ => Some(Place::Downstream),
    }
}

/// The end to be varied: the one that is pressed harder, or toward which the cable creeps where both are free.
fn end(scene: &Scene, last: &PassRecord) -> Place {
    pressed_end(scene, last).unwrap_or(
        if -last.upstream_displacement_m > last.downstream_displacement_m {
            Place::Upstream
        } else {
            Place::Downstream
        },
    )
}

/// Free, springs up to the scene's own and beyond, fixed, and clamps.
fn suitable(scene: &Scene, end: Place) -> Vec<Spring> {
    let own = own_stiffness(scene);
    let held = held(scene, end);
    let mut stiffnesses: Vec<f64> = SPRINGS.iter().map(|share| share * own).collect();
    let is_far = held < stiffnesses[0] || held > stiffnesses[SPRINGS.len() - 1];
    if held > 0.0 && held.is_finite() && is_far {
        stiffnesses.extend(BESIDE.map(|share| share * held));
    }
    stiffnesses.extend([0.0, f64::INFINITY, held]);
    stiffnesses.sort_by(f64::total_cmp);
    stiffnesses.dedup();
    let springs = stiffnesses.into_iter().map(|stiffness| (end, stiffness));
    let clamps = CLAMPS.iter().map(|&(from_end, share)| {
        let share_of_length = if end == Place::Upstream {
            from_end
        } else {
            1.0 - from_end
        };
        (Place::Clamp(share_of_length * scene.duct.length), share * own)
    });
    let spring = |(place, stiffness)| Spring::new(place, stiffness);
    springs.chain(clamps).map(spring).collect()
}

/// EA/L \[N/m\].
fn own_stiffness(scene: &Scene) -> f64 {
    scene.cable.axial_stiffness / scene.duct.length
}

/// Stiffness with which `scene` holds the end \[N/m\].
fn held(scene: &Scene, end: Place) -> f64 {
    let end = end.end().unwrap_or(CableEnd::Downstream).held_in(scene);
    end.stiffness().unwrap_or(f64::INFINITY)
}
