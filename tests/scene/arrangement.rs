//! Several cables in a duct: their normal load from the geometry, and what contradicts it.

use approx::assert_relative_eq;
use creepage::scene::{Arrangement, SceneError};

use super::read;
use crate::scenes::scene_of;

/// A cable of 67 mm in a duct of 200 mm, with a place for its arrangement.
fn text(cable: &str) -> String {
    format!(
        r#"duct = {{ length = "30 m", depth = "1.2 m", inner_diameter = "200 mm" }}
ground.layers = [{{ young_modulus = "800 MPa", poisson_ratio = 0.4 }}]
friction = {{ law = "coulomb", dynamic_coefficient = 0.25 }}
ends = {{ upstream = "free", downstream = "fixed" }}
vehicles = [{{ speed = "40 km/h", load = "20 tf" }}]
traffic.passes = 2
[cable]
weight = "108.8 N/m"
axial_stiffness = "8.01e6 N"
{cable}
"#
    )
}

fn arranged(arrangement: &str) -> String {
    text(&format!("diameter = \"67 mm\"\narrangement = \"{arrangement}\""))
}

fn factor(text: &str) -> f64 {
    read(text).expect("a scene").normal_load_factor()
}

/// The key under which the scene is refused.
fn refused(text: &str) -> String {
    match read(text).expect_err("a wrong scene") {
        SceneError::Wrong(wrong) => wrong.key,
        other => panic!("{other}"),
    }
}

/// The totals are the weight correction factors of pulling calculations for D = 200 mm and d = 67 mm: triangular 1.158, cradled 1.338.
#[test]
fn factors_follow_from_the_geometry() {
    let of = |arrangement: &str| factor(&arranged(arrangement));
    assert_relative_eq!(2.0 * of("trefoil-lower") / 3.0, 1.158, max_relative = 5e-4);
    let cradled = 2.0 * of("cradled-outer") + of("cradled-middle");
    assert_relative_eq!(cradled / 3.0, 1.338, max_relative = 5e-4);
    assert_relative_eq!(of("trefoil-upper"), 1.155, max_relative = 5e-4);
    assert_eq!((of("cradled-outer"), of("single")), (1.0, 1.0));
    let scene = read(&arranged("trefoil-lower")).expect("a scene");
    assert_eq!(scene.cable.arrangement, Arrangement::TrefoilLower);
    assert_relative_eq!(scene.friction_limit(), 0.25 * 108.8 * 1.7364, max_relative = 1e-3);
}

/// Equilibrium of three circles without friction, written out: contacts push along the lines between the centres.
#[test]
fn three_cables_are_in_equilibrium() {
    for ratio in [2.2_f64, 2.6, 3.0, 4.5] {
        let factor = |arrangement: Arrangement| arrangement.normal_load_factor(ratio, 1.0);
        let radius = 0.5 * (ratio - 1.0);
        // Trefoil: the duct holds both lower cables at half a diameter from its middle; up and down all three weights.
        let wall = factor(Arrangement::TrefoilLower);
        let upright = (radius * radius - 0.25).sqrt() / radius;
        assert_relative_eq!(2.0 * wall * upright, 3.0, max_relative = 1e-12);
        // Cradled: up and down all three weights, the outer ones one diameter from the middle one on the circle of centres.
        let [outer, middle] = [Arrangement::CradledOuter, Arrangement::CradledMiddle].map(factor);
        let cosine = 1.0 - 0.5 / (radius * radius);
        assert_relative_eq!(middle + 2.0 * outer * cosine, 3.0, max_relative = 1e-12);
    }
}

#[test]
fn a_factor_and_an_arrangement_exclude_each_other() {
    for cable in ["", "arrangement = \"trefoil-lower\"\n"] {
        let both = text(&format!("{cable}diameter = \"67 mm\"\nnormal_load_factor = 1.5"));
        assert_eq!(refused(&both), "cable.normal_load_factor");
    }
    let single = text("arrangement = \"single\"\nnormal_load_factor = 1.5");
    assert_eq!(factor(&single), 1.5);
}

#[test]
fn what_is_set_later_stands() {
    let lower = arranged("trefoil-lower");
    let scene = scene_of(&lower, &["cable.normal_load_factor=1.5"]);
    let cable = &scene.cable;
    assert_eq!((cable.arrangement, cable.diameter), (Arrangement::Single, None));
    assert_eq!(scene.normal_load_factor(), 1.5);
    let set = ["cable.arrangement=cradled-outer", "cable.diameter=67 mm"];
    let scene = scene_of(&text("normal_load_factor = 1.5"), &set);
    assert_eq!(scene.normal_load_factor(), 1.0);
    assert_eq!(scene.cable.diameter, Some(0.067));
    let wider = scene_of(&lower, &["duct.inner_diameter=250 mm"]);
    assert!(wider.normal_load_factor() < factor(&lower));
}

#[test]
fn a_geometry_that_is_not_possible_is_refused() {
    let thick = |arrangement: &str, diameter: &str| {
        text(&format!(
            "arrangement = \"{arrangement}\"\ndiameter = \"{diameter}\""
        ))
    };
    let narrow = arranged("trefoil-lower").replace(", inner_diameter = \"200 mm\"", "");
    for (text, key) in [
        (thick("trefoil-upper", "93 mm"), "cable.diameter"),
        (thick("single", "200 mm"), "cable.diameter"),
        (text("arrangement = \"trefoil-upper\""), "cable.diameter"),
        (narrow, "duct.inner_diameter"),
        (arranged("trefoil-lowr"), "cable.arrangement"),
    ] {
        assert_eq!(refused(&text), key);
    }
    let thickest = read(&thick("trefoil-upper", "93 mm")).unwrap_err().to_string();
    assert!(thickest.contains("at most 0.0928 m"), "{thickest}");
    assert!(read(&thick("cradled-middle", "92 mm")).is_ok());
    assert!(read(&thick("single", "199 mm")).is_ok());
}

#[test]
fn three_cables_that_may_jam_are_told() {
    let warned = |text: &str| {
        let scene = read(text).expect("a scene");
        let warnings = creepage::plan(&scene).expect("a plan").report().warnings;
        warnings.iter().any(|warning| warning.contains("may jam"))
    };
    assert!(warned(&arranged("trefoil-lower")));
    assert!(!warned(&arranged("single")));
    assert!(!warned(&arranged("trefoil-lower").replace("200 mm", "220 mm")));
}

#[test]
fn an_arrangement_is_written_and_a_factor_that_contradicts_it_refused() {
    for arrangement in "single trefoil-upper trefoil-lower cradled-outer cradled-middle".split(' ') {
        let mut scene = read(&arranged(arrangement)).expect("a scene");
        assert_eq!(read(&scene.to_toml()).expect("a scene").cable, scene.cable);
        scene.validate().expect("valid");
        for factor in [3.0, f64::NAN] {
            scene.cable.normal_load_factor = Some(factor);
            let error = scene.validate().expect_err("another factor");
            let key = "cable.normal_load_factor";
            assert!(matches!(error, SceneError::Wrong(wrong) if wrong.key == key));
        }
    }
}
