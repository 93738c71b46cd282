//! No output replaces a file that the same command reads, by whatever name, and none is written twice.

use std::fs::{File, OpenOptions};
use std::process::Stdio;

use super::common::{Folder, SCENE, WRITERS, creepage, said};

#[test]
fn an_input_is_never_replaced_by_any_of_its_names() {
    let folder = Folder::new("inputs");
    folder.hard_link("scene.toml", "hard");
    folder.link("scene.toml", "soft");
    folder.link("soft", "softer");
    folder.hard_link("data.csv", "hard-data");
    folder.write("sub", "");
    for (arguments, ending) in WRITERS {
        let mut names = vec![
            "scene.toml",
            "./scene.toml",
            "../inputs/scene.toml",
            "hard",
            "soft",
            "softer",
        ];
        if arguments.contains(&"data.csv") {
            names.extend(["data.csv", "hard-data"]);
        }
        for (n, name) in names.into_iter().enumerate() {
            // A table of a sweep is known by its ending.
            let linked = format!("linked-{n}.{ending}");
            let name = if arguments.last() == Some(&"--out") {
                let _ = std::fs::remove_file(folder.path(&linked));
                folder.link(name, &linked);
                &linked
            } else {
                name
            };
            for force in [&[][..], &["--force"]] {
                folder.refused(
                    &[arguments, &[name], force].concat(),
                    "which is read by this command",
                );
            }
        }
    }
}

#[test]
fn standard_input_and_output_may_be_files() {
    let folder = Folder::new("redirected");
    let scene = || Stdio::from(File::open(folder.path("scene.toml")).expect("the scene"));
    let mut read = folder.command(
        creepage(),
        &["run", "/dev/stdin", "--csv", "scene.toml", "--force"],
    );
    let output = read.stdin(scene()).output().expect("the command");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert_eq!(folder.read("scene.toml"), SCENE.as_bytes());

    let appended = OpenOptions::new().append(true).open(folder.path("scene.toml"));
    let mut written = folder.command(creepage(), &["run", "scene.toml", "--csv", "/dev/stdout"]);
    let output = written
        .stdout(appended.expect("the scene"))
        .output()
        .expect("the command");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert_eq!(folder.read("scene.toml"), SCENE.as_bytes());
}

#[test]
fn no_file_is_written_twice() {
    let folder = Folder::new("twice");
    folder.link("out.csv", "link");
    let sweep = [
        "sweep",
        "scene.toml",
        "--vary",
        "duct.depth=1,2",
        "--vary",
        "duct.length=20m,30m",
        "--out",
        "out.csv",
    ];
    for map in ["out.csv", "./out.csv", "link"] {
        folder.refused(&[&sweep[..], &["--map", map, "--force"]].concat(), "writes twice");
    }
}
