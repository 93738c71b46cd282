//! With guards on no cell of the cable's stability maps is wrong: coarse grids of the maps that `examples/stability` draws.

#[path = "../examples/shared/cable_map.rs"]
#[allow(dead_code, reason = "the example draws what the test only counts")]
mod cable_map;
#[path = "../examples/stability/explicit.rs"]
#[allow(dead_code, reason = "the example draws what the test only counts")]
mod explicit;
#[path = "../examples/stability/heat.rs"]
#[allow(dead_code, reason = "the example draws what the test only counts")]
mod heat;
#[path = "../examples/stability/implicit.rs"]
#[allow(dead_code, reason = "the example draws what the test only counts")]
mod implicit;
#[path = "../examples/stability/long_term.rs"]
#[allow(dead_code, reason = "the example draws what the test only counts")]
mod long_term;

#[path = "../examples/stability/sigmoid.rs"]
mod sigmoid;

use cable_map::{Grid, Outcome};
use creepage::scene::SolverMethod;

type Tested = Result<(), Box<dyn std::error::Error>>;

/// Asserts that guards leave nothing wrong, that without them something is, and that they do not refuse everything.
fn assert_guarded(name: &str, [bare, guarded]: &[Grid; 2]) {
    assert_eq!(guarded.count(Outcome::Wrong), 0, "{name}: {}", guarded.csv(name));
    assert!(bare.count(Outcome::Wrong) > 0, "{name}: {}", bare.summary());
    assert!(guarded.count(Outcome::Right) > 0, "{name}: {}", guarded.summary());
}

#[test]
fn the_explicit_solver_is_right_or_says_that_it_is_not() -> Tested {
    for law in [explicit::Law::ElasticPlastic, explicit::Law::Sigmoid] {
        let grids = explicit::over_shape_factor(law, 5, 5)?;
        assert_guarded(&format!("{law:?}"), &grids);
        // Guards refuse what may be wrong, not what is right, but for cells at the limits.
        let [bare, guarded] = grids;
        assert!(4 * guarded.count(Outcome::Right) >= 3 * bare.count(Outcome::Right));
    }
    let grids = explicit::over_speed(explicit::Law::Sigmoid, 4, 2)?;
    assert_guarded("speed", &grids);
    Ok(())
}

#[test]
fn the_quasi_static_solver_is_right_where_plain_newton_cycles() -> Tested {
    let grids = implicit::maps(0, 4)?;
    assert_guarded("implicit", &grids);
    let [_, library] = grids;
    // Steps of 0.8 m, two thirds of the depth, leave out most of the duct's motion: that row alone is refused.
    let (refused, right) = (library.count(Outcome::Refused), library.count(Outcome::Right));
    assert_eq!(refused, library.x.len(), "{}", library.summary());
    assert_eq!(right + refused, library.cells.len(), "{}", library.summary());
    let coarsest = &library.cells[library.cells.len() - refused..];
    assert!(coarsest.iter().all(|cell| cell.outcome == Outcome::Refused));
    Ok(())
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn jumps_over_passes_are_right_or_say_that_they_are_not() -> Tested {
    let mut unguarded = 0;
    for (name, mix) in long_term::MIXES {
        let [bare, guarded] = long_term::maps(mix, 3, 4, true)?;
        unguarded += bare.count(Outcome::Wrong);
        assert_eq!(guarded.count(Outcome::Wrong), 0, "{name}: {}", guarded.csv(name));
        // Near shakedown what is left depends on the way to it: one cell may say so.
        let right = guarded.count(Outcome::Right);
        assert!(right + 1 >= guarded.cells.len(), "{name}: {}", guarded.csv(name));
    }
    // Without guards some traffic is computed wrong.
    assert!(unguarded > 0);
    Ok(())
}

/// Mesh and passes are the same, so that only what days not simulated leave counts.
#[test]
fn days_of_heat_are_right_or_say_that_they_are_not() -> Tested {
    let (mut few, mut all) = (0, 0);
    for case in heat::CASES {
        let map = case.map(2, 2, 4)?;
        let right = map.count(heat::Outcome::Right);
        let whole = map.count(heat::Outcome::RightWhole);
        assert_eq!(right + whole, map.cells.len(), "{}", map.csv(case.name));
        few += right;
        all += map.cells.len();
    }
    // Not by simulating every pass.
    assert!(4 * few >= all, "{few} of {all}");
    Ok(())
}

/// The sequence of three vehicles goes on over midnight where every pass is simulated, and begins anew in days that follow from each other: that is
/// told, or not done.
#[test]
fn days_that_break_a_sequence_are_announced() -> Tested {
    for (per_day, broken) in [(51, false), (50, true)] {
        let [.., mut case] = heat::CASES;
        case.per_day = per_day;
        let mut scene = case.scene(0.1, 5.0, 4)?;
        let mut said = |method| -> Result<bool, creepage::Error> {
            scene.solver.method = method;
            let run = creepage::run(&scene)?;
            let told = run
                .warnings
                .iter()
                .any(|warning| warning.contains("whole number"));
            // Where another beginning of the day changes too much for an answer, every pass is simulated.
            let after_all = run
                .plan
                .reasons
                .iter()
                .any(|reason| reason.contains("simulated after all"));
            Ok(told || after_all)
        };
        assert_eq!(said(SolverMethod::PassLaw)?, broken, "{per_day} a day");
        assert!(!said(SolverMethod::QuasiStatic)?, "{per_day} a day");
    }
    Ok(())
}
