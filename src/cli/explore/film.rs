//! One simulated pass, picture by picture: where the cable slips in its duct, with how much friction, and what force it is left with
//! (Kashiro et al., Figure 7).

use cable_dem::{CableState, DuctedCable, QuasiStatic};
use creepage_plan::{ground::road, plan_over};
use creepage_run::passes::Task;
use ground_field::DuctMotion;
use serde_json::{Value, json};

use super::bench::Bench;
use super::question::Question;
use crate::{Error, Progress, Scene};

/// Pictures of a pass, and nodes in a picture, at most.
const PICTURES: f64 = 300.0;
const NODES: usize = 360;
/// How far on either side of the vehicle the cable is seen, and beyond the duct the vehicle \[depths\].
const SEEN: f64 = 24.0;
const BEYOND: f64 = 8.0;
/// Places at which the motion of the duct is known, on either side of the vehicle.
const PLACES: i32 = 120;
/// Nodes a depth that an eye sees, if the mesh of a draft has not more.
const SEEN_A_DEPTH: f64 = 12.0;
/// Friction of this share of its limit is at it.
const AT_LIMIT: f64 = 1.0 - 1e-6;

/// How pictures are taken.
struct Camera {
    cable: DuctedCable,
    begin: CableState,
    /// Every which node is seen, and how many nodes on either side of the vehicle.
    every: usize,
    half: usize,
}

/// Lets a vehicle pass over the cable of `scene` once more, or for the first time: the duct's motion at places ahead of the vehicle, force
/// along the cable before and after the pass, and pictures. A direction of 1 is that of growing x.
pub fn film(
    bench: &mut Bench,
    scene: &Scene,
    question: &Question,
    progress: Progress<'_>,
) -> Result<Value, Error> {
    let mut start = None;
    if !question.first {
        start = bench.state(scene, progress)?;
    }
    let ground = bench.grounds.of(scene)?;
    let mut plan = plan_over(scene, ground.clone())?;
    plan.start = start.as_ref();
    let index = question.vehicle.min(scene.vehicles.len() - 1);
    let (motion, vehicle, depth) = (&ground.motions[index], &scene.vehicles[index], scene.duct.depth);
    let mut levels = plan.levels.first..plan.levels.finest;
    let is_fine = |level: &usize| SEEN_A_DEPTH * plan.levels.spacing(*level).0 <= depth;
    let level = levels.find(is_fine).unwrap_or(plan.levels.first);
    let task = Task::of(&plan, scene, plan.levels.mesh(level)?);
    let (mesh, cable) = (task.mesh, task.cable()?);
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let passage = solver.passage(motion, road::approach(scene, &ground.motions)?)?;
    let mut state = task.begin()?;
    let half = (SEEN * depth / mesh.spacing()) as usize;
    let every = (2 * half).min(mesh.nodes()).div_ceil(NODES).max(1);
    let begin = state.clone();
    let camera = Camera {
        cable,
        begin,
        every,
        half,
    };
    let (direction, beyond) = (vehicle.direction.sign(), BEYOND * depth);
    let road = -beyond..=mesh.length() + beyond;
    let (mut due, mut pictures) = (f64::NEG_INFINITY, Vec::new());
    solver.pass_observed(&passage, &mut state, |position, look| {
        if road.contains(&position) && direction * position >= due {
            due = direction * position + (mesh.length() + 2.0 * beyond) / PICTURES;
            pictures.push(camera.picture(position, &look()));
        }
    })?;
    let wheels = vehicle.wheels().into_iter().map(|wheel| wheel.x);
    Ok(json!({
        "pass": if question.first { 1 } else { scene.traffic.passes + 1 },
        "vehicle": vehicle.name,
        "direction": direction,
        "wheels_m": wheels.collect::<Vec<_>>(),
        "length_m": mesh.length(),
        "depth_m": depth,
        "spacing_m": mesh.spacing() * every as f64,
        "motion": motion_around(motion, SEEN * depth),
        "before_decinewtons": camera.forces(&camera.begin, 0, usize::MAX)?,
        "after_decinewtons": camera.forces(&state, 0, usize::MAX)?,
        "pictures": pictures.into_iter().collect::<Result<Vec<_>, _>>()?,
    }))
}

/// The motion of the duct so far on either side of the vehicle \[m\].
fn motion_around(motion: &DuctMotion, half: f64) -> Value {
    let place = |k: i32| half * f64::from(k) / f64::from(PLACES);
    let ahead: Vec<f64> = (-PLACES..=PLACES).map(place).collect();
    let along = ahead.iter().map(|place| 1e6 * motion.longitudinal(*place));
    let down = ahead.iter().map(|place| 1e6 * motion.vertical(*place));
    let (along, down): (Vec<f64>, Vec<f64>) = (along.collect(), down.collect());
    json!({ "ahead_m": ahead, "along_um": along, "down_um": down })
}

impl Camera {
    /// The cable as it is `now` around the vehicle, from the node `first` of those that are seen on: friction in percent of its limit, ±100
    /// where it slips; force; displacement since the pass began.
    fn picture(&self, vehicle: f64, now: &CableState) -> Result<Value, Error> {
        let under = (vehicle / now.node_spacing()).max(0.0) as usize;
        let from = under.saturating_sub(self.half) / self.every * self.every;
        let (limits, count) = (now.friction_limits(&self.cable)?, 2 * self.half / self.every + 1);
        let nodes = || (from..limits.len()).step_by(self.every).take(count);
        let moved = |node: usize| 1e8 * (now.displacement()[node] - self.begin.displacement()[node]);
        let friction = nodes().map(|node| percent(now.friction()[node], limits[node]));
        Ok(json!({
            "vehicle_m": vehicle,
            "first": from / self.every,
            "friction_percent": friction.collect::<Vec<_>>(),
            "force_decinewtons": self.forces(now, from, count)?,
            "moved_10_nm": nodes().map(|node| moved(node).round() as i64).collect::<Vec<_>>(),
        }))
    }

    /// The forces \[0.1 N\] at so many nodes that are seen: those in the elements before them and after them.
    fn forces(&self, state: &CableState, from: usize, count: usize) -> Result<Vec<i64>, Error> {
        let forces: Vec<f64> = state.element_forces(&self.cable)?.collect();
        let at = |node: usize| 0.5 * (forces[node.max(1) - 1] + forces[node.min(forces.len() - 1)]);
        let nodes = (from..=forces.len()).step_by(self.every).take(count);
        Ok(nodes.map(|node| (10.0 * at(node)).round() as i64).collect())
    }
}

/// Friction as a share of its limit \[%\]: ±100 at the limit, and nowhere else.
fn percent(friction: f64, limit: f64) -> i64 {
    if friction.abs() >= AT_LIMIT * limit {
        return 100 * friction.signum() as i64;
    }
    (100.0 * friction / limit).round().clamp(-99.0, 99.0) as i64
}
