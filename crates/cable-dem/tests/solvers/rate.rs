//! Rate independence, where it must hold, and its absence where it must not.

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw, Mesh, inertia_ratio};

use super::harness::{
    AXIAL_STIFFNESS, Drive, Kind, LIMITS, MASS, Outcome, Pass, Problem, Run, sheathed, truck,
};

/// What the second pass at `speed` does, with the vehicle in steps of at most `vehicle_step`.
fn second_pass(
    kind: Kind,
    law: FrictionLaw,
    truck: &Drive,
    speed: f64,
    (spacing, vehicle_step): (f64, f64),
) -> Result<Pass, CableError> {
    let cable = DuctedCable::new(15.0, AXIAL_STIFFNESS, Friction::new(law, LIMITS[0])?)?
        .with_ends(End::Free, End::Fixed)?;
    let problem = Problem {
        mesh: Mesh::new(15.0, spacing, vehicle_step)?,
        cable,
        drives: vec![Drive {
            speed,
            ..truck.clone()
        }],
    };
    Run::new(kind, &problem)?.passes(2)
}

/// Accuracy of the explicit solver at this spacing, whose nodes swing as they are passed, at v/h a second.
const LATTICE: f64 = 5e-3;

/// Exactly without inertia, to the inertia ratio with it.
#[test]
fn speed_changes_nothing_but_inertia() -> Outcome {
    let truck = truck()?;
    let force = |kind, law, speed| -> Result<f64, CableError> {
        Ok(second_pass(kind, law, &truck, speed, (0.1, 0.05))?
            .outcome
            .force
            .downstream)
    };
    for law in [FrictionLaw::Coulomb, sheathed(LIMITS[0])] {
        let cable = DuctedCable::new(15.0, AXIAL_STIFFNESS, Friction::new(law, LIMITS[0])?)?;
        for kind in Kind::ALL {
            let slow = force(kind, law, 2.0)?;
            assert!(slow > 100.0, "{slow}");
            for speed in [20.0 / 3.6, 30.0 / 3.6, 40.0 / 3.6, 30.0] {
                let found = force(kind, law, speed)? / slow - 1.0;
                let ratio = inertia_ratio(&cable, MASS, speed)?;
                println!(
                    "{} {kind:?} {speed:.1} m/s: {found:+.1e}, ratio {ratio:.1e}",
                    law.name()
                );
                let allowed = match kind {
                    Kind::QuasiStatic => 0.0,
                    Kind::Explicit => ratio + LATTICE,
                };
                assert!(found.abs() <= allowed, "{} {kind:?}: {found} {ratio}", law.name());
            }
        }
    }
    Ok(())
}

/// The sigmoid's slip is that of one time step, which the explicit solver ties to the mesh: half the speed holds on to less. Read before
/// the ground returns to rest, for which the law takes one step whatever the speed.
#[test]
fn the_sigmoid_depends_on_speed() -> Outcome {
    let truck = truck()?;
    let half_the_speed = |law| -> Result<f64, CableError> {
        let force = |speed| -> Result<f64, CableError> {
            let pass = second_pass(Kind::Explicit, law, &truck, speed, (0.2, 0.1))?;
            Ok(pass.before_rest.downstream)
        };
        Ok(force(5.5)? / force(11.0)?)
    };
    let with_sigmoid = half_the_speed(FrictionLaw::Sigmoid { shape_factor: 1e8 })?;
    let with_memory = half_the_speed(sheathed(LIMITS[0]))?;
    assert!(with_sigmoid < 0.95, "{with_sigmoid}");
    assert!((with_memory - 1.0).abs() < 0.01, "{with_memory}");
    Ok(())
}
