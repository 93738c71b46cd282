//! Ducts that slope, and routes of several sections: the cable's weight along the duct, by every solver.

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint, Section, laid};

use super::harness::{AXIAL_STIFFNESS, Kind, Outcome, Problem, Run, truck};
use super::mirrored::mirrored;

/// Weight per metre \[N/m\] and friction coefficient of the full-scale experiment's upper cable.
const WEIGHT: f64 = 108.8;
const FRICTION: f64 = 0.25;
/// q b/2 of its sheath \[N/m²\].
const SHEATH_STIFFNESS: f64 = 1e8;

/// The upper cable in a duct that rises by `slope` = tan θ: p = −w sin θ, N′ = w cos θ.
fn sloping(
    length: f64,
    slope: f64,
    sheathed: bool,
    (upstream, downstream): (End, End),
) -> Result<DuctedCable, CableError> {
    let angle = slope.atan();
    let limit = FRICTION * WEIGHT * angle.cos();
    let law = if sheathed {
        FrictionLaw::ElasticPlastic {
            shape_factor: 2.0 * SHEATH_STIFFNESS / limit,
        }
    } else {
        FrictionLaw::Coulomb
    };
    DuctedCable::new(length, AXIAL_STIFFNESS, Friction::new(law, limit)?)?
        .with_ends(upstream, downstream)?
        .with_body_force(-WEIGHT * angle.sin())
}

/// That cable under a load of 20 tf which comes either way, with nodes `spacing` apart.
fn problem(cable: DuctedCable, spacing: f64) -> Result<Problem, Box<dyn std::error::Error>> {
    let truck = truck()?;
    Ok(Problem {
        mesh: Mesh::new(cable.length(), spacing, 0.5 * spacing)?,
        cable,
        drives: vec![truck.clone(), truck.back()],
    })
}

/// Which vehicle comes as which pass.
type Traffic = fn(usize) -> usize;

/// Force at the load cell \[N\] after the pass of that number: reference solutions with an independent full-chain program.
const UPHILL: [(usize, f64); 5] = [(1, 80.28), (2, 109.09), (10, 212.8), (20, 281.15), (100, 364.24)];
const DOWNHILL: [(usize, f64); 5] = [(1, 121.2), (2, 168.32), (10, 346.1), (20, 469.39), (100, 689.84)];
/// Equal trucks by turns, forward first.
const BY_TURNS: [(usize, f64); 6] = [
    (1, 80.28),
    (2, -50.69),
    (10, -83.85),
    (20, -109.83),
    (199, -102.62),
    (200, -231.34),
];
/// Largest deviation from that program at the same spacing and step.
const DEVIATION: f64 = 0.003;

#[test]
fn forces_on_a_slope_are_those_of_an_independent_program() -> Outcome {
    let one_way = |_: usize| 0;
    let by_turns = |pass: usize| pass % 2;
    #[allow(clippy::type_complexity, reason = "slope, forces after passes, vehicles")]
    let cases: [(f64, &[(usize, f64)], Traffic); 3] = [
        (0.05, &UPHILL, one_way),
        (-0.05, &DOWNHILL, one_way),
        (0.05, &BY_TURNS, by_turns),
    ];
    for (slope, references, vehicle) in cases {
        let cable = sloping(30.0, slope, true, (End::Free, End::Fixed))?;
        let mut run = Run::new(Kind::QuasiStatic, &problem(cable, 0.1)?)?;
        let mut passed = 0;
        for &(pass, expected) in references {
            let mut force = 0.0;
            while passed < pass {
                force = run.pass(vehicle(passed))?.outcome.force.downstream;
                passed += 1;
            }
            println!("{slope}: {force:.2} N after pass {pass}, {expected}");
            assert!((force / expected - 1.0).abs() < DEVIATION, "{force} {expected}");
        }
    }
    Ok(())
}

/// The same program: between free ends equal traffic both ways lets the cable drift downhill.
#[test]
fn a_free_cable_drifts_downhill_as_in_an_independent_program() -> Outcome {
    let cable = sloping(60.0, 0.05, true, (End::Free, End::Free))?;
    let mut run = Run::new(Kind::QuasiStatic, &problem(cable, 0.1)?)?;
    for pass in 0..80 {
        run.pass(pass % 2)?;
    }
    let moved = 1e3 * run.state.displacement()[0];
    println!("{moved} mm");
    assert!((moved / -0.4661 - 1.0).abs() < DEVIATION, "{moved}");
    Ok(())
}

