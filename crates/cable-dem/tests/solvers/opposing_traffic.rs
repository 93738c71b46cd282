//! Equal opposing traffic between two fixed ends creeps nowhere on average.

use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh};

use super::harness::{AXIAL_STIFFNESS, Kind, LIMITS, Outcome, Problem, Run, sheathed, truck};

/// Each state after a forward pass is the mirror image of the one after the next reverse pass, once both directions have
/// wiped out how it began.
#[test]
fn equal_opposing_traffic_between_fixed_ends_creeps_nowhere_on_average() -> Outcome {
    let truck = truck()?;
    let length = 15.0;
    for law in [FrictionLaw::Coulomb, sheathed(LIMITS[0])] {
        let problem = Problem {
            cable: DuctedCable::new(length, AXIAL_STIFFNESS, Friction::new(law, LIMITS[0])?)?
                .with_ends(End::Fixed, End::Fixed)?,
            mesh: Mesh::new(length, 0.25, 0.125)?,
            drives: vec![truck.clone(), truck.back()],
        };
        for kind in Kind::ALL {
            let mean = |run: &Run| run.state.displacement().iter().sum::<f64>() / problem.mesh.nodes() as f64;
            let mut one_way = Run::new(kind, &problem)?;
            one_way.passes(40)?;
            let mut both = Run::new(kind, &problem)?;
            let (mut creep, mut forward) = (0.0, 0.0);
            for _ in 0..20 {
                both.pass(0)?;
                forward = mean(&both);
                both.pass(1)?;
                creep = 0.5 * (forward + mean(&both));
            }
            println!(
                "{} {kind:?}: {creep:.1e} m, after each pass ±{forward:.1e} m, one way {:.1e} m",
                law.name(),
                mean(&one_way)
            );
            assert!(mean(&one_way) > 1e-5, "{kind:?}");
            assert!(
                creep.abs() < 1e-3 * mean(&one_way),
                "{} {kind:?}: {creep} m of {} m",
                law.name(),
                mean(&one_way)
            );
        }
    }
    Ok(())
}
