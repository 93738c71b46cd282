//! Ducts that slope, and routes of several sections: the cable's weight along the duct, by every solver.

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint, Section, laid};

use super::harness::{AXIAL_STIFFNESS, Kind, Outcome, Problem, Run, assert_near, sheathed, truck};
use super::shared::{mirrored, slipping};

/// Weight per metre \[N/m\] and friction coefficient of the full-scale experiment's upper cable.
const WEIGHT: f64 = 108.8;
const FRICTION: f64 = 0.25;

/// The upper cable in a duct that rises by `slope` = tan θ: p = −w sin θ, N′ = w cos θ.
fn sloping(
    length: f64,
    slope: f64,
    has_sheath: bool,
    (upstream, downstream): (End, End),
) -> Result<DuctedCable, CableError> {
    let angle = slope.atan();
    let limit = FRICTION * WEIGHT * angle.cos();
    let laws = [FrictionLaw::Coulomb, sheathed(limit)];
    let friction = Friction::new(laws[usize::from(has_sheath)], limit)?;
    DuctedCable::new(length, AXIAL_STIFFNESS, friction)?
        .with_ends(upstream, downstream)?
        .with_body_force(-WEIGHT * angle.sin())
}

/// That cable under a load of 20 tf which comes either way, with nodes `spacing` apart.
fn problem(cable: DuctedCable, spacing: f64) -> Result<Problem, Box<dyn std::error::Error>> {
    let truck = truck();
    Ok(Problem {
        mesh: Mesh::new(cable.length(), spacing, 0.5 * spacing)?,
        cable,
        drives: vec![truck.clone(), truck.back()],
    })
}

/// A slope, the ways of its vehicles by turns, and forces at the load cell \[N\] after passes of these numbers: reference solutions with an
/// independent full-chain program on the same mesh.
type Reference<'a> = (f64, &'a [usize], &'a [(usize, f64)]);

#[rustfmt::skip]
const REFERENCES: [Reference; 3] = [
    (0.05, &[0], &[(1, 80.28), (2, 109.09), (10, 212.8), (20, 281.15), (100, 364.24)]),
    (-0.05, &[0], &[(1, 121.2), (2, 168.32), (10, 346.1), (20, 469.39), (100, 689.84)]),
    (0.05, &[0, 1], &[(1, 80.28), (2, -50.69), (10, -83.85), (20, -109.83), (199, -102.62), (200, -231.34)]),
];

/// And between free ends equal traffic both ways lets the cable drift downhill.
#[test]
fn forces_and_drifts_on_a_slope_are_those_of_an_independent_program() -> Outcome {
    for (slope, vehicles, forces) in REFERENCES {
        let cable = sloping(30.0, slope, true, (End::Free, End::Fixed))?;
        let mut run = Run::new(Kind::QuasiStatic, &problem(cable, 0.1)?)?;
        let last = forces[forces.len() - 1].0;
        for (pass, &vehicle) in (1..=last).zip(vehicles.iter().cycle()) {
            let force = run.pass(vehicle)?.outcome.force.downstream;
            for (_, expected) in forces.iter().filter(|(number, _)| *number == pass) {
                assert_near(force, *expected, 0.003 * expected.abs(), (slope, pass));
            }
        }
    }
    let cable = sloping(60.0, 0.05, true, (End::Free, End::Free))?;
    let mut run = Run::new(Kind::QuasiStatic, &problem(cable, 0.1)?)?;
    for pass in 0..80 {
        run.pass(pass % 2)?;
    }
    assert_near(1e3 * run.state.displacement()[0], -0.4661, 0.003 * 0.4661, "mm");
    Ok(())
}

