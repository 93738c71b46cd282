//! A file is there as a whole or as it was before.

use super::common::{Folder, PRECIOUS, said};

#[test]
fn on_a_full_disk_the_older_file_stays() {
    let folder = Folder::new("full");
    // Each writes more than the half kilobyte that is left to it.
    let positions = "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16";
    let friction = "friction.dynamic_coefficient=0.1:0.3:0.01";
    let commands: [(&[&str], &str); 6] = [
        (&["run", "scene.toml", "--xlsx"], "run.xlsx"),
        (
            &["sweep", "scene.toml", "--vary", friction, "--out"],
            "table.xlsx",
        ),
        (
            &["run", "scene.toml", "--set", "traffic.passes=40", "--csv"],
            "run.csv",
        ),
        (
            &["profile", "scene.toml", "--positions", positions, "--csv"],
            "profile.csv",
        ),
        (&["report", "scene.toml", "-o"], "page.html"),
        (&["sweep", "scene.toml", "--vary", friction, "--out"], "table.csv"),
    ];
    for (arguments, name) in commands {
        let command = [arguments, &[name]].concat();
        folder.succeeds(&command);
        let before = folder.contents();
        let output = folder.creepage_after("trap '' XFSZ\nulimit -f 1", &command);
        assert_eq!(output.status.code(), Some(1), "{command:?}: {}", said(&output));
        assert!(said(&output).contains("too large"), "{}", said(&output));
        // A sweep goes on behind its rows when there is room.
        let unfinished = folder.path(&format!("{name}.unfinished"));
        assert_eq!(unfinished.exists(), arguments[0] == "sweep");
        let _ = std::fs::remove_file(unfinished);
        assert!(folder.contents() == before, "{command:?}: {:?}", folder.names());
    }
}

#[test]
fn what_fails_leaves_nothing_behind() {
    let folder = Folder::new("fails");
    let unstable = ["--set", "solver.method=explicit", "--set", "solver.time_step=1"];
    let commands: [&[&str]; 4] = [
        &["run", "scene.toml", "--csv", "new.csv"],
        &["report", "scene.toml", "-o", "new.html"],
        &[
            "calibrate",
            "scene.toml",
            "--data",
            "data.csv",
            "--csv",
            "new.csv",
        ],
        &["run", "scene.toml", "--csv", "new.csv", "--force", "--json"],
    ];
    let before = folder.contents();
    for command in commands {
        let output = folder.creepage(&[command, &unstable].concat());
        assert!(matches!(output.status.code(), Some(1 | 2)), "{}", said(&output));
        assert!(folder.contents() == before, "{command:?}: {:?}", folder.names());
    }
    let sweep = [
        "sweep",
        "scene.toml",
        "--out",
        "new.csv",
        "--map",
        "new.svg",
        "--vary",
        "duct.depth=1,2",
    ];
    folder.refused(&sweep, "a map of two keys");
    let three = ["--vary", "duct.length=20m,30m", "--vary", "traffic.passes=1,2"];
    folder.refused(&[&sweep[..], &three].concat(), "a map of two keys");
    for place in ["no-such-folder/new.csv", ".", "new.csv/", "scene.toml/new.csv"] {
        folder.refused(&["run", "scene.toml", "--csv", place], "cannot be written");
    }
}

#[test]
fn an_unwritable_place_is_told_before_hours_of_computing() {
    let folder = Folder::new("unwritable");
    std::fs::create_dir(folder.path("closed")).expect("a folder");
    folder.write("closed/old.csv", PRECIOUS);
    folder.set_mode("closed", 0o555);
    let hours = ["run", "scene.toml", "--set", "traffic.passes=10000000", "--csv"];
    // Nobody makes files there.
    let mut places = vec!["/proc/new.csv"];
    // Root makes files everywhere else.
    if std::fs::write(folder.path("closed/probe"), "").is_err() {
        places.push("closed/new.csv");
    }
    for place in places {
        folder.refused(&[&hours[..], &[place]].concat(), "cannot be written");
    }
    folder.set_mode("closed", 0o755);
}