#[test]
fn where_friction_holds_the_cable_it_stays() -> Outcome {
    let slopes = [0.2, -0.1];
    let ends = [
        (End::Free, End::Free),
        (End::Fixed, End::Free),
        (End::Spring(1e6), End::Fixed),
    ];
    for (slope, ends, sheathed) in all(&slopes, &ends) {
        let cable = sloping(30.0, slope, sheathed, ends)?;
        let mesh = Mesh::new(30.0, 0.2, 0.1)?;
        let state = laid(&cable, &mesh)?;
        // Friction carries the weight along the duct but for what a sheath gives way beside an end that holds.
        let screened = cable.sections()[0].body_force.abs() * cable.screening_length();
        let (force, moved) = (
            state.end_forces(&cable)?,
            cable.sections()[0].body_force * cable.friction().compliance(),
        );
        for force in [force.upstream, force.downstream] {
            assert!(force.abs() <= 1.2 * screened + 1e-9, "{force} N, {screened} N");
        }
        let middle = state.displacement()[mesh.nodes() / 2];
        assert!(
            (middle - moved).abs() <= 1e-3 * moved.abs(),
            "{middle} m, {moved} m"
        );
        let needed = state.friction_share(&cable)? * cable.friction().limit();
        assert!(needed <= cable.sections()[0].body_force.abs() * (1.0 + 1e-6));
    }
    Ok(())
}

/// Every one with every other.
fn all<'a>(slopes: &'a [f64], ends: &'a [(End, End)]) -> impl Iterator<Item = (f64, (End, End), bool)> + 'a {
    let laws = |slope: f64, ends: (End, End)| [true, false].map(|sheathed| (slope, ends, sheathed));
    slopes
        .iter()
        .flat_map(move |&slope| ends.iter().flat_map(move |&ends| laws(slope, ends)))
}

