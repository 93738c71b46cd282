//! No more model than a scene needs, and no less.

use creepage::{Part, PlanReport};

use super::scenes;
use crate::command::assert_says;
use crate::scenes::{largest, scene_of};

fn plan(text: &str) -> PlanReport {
    creepage::plan(&scene_of(text, &[])).expect("a plan").report()
}

/// A duct of 60 m under one truck on the given ground, with further lines at the end.
fn on(ground: &str, wheels: &str, more: &str) -> String {
    format!(
        "[duct]\nlength = 60\ndepth = 1.2\n[ground]\n{ground}\n\
         [cable]\nweight = 108.8\naxial_stiffness = 8.01e6\n\
         [friction]\ndynamic_coefficient = 0.25\nshape_factor = 7.4e6\n\
         [ends]\nupstream = \"free\"\ndownstream = \"fixed\"\n\
         [[vehicles]]\nname = \"truck\"\nspeed = \"40 km/h\"\n{wheels}\n{more}"
    )
}

fn layer(thickness: f64, modulus: f64) -> String {
    format!("[[ground.layers]]\nthickness = {thickness}\nyoung_modulus = {modulus}\npoisson_ratio = 0.35\n")
}

const SOIL: &str = "[[ground.layers]]\nyoung_modulus = 3e8\npoisson_ratio = 0.4\n";
const POINT: &str = "load = \"20 tf\"";
const PASSES: &str = "[traffic]\npasses = 20\n";

fn with_tolerance(tolerance: f64) -> String {
    format!("{PASSES}[solver]\ntolerance = {tolerance}\n")
}

/// No more ground than the closed form where it is homogeneous, and the Hankel transform however thin layers are; explicit steps for the
/// sigmoid, and jumps for many passes.
#[test]
fn no_more_model_than_a_scene_needs() {
    let wheels = "wheels = [{ x = 0, load = \"5 tf\", contact_radius = 0.15 }, { x = -5, load = \"15 tf\" }]";
    let [thin, thick] = [0.002, 0.2].map(|thickness| layer(thickness, 3e9) + SOIL);
    let (any, many) = (["#"; 2], ["passes = 20", "passes = 10000000"]);
    let fast = ["40 km/h", "400 km/h"];
    let sigmoid = ["shape_factor = 7.4e6", "law = \"sigmoid\"\nshape_factor = 1e9"];
    for tolerance in [0.1, 0.01, 0.002] {
        for (ground, wheels, [old, new], models) in [
            (SOIL, POINT, any, ["boussinesq", "quasi-static"]),
            (SOIL, wheels, any, ["boussinesq", "quasi-static"]),
            (SOIL, POINT, fast, ["boussinesq", "quasi-static"]),
            (SOIL, POINT, many, ["boussinesq", "pass-law"]),
            (SOIL, POINT, sigmoid, ["boussinesq", "explicit"]),
            (&*thin, POINT, any, ["burmister", "quasi-static"]),
            (&*thick, POINT, any, ["burmister", "quasi-static"]),
        ] {
            let text = on(ground, wheels, &with_tolerance(tolerance)).replace(old, new);
            let report = plan(&text);
            assert_eq!([report.ground, report.cable], models, "{text}");
        }
    }
}

/// Nobody waits a day for a law that forgets without having asked for it.
#[test]
fn long_runs_without_a_state_of_rest_are_asked_for_by_name() {
    let text = |length: f64, solver: &str| {
        let text = on(SOIL, POINT, &format!("{PASSES}{solver}"))
            .replace("length = 60", &format!("length = {length}"));
        text.replace("dynamic_coefficient", "law = \"sigmoid\"\ndynamic_coefficient")
    };
    let planned = |text: &str| creepage::plan(&scene_of(text, &[])).map(|plan| plan.report());
    assert_eq!(planned(&text(60.0, "")).expect("a plan").cable, "explicit");
    let error = planned(&text(20_000.0, "")).expect_err("more than a day");
    assert!(error.is_bad_input(), "{error}");
    let named = planned(&text(20_000.0, "[solver]\nmethod = \"explicit\"\n")).expect("a plan");
    assert!(named.estimated_seconds > 600.0);
    // It says what the plan says of the same scene with the method named.
    let hours = format!("would take {:.0} h or more", named.estimated_seconds / 3600.0);
    let message = error.to_string();
    let method = "solver.method = \"explicit\"";
    assert_says(&message, &["friction.law: \"sigmoid\"", &hours, method]);
    // Without friction there is nothing to simulate.
    let free = text(20_000.0, "").replace("dynamic_coefficient = 0.25", "dynamic_coefficient = 0");
    assert!(planned(&free).is_ok());
}

