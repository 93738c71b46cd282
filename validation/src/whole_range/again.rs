//! The same scene once more, on far finer terms and seen in a mirror: what that says of the first answer.

use std::mem::swap;

use creepage::{PassRecord, Run, Scene};
use ground_field::Direction;

use super::judged::run;

/// By what factor the tolerance of the finer run is smaller.
const FINER: f64 = 4.0;
/// What friction holds on this length of cable counts as nothing \[m\].
const SHORT: f64 = 0.01;

/// How far the forces of an answer lie from those of other runs, by the measure of the stated error; `None` where such a run gives no answer in time.
#[derive(Clone, Copy, Default)]
pub struct Again {
    /// From those of a run that is to be [`FINER`] times as exact.
    pub finer: Option<f64>,
    /// From those of the same duct, looked at from its other side.
    pub mirror: Option<f64>,
}

/// What further runs of the scene `text` say of its answer.
pub fn again(text: &str) -> Option<Again> {
    let scene = Scene::from_toml("scene.toml", text).ok()?;
    let own = run(&scene).ok()?;
    let off = |other: Run| apart(&scene, &own, &other);
    let stated = own.error_estimate.relative.max(1e-3);
    let mut finer = scene.clone();
    finer.solver.tolerance = stated / FINER;
    // One that does not come to its tolerance proves nothing.
    let is_finer = |other: &Run| other.error_estimate.relative < 2.0 * stated / FINER;
    Some(Again {
        finer: run(&finer).ok().filter(is_finer).map(off),
        mirror: run(&mirrored(scene.clone())).ok().map(|mut run| {
            run.passes.iter_mut().for_each(turn);
            off(run)
        }),
    })
}

/// The scene as seen from the other side of the road, where left is right.
fn mirrored(mut scene: Scene) -> Scene {
    scene.duct.slope = -scene.duct.slope;
    swap(&mut scene.ends.upstream, &mut scene.ends.downstream);
    for clamp in &mut scene.restraints {
        clamp.position = scene.duct.length - clamp.position;
    }
    for of_traffic in &mut scene.vehicles {
        of_traffic.direction = match of_traffic.direction {
            Direction::Forward => Direction::Reverse,
            Direction::Reverse => Direction::Forward,
        };
    }
    scene
}

fn turn(pass: &mut PassRecord) {
    swap(&mut pass.upstream_force_n, &mut pass.downstream_force_n);
    swap(&mut pass.upstream_peak_n, &mut pass.downstream_peak_n);
    swap(&mut pass.upstream_least_n, &mut pass.downstream_least_n);
}

/// How far forces lie from those that another run finds: those on the ends and the largest in the cable, beside the largest of their pass or a tenth
/// of the largest of all; with heat those on the ends, beside the largest of all. So are those of a cable that is pulled more than it is pressed,
/// whose tension is known after the last pass only.
fn apart(scene: &Scene, own: &Run, other: &Run) -> f64 {
    let heated = scene.heat.is_some();
    let nothing = SHORT * scene.friction_limit();
    let forces = |pass: &PassRecord| {
        let inside = if heated { 0.0 } else { pass.max_compression_n };
        [pass.upstream_force_n, pass.downstream_force_n, inside]
    };
    let largest = |pass: &PassRecord| {
        let peaks = [pass.upstream_peak_n, pass.downstream_peak_n];
        let all = forces(pass).into_iter().chain(peaks);
        all.fold(nothing, |most, force| most.max(force.abs()))
    };
    let of_passes = other.passes.iter().map(largest).fold(nothing, f64::max);
    let along = &other.force_profile.force_n;
    let most = along.iter().fold(of_passes, |most, force| most.max(force.abs()));
    let least = if heated || most > of_passes {
        most
    } else {
        0.1 * most
    };
    let of_pass = |(own, other): (&PassRecord, &PassRecord)| {
        let pairs = forces(own).into_iter().zip(forces(other));
        let apart = pairs.fold(0.0_f64, |most, (own, other)| most.max((own - other).abs()));
        apart / largest(other).max(least).max(f64::MIN_POSITIVE)
    };
    own.passes
        .iter()
        .zip(&other.passes)
        .map(of_pass)
        .fold(0.0, f64::max)
}
