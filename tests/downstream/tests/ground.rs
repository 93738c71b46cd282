//! The stranger's ground below a duct, a cable and a whole scene.

use creepage::ground_field::{
    Direction, DuctLine, DuctMotion, GroundError, GroundField, SurfaceLoad, Vehicle,
};
use downstream::{BoxError, JointForce, MeasuredGround};

/// 196 133 N on 0.5 as Poisson's ratio: c = 3P/(4πE).
const FORCE: f64 = 196_133.0;

fn uniform() -> Result<MeasuredGround, GroundError> {
    MeasuredGround::new(vec![(0.0, 300e6)])
}

fn borehole() -> Result<MeasuredGround, GroundError> {
    MeasuredGround::new(vec![(0.0, 150e6), (0.8, 220e6), (1.6, 300e6), (4.0, 500e6)])
}

/// One soil is Boussinesq's half-space, whatever depths its table names.
#[test]
fn a_table_of_one_modulus_is_a_half_space() -> Result<(), GroundError> {
    let divided = MeasuredGround::new(vec![(0.0, 300e6), (1.0, 300e6), (3.0, 300e6)])?;
    let load = SurfaceLoad::point(FORCE)?;
    let scale = 3.0 * FORCE / (4.0 * std::f64::consts::PI * 300e6);
    for (radius, depth) in [(0.0_f64, 1.2_f64), (0.85, 1.2), (5.0, 0.5), (2.0, 4.0)] {
        let distance = radius.hypot(depth);
        let moved = divided.displacement(load, radius, depth)?;
        let down = scale * (depth * depth / distance.powi(3) + 1.0 / distance);
        let across = scale * radius * depth / distance.powi(3);
        assert!((moved.vertical - down).abs() < 1e-12 * down);
        assert!((moved.radial - across).abs() <= 1e-12 * down);
    }
    Ok(())
}

#[test]
fn bad_tables_and_places_are_refused() -> Result<(), GroundError> {
    for table in [
        vec![],
        vec![(0.5, 1e8)],
        vec![(0.0, f64::NAN)],
        vec![(0.0, 1e8), (0.0, 1e8)],
        vec![(0.0, 1e8), (f64::NAN, 1e8)],
    ] {
        assert!(MeasuredGround::new(table).is_err());
    }
    let load = SurfaceLoad::point(1.0)?;
    let singular = uniform()?.displacement(load, 0.0, 0.0);
    assert!(matches!(singular, Err(GroundError::Singular { .. })));
    assert!(uniform()?.displacement(load, f64::NAN, 1.0).is_err());
    Ok(())
}

/// u_r = c r z/R³ is largest at r = z/√2, where it is c·2/(3√3 z); the opposite lane mirrors it.
#[test]
fn a_duct_moves_by_the_strangers_ground() -> Result<(), GroundError> {
    let depth = 1.2;
    let line = DuctLine::new(depth, 0.0)?;
    let truck = Vehicle::point("truck", FORCE, 11.1)?;
    let motion = DuctMotion::new(&uniform()?, &truck, line, 30.0, 1e-6)?;
    let scale = 3.0 * FORCE / (4.0 * std::f64::consts::PI * 300e6);
    let largest = scale * 2.0 / (3.0 * 3.0_f64.sqrt() * depth);
    assert!((motion.peak_longitudinal() / largest - 1.0).abs() < 1e-5);
    assert!((motion.peak_vertical() / (2.0 * scale / depth) - 1.0).abs() < 1e-5);

    let boxed: Box<dyn GroundField> = Box::new(uniform()?);
    let reverse = truck.driving(Direction::Reverse);
    let mirrored = DuctMotion::new(&boxed, &reverse, line, 30.0, 1e-6)?;
    assert!((mirrored.longitudinal(0.7) - motion.longitudinal(0.7)).abs() < 1e-5 * largest);
    assert!((mirrored.longitudinal_velocity(2.0) + motion.longitudinal_velocity(2.0)).abs() < 1e-9);
    Ok(())
}

/// With friction and ground held, a stiffer ground presses less on the joint, and friction bounds the force by μ w L.
#[test]
fn a_cable_creeps_on_the_strangers_ground() -> Result<(), BoxError> {
    let joint = JointForce::new(&borehole()?, vec![1, 5, 20])?;
    let soft = joint.forces(0.25, 1.0)?;
    let stiff = joint.forces(0.25, 2.0)?;
    assert!(
        soft[0] > 10.0 && soft[1] > soft[0] && soft[2] > soft[1],
        "{soft:?}"
    );
    assert!(
        soft.iter().zip(&stiff).all(|(soft, stiff)| soft > stiff),
        "{soft:?} {stiff:?}"
    );
    assert!(soft[2] < 0.25 * 108.8 * 20.0);
    Ok(())
}

const SCENE: &str = r#"
title = "A stranger's scene"
[duct]
length = "20 m"
depth = "1.2 m"
[[ground.layers]]
young_modulus = "300 MPa"
poisson_ratio = 0.5
[cable]
weight = "108.8 N/m"
axial_stiffness = "8.01e6 N"
[friction]
law = "elastic-plastic"
dynamic_coefficient = 0.25
shape_factor = "7.352941e6 1/m"
[ends]
upstream = "free"
downstream = "fixed"
[[vehicles]]
name = "truck"
speed = "40 km/h"
load = "20 tf"
[traffic]
passes = 10
"#;

/// The scene's own ground is the same half-space: both runs have to agree, and with the stranger's chain of calls too.
#[test]
fn a_scene_runs_on_the_strangers_ground() -> Result<(), BoxError> {
    let scene = creepage::Scene::from_toml("stranger.toml", SCENE)?;
    let own = uniform()?;
    let options = creepage::RunOptions {
        ground: Some(&own),
        ..Default::default()
    };
    let theirs = creepage::run_with(&scene, &options)?;
    let ours = creepage::run(&scene)?;
    for (a, b) in theirs.passes.iter().zip(&ours.passes) {
        let difference = (a.downstream_force_n - b.downstream_force_n).abs();
        assert!(
            difference < 2e-3 * ours.passes[9].downstream_force_n,
            "{a:?}\n{b:?}"
        );
    }
    let direct = JointForce::new(&own, vec![10])?.forces(0.25, 1.0)?[0];
    assert!(
        (direct / theirs.passes[9].downstream_force_n - 1.0).abs() < 0.02,
        "{direct} N"
    );

    let soft_top = borehole()?;
    let options = creepage::RunOptions {
        ground: Some(&soft_top),
        ..Default::default()
    };
    let on_table = creepage::run_with(&scene, &options)?;
    // Soil 1.36 times softer at the duct's depth: more from the first pass on, which friction levels off later.
    let ratio = |pass: usize| on_table.passes[pass].downstream_force_n / ours.passes[pass].downstream_force_n;
    assert!(ratio(0) > 1.05 && ratio(0) < 1.4, "{}", ratio(0));
    assert!(ratio(9) > 1.0 && ratio(9) < ratio(0), "{} {}", ratio(9), ratio(0));
    Ok(())
}
