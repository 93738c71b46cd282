//! A file is there as a whole or as it was before.

use super::common::{Folder, said};

#[test]
fn on_a_full_disk_the_older_file_stays() {
    let folder = Folder::new("full");
    // Each writes more than the half kilobyte that is left to it.
    let sweep = "sweep scene.toml --vary friction.dynamic_coefficient=0.1:0.3:0.01 --out";
    for (command, name) in [
        ("run scene.toml --xlsx", "run.xlsx"),
        (sweep, "table.xlsx"),
        ("run scene.toml --set traffic.passes=40 --csv", "run.csv"),
        ("profile scene.toml --csv", "profile.csv"),
        ("report scene.toml -o", "page.html"),
        (sweep, "table.csv"),
    ] {
        let command = format!("{command} {name}");
        folder.succeeds(&command);
        let before = folder.contents();
        let output = folder.creepage_after("trap '' XFSZ\nulimit -f 1", &command);
        assert_eq!(output.status.code(), Some(1), "{command}: {}", said(&output));
        // A sweep goes on behind its rows when there is room.
        let unfinished = format!("{name}.unfinished");
        assert_eq!(folder.path(&unfinished).exists(), command.starts_with("sweep"));
        folder.remove(&unfinished);
        assert!(folder.contents() == before, "{command}: {:?}", folder.names());
    }
}

#[test]
fn what_fails_leaves_nothing_behind() {
    let folder = Folder::new("fails");
    let before = folder.contents();
    for command in [
        "run scene.toml --csv new.csv",
        "report scene.toml -o new.html",
        "calibrate scene.toml --data data.csv --csv new.csv",
        "run scene.toml --csv new.csv --force --json",
    ] {
        let output = folder.creepage(&format!(
            "{command} --set solver.method=explicit --set solver.time_step=1"
        ));
        assert!(matches!(output.status.code(), Some(1 | 2)), "{}", said(&output));
        assert!(folder.contents() == before, "{command}: {:?}", folder.names());
    }
    let sweep = "sweep scene.toml --out new.csv --map new.svg --vary duct.depth=1,2";
    for more in ["", "--vary duct.length=20m,30m --vary traffic.passes=1,2"] {
        folder.refused(&format!("{sweep} {more}"), "a map of two keys");
    }
    // Told before hours of computing; nobody makes files in /proc.
    for place in [".", "new.csv/", "scene.toml/new.csv", "/proc/new.csv"] {
        let hours = format!("run scene.toml --set traffic.passes=10000000 --csv {place}");
        folder.refused(&hours, "cannot be written");
    }
}
