//! What is not the command's own is replaced only by force.

use super::common::{Folder, PRECIOUS, READINGS, SCENE, WRITERS, assert_complete, said};

#[test]
fn what_is_of_another_kind_is_kept_unless_forced() {
    let folder = Folder::new("kinds");
    let workbook = include_bytes!("../data/readings.xlsx");
    let foreign: [(&[u8], &str); 8] = [
        (workbook, "an Excel workbook"),
        (b"PK\x03\x04\x14\0", "a ZIP archive"),
        (PRECIOUS.as_bytes(), "a text"),
        (READINGS.as_bytes(), "a table of something else"),
        (SCENE.as_bytes(), "a scene"),
        (b"\x7fELF\x00", "binary data"),
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
            if (ending, looks) == ("svg", "an SVG figure") {
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
fn a_workbook_that_somebody_has_saved_is_theirs() {
    let folder = Folder::new("books");
    let run = ["run", "scene.toml", "--xlsx", "book.xlsx"];
    let sweep = [
        "sweep",
        "scene.toml",
        "--vary",
        "duct.depth=1,2",
        "--out",
        "book.xlsx",
    ];
    folder.succeeds(&run);
    folder.refused(&sweep, "found an Excel workbook, which would be lost");
    folder.succeeds(&[&sweep[..], &["--force"]].concat());
    folder.refused(&run, "found an Excel workbook, which would be lost");

    // Saved again by another program: the same parts in another order.
    let saved = include_bytes!("../data/saved.xlsx");
    folder.write("book.xlsx", saved);
    folder.refused(&run, "found an Excel workbook, which would be lost");
    // Half a file is none of ours.
    folder.succeeds(&[&run[..], &["--force"]].concat());
    let ours = folder.read("book.xlsx");
    folder.write("book.xlsx", &ours[..ours.len() / 2]);
    folder.refused(&run, "found an Excel workbook, which would be lost");
}

#[test]
fn the_shell_understands_its_script() {
    let folder = Folder::new("completions");
    folder.write("script", folder.succeeds(&["completions", "bash"]).stdout);
    let line = "source ./script; complete -p creepage; COMP_WORDS=(creepage ru) COMP_CWORD=1; _creepage creepage ru creepage; echo \"${COMPREPLY[@]}\"";
    let bash = folder.command("bash", &["-c", line]).output();
    let bash = bash.expect("bash starts");
    let told = String::from_utf8_lossy(&bash.stdout);
    assert!(
        told.starts_with("complete ") && told.ends_with("\nrun\n"),
        "{told}{}",
        said(&bash)
    );
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