#[test]
fn where_friction_holds_the_cable_it_stays() -> Outcome {
    for ends in [
        (End::Free, End::Free),
        (End::Fixed, End::Free),
        (End::Spring(1e6), End::Fixed),
    ] {
        for (slope, has_sheath) in [(0.2, true), (0.2, false), (-0.1, true), (-0.1, false)] {
            let cable = sloping(30.0, slope, has_sheath, ends)?;
            let mesh = Mesh::new(30.0, 0.2, 0.1)?;
            let state = laid(&cable, &mesh)?;
            let body_force = cable.sections()[0].body_force;
            // Friction carries the weight along the duct but for what a sheath gives way beside an end that holds.
            let screened = 1.2 * body_force.abs() * cable.screening_length() + 1e-9;
            let force = state.end_forces(&cable)?;
            assert_near(force.upstream, 0.0, screened, (slope, ends));
            assert_near(force.downstream, 0.0, screened, (slope, ends));
            let moved = body_force * cable.friction().compliance();
            let middle = state.displacement()[mesh.nodes() / 2];
            assert_near(middle, moved, 1e-3 * moved.abs(), (slope, ends));
            let needed = state.friction_share(&cable)? * cable.friction().limit();
            assert!(needed <= body_force.abs() * (1.0 + 1e-6));
        }
    }
    Ok(())
}

/// Steeper than friction: (w sin θ − q) L on the lower end, or in the lower part of the chain of ends that hold it. Uphill the lower end is
/// the upstream one.
#[test]
fn what_friction_does_not_hold_rests_on_the_lower_end() -> Outcome {
    let length = 30.0;
    let fixed = [(End::Fixed, false), (End::Fixed, true)];
    let sprung = [(End::Spring(1e5), false), (End::Spring(1e5), true)];
    for (end, has_sheath) in fixed.into_iter().chain(sprung) {
        for (slope, ends) in [(0.4, (end, End::Free)), (-0.4, (End::Free, end))] {
            let cable = sloping(length, slope, has_sheath, ends)?;
            let mesh = Mesh::new(length, 0.1, 0.05)?;
            let state = laid(&cable, &mesh)?;
            let force = state.end_forces(&cable)?;
            let upstream = (force.upstream, 0);
            let downstream = (force.downstream, mesh.elements());
            let (lower, node) = if slope > 0.0 { upstream } else { downstream };
            let limit = cable.friction().limit();
            let rest = (cable.sections()[0].body_force.abs() - limit) * length;
            // A sheath at a fixed end is not sheared: there no friction acts on the end's half element.
            let half = 0.5 * mesh.spacing() * limit;
            let half = if has_sheath { half } else { 0.0 };
            assert_near(lower, rest, half + 1e-6 * rest, (slope, ends));
            if let End::Spring(stiffness) = end {
                let carried = stiffness * state.displacement()[node].abs();
                assert_near(carried, rest, 1e-6 * rest, (slope, ends));
            }
        }
    }
    Ok(())
}

