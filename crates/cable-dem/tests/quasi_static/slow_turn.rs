//! A duct that turns slowly: however little a node slips in a step, what it slips back turns its friction over.

use cable_dem::{End, Mesh, Passage};
use ground_field::Direction;

use super::scenes::{Run, assert_near, cable, elastic_plastic};

const LIMIT: f64 = 1.6;
const LENGTH: f64 = 1.0;
/// The duct moves forward by so much and back again while the vehicle drives `WAVE` past it, a tenth of a nanometre a step; then
/// forward once more.
const SWING: f64 = 2e-7;
const WAVE: f64 = 160.0;
/// All of it at a millimetre from its place at rest, relative to which a step's slip is a ten-millionth.
const OFFSET: f64 = 1e-3;

#[test]
fn a_duct_that_turns_slowly_turns_friction_over() {
    // So short that friction cannot carry the cable along between its fixed ends: all of it slips, there and back.
    let friction = elastic_plastic(1e8, LIMIT);
    let cable = cable(LENGTH, 1e7, friction, End::Fixed, End::Fixed);
    let mesh = Mesh::new(LENGTH, 0.05, 0.025).expect("a valid mesh");
    let after = |approach: f64| {
        let shape = |xi: f64| {
            let turn = (-xi / WAVE).clamp(0.0, 1.5) * std::f64::consts::TAU;
            OFFSET + 0.5 * SWING * (1.0 - turn.cos())
        };
        let passage =
            Passage::from_shape(&cable, &mesh, Direction::Forward, shape, approach).expect("a valid passage");
        let mut run = Run::new(cable.clone(), mesh);
        // Before the duct returns to rest, which turns friction over by a millimetre.
        let (_, last) = run.pass_and_last(&passage);
        last.friction()[mesh.elements() / 2]
    };
    for (waves, turned) in [(0.5, LIMIT), (1.0, -LIMIT), (1.5, LIMIT)] {
        assert_near(after(waves * WAVE), turned, 1e-3 * LIMIT, waves);
    }
}
