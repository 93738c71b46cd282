//! States save and load, and a run goes on from them as if it had never stopped.

use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint};

use super::harness::{AXIAL_STIFFNESS, Kind, LIMITS, Outcome, Problem, Run, sheathed, truck};

#[test]
fn a_run_resumed_from_a_saved_state_equals_a_straight_run() -> Outcome {
    let truck = truck()?;
    for law in [
        FrictionLaw::Coulomb,
        sheathed(LIMITS[1]),
        FrictionLaw::Sigmoid { shape_factor: 1e9 },
    ] {
        let clamp = Restraint::new(4.1, 1e6);
        let problem = Problem {
            cable: DuctedCable::new(12.0, AXIAL_STIFFNESS, Friction::new(law, LIMITS[1])?)?
                .with_ends(End::Spring(1e6), End::Fixed)?
                .with_restraints(vec![clamp])?,
            mesh: Mesh::new(12.0, 0.25, 0.125)?,
            drives: vec![truck.clone(), truck.back()],
        };
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
        }
    }
    Ok(())
}

#[test]
fn a_damaged_state_is_refused() -> Outcome {
    let mesh = Mesh::new(12.0, 2.0, 1.0)?;
    let saved = serde_json::to_string(&CableState::at_rest(&mesh))?;
    assert!(serde_json::from_str::<CableState>(&saved).is_ok());
    for damaged in [
        saved.replace("friction", "fiction"),
        saved.replacen("0.0", "null", 1),
        saved[..saved.len() - 2].to_owned(),
        saved.replacen("0.0,", "", 1),
    ] {
        assert!(serde_json::from_str::<CableState>(&damaged).is_err(), "{damaged}");
    }
    // One of a mesh of other fineness is the solver's to refuse.
    let problem = Problem {
        cable: DuctedCable::new(
            12.0,
            AXIAL_STIFFNESS,
            Friction::new(FrictionLaw::Coulomb, LIMITS[0])?,
        )?,
        mesh,
        drives: vec![truck()?],
    };
    let coarse = r#"{"node_spacing":6.0,"displacement":[0.0,0.0,0.0],"friction":[0.0,0.0,0.0]}"#;
    for kind in Kind::ALL {
        let state = serde_json::from_str(coarse)?;
        assert!(Run::resumed(kind, &problem, state)?.pass(0).is_err(), "{kind:?}");
    }
    Ok(())
}
