//! States save and load, and a run goes on from them as if it had never stopped.

use cable_dem::{CableState, End, FrictionLaw, Mesh, Restraint};

use super::harness::{Bar, Kind, LIMITS, Outcome, Run, UPPER, sheathed, truck};

#[test]
fn a_run_resumed_from_a_saved_state_equals_a_straight_run() -> Outcome {
    let truck = truck();
    for law in [
        FrictionLaw::Coulomb,
        sheathed(LIMITS[1]),
        FrictionLaw::Sigmoid { shape_factor: 1e9 },
    ] {
        let bar = Bar {
            length: 6.0,
            law,
            limit: LIMITS[1],
            ends: (End::Spring(1e6), End::Fixed),
            mesh: (0.25, 0.125),
            ..UPPER
        };
        let mut problem = bar.under(&truck)?;
        problem.cable = problem.cable.with_restraints(vec![Restraint::new(4.1, 1e6)])?;
        for kind in Kind::for_law(law) {
            let name = format!("{} {kind:?}", law.name());
            let mut straight = Run::new(kind, &problem)?;
            for drive in [0, 1, 0] {
                straight.pass(drive)?;
            }
            let saved = serde_json::to_string(&straight.state)?;
            let loaded: CableState = serde_json::from_str(&saved)?;
            // Digit for digit.
            assert_eq!(loaded, straight.state, "{name}");

            let mut resumed = Run::resumed(kind, &problem, loaded)?;
            for drive in [1, 0, 0] {
                let (one, other) = (straight.pass(drive)?, resumed.pass(drive)?);
                assert_eq!(one.energy, other.energy, "{name}");
                assert_eq!(one.outcome.peak, other.outcome.peak, "{name}");
                // A pass is a function of the state and the passage, whatever passed before.
                assert_eq!(straight.state, resumed.state, "{name}");
            }
            let coarse = CableState::at_rest(&Mesh::new(6.0, 3.0, 3.0)?);
            assert!(Run::resumed(kind, &problem, coarse)?.pass(0).is_err(), "{name}");
        }
    }
    Ok(())
}
