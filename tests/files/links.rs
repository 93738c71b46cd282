//! Devices, pipes, links to a sweep's own files, and outputs that are inputs or each other.

use std::fs::{self, File, OpenOptions};
use std::os::unix::fs::FileTypeExt;
use std::process::Stdio;

use super::common::{Folder, MAP, PRECIOUS, SCENE, SWEEP, said};

#[test]
fn devices_are_written_as_they_are() {
    let folder = Folder::new("devices");
    folder.succeeds("report scene.toml -o /dev/null");
    let null = fs::metadata("/dev/null").expect("the null device");
    assert!(null.file_type().is_char_device());
    folder.refused("run scene.toml --csv /dev/stdout --json", "where --json prints");
    // Into a file as well, where the table is followed by the answer in words.
    let both = OpenOptions::new()
        .create(true)
        .append(true)
        .open(folder.path("both"));
    let mut command = folder.piped("run scene.toml --csv /dev/stdout");
    let status = command.stdout(both.expect("a file")).status();
    assert!(status.expect("the command").success());
    let both = String::from_utf8(folder.read("both")).expect("UTF-8");
    assert!(both.starts_with("pass,") && both.contains("\nSmall\n") && both.contains("estimated error"));
}

#[test]
fn a_sweep_follows_no_link_to_its_own_files() {
    let folder = Folder::new("unfinished");
    let sweep = format!("{SWEEP} --out out.csv");
    for (victim, to) in [("", "victim"), (PRECIOUS, "victim"), (PRECIOUS, "nowhere")] {
        folder.write("victim", victim);
        folder.link(to, "out.csv.unfinished");
        folder.refused(&sweep, "found a link");
        folder.remove("out.csv.unfinished");
    }
    folder.link("victim", "out.csv.partial");
    folder.succeeds(&sweep);
    assert_eq!(folder.read("victim"), PRECIOUS.as_bytes());
    let table = fs::symlink_metadata(folder.path("out.csv"));
    assert!(!table.expect("a table").is_symlink());
    folder.remove("out.csv.partial");
    folder.write("out.csv.partial", PRECIOUS);
    folder.succeeds(&sweep);
    assert_eq!(folder.read("out.csv.partial"), PRECIOUS.as_bytes());
}

#[test]
fn standard_input_and_output_may_be_the_scene() {
    let folder = Folder::new("redirected");
    let mut read = folder.piped("run /dev/stdin --csv scene.toml --force");
    read.stdin(Stdio::from(
        File::open(folder.path("scene.toml")).expect("the scene"),
    ));
    let mut written = folder.piped("run scene.toml --csv /dev/stdout");
    let appended = OpenOptions::new().append(true).open(folder.path("scene.toml"));
    written.stdout(appended.expect("the scene"));
    for mut command in [read, written] {
        let output = command.output().expect("the command");
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert_eq!(folder.read("scene.toml"), SCENE.as_bytes());
    }
}

#[test]
fn no_file_is_written_twice() {
    let folder = Folder::new("twice");
    folder.link("out.csv", "link");
    for map in ["out.csv", "./out.csv", "link"] {
        folder.refused(
            &format!("{MAP} --out out.csv --map {map} --force"),
            "writes twice",
        );
    }
}
