//! Values that contradict each other are refused.

use super::{FULL, assert_override_refused, assert_refused, read, read_with};

#[test]
fn shape_factor_belongs_to_the_laws_that_have_one() {
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
            .contains("`vehicles.1.name` (vehicle 2): found \"vehicle 2\"; allowed: a name")
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
