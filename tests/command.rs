//! The command `creepage` as one types it, and what it prints.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

pub const UPPER: &str = "examples/scenes/full-scale-upper.toml";
pub const SERIES: &str = "examples/data/synthetic-upper.csv";

/// The words of a line. What stands in `'…'` keeps its blanks; UPPER and SERIES are the experiment's scene and readings.
pub fn words(line: &str) -> Vec<String> {
    let quoted = |(index, part): (usize, &str)| match (index % 2, part) {
        (1, "") => "\u{2}".to_owned(),
        (1, part) => part.replace(' ', "\u{1}"),
        _ => part.to_owned(),
    };
    let marked: String = line.split('\'').enumerate().map(quoted).collect();
    let named = |word: &str| match word {
        "UPPER" => UPPER.to_owned(),
        "SERIES" => SERIES.to_owned(),
        word => word.replace('\u{1}', " ").replace('\u{2}', ""),
    };
    marked.split_whitespace().map(named).collect()
}

pub fn command(line: &str) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("creepage"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(words(line))
        .stdin(Stdio::null());
    command
}

/// Exit status, standard output and standard error.
pub fn output(line: &str) -> (i32, String, String) {
    answer(command(line).output().expect("the command starts"))
}

/// The same of an output.
pub fn answer(output: Output) -> (i32, String, String) {
    let [said, errors] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
    (output.status.code().expect("no signal"), said, errors)
}

/// What a command that succeeds prints, with nothing on standard error.
#[track_caller]
pub fn printed(line: &str) -> String {
    let (status, said, errors) = output(line);
    assert_eq!((status, &*errors), (0, ""), "{line}");
    said
}

/// The document of a command that succeeds: the whole of standard output, and of standard error nothing but progress.
#[track_caller]
pub fn json(line: &str) -> Value {
    let (document, errors) = answered(line);
    assert_eq!(errors, "", "{line}");
    document
}

/// The document of a command that succeeds, and its warnings.
#[track_caller]
pub fn answered(line: &str) -> (Value, String) {
    let (status, said, errors) = output(&format!("{line} --json"));
    assert_eq!(status, 0, "{line}: {errors}");
    (
        serde_json::from_str(&said).expect("JSON and nothing else"),
        errors,
    )
}

/// Asserts that `said` has all of `parts`.
#[track_caller]
pub fn assert_says(said: &str, parts: &[&str]) {
    for part in parts {
        assert!(said.contains(part), "{part} is not in\n{said}");
    }
}

/// An empty folder for the files of one test.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("command").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// A file of the repository as a text.
pub fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect(path)
}

#[track_caller]
pub fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is not a number"))
}

#[track_caller]
pub fn list(value: &Value) -> &[Value] {
    value
        .as_array()
        .unwrap_or_else(|| panic!("{value} is not a list"))
}

#[track_caller]
pub fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// Header and rows of a CSV file.
pub fn table(file: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(file).expect("a CSV file");
    let own = |row: &csv::StringRecord| row.iter().map(String::from).collect();
    let header = own(reader.headers().expect("a header"));
    (
        header,
        reader.records().map(|row| own(&row.expect("a row"))).collect(),
    )
}
