//! Values that contradict each other are refused.

use super::{FULL, assert_override_refused, assert_refused, read, read_with};

#[test]
fn two_scalings_are_refused() {
    assert_refused(
        "longitudinal_peak = \"35.7 um\"",
        "longitudinal_peak = \"35.7 um\"\nvertical_peak = \"90 um\"",
        "vertical_peak",
        &[
            "`ground.vertical_peak`",
            "both `longitudinal_peak` and `vertical_peak`",
            "only one",
        ],
    );
}

#[test]
fn load_and_wheels_exclude_each_other_and_one_is_needed() {
    assert_refused(
        "load = \"20 tf\"",
        "load = \"20 tf\"\nwheels = [{ load = 1 }]",
        "wheels = [{ load",
        &["`vehicles.0.wheels`", "both `load` and `wheels`", "only one"],
    );
    assert_refused(
        "load = \"20 tf\"",
        "",
        "[[vehicles]]",
        &["`vehicles.0`", "neither `load` nor `wheels`"],
    );
}

#[test]
fn shape_factor_belongs_to_the_laws_that_have_one() {
    assert_refused(
        "law = \"sigmoid\"",
        "law = \"coulomb\"",
        "shape_factor",
        &[
            "`friction.shape_factor`",
            "with `law` = \"coulomb\"",
            "no `shape_factor`",
        ],
    );
    for law in ["sigmoid", "elastic-plastic"] {
        let text = FULL
            .replace("\"sigmoid\"", &format!("\"{law}\""))
            .replace("shape_factor = \"2e7 1/m\"\n", "");
        let message = read(&text).unwrap_err().to_string();
        assert!(
            message.starts_with("bad.toml, line 27: key `friction.shape_factor` is missing"),
            "{message}"
        );
    }
}

#[test]
fn layers_have_a_thickness_but_the_last() {
    assert_refused(
        "young_modulus = \"800 MPa\"",
        "thickness = 2\nyoung_modulus = \"800 MPa\"",
        "thickness = 2",
        &[
            "`ground.layers.2.thickness`",
            "found 2",
            "no thickness in the last layer",
        ],
    );
    assert_refused(
        "thickness = \"50 mm\"",
        "",
        "[[ground.layers]]",
        &["key `ground.layers.0.thickness` (layer 1) is missing"],
    );
}

#[test]
fn a_half_space_has_one_modulus() {
    let text = FULL
        .replace("rigid_base_depth = \"12 m\"\n", "")
        .replace("\"800 MPa\"", "{ top = 1e6, bottom = 2e6 }");
    let message = read(&text).unwrap_err().to_string();
    assert!(
        message.starts_with(
            "bad.toml, line 20: `ground.layers.2.young_modulus` (layer 3): found a modulus that varies"
        ),
        "{message}"
    );
    assert!(read(&FULL.replace("\"800 MPa\"", "{ top = 1e6, bottom = 2e6 }")).is_ok());
}

#[test]
fn vehicles_have_different_names() {
    let message = |new| {
        read(&FULL.replace("name = \"van\"", new))
            .unwrap_err()
            .to_string()
    };
    for (new, start) in [
        (
            "name = \"truck\"",
            "bad.toml, line 43: `vehicles.1.name` (vehicle 2): found \"truck\"; allowed: a name",
        ),
        (
            "name = \" \"",
            "bad.toml, line 43: `vehicles.1.name` (vehicle 2): found \" \"; allowed: a name",
        ),
    ] {
        assert!(message(new).starts_with(start), "{}", message(new));
    }
    let text = FULL
        .replace("name = \"truck\"", "name = \"vehicle 2\"")
        .replace("name = \"van\"\n", "");
    assert!(
        read(&text)
            .unwrap_err()
            .to_string()
            .contains("`vehicles.1` (vehicle 2): found no name, where \"vehicle 2\" is taken")
    );
}

#[test]
fn a_sequence_names_known_vehicles() {
    let sequence = |list: &str| FULL.replace("order = \"random\"\nseed = 7", &format!("sequence = {list}"));
    let message = |list| read(&sequence(list)).unwrap_err().to_string();
    let unknown = message("[\"truck\", \"vam\"]");
    assert!(
        unknown.starts_with("bad.toml, line 54: `traffic.sequence.1`: found \"vam\" (did you mean `van`?)"),
        "{unknown}"
    );
    assert!(unknown.contains("allowed: \"truck\", \"van\""), "{unknown}");
    assert!(message("[]").contains("`traffic.sequence`: found an empty list"));
    assert!(message("\"truck\"").contains("`traffic.sequence`: found the text \"truck\"; allowed: a list"));
}

#[test]
fn order_and_sequence_exclude_each_other() {
    assert_refused(
        "seed = 7",
        "sequence = [\"van\"]",
        "sequence",
        &["`traffic.sequence`", "both `order` and `sequence`"],
    );
}

#[test]
fn a_seed_needs_a_random_order() {
    let allowed = "`seed` only with order = \"random\"";
    assert_refused(
        "order = \"random\"",
        "",
        "seed",
        &["`traffic.seed`", "found 7 with no `order`", allowed],
    );
    assert_refused(
        "order = \"random\"",
        "order = \"interleaved\"",
        "seed",
        &["7 with `order` = \"interleaved\"", allowed],
    );
}

#[test]
fn a_time_step_needs_a_method_that_steps_in_time() {
    for method in ["quasi-static", "pass-law"] {
        assert_refused(
            "method = \"explicit\"",
            &format!("method = \"{method}\""),
            "time_step",
            &["`solver.time_step`", "\"explicit\"", method],
        );
    }
    assert!(read(&FULL.replace("\"explicit\"", "\"auto\"")).is_ok());
}

#[test]
fn a_vehicle_without_load_cannot_be_scaled() {
    assert_refused(
        "load = \"20 tf\"",
        "load = 0",
        "load = 0",
        &["`vehicles.0.load`", "without load", "`ground.longitudinal_peak`"],
    );
    assert!(read_with(&["vehicles.0.load=0", "ground.longitudinal_peak="]).is_ok());
}

#[test]
fn empty_lists_are_refused() {
    for (list, key) in [
        ("[]", "vehicles"),
        ("[]", "ground.layers"),
        ("[]", "vehicles.1.wheels"),
    ] {
        assert_override_refused(
            &[&format!("{key}={list}")],
            &[
                &format!("--set {key}=[]: `{key}`"),
                ": found an empty list; allowed: ",
            ],
        );
    }
}
