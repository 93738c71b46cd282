//! One simulated pass, picture by picture: where the cable slips in its duct, with how much friction, and what force it is left with
//! (Kashiro et al., Figure 7).

use std::sync::Arc;

use cable_dem::{CableState, QuasiStatic};
use serde::Serialize;

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
/// Finer than this many nodes a depth no eye sees.
const FINEST: f64 = 12.0;
/// Friction of this share of its limit is at it.
const AT_LIMIT: f64 = 1.0 - 1e-6;
/// One unit of what a picture holds is so much: a tenth of a newton, 10 nm.
const FORCE: f64 = 0.1;
const MOVEMENT: f64 = 1e-8;

/// A pass.
#[derive(Serialize)]
pub struct Film {
    /// Its number; the first, or the one after the last.
    pass: u64,
    vehicle: String,
    /// 1 with growing x, else −1.
    direction: f64,
    /// Wheels ahead of the vehicle's origin \[m\].
    wheels_m: Vec<f64>,
    length_m: f64,
    depth_m: f64,
    /// Largest friction \[N/m\], in the mean.
    limit_n_per_m: f64,
    /// Distance between the nodes of pictures \[m\].
    spacing_m: f64,
    motion: Motion,
    /// Force along the cable before the pass and after it \[0.1 N\], at every node of pictures.
    before: Vec<i32>,
    after: Vec<i32>,
    pictures: Vec<Picture>,
}

/// Motion of the duct at places in front of the vehicle and behind it.
#[derive(Serialize)]
struct Motion {
    ahead_m: Vec<f64>,
    along_um: Vec<f64>,
    down_um: Vec<f64>,
}

/// The cable with the vehicle at one place, from some node on.
#[derive(Serialize)]
struct Picture {
    vehicle_m: f64,
    first: usize,
    /// Friction on the cable \[% of its limit\]: at ±100 it slips.
    friction: Vec<i32>,
    /// Force in the cable \[0.1 N\].
    force: Vec<i32>,
    /// Displacement since the pass began \[10 nm\].
    moved: Vec<i32>,
}

/// Lets a vehicle pass over the cable of `scene` once more, or for the first time.
pub fn film(
    bench: &mut Bench,
    scene: &Scene,
    question: &Question,
    progress: Progress<'_>,
) -> Result<Film, Error> {
    let start = if question.first {
        None
    } else {
        bench.state(scene, progress)?
    };
    let ground = bench.ground(scene)?;
    let mut plan = creepage_run::plan::plan_over(scene, Arc::clone(&ground))?;
    plan.start = start.as_deref();
    let vehicle = question.vehicle.min(scene.vehicles.len() - 1);
    let motion = &ground.motions[vehicle];
    let depth = scene.duct.depth;
    let level = (plan.levels.first..plan.levels.finest)
        .find(|level| FINEST * plan.levels.spacing(*level).0 <= depth)
        .unwrap_or(plan.levels.first);
    let task = plan.task(scene, plan.levels.mesh(level)?);
    let (cable, mesh) = (task.cable()?, task.mesh);
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let passage = solver.passage(motion, road_of(scene, &ground.motions)?)?;
    let mut state = task.begin()?.unwrap_or_else(|| solver.at_rest());
    let (begin, limits) = (state.clone(), state.friction_limits(&cable)?);

    let seen = (2.0 * SEEN * depth / mesh.spacing()) as usize;
    let every = seen.min(mesh.nodes()).div_ceil(NODES).max(1);
    let beyond = BEYOND * depth;
    let apart = (mesh.length() + 2.0 * beyond) / PICTURES;
    let (mut due, mut pictures) = (f64::NEG_INFINITY, Vec::new());
    let direction = scene.vehicles[vehicle].direction.sign();
    let picture = |position: f64, now: &CableState| {
        let from = ((position - SEEN * depth) / mesh.spacing()).max(0.0) as usize / every * every;
        let nodes = (from..mesh.nodes()).step_by(every).take(seen / every + 1);
        let moved = |node: usize| now.displacement()[node] - begin.displacement()[node];
        let forces: Vec<f64> = now.element_forces(&cable)?.collect();
        Ok::<_, Error>(Picture {
            vehicle_m: position,
            first: from / every,
            friction: nodes
                .clone()
                .map(|node| percent(now.friction()[node], limits[node]))
                .collect(),
            force: nodes.clone().map(|node| at_node(&forces, node)).collect(),
            moved: nodes
                .map(|node| (moved(node) / MOVEMENT).round() as i32)
                .collect(),
        })
    };
    let outcome = solver.pass_observed(&passage, &mut state, |position, look| {
        let is_near = (-beyond..=mesh.length() + beyond).contains(&position);
        if is_near && direction * position >= due {
            due = direction * position + apart;
            pictures.push(picture(position, &look()));
        }
    });
    outcome?;
    let profile = |state: &CableState| {
        let forces: Vec<f64> = state.element_forces(&cable)?.collect();
        let nodes = (0..mesh.nodes()).step_by(every);
        Ok::<_, Error>(nodes.map(|node| at_node(&forces, node)).collect())
    };
    let half = SEEN * depth;
    let ahead_m: Vec<f64> = (-PLACES..=PLACES)
        .map(|k| half * f64::from(k) / f64::from(PLACES))
        .collect();
    let micro = |of: &dyn Fn(f64) -> f64| {
        ahead_m
            .iter()
            .map(|&ahead| (1e9 * of(ahead)).round() / 1e3)
            .collect()
    };
    Ok(Film {
        pass: if question.first {
            1
        } else {
            scene.traffic.passes + 1
        },
        vehicle: scene.vehicles[vehicle].name.clone(),
        direction,
        wheels_m: scene.vehicles[vehicle]
            .wheels()
            .iter()
            .map(|wheel| wheel.x)
            .collect(),
        length_m: mesh.length(),
        depth_m: depth,
        limit_n_per_m: scene.friction_limit(),
        spacing_m: mesh.spacing() * every as f64,
        motion: Motion {
            along_um: micro(&|ahead| motion.longitudinal(ahead)),
            down_um: micro(&|ahead| motion.vertical(ahead)),
            ahead_m,
        },
        before: profile(&begin)?,
        after: profile(&state)?,
        pictures: pictures.into_iter().collect::<Result<_, _>>()?,
    })
}

/// How far beyond the duct vehicles are followed \[m\].
fn road_of(scene: &Scene, motions: &[ground_field::DuctMotion]) -> Result<f64, Error> {
    Ok(crate::ground::road::approach(scene, motions)?)
}

/// Friction as a share of its limit \[%\]: ±100 at the limit, and nowhere else.
fn percent(friction: f64, limit: f64) -> i32 {
    if friction.abs() >= AT_LIMIT * limit {
        return 100 * friction.signum() as i32;
    }
    (100.0 * friction / limit).round().clamp(-99.0, 99.0) as i32
}

/// The force at a node \[0.1 N\], from those in the elements before it and after it.
fn at_node(forces: &[f64], node: usize) -> i32 {
    let after = forces[node.min(forces.len() - 1)];
    let before = forces[node.max(1) - 1];
    (0.5 * (before + after) / FORCE).round() as i32
}
