//! A very stiff end spring is a fixed end, for the peak of its force as for the force after the pass.

use cable_dem::{CableError, End, FrictionLaw};

use super::harness::{AXIAL_STIFFNESS, Bar, Kind, LIMITS, Outcome, Run, SHEATH, UPPER, assert_near, truck};

#[test]
fn stiff_springs_read_what_a_fixed_end_reads() -> Outcome {
    let truck = truck();
    for law in [FrictionLaw::Coulomb, SHEATH] {
        let bar = Bar {
            length: 15.0,
            law,
            ..UPPER
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
        let is_rigid = law == FrictionLaw::Coulomb;
        let undetermined = if is_rigid { bar.mesh.0 * LIMITS[0] } else { 0.0 };
        for stiffness in [1e8, 1e9, 1e10, 1e12] {
            let end = End::Spring(stiffness);
            let reference = force_and_peak(Kind::QuasiStatic, end)?;
            // What the spring yields relative to a metre of cable.
            let yielding = AXIAL_STIFFNESS / stiffness;
            for kind in Kind::ALL {
                // An explicit step of a microsecond is no use.
                if kind == Kind::Explicit && stiffness > 1e9 {
                    continue;
                }
                let [force, peak] = force_and_peak(kind, end)?;
                let yielded = 0.005 + yielding;
                for (found, expected, allowed) in [
                    (force, reference[0], 0.005 * reference[0]),
                    (peak, reference[1], 0.005 * reference[1]),
                    (force, fixed[0], yielded * fixed[0] + undetermined),
                    (peak, fixed[1], yielded * fixed[1]),
                ] {
                    assert_near(found, expected, allowed, (law, stiffness, kind));
                }
            }
        }
    }
    Ok(())
}
