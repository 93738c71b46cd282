//! Ways to hold the cable, each by a run of the scene.

use std::sync::Arc;

use crate::words::{Reader, pressed_end};
use creepage_plan::ground::Ground;
use creepage_run::{Error, Limits, PassRecord, Progress, Run};
use creepage_scene::{CableEnd, Scene};
use creepage_study::{
    design::compare::compare_over,
    design::{DesignError, Place, Spring, TradeOff},
};

/// Tolerance of these runs, unless the scene's is looser: they are compared with each other, on one mesh.
const TOLERANCE: f64 = 0.05;
/// Stiffnesses of end springs, as shares of the cable's own EA/L.
const SPRINGS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
/// Clamps: place from the end that is held, as a share of the duct's length, and stiffness as a share of EA/L.
const CLAMPS: [(f64, f64); 3] = [(0.5, 1.0), (0.5, 10.0), (0.1, 10.0)];

/// Ways to hold the cable, and what each of them does.
#[derive(Debug)]
pub struct Comparison {
    /// The end that is varied.
    pub end: CableEnd,
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
        scene.solver.tolerance = scene.solver.tolerance.max(TOLERANCE);
        let end = run
            .passes
            .last()
            .map_or(CableEnd::Downstream, |last| varied(&scene, last));
        let own = scene.cable.axial_stiffness / scene.duct.length;
        let held = end.held_in(&scene).stiffness().unwrap_or(f64::INFINITY);
        let as_in_scene = Spring::new(end.into(), held);
        let springs =
            measures.map_or_else(|| suitable(end, own, held, scene.duct.length), <[Spring]>::to_vec);
        let others: Vec<Spring> = springs
            .iter()
            .copied()
            .filter(|way| *way != as_in_scene)
            .collect();
        let compared = match &others[..] {
            [] => Ok(Vec::new()),
            others => compare_over(&scene, ground, others, progress),
        };
        let (answers, failure) = match compared {
            Ok(answers) => (answers, None),
            Err(DesignError::Analysis(Error::Stopped)) => return Err(Error::Stopped),
            Err(error) => (Vec::new(), Some(error.to_string())),
        };
        let mut answers = answers.into_iter();
        let ways = springs.into_iter().filter_map(|spring| {
            let is_scene = spring == as_in_scene;
            let own = is_scene.then(|| Ok(TradeOff::of(&scene, run, &[spring], &Limits::default())));
            let answer = own.or_else(|| answers.next())?;
            Some(Way {
                spring,
                is_scene,
                answer,
            })
        });
        Ok(Self {
            end,
            tolerance: scene.solver.tolerance,
            ways: ways.collect(),
            own_stiffness: measures.is_none().then_some(own),
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
    pub fn name(&self, reader: &Reader) -> String {
        let stiffness = self.spring.stiffness();
        let spring = reader.stiffness(stiffness);
        let name = match self.spring.place {
            Place::Clamp(position) => format!("clamp of {spring} at {}", reader.length(position)),
            _ if stiffness == 0.0 => "free end".to_owned(),
            _ if stiffness.is_infinite() => "fixed end".to_owned(),
            _ => format!("spring of {spring}"),
        };
        let scene = if self.is_scene { ", as in the scene" } else { "" };
        name + scene
    }
}

/// The end to be varied: the one that is pressed harder, or toward which the cable creeps where both are free.
fn varied(scene: &Scene, last: &PassRecord) -> CableEnd {
    let is_upstream = -last.upstream_displacement_m > last.downstream_displacement_m;
    let creeps_to = if is_upstream {
        CableEnd::Upstream
    } else {
        CableEnd::Downstream
    };
    pressed_end(scene, last).unwrap_or(creeps_to)
}

/// Free, springs up to the scene's own and beyond, fixed, and clamps; stiffnesses \[N/m\] are shares of the cable's `own` and beside that with
/// which the scene holds the end.
fn suitable(end: CableEnd, own: f64, held: f64, length: f64) -> Vec<Spring> {
    let mut stiffnesses: Vec<f64> = SPRINGS.iter().map(|share| share * own).collect();
    stiffnesses.extend([0.0, f64::INFINITY, held]);
    stiffnesses.sort_by(f64::total_cmp);
    stiffnesses.dedup();
    let springs = stiffnesses
        .into_iter()
        .map(|stiffness| Spring::new(end.into(), stiffness));
    let clamps = CLAMPS.map(|(from_end, share)| {
        let place = end.of([from_end, 1.0 - from_end]) * length;
        Spring::new(Place::Clamp(place), share * own)
    });
    springs.chain(clamps).collect()
}
