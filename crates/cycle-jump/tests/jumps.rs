//! Jumps against every period, on a law of passes that is known and on the cable itself.

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, PassOutcome, Passage, QuasiStatic,
    RestingCable, Restraint, Section,
};
use cycle_jump::{Evolution, Guide, JumpError, Jumps, Next, Request, evolve};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, Vehicle};

use super::assert_near;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

const LIMIT: f64 = 27.2;
const LENGTH: f64 = 30.0;

fn cable(upstream: End, downstream: End, limit: f64) -> Result<(DuctedCable, Mesh), CableError> {
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / LIMIT,
    };
    let cable =
        DuctedCable::new(LENGTH, 8.01e6, Friction::new(law, limit)?)?.with_ends(upstream, downstream)?;
    Ok((cable, Mesh::for_depth(LENGTH, 1.2, 6.0)?))
}

fn jumps(tolerance: f64) -> Result<Jumps, JumpError> {
    let jumps = Jumps::new(tolerance, 1.2, (0.01 * LIMIT, 4e-6))?;
    Ok(jumps.with_max_passes(1000, 1000))
}

fn request<'a>(
    passes: u64,
    period: usize,
    wanted: &'a [u64],
    guide: Guide<'a>,
) -> Result<Request<'a>, JumpError> {
    let mut request = Request::new(passes, &[0; 64][..period])?;
    (request.wanted, request.guide) = (wanted, guide);
    Ok(request)
}

#[test]
fn what_has_no_meaning_is_refused() {
    let is_refused = |found: Result<(), JumpError>| matches!(found, Err(JumpError::InvalidParameter { .. }));
    // A period without vehicles would never end.
    assert!(is_refused(Request::new(100, &[]).map(|_| ())));
    for (tolerance, length, least) in [
        (0.0, 1.2, (0.3, 1e-6)),
        (f64::NAN, 1.2, (0.3, 1e-6)),
        (0.01, 0.0, (0.3, 1e-6)),
        (0.01, 1.2, (0.3, -1.0)),
        (0.01, 1.2, (f64::INFINITY, 1e-6)),
    ] {
        assert!(is_refused(Jumps::new(tolerance, length, least).map(|_| ())));
    }
    let jumps = jumps(0.01).expect("jumps");
    assert!(is_refused(jumps.with_start(1, 0.25).map(|_| ())));
    assert!(is_refused(jumps.with_start(8, 0.0).map(|_| ())));
}

/// A pass that moves every node by g (0.7 q − f̄), spread as one period spreads it: the exact law of a diffusion.
fn diffuse(
    resting: &mut RestingCable,
    mesh: &Mesh,
    state: &mut CableState,
) -> Result<PassOutcome, CableError> {
    const SLOPE: f64 = 2e-6;
    let mut moved = vec![0.0; mesh.nodes()];
    resting.balance(state.displacement(), &mut moved);
    for advance in &mut moved {
        *advance = SLOPE * (0.7 * LIMIT - *advance);
    }
    resting.diffuse(|_| SLOPE, &mut moved);
    let displacement = state.displacement().iter().zip(&moved).map(|(u, v)| u + v);
    *state = CableState::from_parts(mesh, displacement.collect(), state.friction().to_vec())?;
    resting.settle(state)?;
    PassOutcome::at_rest(resting.cable(), state)
}

/// [`diffuse`] with jumps.
fn evolve_diffusion(
    resting: &mut RestingCable,
    mesh: &Mesh,
    tolerance: f64,
    request: &Request<'_>,
) -> Result<Evolution, JumpError> {
    let cable = resting.cable().clone();
    evolve(&cable, mesh, &jumps(tolerance)?, request, |_: Next, state| {
        diffuse(resting, mesh, state).map_err(JumpError::from)
    })
}