/// Steeper than friction: (w sin θ − q) L on the lower end, or in the lower part of the chain of ends that hold it.
#[test]
fn what_friction_does_not_hold_rests_on_the_lower_end() -> Outcome {
    let length = 30.0;
    for slope in [0.4, -0.4] {
        for end in [End::Fixed, End::Spring(1e5)] {
            let ends = if slope > 0.0 {
                (end, End::Free)
            } else {
                (End::Free, end)
            };
            for sheathed in [false, true] {
                let cable = sloping(length, slope, sheathed, ends)?;
                let mesh = Mesh::new(length, 0.1, 0.05)?;
                let state = laid(&cable, &mesh)?;
                let force = state.end_forces(&cable)?;
                let lower = if slope > 0.0 {
                    force.upstream
                } else {
                    force.downstream
                };
                let limit = cable.friction().limit();
                let rest = (cable.sections()[0].body_force.abs() - limit) * length;
                // A sheath at a fixed end is not sheared: there no friction acts on the end's half element.
                let half = 0.5 * mesh.spacing() * limit;
                let off = if sheathed { half } else { 0.0 } + 1e-6 * rest;
                assert!(
                    (lower - rest).abs() <= off,
                    "{lower} N, {rest} N, {end:?}, {sheathed}"
                );
                if let End::Spring(stiffness) = end {
                    let node = if slope > 0.0 { 0 } else { mesh.elements() };
                    let carried = stiffness * state.displacement()[node].abs();
                    assert!((carried - rest).abs() < 1e-6 * rest, "{carried} N, {rest} N");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn without_friction_the_lower_ends_and_clamps_hold_the_weight() -> Outcome {
    let friction = Friction::new(FrictionLaw::Coulomb, 0.0)?;
    let clamp = Restraint::new(12.3, 2e5);
    let cable = DuctedCable::new(30.0, AXIAL_STIFFNESS, friction)?
        .with_ends(End::Spring(3e5), End::Fixed)?
        .with_restraints(vec![clamp])?
        .with_body_force(-40.0)?;
    let problem = problem(cable.clone(), 0.2)?;
    for kind in Kind::ALL {
        let mut run = Run::new(kind, &problem)?;
        let laid = run.state.clone();
        let force = run.pass(0)?.outcome.force;
        assert_eq!(run.state, laid);
        let clamps: f64 = run.state.restraint_forces(&cable)?.iter().sum();
        let carried = force.downstream - force.upstream + clamps;
        assert!((carried + 40.0 * 30.0).abs() < 1e-6, "{carried}");
    }
    Ok(())
}

#[test]
fn what_nothing_holds_is_an_error() -> Outcome {
    let cable = sloping(30.0, 0.3, true, (End::Free, End::Spring(0.0)))?;
    let mesh = Mesh::new(30.0, 0.2, 0.1)?;
    assert!(matches!(
        laid(&cable, &mesh),
        Err(CableError::NothingHolds { body_force, limit }) if -body_force > limit
    ));
    assert!(laid(&mirrored(&cable)?, &mesh).is_err());
    assert!(cable.with_body_force(f64::NAN).is_err());
    Ok(())
}

/// Seen in a mirror the duct slopes the other way, ends change places and traffic comes from the other side.
#[test]
fn the_mirror_image_of_a_slope_gives_the_mirror_image_of_the_answer() -> Outcome {
    for sheathed in [true, false] {
        let clamp = Restraint::new(4.0, 1e6);
        let cable =
            sloping(12.0, 0.08, sheathed, (End::Spring(2e6), End::Fixed))?.with_restraints(vec![clamp])?;
        let (here, there) = (problem(cable.clone(), 0.2)?, problem(mirrored(&cable)?, 0.2)?);
        for kind in Kind::ALL {
            let (mut one, mut other) = (Run::new(kind, &here)?, Run::new(kind, &there)?);
            for vehicle in [0, 1, 0] {
                let one = one.pass(vehicle)?.outcome;
                let other = other.pass(1 - vehicle)?.outcome;
                let scale = here.largest_force();
                for (a, b) in [
                    (one.force.upstream, other.force.downstream),
                    (one.force.downstream, other.force.upstream),
                    (one.max_compression, other.max_compression),
                    (one.peak.downstream, other.peak.upstream),
                ] {
                    assert!((a - b).abs() < 1e-5 * scale, "{kind:?}: {a} N, {b} N");
                }
            }
        }
    }
    Ok(())
}

/// Ends of all kinds, one way and both: little inertia, one answer, with balanced forces and energy.
#[test]
fn all_solvers_agree_on_slopes() -> Outcome {
    let clamp = Restraint::new(5.1, 1e6);
    for (slope, ends, clamps) in [
        (0.05, (End::Free, End::Fixed), vec![]),
        (-0.12, (End::Free, End::Spring(2e6)), vec![clamp]),
        (0.35, (End::Spring(1e6), End::Fixed), vec![]),
    ] {
        for sheathed in [true, false] {
            let cable = sloping(12.0, slope, sheathed, ends)?.with_restraints(clamps.clone())?;
            let problem = problem(cable.clone(), 0.2)?;
            let mut runs = Vec::new();
            for kind in Kind::ALL {
                runs.push(Run::new(kind, &problem)?);
            }
            for vehicle in [0, 0, 1] {
                let mut forces = Vec::new();
                for run in &mut runs {
                    let pass = run.pass(vehicle)?;
                    let needed = run.state.friction_share(&cable)?;
                    assert!(needed <= 1.0 + 1e-6, "{needed} of the limit");
                    if let Some(energy) = pass.energy {
                        let (unbalanced, returned) = (energy.unbalanced_share(), energy.returned_share());
                        assert!(unbalanced < 0.01 || energy.residual() > 0.0, "{energy:?}");
                        assert!(returned < 1e-3, "{energy:?}");
                    }
                    forces.push(pass.outcome.force);
                }
                println!("{slope} {sheathed}: {forces:?}");
                for force in &forces[1..] {
                    for (a, b) in [
                        (force.upstream, forces[0].upstream),
                        (force.downstream, forces[0].downstream),
                    ] {
                        assert!((a - b).abs() < 5e-3 * problem.largest_force(), "{forces:?}");
                    }
                }
            }
        }
    }
    Ok(())
}

/// The law without memory lets the cable slide: sooner or later its lower end carries all of it.
#[test]
fn under_the_sigmoid_law_the_whole_weight_reaches_the_lower_end() -> Outcome {
    let limit = FRICTION * WEIGHT;
    let law = FrictionLaw::Sigmoid { shape_factor: 1e6 };
    let cable = DuctedCable::new(6.0, AXIAL_STIFFNESS, Friction::new(law, limit)?)?
        .with_ends(End::Fixed, End::Free)?
        .with_body_force(-5.0)?;
    let problem = problem(cable, 0.2)?;
    let force = Run::new(Kind::Explicit, &problem)?
        .passes(3)?
        .before_rest
        .upstream;
    assert!((force / 30.0 - 1.0).abs() < 0.05, "{force} N");
    Ok(())
}

/// F(θ) = F(0) − w L sin θ, but for what the normal force loses.
#[test]
fn at_saturation_the_slope_takes_its_part_of_the_weight_off_the_force() -> Outcome {
    let force = |slope: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let cable = sloping(30.0, slope, true, (End::Free, End::Fixed))?;
        let mut run = Run::new(Kind::QuasiStatic, &problem(cable, 0.2)?)?;
        Ok(run.passes(300)?.outcome.force.downstream)
    };
    let level = force(0.0)?;
    for slope in [0.05_f64, -0.05] {
        let (found, expected) = (force(slope)?, level - WEIGHT * 30.0 * slope.atan().sin());
        println!("{slope}: {found:.1} N, {expected:.1} N");
        assert!((found - expected).abs() < 0.03 * level, "{found} N, {expected} N");
    }
    Ok(())
}

/// A slope, a bend, a rougher level part, and a clamp that slips in the first passes.
fn route(sheathed: bool) -> Result<DuctedCable, CableError> {
    let limit = FRICTION * WEIGHT;
    let clamp = Restraint {
        holds: Some(40.0),
        ..Restraint::new(7.03, 5e6)
    };
    let sections = [
        Section::new(4.0, limit).with_body_force(0.08 * WEIGHT),
        Section::new(3.2, limit).with_bend(FRICTION / 2.0),
        Section::new(4.8, 1.4 * limit),
    ];
    sloping(12.0, 0.0, sheathed, (End::Spring(2e6), End::Fixed))?
        .with_restraints(vec![clamp])?
        .with_sections(&sections)
}

#[test]
fn all_solvers_agree_on_a_route() -> Outcome {
    for sheathed in [true, false] {
        let cable = route(sheathed)?;
        let problem = problem(cable.clone(), 0.2)?;
        let mut runs = Vec::new();
        for kind in Kind::ALL {
            runs.push(Run::new(kind, &problem)?);
        }
        for vehicle in [0, 0, 1, 0] {
            let mut found = Vec::new();
            for run in &mut runs {
                let pass = run.pass(vehicle)?;
                assert!(run.state.friction_share(&cable)? < 1.0 + 1e-2);
                if let Some(energy) = pass.energy {
                    assert!(
                        energy.unbalanced_share() < 0.01 && energy.returned_share() < 1e-3,
                        "{energy:?}"
                    );
                }
                let force = pass.outcome.force;
                let slipped = 5e6 * run.state.clamp_slips(&cable)[0];
                found.push([
                    force.upstream,
                    force.downstream,
                    pass.outcome.restraints[0],
                    slipped,
                ]);
            }
            println!("{sheathed}: {found:?}");
            for other in &found[1..] {
                for (a, b) in other.iter().zip(found[0]) {
                    assert!((a - b).abs() < 1e-2 * problem.largest_force(), "{found:?}");
                }
            }
        }
        assert!(runs[0].state.clamp_slips(&cable)[0] > 1e-6);
    }
    Ok(())
}

#[test]
fn the_mirror_image_of_a_route_gives_the_mirror_image_of_the_answer() -> Outcome {
    let cable = route(true)?;
    let (here, there) = (problem(cable.clone(), 0.2)?, problem(mirrored(&cable)?, 0.2)?);
    for kind in Kind::ALL {
        let (mut one, mut other) = (Run::new(kind, &here)?, Run::new(kind, &there)?);
        for vehicle in [0, 0, 1, 0] {
            let (a, b) = (one.pass(vehicle)?.outcome, other.pass(1 - vehicle)?.outcome);
            let slips = [
                one.state.clamp_slips(&here.cable)[0],
                -other.state.clamp_slips(&there.cable)[0],
            ]
            .map(|slip| 5e6 * slip);
            for (a, b) in [
                (a.force.upstream, b.force.downstream),
                (a.force.downstream, b.force.upstream),
                (a.restraints[0], -b.restraints[0]),
                (slips[0], slips[1]),
            ] {
                assert!(
                    (a - b).abs() < 1e-5 * here.largest_force(),
                    "{kind:?}: {a} N, {b} N"
                );
            }
        }
    }
    Ok(())
}
