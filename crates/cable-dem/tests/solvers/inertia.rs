//! What inertia does.

use cable_dem::inertia_ratio;

use super::harness::{Bar, Kind, MASS, Outcome, Run, UPPER, assert_near, truck};

/// Accuracy of the explicit solver on these meshes, whose nodes swing as they are passed, at v/h a second.
const LATTICE: f64 = 5e-3;

/// Near the vehicle inertia softens the cable by v²/c²: the force is smaller by a part of that share, a third to a half.
#[test]
fn the_inertia_ratio_predicts_what_leaving_inertia_out_costs() -> Outcome {
    for (speed, spacing) in [(100.0, 0.1), (300.0, 0.05), (1000.0, 0.05)] {
        let bar = Bar {
            mesh: (spacing, 0.5 * spacing),
            ..UPPER
        };
        let problem = bar.under(&truck().at(speed / 3.6))?;
        let force = |kind| {
            Run::new(kind, &problem)?
                .passes(3)
                .map(|pass| pass.outcome.force.downstream)
        };
        let found = force(Kind::Explicit)? / force(Kind::QuasiStatic)? - 1.0;
        let ratio = inertia_ratio(&problem.cable, MASS, speed / 3.6)?;
        assert!(found < LATTICE && found > -ratio - LATTICE, "{found} {ratio}");
        assert_near(-found / ratio, 0.37, 0.12 + LATTICE / ratio, speed);
    }
    Ok(())
}
