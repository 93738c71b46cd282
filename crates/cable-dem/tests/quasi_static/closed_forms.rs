//! Long bars whose answer is a formula, on finer meshes and with more sheaths than `solvers/models.rs`, where the formulas are told: duct and
//! cable start at rest, and a wide front moves the duct forward by D behind it; at the end of the pass the duct comes back to rest at once.
//!
//! Friction q reaches X = √(2EA·D/q) from the fixed end, and the force there is q X. With an elastic sheath, whose screening length is
//! λ = √(EA γ), γ = 2/(q b), the friction beyond fades as e^(−x/λ), and the slipping part S and the force F = q (S + λ) follow from
//! D = q/(2EA)·((S + λ)² + λ²). After the return an anchored bar keeps (1 − √2) of its force.

use cable_dem::{CableState, DuctedCable, End, Friction, Mesh, PassOutcome, Passage, Restraint};
use ground_field::Direction;

use super::scenes::{Run, assert_near, cable, coulomb, elastic_plastic};

/// Half-widths after which tanh is 1 to 3e-8.
const TAIL: f64 = 9.0;

const EA: f64 = 8e6;
const Q: f64 = 40.0;
/// Displacement of the duct \[m\].
const D: f64 = 1e-4;

/// X, the length over which friction q takes up the displacement D from an end that does not move \[m\].
fn anchored_length() -> f64 {
    (2.0 * EA * D / Q).sqrt()
}

/// A front of half-width `width` behind which the duct has moved by `displacement`.
fn front(cable: &DuctedCable, mesh: &Mesh, width: f64, displacement: f64) -> Passage {
    fronts(cable, mesh, width, &[displacement])
}

/// Fronts that move the duct one after the other, each when the whole duct has felt the last one.
fn fronts(cable: &DuctedCable, mesh: &Mesh, width: f64, moves: &[f64]) -> Passage {
    let apart = stage(cable, width);
    let foremost = 0.5 * apart * (moves.len() - 1) as f64;
    let shape = |xi: f64| {
        let behind = |number: usize| (foremost - apart * number as f64 - xi) / width;
        let moved = moves.iter().enumerate();
        moved
            .map(|(number, displacement)| 0.5 * displacement * (1.0 + behind(number).tanh()))
            .sum()
    };
    let approach = 0.5 * (apart * moves.len() as f64 - cable.length());
    Passage::from_shape(cable, mesh, Direction::Forward, shape, approach).expect("a valid passage")
}

/// How far the vehicle travels while one front passes over the whole cable \[m\].
fn stage(cable: &DuctedCable, width: f64) -> f64 {
    cable.length() + 2.0 * TAIL * width
}

/// A bar of ten anchored lengths, and its mesh.
fn long_bar(friction: Friction, downstream: End, nodes_per_length: f64) -> (DuctedCable, Mesh) {
    let length = 10.0 * anchored_length();
    let spacing = anchored_length() / nodes_per_length;
    (
        cable(length, EA, friction, End::Free, downstream),
        Mesh::new(length, spacing, spacing).expect("a valid mesh"),
    )
}

/// Force at the fixed end of a long bar after each of `moves` of the duct in one pass, and last of all after the duct's
/// return to rest.
///
/// The front is twenty times as wide as the slipping zone. A steeper one ratchets: where friction is locked at q, its
/// bend EA D″ makes the cable slip on in passing, by about (X/W)²/40 of the force.
fn anchored_forces(friction: Friction, nodes_per_length: f64, moves: &[f64]) -> Vec<f64> {
    let (bar, mesh) = long_bar(friction, End::Fixed, nodes_per_length);
    let width = 20.0 * anchored_length();
    let passage = fronts(&bar, &mesh, width, moves);
    let mut forces = vec![0.0; moves.len() + 1];
    let start = 0.5 * (bar.length() - stage(&bar, width) * moves.len() as f64);
    let mut run = Run::new(bar.clone(), mesh);
    let outcome = run.watch(&passage, |position, cable| {
        let stages = (position - start) / stage(&bar, width);
        let number = (stages.ceil() as usize).clamp(1, moves.len());
        forces[number - 1] = cable.end_forces(&bar).expect("the state's mesh").downstream;
    });
    forces[moves.len()] = outcome.force.downstream;
    forces
}

/// When the duct turns back by s, friction turns over along √(EA s/q) from the fixed end and takes 2 q √(EA s/q) off the
/// force: over a small part of an element as over many.
#[test]
fn the_least_turn_of_the_duct_takes_its_own_part_off_a_fixed_end() {
    let pushed = Q * anchored_length();
    for nodes_per_length in [10.7, 21.9] {
        let spacing = anchored_length() / nodes_per_length;
        for zone in [0.02, 0.3, 0.8, 1.0, 1.3, 2.4, 3.5, 0.5 * nodes_per_length] {
            let turned = zone * spacing;
            let back = Q * turned * turned / EA;
            let forces = anchored_forces(coulomb(Q), nodes_per_length, &[D, -back]);
            let fallen = (forces[0] - forces[1]) / (Q * spacing);
            // Within the last element the law is exact; farther in, the zone's border falls between two nodes: at most
            // (h/2)² q/X.
            let border = if zone <= 1.0 { 0.0 } else { 0.25 / zone };
            // Windows, and the ratchet of a front of 20 anchored lengths.
            let others = (1e-4 + 1.0 / 16e3) * pushed / (Q * spacing);
            assert_near(fallen, 2.0 * zone, border + others, (nodes_per_length, zone));
        }
    }
}

