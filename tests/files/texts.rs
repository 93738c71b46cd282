//! Texts that come from files and arguments: bounded, and without orders for a terminal.

use std::time::{Duration, Instant};

use crate::command::assert_says;

use super::common::{Folder, SCENE, SWEEP, creepage, said};

/// Orders for a terminal: a colour, a title, a bell, DEL, one of C1, and a turn of the direction of writing.
const ORDERS: &str = "\u{1b}[31m\u{1b}]0;x\u{7}\u{7f}\u{9b}2J\u{202e}\u{2066}\r";

/// The orders as a text of TOML has them.
fn escaped() -> String {
    let codes = ORDERS.chars().map(|c| format!("\\u{:04x}", u32::from(c)));
    codes.collect()
}

#[track_caller]
fn assert_harmless(text: &[u8]) {
    let text = str::from_utf8(text).expect("UTF-8");
    let bad = |c: char| {
        (c.is_control() && c != '\n') || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    assert!(!text.contains(bad), "{text:?}");
}

/// Asserts that the command is refused, TEXT being one of its words or a part of one; what it says.
#[track_caller]
fn refused(folder: &Folder, line: &str, text: &str) -> String {
    let words: Vec<String> = line.split(' ').map(|word| word.replace("TEXT", text)).collect();
    let output = folder.command(creepage(), &words).output().expect("an answer");
    let said = said(&output);
    assert_eq!(output.status.code(), Some(2), "{line}: {said:.200}");
    assert!(said.starts_with("error: "), "{said:.200}");
    said
}

#[test]
fn no_answer_gives_orders_to_a_terminal() {
    let folder = Folder::new("orders");
    let title = SCENE.replace("Small", &format!("A{}B\\nnext line", escaped()));
    folder.write("scene.toml", title.replace("truck", &escaped()));
    for (line, shows_title) in [
        ("run scene.toml", true),
        ("check scene.toml", true),
        ("plan scene.toml", true),
        ("profile scene.toml", false),
        (
            "calibrate scene.toml --data data.csv --fit dynamic_coefficient",
            true,
        ),
        ("design scene.toml --limit-force 100N", false),
        (&format!("{SWEEP} --out out.csv"), false),
    ] {
        let output = folder.succeeds(line);
        assert_harmless(&output.stdout);
        assert_harmless(&output.stderr);
        let out = String::from_utf8_lossy(&output.stdout);
        assert!(out.contains("A\u{fffd}") || !shows_title, "{out}");
        assert!(!out.contains("\nnext line"), "{out}");
    }
    // A document escapes what it holds, and loses nothing.
    let document = folder.succeeds("run scene.toml --json").stdout;
    let document: serde_json::Value = serde_json::from_slice(&document).expect("JSON");
    assert_eq!(document["title"], format!("A{ORDERS}B\nnext line"));
}

#[test]
fn no_error_gives_orders_to_a_terminal() {
    let folder = Folder::new("errors");
    folder.write("key.toml", format!("{SCENE}\"foo{}bar\" = 1\n", escaped()));
    folder.write("data.csv", format!("pass,force_n\n1,{}\n", ORDERS.trim_end()));
    folder.write("raw.toml", format!("title = \"{ORDERS}\"\n{SCENE}"));
    folder.write(&format!("named{ORDERS}.toml"), "duct = 1\n");
    for line in [
        "check key.toml",
        "check raw.toml",
        "check namedTEXT.toml",
        "check no-suchTEXT.toml",
        "check scene.toml --set friction.law=TEXT",
        "check scene.toml --set duct.depth=1TEXT",
        "check scene.toml --set duct.TEXTx",
        "calibrate scene.toml --data data.csv",
        "sweep scene.toml --out out.csv --vary duct.TEXTx",
        "run scene.toml --csv noTEXT/such",
        "TEXT",
        "run scene.toml TEXT",
        "profile scene.toml --positions TEXT",
        "presets TEXT",
    ] {
        assert_harmless(refused(&folder, line, ORDERS).as_bytes());
    }
}

#[test]
fn messages_are_bounded_whatever_they_are_about() {
    let folder = Folder::new("long");
    let long = "n".repeat(200_000);
    let unknown = SCENE.replace("passes = 5", &format!("passes = 5, sequence = [\"{long}\"]"));
    folder.write("sequence.toml", &unknown);
    folder.write("vehicle.toml", unknown.replace("truck", &format!("{long}m")));
    folder.write("key.toml", format!("{SCENE}{long} = 1\n"));
    folder.write("value.toml", SCENE.replace("40 km/h", &format!("40 {long}")));
    folder.write("data.csv", format!("pass,force_n\n1,{long}\n"));
    for line in [
        "check sequence.toml",
        "check vehicle.toml",
        "check key.toml",
        "check value.toml",
        "calibrate scene.toml --data data.csv",
        "check scene.toml --set friction.law=TEXT",
        "check scene.toml --set TEXT",
        "sweep scene.toml --out out.csv --vary duct.depth=normal(TEXT)",
        "run scene.toml --csv TEXT",
        "profile scene.toml --positions TEXT",
        "TEXT",
    ] {
        let said = refused(&folder, line, &long[..100_000]);
        let length = said.chars().count();
        assert!(length < 2100, "{length} characters: {said:.300}");
        // What is allowed and the line at fault are still told.
        if line.ends_with("sequence.toml") {
            assert_says(&said, &["allowed: \"truck\"", "^^^"]);
        }
    }
}

#[test]
fn readings_without_an_end_are_refused_with_little_memory() {
    let folder = Folder::new("endless");
    let begin = Instant::now();
    let output = folder.creepage_after("ulimit -v 1000000", "calibrate scene.toml --data /dev/zero");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert_says(&said(&output), &["at most 67108864 bytes"]);
    assert!(begin.elapsed() < Duration::from_secs(10));
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_is_an_error() {
    let folder = Folder::new("printed");
    let profiles = ["profile scene.toml", "profile scene.toml --json"];
    for line in ["--help", "run --help", "--version", "check scene.toml"]
        .into_iter()
        .chain(profiles)
    {
        let output = folder.creepage_after("exec >/dev/full", line);
        assert_eq!(output.status.code(), Some(1), "{line}");
        let said = said(&output);
        assert!(said.contains("standard output: cannot be written"), "{said}");
    }
    let output = folder.creepage("profile scene.toml --csv /dev/full");
    assert_eq!(output.status.code(), Some(1));
}
