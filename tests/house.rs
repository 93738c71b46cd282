//! How the files lie: none is long, folders import one way, every test is run by something, every package has its licences.

use std::fs;

use testkit::house::{circles, files};

fn text(path: &str) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

/// Whether `test`, a path below `tests/`, is a module or program that `named` does not name.
fn is_lost(test: &str, named: &str) -> bool {
    let mut ends = ["/main.rs", "/mod.rs", ".rs"].iter();
    match ends.find_map(|end| test.strip_suffix(end)) {
        Some(name) if !name.contains('/') => {
            !named.contains(&format!("\"{name}")) && !named.contains(&format!("mod {name};"))
        }
        _ => false,
    }
}

#[test]
fn the_house_is_in_order() {
    let mut packages = vec![".".to_owned(), "validation".to_owned()];
    packages.extend(
        fs::read_dir("crates")
            .unwrap()
            .map(|entry| entry.unwrap().path().display().to_string()),
    );
    for package in packages {
        let manifest = text(&format!("{package}/Cargo.toml"));
        let mut sources = Vec::new();
        for file in files(&format!("{package}/src")) {
            let code = text(&format!("{package}/src/{file}"));
            assert!(code.lines().count() <= 400, "{package}: {file} is long");
            if !["lib.rs", "main.rs"].contains(&&*file) {
                sources.push((file, code));
            }
        }
        assert!(circles(&sources).is_empty(), "{package}: {:?}", circles(&sources));
        if manifest.contains("autotests = false") {
            let named = manifest.clone() + &text(&format!("{package}/tests/main.rs"));
            let mut tests = files(&format!("{package}/tests"));
            tests.retain(|test| is_lost(test, &named));
            assert!(tests.is_empty(), "{package}: no program runs {tests:?}");
        }
        if !manifest.contains("\npublish = false\n") {
            for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
                assert!(manifest.contains("\"/LICENSE-*\""), "{package}");
                assert_eq!(
                    text(&format!("{package}/{licence}")),
                    text(licence),
                    "{package}: {licence}"
                );
            }
        }
    }
    assert!(is_lost("a.rs", "mod b;") && is_lost("c/main.rs", "") && !is_lost("a/b.rs", ""));
}