#[test]
fn a_long_bar_is_anchored_by_coulomb_friction() {
    let exact = Q * anchored_length();
    let kept = exact * (1.0 - 2.0_f64.sqrt());
    // The border of the slipping zone falls between two nodes: an error of at most (h/X)²/8.
    for nodes_per_length in [5.3, 10.7, 21.9, 43.1] {
        let forces = anchored_forces(coulomb(Q), nodes_per_length, &[D]);
        let allowed = (0.13 / (nodes_per_length * nodes_per_length) + 1e-5) * exact;
        assert_near(forces[0], exact, allowed, nodes_per_length);
        // The return is a push of D/2, doubled: its zone is X/√2 long, and its border moves the force as much twice over √2.
        let allowed = (1.0 + 2.0 * 2.0_f64.sqrt()) * allowed;
        assert_near(forces[1], kept, allowed, nodes_per_length);
    }
}

#[test]
fn a_bar_that_only_shears_its_sheath_pulls_with_ea_d_over_lambda() {
    // D is a third of the slip at which the sheath gives way.
    let friction = elastic_plastic(2.0 / (3.0 * D), Q);
    let bar = |length| cable(length, EA, friction, End::Free, End::Fixed);
    let screening_length = bar(1.0).screening_length();
    let length = 30.0 * screening_length;
    let bar = bar(length);
    let mesh = Mesh::new(length, screening_length / 40.0, screening_length / 10.0).expect("a valid mesh");
    let mut run = Run::new(bar.clone(), mesh);
    let (outcome, pushed) = run.pass_and_last(&front(&bar, &mesh, 2.0 * screening_length, D));
    let force = pushed.end_forces(&bar).expect("the state's mesh").downstream;
    let exact = EA * D / screening_length;
    assert_near(force, exact, 3e-4 * exact, "pushed");
    // Nothing has slipped: the return gives all of it back.
    assert_near(outcome.force.downstream, 0.0, 3e-4 * exact, "returned");
    assert_near(outcome.dissipated, 0.0, 1e-9 * Q * D * length, "heat");
}

#[test]
fn push_and_pull_is_a_masing_loop() {
    let forces = anchored_forces(coulomb(Q), 43.1, &[D, -D, D, -D, D, -D]);
    let pushed = Q * anchored_length();
    // Unloading works against friction 2 q: half the displacement in a bar twice as strong.
    let pulled = pushed * (1.0 - 2.0_f64.sqrt());
    for (force, exact) in forces[..6].iter().zip([pushed, pulled].into_iter().cycle()) {
        assert_near(*force, exact, 3e-4 * pushed, &forces);
    }
    // The loop is closed: the third round repeats the second, up to what the windows leave out within a pass. And the duct has come
    // back by itself: its return moves nothing.
    for (again, before) in [(4, 2), (5, 3), (6, 5)] {
        assert_near(forces[again], forces[before], 1e-4 * pushed, &forces);
    }
}

/// A pass that leaves the duct moved is a push and a pull, the pull in one step.
#[test]
fn a_pass_that_leaves_the_duct_moved_is_a_masing_loop() {
    let (bar, mesh) = long_bar(coulomb(Q), End::Fixed, 43.1);
    let pushed = Q * anchored_length();
    let kept = pushed * (1.0 - 2.0_f64.sqrt());
    let mut run = Run::new(bar.clone(), mesh);
    // From one push to the next the other way the duct turns by 2 D: the doubled loading curve ends at its mirror image.
    for sign in [1.0, 1.0, -1.0, -1.0, 1.0] {
        let outcome = run.pass(&front(&bar, &mesh, 20.0 * anchored_length(), sign * D));
        let extreme = if sign > 0.0 { outcome.peak } else { outcome.lowest };
        assert_near(extreme.downstream, sign * pushed, 3e-4 * pushed, sign);
        assert_near(outcome.force.downstream, sign * kept, 3e-4 * pushed, sign);
    }
}

#[test]
fn a_spring_end_gives_way() {
    let x = anchored_length();
    for spring in [0.01, 0.3, 1.0, 10.0, 1000.0].map(|share| share * EA / x) {
        let (bar, mesh) = long_bar(coulomb(Q), End::Spring(spring), 43.1);
        let mut run = Run::new(bar.clone(), mesh);
        let (outcome, last) = run.pass_and_last(&front(&bar, &mesh, 2.0 * x, D));
        // D = q X²/(2EA) + q X/S, the stretch over X and the spring's own.
        let compliance = EA / spring;
        let slipping = |share: f64| (compliance * compliance + share * x * x).sqrt() - compliance;
        let (pushed, kept) = (slipping(1.0), slipping(1.0) - 2.0 * slipping(0.5));
        let force = last.end_forces(&bar).expect("the state's mesh").downstream;
        assert_near(force, Q * pushed, 2e-4 * Q * x, spring);
        assert_near(outcome.force.downstream, Q * kept, 2e-4 * Q * x, spring);
        let end = last.displacement()[mesh.elements()] * spring;
        assert_near(end, Q * pushed, 2e-2 * Q * pushed, spring);
    }
}

