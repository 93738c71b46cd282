//! The same scene once more: on far finer terms, from its other side, and larger; what that says of the first answer.

use std::mem::swap;

use creepage::scene::End;
use creepage::{Error, Run, Scene};
use ground_field::{Direction, Modulus};
use serde_json::Value;

use super::differences::{Errors, errors, stated};
use super::judged::run;

/// By what factor the tolerance of the finer run is smaller.
pub const FINER: f64 = 4.0;

/// How many times as long all lengths are in the larger scene. Froude's scale keeps gravity and densities, so that inertia scales too: times
/// grow as its root, forces as its cube.
pub const LENGTH: f64 = 4.0;
const TIME: f64 = 2.0;
const FORCE: f64 = 64.0;

/// How far the answer of a scene lies from those of other runs; infinitely far where the other has no answer though it has one. `None` if
/// that takes too long, or where the other scene is out of range.
pub struct Twins {
    /// What the answer states.
    pub stated: Errors,
    /// From a run that is to be [`FINER`] times as exact, and what that one states; `None` also where it is not.
    pub finer: Option<(Errors, Errors)>,
    /// From the same duct, looked at from its other side.
    pub mirror: Option<Errors>,
    /// From the same duct at [`LENGTH`] times its size.
    pub larger: Option<Errors>,
}

/// What further runs of a scene say of its answer `own`.
pub fn twins(scene: &Scene, own: &Run) -> Twins {
    let whole = own.error_estimate.relative.max(1e-3);
    let mut finer = scene.clone();
    finer.solver.tolerance = whole / FINER;
    // One that does not come to its tolerance proves nothing.
    let is_finer = |other: &Run| other.error_estimate.relative < 2.0 * whole / FINER;
    let finer = run(&finer).ok().filter(is_finer);
    Twins {
        stated: stated(own),
        finer: finer.map(|finer| (off_finer(scene, own, &finer), stated(&finer))),
        mirror: mirror(scene, own),
        larger: larger(scene, own),
    }
}

/// How far the answer `own` of a scene lies from that of a finer run, which may show the other sign of a clamp that is pulled about as hard
/// as it is pressed.
pub fn off_finer(scene: &Scene, own: &Run, finer: &Run) -> Errors {
    let [one, other] = [own, finer].map(|run| unsigned(scene, run, |_, _, _| true));
    errors(scene, &one, &other)
}

/// The run without the sign of every largest force on a clamp during a pass that `is_unsure` of its size, of the force after the pass, and of
/// what the clamp holds.
fn unsigned(scene: &Scene, run: &Run, is_unsure: impl Fn(f64, f64, f64) -> bool) -> Run {
    let mut run = run.clone();
    for (clamp, restraint) in run.restraints.iter_mut().zip(&scene.restraints) {
        let holds = restraint.holds.unwrap_or(f64::INFINITY);
        for (force, after) in clamp.during_passes_n.iter_mut().zip(&clamp.after_passes_n) {
            if is_unsure(force.abs(), after.abs(), holds) {
                *force = force.abs();
            }
        }
    }
    run
}

/// Whether a clamp may bear as much both ways within a pass, since all friction beside it turned over or it slipped both ways: then rounding
/// says which force is the largest.
fn turns_over(force: f64, after: f64, holds: f64) -> bool {
    force < 1.000_001 * after || force > 0.999_999 * holds
}

/// How far the answer `own` of a scene lies from that of its mirror image.
pub fn mirror(scene: &Scene, own: &Run) -> Option<Errors> {
    off(scene, own, run(&mirrored(scene.clone())).map(turned))
}

/// How far it lies from that of the scene at [`LENGTH`] times its size.
pub fn larger(scene: &Scene, own: &Run) -> Option<Errors> {
    off(scene, own, run(&enlarged(scene.clone())).map(|run| reduced(&run)))
}

fn off(scene: &Scene, own: &Run, other: Result<Run, Error>) -> Option<Errors> {
    match other {
        Ok(other) => {
            let [one, other] = [own, &other].map(|run| unsigned(scene, run, turns_over));
            Some(errors(scene, &one, &other))
        }
        Err(Error::Stopped | Error::Scene(_)) => None,
        Err(_) => Some([f64::INFINITY; 5]),
    }
}

/// The scene as seen from the other side of the road, where left is right.
fn mirrored(mut scene: Scene) -> Scene {
    scene.duct.slope = -scene.duct.slope;
    scene.route.reverse();
    for section in &mut scene.route {
        section.slope = -section.slope;
    }
    swap(&mut scene.ends.upstream, &mut scene.ends.downstream);
    for clamp in &mut scene.restraints {
        clamp.position = scene.duct.length - clamp.position;
    }
    for vehicle in &mut scene.vehicles {
        vehicle.direction = match vehicle.direction {
            Direction::Forward => Direction::Reverse,
            Direction::Reverse => Direction::Forward,
        };
    }
    scene
}

