//! What inertia does.

use crate::common::{MASS, Outcome, STIFF_SHEATH, Scene, relative, truck};
use cable_dem::{ExplicitOptions, inertia_ratio};

/// Accuracy of the explicit solver on these meshes, whose nodes swing as they are passed, at v/h a second.
const LATTICE: f64 = 5e-3;

/// Near the vehicle inertia softens the cable by v²/c²: the force is smaller by a part of that share, a third to a half.
#[test]
fn the_inertia_ratio_predicts_what_leaving_inertia_out_costs() -> Outcome {
    for (speed, spacing) in [(100.0, 0.1), (300.0, 0.05), (1000.0, 0.05)] {
        let scene = Scene::thirty_metres(STIFF_SHEATH, spacing, &truck(speed)?)?;
        let without = scene.quasi_static(3)?.force.downstream;
        let with = scene.explicit(3, ExplicitOptions::default())?;
        let ratio = inertia_ratio(&scene.cable, MASS, speed / 3.6)?;
        let found = relative(with.pass.force.downstream, without);
        println!(
            "{speed} km/h: ratio {ratio:.2e}, found {found:+.2e}, share {:.2}",
            -found / ratio
        );
        assert!(
            found < LATTICE && found > -ratio - LATTICE,
            "{speed} km/h: {found} {ratio}"
        );
        assert!(
            (-found / ratio - 0.37).abs() < 0.12 + LATTICE / ratio,
            "{speed} km/h: {found} {ratio}"
        );
    }
    Ok(())
}
