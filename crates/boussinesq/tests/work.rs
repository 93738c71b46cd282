//! What a profile costs, counted: evaluations do not depend on the machine.

use boussinesq::HalfSpace;
use ground_field::{Direction, DuctLine, DuctMotion, GroundField, Soil, SurfaceLoad, Vehicle, Wheel};

fn evaluations(field: &dyn GroundField, accuracy: f64) -> usize {
    let load = SurfaceLoad::new(196_133.0, 0.15).expect("a load");
    let wheel = Wheel { x: 0.0, y: 0.0, load };
    let vehicle = Vehicle::new("wheel", vec![wheel], 11.0, Direction::Forward).expect("a vehicle");
    let line = DuctLine::new(1.2, 0.0).expect("a duct");
    DuctMotion::new(field, &vehicle, line, 15.0, accuracy)
        .expect("a motion")
        .samples()
}

/// Nine cells grow with the distance from the axis to 15 m; with 11 evaluations each they are right to 6e-9 without any bisection.
/// Each further factor of 100 may halve the cells once. Ten radii beyond show that the field has faded.
#[test]
fn a_closed_form_is_asked_a_hundred_times() {
    let soil = Soil::new(800e6, 0.4).expect("soil");
    let ground = HalfSpace::new(soil);
    assert_eq!(evaluations(&ground, 1e-6), 9 * 11 + 10);
    assert!(evaluations(&ground, 1e-10) <= 3 * 9 * 11);
    assert!(evaluations(&ground, 1e-12) <= 7 * 9 * 11);
}
