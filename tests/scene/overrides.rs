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
    assert_eq!(scene.friction.dynamic_coefficient, 0.3);
    assert_eq!(scene.vehicles[0].speed, 20.0);
    assert_eq!(scene.vehicles[1].weight(), 16e3);
    assert_eq!(
        scene.ground.profile().expect("layers").layers()[2].modulus(),
        Modulus::Uniform(1e8)
    );
    assert_eq!(
        (scene.ends.upstream, scene.ends.downstream),
        (End::Spring(2e6), End::Fixed)
    );
    assert_eq!(scene.duct.lateral_offset, 0.5);
    assert!(scene.restraints.is_empty());
    assert_eq!(scene.solver.tolerance, 0.05);
    assert_eq!(scene.title, "Two = words");
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
    assert!(matches!(
        scene.ground.profile().expect("layers").base(),
        Base::HalfSpace(_)
    ));
    assert!(scene.restraints.is_empty());
    assert_eq!(scene.vehicles.len(), 1);
    assert_override_refused(
        &["duct.lenght="],
        &["--set duct.lenght=: `duct.lenght`", "a key that the scene holds"],
    );
}

#[test]
fn an_override_beats_a_key_of_the_file_that_excludes_it() {
    assert_eq!(
        read_with(&["friction.law=coulomb"]).unwrap().friction.law(),
        FrictionLaw::Coulomb
    );
    let vertical = read_with(&["ground.vertical_peak=90 um"]).unwrap();
    let ground = &vertical.ground;
    assert_eq!(
        (ground.longitudinal_peak, ground.vertical_peak),
        (None, Some(90e-6))
    );
    let wheels = read_with(&["vehicles.0.wheels=[{ load = 1 }, { x = 3, load = 2 }]"]).unwrap();
    assert_eq!(wheels.vehicles[0].weight(), 3.0);
    let ordered = read_with(&["traffic.order=interleaved"]).unwrap();
    assert_eq!(ordered.order(), Order::Interleaved);
    assert_eq!(
        read_with(&["solver.method=pass-law"]).unwrap().solver.time_step,
        None
    );
    // Without scaling a vehicle may have no load.
    assert!(read_with(&["vehicles.0.load=0", "ground.longitudinal_peak="]).is_ok());
    // But what has no meaning in the scene is still refused, as are two overrides at odds with each other.
    assert_override_refused(
        &["friction.law=coulomb", "friction.shape_factor=1"],
        &["--set friction.shape_factor=1: ", "with `law` = coulomb"],
    );
}

/// Overrides, one after the other | parts of the message
const REFUSED: &str = r"
duct.depth=1.2 kN | --set duct.depth=1.2 kN: `duct.depth`: found 1.2 kN: `kN` is the unit of a force
duct.depth=-1 | --set duct.depth=-1: `duct.depth`: found -1
frction.law=coulomb | unknown key `frction` | did you mean `friction`?
friction.lwa=coulomb | unknown key `friction.lwa` | did you mean `law`?
ends={} | --set ends={}: key `ends.upstream` is missing
friction.law | --set friction.law:  | KEY=VALUE
=3 | --set =3:  | a key such as
duct..length=3 | --set duct..length=3: 
vehicles.2.speed=3 | found `2` | an index from 0 to 1
vehicles.truck.speed=3 | found `truck` | an index from 0 to 1
restraints.1.position=3 | an index from 0 to 0
vehicles=[] | --set vehicles=[]: `vehicles` | found an empty list; allowed: 
ground.layers=[] | `ground.layers` | found an empty list
vehicles.1.wheels=[] | `vehicles.1.wheels` | found an empty list
";

#[test]
fn errors_in_overrides_name_the_override() {
    for row in REFUSED.lines().filter(|row| !row.is_empty()) {
        let (overrides, parts) = row.split_once(" | ").unwrap();
        let parts: Vec<&str> = parts.split(" | ").collect();
        assert_override_refused(&overrides.split(" ; ").collect::<Vec<_>>(), &parts);
    }
    assert_override_refused(
        &["ground.model=foo"],
        &[
            "--set ground.model=foo: `ground.model`: found foo; allowed: \"auto\"",
            "ground.model=foo\n |              ^^^",
        ],
    );
    let deep = format!("{}x=1", "x.".repeat(100_000));
    assert!(read_with(&[&deep]).is_err());
}

const NUMBERS: &str = "duct.length ground.rigid_base_depth ground.layers.0.thickness ground.layers.1.young_modulus \
    ground.layers.2.poisson_ratio cable.weight friction.shape_factor ends.upstream.spring restraints.0.position vehicles.0.speed \
    vehicles.0.share vehicles.1.wheels.0.x traffic.passes traffic.seed solver.tolerance solver.node_spacing title duct vehicles";

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(2000))]

    #[test]
    fn any_number_is_taken_or_refused_with_its_key(
        key in proptest::sample::select(NUMBERS.split(' ').collect::<Vec<_>>()), value in proptest::num::f64::ANY,
    ) {
        if let Err(error) = read_with(&[&format!("{key}={value:e}")]) {
            let message = error.to_string();
            proptest::prop_assert!(message.contains(" found ") && message.contains(" allowed: "), "{message}");
        }
    }
}