/// What the scene itself answers, from the answer of its mirror image.
fn turned(mut run: Run) -> Run {
    for pass in &mut run.passes {
        swap(&mut pass.upstream_force_n, &mut pass.downstream_force_n);
        swap(&mut pass.upstream_peak_n, &mut pass.downstream_peak_n);
        swap(&mut pass.upstream_least_n, &mut pass.downstream_least_n);
        let moved = [pass.upstream_displacement_m, pass.downstream_displacement_m];
        [pass.downstream_displacement_m, pass.upstream_displacement_m] = moved.map(|moved| -moved);
    }
    for day in &mut run.days {
        swap(&mut day.upstream_max_n, &mut day.downstream_max_n);
        swap(&mut day.upstream_min_n, &mut day.downstream_min_n);
        let [upstream, downstream] = [
            [day.upstream_displacement_min_m, day.upstream_displacement_max_m],
            [
                day.downstream_displacement_min_m,
                day.downstream_displacement_max_m,
            ],
        ];
        [
            day.downstream_displacement_max_m,
            day.downstream_displacement_min_m,
        ] = upstream.map(|moved| -moved);
        [day.upstream_displacement_max_m, day.upstream_displacement_min_m] = downstream.map(|moved| -moved);
        for clamp in &mut day.restraints {
            (clamp.min_n, clamp.max_n) = (-clamp.max_n, -clamp.min_n);
        }
    }
    for clamp in &mut run.restraints {
        let forces = clamp.after_passes_n.iter_mut().chain(&mut clamp.during_passes_n);
        forces.for_each(|force| *force = -*force);
    }
    run
}

/// The scene at [`LENGTH`] times its size.
fn enlarged(mut scene: Scene) -> Scene {
    let (pressure, line_load) = (FORCE / (LENGTH * LENGTH), FORCE / LENGTH);
    let lengths = |lengths: &mut [&mut f64]| lengths.iter_mut().for_each(|length| **length *= LENGTH);
    let given = |values: &mut [&mut Option<f64>], factor: f64| {
        values
            .iter_mut()
            .filter_map(|value| value.as_mut())
            .for_each(|value| *value *= factor);
    };
    let duct = &mut scene.duct;
    lengths(&mut [&mut duct.length, &mut duct.depth, &mut duct.lateral_offset]);
    given(&mut [&mut duct.inner_diameter, &mut scene.cable.diameter], LENGTH);
    for section in &mut scene.route {
        given(&mut [&mut section.length, &mut section.bend_radius], LENGTH);
    }
    let ground = &mut scene.ground;
    given(
        &mut [
            &mut ground.rigid_base_depth,
            &mut ground.longitudinal_peak,
            &mut ground.vertical_peak,
        ],
        LENGTH,
    );
    for layer in &mut ground.layers {
        given(&mut [&mut layer.thickness], LENGTH);
        layer.young_modulus = match layer.young_modulus {
            Modulus::Uniform(modulus) => Modulus::Uniform(pressure * modulus),
            Modulus::Linear { top, bottom } => Modulus::Linear {
                top: pressure * top,
                bottom: pressure * bottom,
            },
        };
    }
    scene.cable.weight *= line_load;
    scene.cable.axial_stiffness *= FORCE;
    given(&mut [&mut scene.friction.shape_factor], 1.0 / LENGTH);
    for end in [&mut scene.ends.upstream, &mut scene.ends.downstream] {
        if let End::Spring(stiffness) = end {
            *stiffness *= line_load;
        }
    }
    for clamp in &mut scene.restraints {
        clamp.position *= LENGTH;
        clamp.stiffness *= line_load;
        given(&mut [&mut clamp.holds], FORCE);
    }
    for vehicle in &mut scene.vehicles {
        vehicle.speed *= LENGTH / TIME;
        vehicle.lateral_offset *= LENGTH;
        given(&mut [&mut vehicle.load], FORCE);
        for wheel in &mut vehicle.wheels {
            lengths(&mut [&mut wheel.x, &mut wheel.y, &mut wheel.contact_radius]);
            wheel.load *= FORCE;
        }
    }
    let solver = &mut scene.solver;
    given(
        &mut [
            &mut solver.node_spacing,
            &mut solver.vehicle_step,
            &mut solver.approach,
        ],
        LENGTH,
    );
    given(&mut [&mut solver.time_step], TIME);
    scene
}

/// What the scene itself answers, from the answer of the larger one.
fn reduced(run: &Run) -> Run {
    let mut answer = serde_json::to_value(run).expect("numbers and texts");
    reduce("", &mut answer);
    serde_json::from_value(answer).expect("the same fields")
}

/// Divides forces and lengths, by the units in which their names end; other numbers are not compared.
fn reduce(name: &str, value: &mut Value) {
    match value {
        Value::Object(entries) => entries.iter_mut().for_each(|(name, value)| reduce(name, value)),
        Value::Array(items) => items.iter_mut().for_each(|item| reduce(name, item)),
        Value::Number(number) => {
            let factor = match name.rsplit_once('_') {
                Some((_, "n")) => FORCE,
                Some((before, "m")) if !before.ends_with("per") => LENGTH,
                _ => return,
            };
            *value = (number.as_f64().unwrap_or(f64::NAN) / factor).into();
        }
        _ => {}
    }
}
