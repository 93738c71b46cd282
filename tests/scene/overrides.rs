//! `KEY=VALUE` on top of a scene.

use creepage::scene::{End, FrictionLaw, Order, SolverMethod};
use ground_field::{Base, Modulus};

use super::{FULL, assert_override_refused, read_with};
use crate::scenes::scene_of;

#[test]
fn overrides_set_any_key() {
    let scene = read_with(&[
        "friction.dynamic_coefficient=0.3",
        "vehicles.0.speed = 72 km/h",
        "vehicles.1.wheels.0.load=\"9 kN\"",
        "ground.layers.2.young_modulus=100 MPa",
        "ends.upstream={ spring = \"2 MN/m\" }",
        "ends.downstream=fixed",
        "duct.lateral_offset=.5",
        "restraints=[]",
        "solver.tolerance=5 %",
        "title=Two = words",
    ])
    .unwrap();
    assert_eq!(
        (scene.friction.dynamic_coefficient, scene.duct.lateral_offset),
        (0.3, 0.5)
    );
    assert_eq!(
        (scene.vehicles[0].speed, scene.vehicles[1].weight()),
        (20.0, 16e3)
    );
    let modulus = scene.ground.profile().expect("layers").layers()[2].modulus();
    assert_eq!(modulus, Modulus::Uniform(1e8));
    let ends = (scene.ends.upstream, scene.ends.downstream);
    assert_eq!(ends, (End::Spring(2e6), End::Fixed));
    assert!(scene.restraints.is_empty());
    assert_eq!((scene.solver.tolerance, &*scene.title), (0.05, "Two = words"));
}

#[test]
fn overrides_make_what_is_not_there() {
    let text = FULL.split("[solver]").next().unwrap();
    let overrides = [
        "solver.method=explicit",
        "ends.upstream.spring=5",
        "solver.method=auto",
    ];
    let scene = scene_of(text, &overrides);
    assert_eq!(scene.solver.method, SolverMethod::Auto);
    assert_eq!(scene.ends.upstream, End::Spring(5.0));
}

#[test]
fn an_empty_override_removes_the_key() {
    let scene = read_with(&["ground.rigid_base_depth=", "restraints.0=", "vehicles.0="]).unwrap();
    let base = scene.ground.profile().expect("layers").base();
    assert!(matches!(base, Base::HalfSpace(_)));
    assert!(scene.restraints.is_empty());
    assert_eq!(scene.vehicles.len(), 1);
    assert_override_refused(&["duct.lenght="], "duct.lenght");
}

#[test]
fn an_override_beats_a_key_of_the_file_that_excludes_it() {
    let set = |set: &str| read_with(&[set]).unwrap();
    assert_eq!(set("friction.law=coulomb").friction.law(), FrictionLaw::Coulomb);
    let ground = set("ground.vertical_peak=90 um").ground;
    assert_eq!(
        (ground.longitudinal_peak, ground.vertical_peak),
        (None, Some(90e-6))
    );
    let wheels = set("vehicles.0.wheels=[{ load = 1 }, { x = 3, load = 2 }]");
    assert_eq!(wheels.vehicles[0].weight(), 3.0);
    assert_eq!(set("traffic.order=interleaved").order(), Order::Interleaved);
    assert_eq!(set("solver.method=pass-law").solver.time_step, None);
    // Without scaling a vehicle may have no load.
    assert!(read_with(&["vehicles.0.load=0", "ground.longitudinal_peak="]).is_ok());
    // But two overrides at odds with each other are refused.
    let law_and_shape = ["friction.law=coulomb", "friction.shape_factor=1"];
    assert_override_refused(&law_and_shape, "friction.shape_factor");
}

#[test]
fn errors_in_overrides_name_the_override_and_the_key() {
    for (set, key) in [
        ("duct.depth=1.2 kN", "duct.depth"),
        ("frction.law=coulomb", "frction"),
        ("friction.lwa=coulomb", "friction.lwa"),
        ("ends={}", "ends.upstream"),
        ("friction.law", "friction.law"),
        ("duct..length=3", "duct..length"),
        ("vehicles.2.speed=3", "vehicles.2.speed"),
        ("vehicles.truck.speed=3", "vehicles.truck.speed"),
        ("restraints.1.position=3", "restraints.1.position"),
        ("vehicles=[]", "vehicles"),
        ("ground.layers=[]", "ground.layers"),
        ("vehicles.1.wheels=[]", "vehicles.1.wheels"),
    ] {
        assert_override_refused(&[set], key);
    }
    let deep = format!("{}x=1", "x.".repeat(100_000));
    assert!(read_with(&[&deep]).is_err());
}
