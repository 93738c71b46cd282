//! Texts that come from files and arguments: bounded, and without orders for a terminal.

use std::time::{Duration, Instant};

use super::common::{Folder, SCENE, said};

/// Orders for a terminal: a colour, a title, a bell, DEL, one of C1, and a turn of the direction of writing.
const ORDERS: &str = "\u{1b}[31m\u{1b}]0;x\u{7}\u{7f}\u{9b}2J\u{202e}\u{2066}\r";

/// The orders as a text of TOML has them.
fn escaped() -> String {
    let codes: Vec<String> = ORDERS
        .chars()
        .map(|c| format!("\\u{:04x}", u32::from(c)))
        .collect();
    codes.concat()
}

#[track_caller]
fn assert_harmless(text: &[u8]) {
    let text = str::from_utf8(text).expect("UTF-8");
    let bad = |c: char| {
        (c.is_control() && c != '\n') || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    assert!(!text.contains(bad), "{text:?}");
}

#[test]
fn no_answer_gives_orders_to_a_terminal() {
    let folder = Folder::new("orders");
    let escaped = escaped();
    folder.write(
        "scene.toml",
        SCENE
            .replace("Small", &format!("A{escaped}B\\nnext line"))
            .replace("truck", &escaped),
    );
    for arguments in [
        &["run", "scene.toml"][..],
        &["check", "scene.toml"],
        &["plan", "scene.toml"],
        &["profile", "scene.toml"],
        &[
            "calibrate",
            "scene.toml",
            "--data",
            "data.csv",
            "--fit",
            "dynamic_coefficient",
        ],
        &["design", "scene.toml", "--limit-force", "100 N"],
        &[
            "sweep",
            "scene.toml",
            "--vary",
            "duct.depth=1,2",
            "--out",
            "out.csv",
        ],
    ] {
        let output = folder.succeeds(arguments);
        assert_harmless(&output.stdout);
        assert_harmless(&output.stderr);
        if matches!(arguments[0], "run" | "check" | "plan" | "calibrate") {
            let out = String::from_utf8_lossy(&output.stdout);
            assert!(out.contains("A\u{fffd}") && !out.contains("\nnext line"), "{out}");
        }
    }
    // A document escapes what it holds, and loses nothing.
    let document = folder.succeeds(&["run", "scene.toml", "--json"]).stdout;
    let document: serde_json::Value = serde_json::from_slice(&document).expect("JSON");
    assert_eq!(document["title"], format!("A{ORDERS}B\nnext line"));
}

#[test]
fn no_error_gives_orders_to_a_terminal() {
    let folder = Folder::new("errors");
    let escaped = escaped();
    folder.write("key.toml", format!("{SCENE}\"foo{escaped}bar\" = 1\n"));
    folder.write("data.csv", format!("pass,force_n\n1,{}\n", ORDERS.trim_end()));
    folder.write("raw.toml", format!("title = \"{ORDERS}\"\n{SCENE}"));
    let named = format!("named{ORDERS}.toml");
    folder.write(&named, "duct = 1\n");
    let set = |key: &str| format!("{key}{ORDERS}x");
    let (law, depth, key) = (set("friction.law="), set("duct.depth=1 "), set("duct."));
    for arguments in [
        &["check", "key.toml"][..],
        &["check", "raw.toml"],
        &["check", &named],
        &["check", "no-such\u{1b}[2J.toml"],
        &["check", "scene.toml", "--set", &law],
        &["check", "scene.toml", "--set", &depth],
        &["check", "scene.toml", "--set", &key],
        &["calibrate", "scene.toml", "--data", "data.csv"],
        &["sweep", "scene.toml", "--out", "out.csv", "--vary", &key],
        &["run", "scene.toml", "--csv", "no\u{1b}[2J/such"],
        &[ORDERS],
        &["run", "scene.toml", ORDERS],
        &["profile", "scene.toml", "--positions", ORDERS],
        &["presets", ORDERS],
    ] {
        let output = folder.creepage(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(said(&output).starts_with("error: "), "{}", said(&output));
        assert_harmless(&output.stderr);
    }
}

#[test]
fn messages_are_bounded_whatever_they_are_about() {
    let folder = Folder::new("long");
    let long = "n".repeat(2_000_000);
    let sequence = format!("[traffic]\npasses = 5\nsequence = [\"{long}\"]\n");
    let unknown = SCENE.replace("[traffic]\npasses = 5\n", &sequence);
    folder.write("sequence.toml", &unknown);
    folder.write("vehicle.toml", unknown.replace("truck", &format!("{long}m")));
    folder.write("key.toml", format!("{SCENE}{long} = 1\n"));
    folder.write("value.toml", SCENE.replace("40 km/h", &format!("40 {long}")));
    folder.write("data.csv", format!("pass,force_n\n1,{long}\n"));
    let shorter = "n".repeat(100_000);
    let set = format!("friction.law={shorter}");
    let vary = format!("duct.depth=normal({shorter})");
    for arguments in [
        &["check", "sequence.toml"][..],
        &["check", "vehicle.toml"],
        &["check", "key.toml"],
        &["check", "value.toml"],
        &["calibrate", "scene.toml", "--data", "data.csv"],
        &["check", "scene.toml", "--set", &set],
        &["check", "scene.toml", "--set", &shorter],
        &["sweep", "scene.toml", "--out", "out.csv", "--vary", &vary],
        &["run", "scene.toml", "--csv", &shorter],
        &["profile", "scene.toml", "--positions", &shorter],
        &[&shorter],
    ] {
        let output = folder.creepage(arguments);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{said:.200}");
        assert!(
            said.chars().count() < 2100,
            "{} characters: {said:.300}",
            said.chars().count()
        );
        assert!(said.starts_with("error: "), "{said}");
    }
    // What is allowed and the line at fault are still told.
    let said = said(&folder.creepage(&["check", "sequence.toml"]));
    assert!(
        said.contains("… (2000002 characters); allowed: \"truck\"") && said.contains("^^^"),
        "{said}"
    );
}

#[test]
fn readings_without_an_end_are_refused_with_little_memory() {
    let folder = Folder::new("endless");
    let begin = Instant::now();
    let calibrate = ["calibrate", "scene.toml", "--data", "/dev/zero"];
    let output = folder.creepage_after("ulimit -v 1000000", &calibrate);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(
        said(&output).contains("allowed: a table of at most 67108864 bytes"),
        "{}",
        said(&output)
    );
    assert!(begin.elapsed() < Duration::from_secs(10));
}

#[test]
fn a_cell_is_no_formula() {
    let folder = Folder::new("formula");
    let formula = "vehicles.0.name==cmd|' /C calc'!A0,@SUM(A1),+1+1,-a,-1,plain";
    folder.succeeds(&["sweep", "scene.toml", "--vary", formula, "--out", "out.csv"]);
    let mut reader = csv::Reader::from_path(folder.path("out.csv")).expect("a table");
    let cells: Vec<String> = reader
        .records()
        .map(|row| row.expect("a row")[0].to_owned())
        .collect();
    assert_eq!(
        cells,
        ["'=cmd|' /C calc'!A0", "'@SUM(A1)", "'+1+1", "'-a", "-1", "plain"]
    );
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_written_is_an_error() {
    let folder = Folder::new("help");
    for arguments in [&["--help"][..], &["run", "--help"], &["--version"]] {
        let output = folder.creepage_after("exec >/dev/full", arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(
            said(&output).contains("standard output: cannot be written"),
            "{}",
            said(&output)
        );
    }
}
