//! What the program says of mistakes: one table, of changed scenes, of commands and of readings, and what each message has to hold.
//!
//! `messages/scenes.txt` changes `messages/scene.toml`, `full_scenes.txt` the scene that uses every key: what stands there → what an
//! engineer writes in its place | exit status of `check` | line of the message | parts of it. What is only hardly meant is a warning,
//! with status 0. `commands.txt`: a command (`run/plan` is either) | exit status | parts. `readings.txt`: a file ‖ options ‖ parts. `¶`
//! ends a line, `⇥` is a tab, `∅` is nothing, `«…»` stands for a file with that text, and `##` begins a heading.

use std::fs;
use std::path::Path;

use crate::command::{SERIES, UPPER, answer, assert_says, command, folder, read, words};
use crate::reading_shapes::options;
use crate::scene::FULL;

const SCENE: &str = include_str!("messages/scene.toml");
const OLDER: &[u8] = b"<!DOCTYPE html><meta name=\"generator\" content=\"creepage 0.0.0\"/>";
/// Files by their names in the table.
const FILES: [(&str, &str, &[u8]); 6] = [
    ("DATA", "data.csv", b"pass,force_n\n1,90\n2,114\n5,168\n10,222\n"),
    ("MANY", "many.csv", b"pass,force_n\n1,113\n2,many\n"),
    ("DUCTS", "ducts.csv", b"id;duct.depth;cable.wieght\na;1,5 m;110\n"),
    ("RAGGED", "ragged.csv", b"id,duct.depth\na,1.5\nb,1,5\n"),
    ("BINARY", "binary.toml", b"title = \"\xff\xfe\"\n"),
    ("OLDER", "older.html", OLDER),
];

fn rows(table: &str) -> impl Iterator<Item = &str> {
    table.lines().filter(|row| !row.starts_with("## "))
}

fn plain(text: &str) -> String {
    text.replace('¶', "\n").replace('⇥', "\t").replace('∅', "")
}

/// Runs a command in `folder`: exit status, standard output and what it says of mistakes.
fn run(folder: &Path, line: &str) -> (i32, String, String) {
    let named = |word: String| match &*word {
        "SCENE" => "scene.toml".into(),
        "UNFIT" | "FAULTY" | "UNCLOSED" => word.to_lowercase() + ".toml",
        UPPER | SERIES => format!("{}/{word}", env!("CARGO_MANIFEST_DIR")),
        _ => match FILES.iter().find(|(name, ..)| *name == word) {
            Some((_, file, _)) => (*file).into(),
            None => word,
        },
    };
    let mut command = command("");
    command
        .args(words(line).into_iter().map(named))
        .current_dir(folder);
    answer(command.output().expect("the program to run"))
}

/// What lacks of the parts that a message has to hold.
fn lacking(what: &str, message: &str, parts: &[&str]) -> Option<String> {
    let lacks = |part: &&&str| match **part {
        "∅" => !message.is_empty(),
        part => !message.contains(part),
    };
    let part = parts.iter().find(lacks)?;
    Some(format!("{what}\n  lacks: {part}\n  said: {message}"))
}

#[test]
fn each_change_of_a_scene_gets_a_message_that_helps() {
    let folder = folder("messages-scenes");
    let write = |text: &str| fs::write(folder.join("scene.toml"), text).expect("a file");
    let mut failures = Vec::new();
    for (scene, table) in [
        (SCENE, include_str!("messages/scenes.txt")),
        (FULL, include_str!("messages/full_scenes.txt")),
    ] {
        for row in rows(table) {
            let (old, row) = row.split_once(" → ").expect("→");
            let cells: Vec<&str> = row.split(" | ").collect();
            let [old, new] = [old, cells[0]].map(plain);
            assert!(scene.contains(&old), "{old} is a place of the scene");
            write(&scene.replacen(&old, &new, 1));
            let (status, _, message) = run(&folder, "check SCENE");
            assert_eq!(status.to_string(), cells[1], "{new}: {message}");
            let line = format!("scene.toml, line {}: ", cells[2]);
            failures.extend(lacking(&new, &message, &[&[&*line], &cells[3..]].concat()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    write(SCENE);
    let (status, _, message) = run(&folder, "check SCENE");
    assert_eq!((status, &*message), (0, ""));
}

#[test]
fn each_command_has_its_exit_status_and_a_message_that_helps() {
    let path = &folder("messages-commands");
    let write = |name: &str, text: &[u8]| fs::write(path.join(name), text).expect("a file");
    let unfit = read(UPPER).replace("law = \"elastic-plastic\"", "law = \"sigmoid\"");
    let faulty = [
        ("scene.toml", SCENE.to_owned()),
        ("faulty.toml", SCENE.replace("1.3 m", "1.3 kN")),
        ("unclosed.toml", SCENE.replace("1.3 m\"", "1.3 m")),
        (
            "unfit.toml",
            unfit.replace("= 200", "= 20\n[solver]\nmethod = \"quasi-static\""),
        ),
    ];
    for (name, text) in &faulty {
        write(name, text.as_bytes());
    }
    for (_, name, bytes) in FILES {
        write(name, bytes);
    }
    write("given.csv", b"");
    let before = fs::read_dir(path).expect("the folder").count();
    let mut failures = Vec::new();
    for row in rows(include_str!("messages/commands.txt")) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let mut line = plain(cells[0]);
        if let Some((before, rest)) = cells[0].split_once('«') {
            let (given, after) = rest.split_once('»').expect("»");
            write("given.csv", plain(given).as_bytes());
            line = format!("{before}given.csv{after}");
        }
        let (names, rest) = line.split_once(' ').unwrap_or((&line, ""));
        for name in names.split('/') {
            let (status, said, message) = run(path, &format!("{name} {rest}"));
            failures.extend(lacking(&format!("{name} {rest}"), &message, &cells[2..]));
            if status.to_string() != cells[1] || (status != 0 && !said.is_empty()) {
                failures.push(format!("{name} {rest}\n  ends with {status}: {message}{said}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    // Nothing half made is left, and what was there before is what it was.
    assert_eq!(fs::read_dir(path).expect("the folder").count(), before);
    for (name, text) in faulty {
        assert_eq!(fs::read_to_string(path.join(name)).expect("a file"), text);
    }
    assert_eq!(fs::read(path.join("older.html")).expect("a file"), OLDER);
}

#[test]
fn readings_that_cannot_be_read_are_refused_with_their_cause() {
    let read = |name: &str, bytes: &[u8], words: &str| {
        let read = creepage::Readings::from_bytes(name, bytes, &options(words));
        read.expect_err(name).to_string()
    };
    for row in rows(include_str!("messages/readings.txt")) {
        let cells: Vec<&str> = row.split(" ‖ ").collect();
        let words = cells[1].trim_start_matches('-');
        let message = read("cell.csv", plain(cells[0]).as_bytes(), words);
        assert_eq!(lacking(cells[0], &message, &cells[2..]), None);
    }
    let photo = [0xFF, 0xD8, 0xFF, 0xE0, 0, 16, 1, 2];
    assert_says(&read("photo.jpg", &photo, ""), &["no text"]);
    assert_says(
        &read("notes.docx", b"PK\x03\x04 and more", ""),
        &["cannot be read"],
    );
}
