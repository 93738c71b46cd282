//! What `creepage explain` says of a key is what the reader does with it.

use creepage::scene::key_meanings;

use super::{FULL, read_with};

/// The key with numbers of list items that the full scene has.
fn numbered(key: &str) -> String {
    key.replace("measures.", "measures.0.")
        .replace("ground.layers.", "ground.layers.1.")
        .replace("restraints.", "restraints.0.")
        .replace("route.", "route.0.")
        .replace("vehicles.", "vehicles.1.")
        .replace("wheels.", "wheels.0.")
}

#[test]
fn every_key_with_a_unit_or_a_range_is_read() {
    let mut count = 0;
    for key in key_meanings() {
        let measured = key.allowed.contains("units:") || key.allowed.starts_with("a number");
        // Those of a histogram, which its own test reads.
        if (!measured && !key.allowed.starts_with("a whole number"))
            || key.key == "traffic.speed"
            || key.key.starts_with("traffic.histogram.")
        {
            continue;
        }
        let path = numbered(&key.key);
        let set = format!("{path}=\"1 parsec\"");
        // A cable is heated by both of these.
        let mut overrides = vec!["heat.expansion=1e-5", "heat.daily_swing=20"];
        overrides.truncate(if path.starts_with("heat.") { 2 } else { 0 });
        if path.starts_with("route.") {
            overrides = vec!["duct.slope=0", "route=[{}]"];
        }
        overrides.push(&set);
        let message = read_with(&overrides).expect_err(&path).to_string();
        assert!(message.contains(&format!("`{path}`")) && message.contains(&key.allowed));
        count += 1;
    }
    assert!(count >= 35, "{count}");
}

/// Words in quotes, apart from names of files and quantities.
#[test]
fn every_word_that_is_told_is_accepted() {
    let mut count = 0;
    for key in key_meanings() {
        if key.allowed.contains("units:") || key.key == "traffic.histogram" {
            continue;
        }
        for word in key
            .allowed
            .split('"')
            .skip(1)
            .step_by(2)
            .filter(|word| !word.contains(' '))
        {
            let set = format!("{}={word}", numbered(&key.key));
            if let Err(error) = read_with(&[&set]) {
                assert!(!error.to_string().contains(&format!("found \"{word}\"")));
            }
            count += 1;
        }
    }
    assert!(count >= 20, "{count}");
}

#[test]
fn what_is_required_is_missed_and_nothing_else_is() {
    for key in key_meanings() {
        let path = numbered(&key.key);
        let section = path.contains('.');
        let in_file = FULL.contains(&format!("{} = ", path.rsplit('.').next().unwrap_or_default()));
        if !section || !in_file || path.starts_with("ends.upstream.") {
            continue;
        }
        let missed = match read_with(&[&format!("{path}=")]) {
            Err(error) => error.to_string().contains("is missing") && error.to_string().contains(&path),
            Ok(_) => false,
        };
        if key.default.is_none() {
            assert!(missed, "{path} is required");
        } else if !["passes", "shape_factor", "preset", "thickness", "axial_stiffness"]
            .iter()
            .any(|name| path.ends_with(name))
        {
            assert!(!missed, "{path} may be left out");
        }
    }
}