#[test]
fn a_thousand_thin_layers_are_planned() {
    let layers = (0..1000).map(|k| layer(0.01, if k % 2 == 0 { 1e8 } else { 2e8 + 1e5 * f64::from(k) }));
    let ground = layers.collect::<String>() + SOIL;
    let begin = std::time::Instant::now();
    assert_eq!(plan(&on(&ground, POINT, PASSES)).ground, "burmister");
    // Half a second; ten times that on a machine with other work.
    assert!(begin.elapsed().as_secs_f64() < 5.0, "{:?}", begin.elapsed());
}

/// A modulus that varies is cut into sublayers until the duct's motion is steady; finite elements, which follow the modulus
/// itself, agree.
#[test]
fn a_modulus_that_varies_moves_the_duct_as_finite_elements_say() {
    for (top, bottom, depth) in [(3e8, 9e8, 8.0), (1e9, 5e7, 2.0), (5e7, 2e9, 30.0)] {
        let ground = |model: &str| {
            format!(
                "model = \"{model}\"\nrigid_base_depth = {depth}\n\
                 [[ground.layers]]\nyoung_modulus = {{ top = {top}, bottom = {bottom} }}\npoisson_ratio = 0.4\n"
            )
        };
        let profile = |model: &str| {
            let text = on(&ground(model), POINT, &with_tolerance(0.004));
            creepage::profile(&scene_of(&text, &[])).expect("a profile")
        };
        let (sublayers, elements) = (profile("auto"), profile("fem"));
        assert_eq!((&*sublayers.ground, &*elements.ground), ("burmister", "fem"));
        let pairs = sublayers.longitudinal_m.iter().zip(&elements.longitudinal_m);
        let off = largest(pairs.map(|(a, b)| a - b));
        let peak = largest(sublayers.longitudinal_m.iter().copied());
        // What both are asked for at this tolerance.
        assert!(off < (2e-4 + 1e-3) * peak, "{:e} of the peak", off / peak);
    }
}

#[test]
fn what_the_scene_asks_for_is_taken_and_said() {
    let more = format!("{PASSES}[solver]\nmethod = \"explicit\"\nnode_spacing = 0.3\n");
    let report = plan(&on(&format!("model = \"burmister\"\n{SOIL}"), POINT, &more));
    assert_eq!((&*report.ground, &*report.cable), ("burmister", "explicit"));
    assert!((report.node_spacing_m - 0.3).abs() < 1e-12);
    for reason in &report.reasons {
        assert!(reason.contains("the scene asks for it"), "{reason}");
    }
    let mut candidates = report.candidates.iter();
    let mesh = candidates.find(|candidate| candidate.part == Part::Mesh && candidate.chosen);
    assert_eq!(mesh.expect("a mesh").reason, "the scene asks for it");
}

#[test]
fn one_candidate_of_every_part_is_chosen_and_every_other_has_a_reason() {
    for (seed, kind) in (0..).zip(scenes::KINDS.split(' ')) {
        let report = creepage::plan(&scenes::scene(kind, seed))
            .expect("a plan")
            .report();
        for part in [Part::Ground, Part::Cable] {
            let chosen = report.candidates.iter().filter(|c| c.part == part && c.chosen);
            assert_eq!(chosen.count(), 1, "{seed}: {part}");
        }
        let mut reasons = report.candidates.iter().map(|candidate| &candidate.reason);
        assert!(reasons.all(|reason| !reason.is_empty()));
    }
}

#[test]
fn a_vehicle_near_the_speed_of_the_grounds_waves_is_warned_of() {
    let soft = "[[ground.layers]]\nyoung_modulus = 2e7\npoisson_ratio = 0.4\n";
    // Shear waves at √(7.1 MPa / 1800 kg/m³) = 63 m/s.
    let at = |speed: &str| {
        let text = on(soft, POINT, PASSES).replace("40 km/h", speed);
        plan(&text).warnings
    };
    let is_warned = |speed: &str| at(speed).iter().any(|warning| warning.contains("shear waves"));
    assert!(!is_warned("60 km/h"), "{:?}", at("60 km/h"));
    assert!(is_warned("90 km/h"), "{:?}", at("90 km/h"));
}
