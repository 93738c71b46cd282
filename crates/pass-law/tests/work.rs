//! How much work the law does, in counts that do not depend on the machine.

mod common;

use common::{Outcome, TRUCK, cable, motion, resolution};
use ground_field::Direction::{Forward, Reverse};
use pass_law::PassLaw;

/// Cells, runs at the ends and steps for one vehicle, and for two in opposite directions, on short and long ducts.
#[test]
fn preparation_does_not_grow_with_the_duct_nor_steps_but_slowly_with_the_passes() -> Outcome {
    let one = vec![(motion(TRUCK, Forward)?, 1.0)];
    let two = vec![
        (motion(TRUCK, Forward)?, 2.0),
        (motion(0.6 * TRUCK, Reverse)?, 1.0),
    ];
    for traffic in [one, two] {
        let mut prepared = Vec::new();
        for length in [60.0, 300.0, 1000.0] {
            let law = PassLaw::new(&cable(length, 0.25, 108.8)?, &traffic, resolution()?)?;
            let preparation = law.preparation();
            // A table to 0.2 %: a dozen and a half values of the locked friction, each with three cells for advance and lag;
            // and a steady layer at each end in a hundred passes of every vehicle.
            let vehicles = traffic.len();
            assert!(preparation.cell_passes <= 60 * vehicles, "{preparation:?}");
            assert!(preparation.end_passes <= 170 * vehicles, "{preparation:?}");
            prepared.push(preparation);

            for exponent in [2, 4, 6, 9] {
                let work = law.run(&[10_u64.pow(exponent)])?.statistics;
                // The start takes its steps, and then every tenfold of passes as many as the last until it saturates.
                let steps = 65 + 25 * exponent as usize;
                assert!(work.steps <= steps, "{length} m, 1e{exponent}: {work:?}");
                assert!(work.rejected <= 12, "{length} m, 1e{exponent}: {work:?}");
                // Two stages of four iterations.
                let attempts = work.steps + work.rejected;
                assert!(work.newton_iterations <= 8 * attempts, "1e{exponent}: {work:?}");
            }
        }
        assert!(prepared.iter().all(|one| *one == prepared[0]), "{prepared:?}");
    }
    Ok(())
}
