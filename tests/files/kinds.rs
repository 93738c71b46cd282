//! What is not the command's own is replaced only by force.

use super::common::{Folder, PRECIOUS, READINGS, SCENE, WRITERS, assert_complete};

#[test]
fn what_is_of_another_kind_is_kept_unless_forced() {
    let folder = Folder::new("kinds");
    let foreign: [(&[u8], &str); 7] = [
        (PRECIOUS.as_bytes(), "a text"),
        (READINGS.as_bytes(), "a table of something else"),
        (SCENE.as_bytes(), "a scene"),
        (b"\x7fELF\x00", "binary data"),
        (b"PAR1xxxxPAR1", "a Parquet file"),
        (
            b"<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>",
            "an SVG figure",
        ),
        (b"<!DOCTYPE html>\n<title>of mine</title>\n", "a page of HTML"),
    ];
    for (arguments, ending) in WRITERS {
        let name = format!("target.{ending}");
        let command = [arguments, &[&*name]].concat();
        for (content, looks) in foreign {
            if matches!(
                (ending, looks),
                ("parquet", "a Parquet file") | ("svg", "an SVG figure")
            ) {
                continue;
            }
            folder.write(&name, content);
            folder.refused(&command, &format!("found {looks}, which would be lost"));
            folder.refused(&command, "--force");
        }
        folder.succeeds(&[&command[..], &["--force"]].concat());
        assert_complete(&folder.read(&name), ending);
        // Its own is replaced, and so is what is empty.
        folder.succeeds(&command);
        folder.write(&name, "");
        folder.succeeds(&command);
        assert_complete(&folder.read(&name), ending);
    }
}

#[test]
fn a_table_of_another_command_is_of_another_kind() {
    let folder = Folder::new("tables");
    let tables: Vec<_> = WRITERS.iter().filter(|(_, ending)| *ending == "csv").collect();
    assert_eq!(tables.len(), 4);
    for (first, _) in &tables {
        let _ = std::fs::remove_file(folder.path("target.csv"));
        folder.succeeds(&[first, &["target.csv"][..]].concat());
        for (second, _) in &tables {
            if first != second {
                folder.refused(
                    &[second, &["target.csv"][..]].concat(),
                    &format!("found a table of `creepage {}`", first[0]),
                );
            }
        }
    }
}

#[test]
fn a_new_scene_replaces_nothing_unless_forced() {
    let folder = Folder::new("new");
    folder.write("notes.txt", PRECIOUS);
    for name in ["scene.toml", "notes.txt"] {
        folder.refused(&["new", name], "exists");
        folder.succeeds(&["new", name, "--force"]);
        assert_complete(&folder.read(name), "toml");
        assert!(folder.read(name) != SCENE.as_bytes());
    }
    folder.write("empty.toml", "");
    folder.succeeds(&["new", "empty.toml"]);
    assert_complete(&folder.read("empty.toml"), "toml");
}
