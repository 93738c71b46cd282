//! A very stiff end spring is a fixed end, for the peak of its force as for the force after the pass.

use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh};

use super::harness::{AXIAL_STIFFNESS, Drive, Kind, LIMITS, Outcome, Problem, Run, sheathed, truck};

/// Node spacing \[m\].
const SPACING: f64 = 0.2;

/// Second pass of a truck over 15 m of duct: force and peak at the downstream end.
fn force_and_peak(
    kind: Kind,
    law: FrictionLaw,
    downstream: End,
    truck: &Drive,
) -> Result<[f64; 2], cable_dem::CableError> {
    let problem = Problem {
        cable: DuctedCable::new(15.0, AXIAL_STIFFNESS, Friction::new(law, LIMITS[0])?)?
            .with_ends(End::Free, downstream)?,
        mesh: Mesh::new(15.0, SPACING, 0.5 * SPACING)?,
        drives: vec![truck.clone()],
    };
    let outcome = Run::new(kind, &problem)?.passes(2)?.outcome;
    Ok([outcome.force.downstream, outcome.peak.downstream])
}

#[test]
fn stiff_springs_read_what_a_fixed_end_reads() -> Outcome {
    let truck = truck()?;
    let mut failures = Vec::new();
    for law in [FrictionLaw::Coulomb, sheathed(LIMITS[0])] {
        let fixed = force_and_peak(Kind::QuasiStatic, law, End::Fixed, &truck)?;
        // At rest, Coulomb's law lets the friction on the last half element be anything from −q to q.
        let undetermined = if law == FrictionLaw::Coulomb {
            SPACING * LIMITS[0]
        } else {
            0.0
        };
        for stiffness in [1e8, 1e9, 1e10, 1e11, 1e12] {
            let end = End::Spring(stiffness);
            let reference = force_and_peak(Kind::QuasiStatic, law, end, &truck)?;
            // What the spring yields beside a metre of cable.
            let yielding = AXIAL_STIFFNESS / stiffness;
            for kind in Kind::ALL {
                // An explicit step of a microsecond is no use.
                if kind == Kind::Explicit && stiffness > 1e9 {
                    continue;
                }
                let [force, peak] = force_and_peak(kind, law, end, &truck)?;
                let name = format!("{} {stiffness:.0e} {kind:?}", law.name());
                println!("{name}: {force:.2} {peak:.2}, fixed {fixed:.2?}");
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