/// The law of a diffusion, thousands of times one by one.
#[test]
fn a_diffusion_is_followed_to_its_end() -> Outcome {
    let (cable, mesh) = cable(End::Free, End::Spring(1e6), LIMIT)?;
    let wanted = [5, 20, 50, 100, 300, 1000, 3000, 20_000];
    let mut resting = RestingCable::new(&cable, &mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let mut right = Vec::new();
    for pass in 1..=wanted[wanted.len() - 1] {
        let outcome = diffuse(&mut resting, &mesh, &mut state)?;
        if wanted.contains(&pass) {
            right.push(outcome);
        }
    }
    let request = request(20_000, 1, &wanted, Guide::Free)?;
    for (tolerance, allowed, most) in [(2e-2, 5e-3, 60), (1e-3, 1e-3, 120)] {
        let found = evolve_diffusion(&mut resting, &mesh, tolerance, &request)?;
        assert!(found.simulated <= most, "{} passes", found.simulated);
        for (record, right) in found.records.iter().zip(&right) {
            let (force, expected) = (record.outcome.force.downstream, right.force.downstream);
            assert_near(force, expected, allowed * expected);
        }
    }
    Ok(())
}

/// Every second pass undoes what the one before it did, which grows evenly with their number: over a jump it is as far on its way as the jump.
#[test]
fn what_passes_do_within_a_period_grows_over_a_jump() -> Outcome {
    const GROWTH: f64 = 1e-7;
    let (cable, mesh) = cable(End::Free, End::Spring(1e6), LIMIT)?;
    let mut resting = RestingCable::new(&cable, &mesh)?;
    let mut shift = 0.0;
    let mut pass = |Next { phase, number }: Next, state: &mut CableState| {
        // Passes that only measure end their period where the others do.
        shift = if phase == 0 {
            GROWTH * number.unwrap_or(0) as f64
        } else {
            -shift
        };
        let displacement = state.displacement().iter().map(|u| u + shift).collect();
        *state = CableState::from_parts(&mesh, displacement, state.friction().to_vec())?;
        if phase == 0 {
            return PassOutcome::at_rest(resting.cable(), state);
        }
        diffuse(&mut resting, &mesh, state)
    };
    let wanted = [41, 101, 201, 601, 1001, 1501, 1999];
    let mut right = Vec::new();
    let mut state = CableState::at_rest(&mesh);
    for number in 1..=2000 {
        let phase = (number - 1) as usize % 2;
        let next = Next {
            phase,
            number: Some(number),
        };
        let outcome = pass(next, &mut state)?;
        if wanted.contains(&number) {
            right.push(outcome.upstream_displacement);
        }
    }
    let mut request = Request::new(2000, &[0, 1])?;
    request.wanted = &wanted;
    let found = evolve(&cable, &mesh, &jumps(1e-3)?, &request, |next, state| {
        pass(next, state).map_err(JumpError::from)
    })?;
    assert!(found.simulated < 400, "{}", found.simulated);
    let wanted = found
        .records
        .iter()
        .filter(|record| wanted.contains(&record.pass));
    for (record, right) in wanted.zip(right) {
        assert_near(
            record.outcome.upstream_displacement,
            right,
            0.02 * GROWTH * 2000.0,
        );
    }
    Ok(())
}

/// Nothing holds the cable: it goes on for ever, 0.7 q g a pass, and no rounding of its way is felt.
#[test]
fn a_cable_that_nothing_holds_moves_on() -> Outcome {
    let (cable, mesh) = cable(End::Free, End::Free, LIMIT)?;
    let mut resting = RestingCable::new(&cable, &mesh)?;
    let passes = 1_000_000_000;
    let wanted = [10, passes];
    let request = request(passes, 1, &wanted, Guide::Free)?;
    let found = evolve_diffusion(&mut resting, &mesh, 1e-3, &request)?;
    let outcome = &found.records[1].outcome;
    let expected = 0.7 * LIMIT * 2e-6 * passes as f64;
    assert_near(outcome.downstream_displacement, expected, 1e-3 * expected);
    assert_near(outcome.max_compression, 0.0, 1e-3 * LIMIT * LENGTH);
    Ok(())
}

const ONE_WAY: [Direction; 1] = [Direction::Forward];
const TWO_WAY: [Direction; 3] = [Direction::Forward, Direction::Forward, Direction::Reverse];

/// Two trucks there and one back over the cable itself.
fn trucks(guide: Guide<'_>, friction: f64) -> Outcome<(Evolution, Vec<PassOutcome>)> {
    let (cable, mesh) = cable(End::Free, End::Fixed, friction)?;
    traffic(&cable, mesh, guide, &TWO_WAY)
}

/// 300 passes of a truck that comes in these `directions` by turns, with jumps and one by one.
fn traffic(
    cable: &DuctedCable,
    mesh: Mesh,
    guide: Guide<'_>,
    directions: &[Direction],
) -> Outcome<(Evolution, Vec<PassOutcome>)> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 130.0, 1e-8)?;
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let passage = |&direction| {
        let shape = |xi: f64| motion.longitudinal(xi);
        Passage::from_shape(cable, &mesh, direction, shape, 48.0)
    };
    let passages: Vec<Passage> = directions.iter().map(passage).collect::<Result<_, _>>()?;
    let mut state = solver.at_rest();
    let mut every = Vec::new();
    for pass in 0..300 {
        every.push(solver.pass(&passages[pass % directions.len()], &mut state)?);
    }
    let wanted: Vec<u64> = (1..=300).collect();
    let request = request(300, directions.len(), &wanted, guide)?;
    let found = evolve(cable, &mesh, &jumps(5e-3)?, &request, |next: Next, state| {
        solver.pass(&passages[next.phase], state).map_err(JumpError::from)
    })?;
    Ok((found, every))
}

