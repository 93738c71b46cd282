//! With guards on no cell of the cable's stability maps is wrong: coarse grids of the maps that are drawn.

use creepage::scene::SolverMethod;
use creepage_validation::Failure;
use creepage_validation::map::{Cell, Grid, Outcome};
use creepage_validation::stability::{bends, explicit, heat, implicit, long_term, sections};

/// Methods in a map: without guards, and with them.
const BARE: usize = 0;
const GUARDED: usize = 1;

type Tested = Result<(), Failure>;

/// Asserts that guards leave nothing wrong, that without them something is, and that they do not refuse everything.
fn assert_guarded(name: &str, map: &Grid<[Cell; 2]>) {
    let [bare, guarded] = [BARE, GUARDED].map(|method| map.summary(method));
    assert_eq!(map.count(GUARDED, Outcome::Wrong), 0, "{name}: {guarded}");
    assert!(map.count(BARE, Outcome::Wrong) > 0, "{name}: {bare}");
    assert!(map.count(GUARDED, Outcome::Right) > 0, "{name}: {guarded}");
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn the_explicit_solver_is_right_or_says_that_it_is_not() -> Tested {
    for law in [explicit::Law::ElasticPlastic, explicit::Law::Sigmoid] {
        let map = explicit::over_shape_factor(law, 4, 4)?;
        assert_guarded(&format!("{law:?}"), &map);
        // Guards refuse what may be wrong, not what is right, but for cells at the limits.
        assert!(4 * map.count(GUARDED, Outcome::Right) >= 3 * map.count(BARE, Outcome::Right));
    }
    assert_guarded("speed", &explicit::over_speed(explicit::Law::Sigmoid, 4, 2)?);
    Ok(())
}

#[test]
fn the_quasi_static_solver_is_right_where_plain_newton_cycles() -> Tested {
    let map = implicit::map(0, 4)?;
    assert_guarded("implicit", &map);
    // Steps of 0.8 m, two thirds of the depth, leave out most of the duct's motion: that row alone is refused.
    let [refused, right] = [Outcome::Refused, Outcome::Right].map(|outcome| map.count(GUARDED, outcome));
    assert_eq!(refused, map.x.len(), "{}", map.summary(GUARDED));
    assert_eq!(right + refused, map.cells.len(), "{}", map.summary(GUARDED));
    let coarsest = &map.cells[map.cells.len() - refused..];
    assert!(
        coarsest
            .iter()
            .all(|cell| cell[GUARDED].outcome == Outcome::Refused)
    );
    Ok(())
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn jumps_over_passes_are_right_or_say_that_they_are_not() -> Tested {
    let mut unguarded = 0;
    for (name, mix) in long_term::MIXES {
        let map = long_term::map(mix, 2, 3, true)?;
        let told = || format!("{name}: {}", map.summary(GUARDED));
        unguarded += map.count(BARE, Outcome::Wrong);
        assert_eq!(map.count(GUARDED, Outcome::Wrong), 0, "{}", told());
        // Near shakedown what is left depends on the way to it: one cell may say so.
        assert!(
            map.count(GUARDED, Outcome::Right) + 1 >= map.cells.len(),
            "{}",
            told()
        );
        // The map that is drawn: the jumps' own guards, without the program's.
        let own = long_term::map(mix, 2, 2, false)?;
        assert_eq!(own.count(GUARDED, Outcome::Right), own.cells.len(), "{name}");
    }
    // Without guards some traffic is computed wrong.
    assert!(unguarded > 0);
    Ok(())
}

/// Mesh and passes are the same, so that only what days not simulated leave counts.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn days_of_heat_are_right_or_say_that_they_are_not() -> Tested {
    let (mut few, mut all) = (0, 0);
    for case in heat::CASES {
        let map = case.map(2, 2, 3)?;
        let [right, whole] =
            [heat::Outcome::Right, heat::Outcome::RightWhole].map(|is| heat::count(&map, is));
        assert_eq!(right + whole, map.cells.len(), "{}", case.lines(&map));
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

/// Where a bend is so tight that it counts with which force the cable presses on it, the stated error holds that too.
#[test]
fn what_the_force_of_the_step_before_costs_in_a_bend_is_stated() -> Tested {
    let map = bends::map(2, 2, bends::STIFFNESSES[1])?;
    let [rough_and_tight, wide] = [map.cells[2].error, map.cells[3].error];
    assert!(rough_and_tight > 0.02 && wide < 1e-4, "{rough_and_tight} {wide}");
    let run = |tolerance| -> Result<_, creepage_validation::Failure> {
        let mut scene = bends::scene(1.6, 1.0, bends::STIFFNESSES[1], 1.0)?;
        (scene.solver.node_spacing, scene.solver.vehicle_step) = (None, None);
        (scene.solver.tolerance, scene.traffic.passes) = (tolerance, 5);
        Ok(creepage::run(&scene)?)
    };
    let (found, finer) = (run(0.05)?, run(0.01)?);
    let forces = [&found, &finer].map(|run| run.passes[4].downstream_force_n);
    let (off, stated) = (forces[0] / forces[1] - 1.0, found.error_estimate.relative);
    assert!(off > 0.01 && off < stated, "{off} {stated}");
    Ok(())
}

/// Where a section locks the cable, the coarse mesh that other friction may do with is refined.
#[test]
fn a_section_that_locks_the_cable_is_refined() -> Tested {
    let map = sections::map(3, 3)?;
    let [least, usual] = [0, 1].map(|ratio| map.cells[3 + ratio].error);
    assert!(least < 1.4e-2 && usual < 1.4e-2, "{least} {usual}");
    let key = format!("dynamic_coefficient = {}", map.x[2] * map.y[1]);
    let mut scene = bends::duct(&key, map.y[1], bends::STIFFNESSES[0], bends::NODES, 1.0)?;
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (None, None);
    scene.solver.tolerance = 0.01;
    let run = creepage::run(&scene)?;
    let (spacing, stated) = (run.plan.node_spacing_m, run.error_estimate.relative);
    assert!(
        spacing < 0.25 * 1.2 / bends::NODES && stated <= 0.01,
        "{spacing} {stated}"
    );
    Ok(())
}