/// λ² = EA γ; by Masing's rule the pull is a push by D/2, doubled.
#[test]
fn elastic_sheaths_go_over_into_coulomb_friction() {
    let x = anchored_length();
    // λ as a share of X, nodes per X, and what a mesh of second order in h/λ may be off by.
    let of_screening = |share: f64| 2.0 * EA / (Q * (share * x).powi(2));
    let long = [0.05, 0.2, 0.5].map(|share| (of_screening(share), 60.0, 0.1 / (60.0 * share).powi(2) + 1e-4));
    let stiff = [1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e12].map(|shape_factor| (shape_factor, 40.0, 5e-4));
    let rigid = anchored_forces(coulomb(Q), 40.0, &[D, -D]);
    for (shape_factor, nodes, allowed) in long.into_iter().chain(stiff) {
        let forces = anchored_forces(elastic_plastic(shape_factor, Q), nodes, &[D, -D]);
        let screening = 2.0 * EA / (Q * shape_factor);
        let pushed = Q * (x * x - screening).sqrt();
        let pulled = pushed - 2.0 * Q * (0.5 * x * x - screening).sqrt();
        for ((force, exact), rigid) in forces.iter().zip([pushed, pulled]).zip(&rigid) {
            assert_near(*force, exact, allowed * pushed, shape_factor);
            if shape_factor >= 1e6 {
                // λ²/(2X²) = 1/(2 b D) of the force for the push, and (1 + √2)-fold with the pull.
                let elastic = (3.0 / (2.0 * shape_factor * D) + 1e-4) * Q * x;
                assert_near(*force, *rigid, elastic, shape_factor);
            }
        }
    }
}

#[test]
fn a_clamp_holds_a_long_cable_from_both_sides() {
    let x = anchored_length();
    for spring in [0.1, 1.0, 10.0].map(|share| share * EA / x) {
        let (bar, mesh) = long_bar(coulomb(Q), End::Free, 43.1);
        let clamp = Restraint::new(mesh.spacing() * (mesh.elements() / 2) as f64, spring);
        let bar = bar.with_restraints(vec![clamp]).expect("a valid clamp");
        let mut run = Run::new(bar.clone(), mesh);
        let (outcome, last) = run.pass_and_last(&front(&bar, &mesh, 2.0 * x, D));
        // Tension behind the clamp and compression before it: each takes half of S u.
        let compliance = 2.0 * EA / spring;
        let slipping = |share: f64| (compliance * compliance + share * x * x).sqrt() - compliance;
        let (pushed, kept) = (slipping(1.0), slipping(1.0) - 2.0 * slipping(0.5));
        for (state, half) in [(&last, Q * pushed), (&run.state, Q * kept)] {
            let reaction = state.restraint_forces(&bar).expect("the state's mesh")[0];
            assert_near(reaction, 2.0 * half, 4e-4 * Q * x, spring);
        }
        let forces = last.element_forces(&bar).expect("the state's mesh");
        assert_near(forces.fold(0.0, f64::max), Q * pushed, Q * mesh.spacing(), spring);
        // Of the push, friction beyond the return's zone keeps what it had there.
        let kept_beside = Q * (pushed - slipping(0.5)).abs().max(kept.abs());
        assert!(outcome.max_compression <= kept_beside + Q * mesh.spacing());
    }
}

/// Friction pushes all of the cable forward, and a clamp within an element takes away twice what has come to it: the forces on either side of
/// the clamp are the extremes.
#[test]
fn forces_are_extreme_beside_a_clamp_within_an_element() {
    let (length, spacing, place) = (10.0, 0.5, 6.1);
    let borne = Q * place;
    let cable = cable(length, EA, coulomb(Q), End::Free, End::Free);
    let cable = cable
        .with_restraints(vec![Restraint::new(place, 1e6)])
        .expect("a clamp");
    let mesh = Mesh::new(length, spacing, spacing).expect("a mesh");
    let mut displacement = vec![1e-3];
    for element in 0..mesh.elements() {
        let [from, to] = [0, 1].map(|node| (element + node) as f64 * spacing);
        let beyond = (to - place.max(from)).max(0.0) / spacing;
        let force = 0.5 * Q * (from + to) - 2.0 * borne * beyond;
        displacement.push(displacement[element] - force * spacing / EA);
    }
    let state = CableState::from_parts(&mesh, displacement, vec![Q; mesh.nodes()]).expect("a state");
    let found = PassOutcome::at_rest(&cable, &state).expect("forces");
    assert_near(found.max_compression, borne, 1e-6 * borne, "before");
    assert_near(found.max_tension, borne, 1e-6 * borne, "beyond");
}