/// A slope, a bend and a rougher part with a clamp that sticks, slips for a while, or slips in every pass; a stiff one between two nodes
/// may slip on one of them alone.
#[test]
fn routes_with_clamps_that_slip_agree_with_every_pass() -> Outcome {
    let sections = [
        Section::new(9.0, LIMIT).with_body_force(-0.03 * 108.8),
        Section::new(9.0, LIMIT).with_bend(0.25 / 4.0),
        Section::new(12.0, 1.3 * LIMIT),
    ];
    for (stiffness, holds, directions) in [
        (5e6, 5e3, &ONE_WAY[..]),
        (5e6, 300.0, &ONE_WAY),
        (5e6, 100.0, &ONE_WAY),
        (5e6, 100.0, &TWO_WAY),
        (5e11, 450.0, &ONE_WAY),
        (5e11, 150.0, &TWO_WAY),
    ] {
        let clamp = Restraint {
            holds: Some(holds),
            ..Restraint::new(14.93, stiffness)
        };
        let (cable, mesh) = cable(End::Free, End::Fixed, LIMIT)?;
        let cable = cable.with_sections(&sections)?.with_restraints(vec![clamp])?;
        let (found, every) = traffic(&cable, mesh, Guide::Free, directions)?;
        let size = |pass: &PassOutcome| pass.max_compression.max(pass.restraints[0].abs());
        let largest = every.iter().map(size).fold(0.0, f64::max);
        let moved = every.iter().map(|pass| pass.upstream_displacement.abs());
        let moved = moved.fold(0.0, f64::max);
        assert!(found.simulated < 150, "{holds} N: {}", found.simulated);
        for (record, every) in found.records.iter().zip(&every) {
            let found = &record.outcome;
            assert_near(found.force.downstream, every.force.downstream, 1e-2 * largest);
            assert_near(found.restraints[0], every.restraints[0], 1e-2 * largest);
            let off = found.upstream_displacement - every.upstream_displacement;
            assert_near(off, 0.0, 1e-2 * moved);
        }
    }
    Ok(())
}

/// And the same jumps again and again: the answer is smooth in a parameter, as a fit needs it.
#[test]
fn jumps_over_two_way_traffic_agree_with_every_pass_and_are_smooth_when_obeyed() -> Outcome {
    let (first, every) = trucks(Guide::Free, LIMIT)?;
    assert!(first.simulated < 120, "{}", first.simulated);
    assert_eq!(first.records.len(), every.len());
    let largest = every.iter().map(|pass| pass.max_compression).fold(0.0, f64::max);
    for (record, every) in first.records.iter().zip(&every) {
        let found = &record.outcome;
        assert_near(found.force.downstream, every.force.downstream, 5e-3 * largest);
        assert_near(found.peak.downstream, every.peak.downstream, 1e-2 * largest);
    }
    let mut forces = Vec::new();
    for step in -3..=3 {
        let friction = LIMIT * (1.0 + 1e-3 * f64::from(step));
        let (again, _) = trucks(Guide::Obey(&first.schedule), friction)?;
        assert_eq!(again.schedule, first.schedule);
        forces.push(again.records[299].outcome.force.downstream);
    }
    let slope = (forces[6] - forces[0]) / 6.0;
    for three in forces.windows(3) {
        assert_near(three[0] + three[2], 2.0 * three[1], 0.1 * slope.abs());
    }
    Ok(())
}

/// Every node advances until its friction is 0.7 q: that is where the forces lead, and once they are there no pass is simulated to see it.
#[test]
fn where_forces_lead_costs_passes_only_while_they_change() -> Outcome {
    let (cable, mesh) = cable(End::Free, End::Spring(1e6), LIMIT)?;
    let mut resting = RestingCable::new(&cable, &mesh)?;
    let mut follow = |passes, beyond| {
        let mut request = request(passes, 1, &[], Guide::Free)?;
        request.beyond = beyond;
        evolve_diffusion(&mut resting, &mesh, 1e-2, &request)
    };
    let beyond = [200_000, 1_000_000];
    for (passes, still_changes) in [(100, true), (100_000, false)] {
        let (alone, followed) = (follow(passes, &[])?, follow(passes, &beyond)?);
        assert_eq!(followed.simulated > alone.simulated, still_changes, "{passes}");
        let leads = followed.beyond.ok_or("forces become steady")?;
        let numbers: Vec<u64> = leads.records.iter().map(|record| record.pass).collect();
        assert_eq!(numbers, beyond);
        let last = leads.period.iter();
        for outcome in leads.records.iter().map(|record| &record.outcome).chain(last) {
            // What friction holds in the end.
            let held = 0.7 * LIMIT * LENGTH;
            assert_near(outcome.force.downstream, held, 5e-3 * held);
        }
    }
    Ok(())
}
