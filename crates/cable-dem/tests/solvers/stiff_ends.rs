//! A very stiff end spring is a fixed end, for the peak of its force as for the force after the pass; and equal traffic both ways between two
//! fixed ends creeps nowhere.

use cable_dem::{CableError, End, FrictionLaw};

use super::harness::{AXIAL_STIFFNESS, Bar, Kind, LIMITS, Outcome, Run, SHEATH, truck};

#[test]
fn stiff_springs_read_what_a_fixed_end_reads() -> Outcome {
    let truck = truck()?;
    let mut failures = Vec::new();
    for law in [FrictionLaw::Coulomb, SHEATH] {
        let bar = Bar {
            length: 15.0,
            law,
            ..Bar::default()
        };
        // In the second pass.
        let force_and_peak = |kind: Kind, downstream: End| -> Result<[f64; 2], CableError> {
            let ends = (End::Free, downstream);
            let problem = Bar { ends, ..bar }.under(&truck)?;
            let outcome = Run::new(kind, &problem)?.passes(2)?.outcome;
            Ok([outcome.force.downstream, outcome.peak.downstream])
        };
        let fixed = force_and_peak(Kind::QuasiStatic, End::Fixed)?;
        // At rest, Coulomb's law lets the friction on the last half element be anything from −q to q.
        let undetermined = if law == FrictionLaw::Coulomb {
            bar.mesh.0 * LIMITS[0]
        } else {
            0.0
        };
        for stiffness in [1e8, 1e9, 1e10, 1e11, 1e12] {
            let end = End::Spring(stiffness);
            let reference = force_and_peak(Kind::QuasiStatic, end)?;
            // What the spring yields beside a metre of cable.
            let yielding = AXIAL_STIFFNESS / stiffness;
            for kind in Kind::ALL {
                // An explicit step of a microsecond is no use.
                if kind == Kind::Explicit && stiffness > 1e9 {
                    continue;
                }
                let [force, peak] = force_and_peak(kind, end)?;
                let name = format!("{} {stiffness:.0e} {kind:?}", law.name());
                for (found, expected, allowed) in [
                    (force, reference[0], 0.005 * reference[0]),
                    (peak, reference[1], 0.005 * reference[1]),
                    (force, fixed[0], (0.005 + yielding) * fixed[0] + undetermined),
                    (peak, fixed[1], (0.005 + yielding) * fixed[1]),
                ] {
                    let error = (found - expected).abs();
                    if error > allowed || error.is_nan() {
                        failures.push(format!("{name}: {found} N, not {expected} N"));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// Each state after a forward pass is the mirror image of the one after the next reverse pass, once both directions have wiped out how it
/// began.
#[test]
fn equal_opposing_traffic_between_fixed_ends_creeps_nowhere_on_average() -> Outcome {
    let truck = truck()?;
    for law in [FrictionLaw::Coulomb, SHEATH] {
        let bar = Bar {
            length: 15.0,
            law,
            ends: (End::Fixed, End::Fixed),
            mesh: (0.25, 0.125),
            ..Bar::default()
        };
        let problem = bar.under(&truck)?;
        for kind in Kind::ALL {
            let mean = |run: &Run| run.state.displacement().iter().sum::<f64>() / problem.mesh.nodes() as f64;
            let mut one_way = Run::new(kind, &problem)?;
            one_way.passes(40)?;
            let mut both = Run::new(kind, &problem)?;
            let mut creep = 0.0;
            for _ in 0..20 {
                both.pass(0)?;
                let forward = mean(&both);
                both.pass(1)?;
                creep = 0.5 * (forward + mean(&both));
            }
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