#[test]
fn without_friction_the_lower_ends_and_clamps_hold_the_weight() -> Outcome {
    let friction = Friction::new(FrictionLaw::Coulomb, 0.0)?;
    let cable = DuctedCable::new(30.0, AXIAL_STIFFNESS, friction)?
        .with_ends(End::Spring(3e5), End::Fixed)?
        .with_restraints(vec![Restraint::new(12.3, 2e5)])?
        .with_body_force(-40.0)?;
    let problem = problem(cable.clone(), 0.2)?;
    for kind in Kind::ALL {
        let mut run = Run::new(kind, &problem)?;
        let laid = run.state.clone();
        let force = run.pass(0)?.outcome.force;
        assert_eq!(run.state, laid);
        let clamps: f64 = run.state.restraint_forces(&cable)?.iter().sum();
        let carried = force.downstream - force.upstream + clamps;
        assert_near(carried, -40.0 * 30.0, 1e-6, kind);
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

/// The law without memory lets the cable slide: sooner or later its lower end carries all of it.
#[test]
fn under_the_sigmoid_law_the_whole_weight_reaches_the_lower_end() -> Outcome {
    let limit = FRICTION * WEIGHT;
    let law = FrictionLaw::Sigmoid { shape_factor: 1e6 };
    let cable = DuctedCable::new(6.0, AXIAL_STIFFNESS, Friction::new(law, limit)?)?
        .with_ends(End::Fixed, End::Free)?
        .with_body_force(-5.0)?;
    let mut run = Run::new(Kind::Explicit, &problem(cable, 0.2)?)?;
    let force = run.passes(3)?.before_rest.upstream;
    assert_near(force, 30.0, 0.05 * 30.0, "N");
    Ok(())
}

/// A slope, a bend, a rougher level part, and a clamp that slips in the first passes.
fn route(has_sheath: bool) -> Result<DuctedCable, CableError> {
    let limit = FRICTION * WEIGHT;
    let sections = [
        Section::new(4.0, limit).with_body_force(0.08 * WEIGHT),
        Section::new(3.2, limit).with_bend(FRICTION / 2.0),
        Section::new(4.8, 1.4 * limit),
    ];
    sloping(12.0, 0.0, has_sheath, (End::Spring(2e6), End::Fixed))?
        .with_restraints(vec![slipping(7.03, 5e6, 40.0)])?
        .with_sections(&sections)
}

/// Force on the ends and the clamp, and the clamp's slip by its spring \[N\].
fn readings(problem: &Problem, run: &mut Run, vehicle: usize) -> Result<[f64; 4], CableError> {
    let pass = run.pass(vehicle)?;
    let needed = run.state.friction_share(&problem.cable)?;
    assert!(needed < 1.0 + 1e-2, "{needed} of the limit");
    if let Some(energy) = pass.energy {
        let (unbalanced, returned) = (energy.unbalanced_share(), energy.returned_share());
        assert!(unbalanced < 0.01 && returned < 1e-3, "{energy:?}");
    }
    let force = pass.outcome.force;
    let slipped = 5e6 * run.state.clamp_slips(&problem.cable)[0];
    let held = pass.outcome.restraints[0];
    Ok([force.upstream, force.downstream, held, slipped])
}

/// Steeper than friction, and over a route: little inertia, one answer; and in a mirror, with traffic from the other side, its mirror image.
#[test]
fn both_solvers_agree_on_a_route_and_have_mirror_images() -> Outcome {
    let clamp = Restraint::new(5.1, 1e6);
    let ends = (End::Spring(1e6), End::Fixed);
    let steep = |has_sheath| sloping(12.0, 0.35, has_sheath, ends)?.with_restraints(vec![clamp]);
    let steep = [steep(true)?, steep(false)?].map(|cable| (cable, 5e-3));
    let routes = [route(true)?, route(false)?].map(|cable| (cable, 1e-2));
    for (cable, agreement) in routes.into_iter().chain(steep) {
        let (here, there) = (problem(cable.clone(), 0.2)?, problem(mirrored(&cable)?, 0.2)?);
        let force = here.largest_force();
        let mut by_kind = Vec::new();
        for kind in Kind::ALL {
            let (mut one, mut other) = (Run::new(kind, &here)?, Run::new(kind, &there)?);
            let mut all = Vec::new();
            for vehicle in [0, 0, 1, 0] {
                let found = readings(&here, &mut one, vehicle)?;
                let image = readings(&there, &mut other, 1 - vehicle)?;
                for (a, b) in found.into_iter().zip([image[1], image[0], -image[2], -image[3]]) {
                    assert_near(a, b, 1e-5 * force, kind);
                }
                all.extend(found);
            }
            by_kind.push(all);
        }
        for (one, other) in by_kind[0].iter().zip(&by_kind[1]) {
            assert_near(*one, *other, agreement * force, &by_kind);
        }
        assert_eq!(by_kind[0][3] != 0.0, cable.restraints()[0].holds.is_some());
    }
    Ok(())
}
