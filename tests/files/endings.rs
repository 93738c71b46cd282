//! What does not end as the output does is replaced only by force.

use super::common::{Folder, PRECIOUS, SCENE, WRITERS, assert_complete, said};

#[test]
fn what_ends_as_the_output_does_is_replaced() {
    let folder = Folder::new("endings");
    for (arguments, ending) in WRITERS {
        for name in [
            format!("target.{ending}"),
            format!("TARGET.{}", ending.to_uppercase()),
        ] {
            for content in [PRECIOUS, ""] {
                folder.write(&name, content);
                folder.succeeds(&[arguments, &[&*name]].concat());
                assert_complete(&folder.read(&name), ending);
            }
        }
    }
}

#[test]
fn what_ends_otherwise_is_kept_unless_forced() {
    let folder = Folder::new("other-endings");
    for (arguments, ending) in WRITERS {
        // A table of a sweep is known by its ending, and so a link leads to the file.
        let link = format!("link.{ending}");
        for name in [
            "notes",
            "notes.txt",
            "notes.toml",
            "notes.csv.bak",
            &*format!("notes{ending}"),
        ] {
            let _ = std::fs::remove_file(folder.path(&link));
            folder.link(name, &link);
            folder.write(name, PRECIOUS);
            let command = [arguments, &[&*link]].concat();
            folder.refused(&command, &format!("{name}: found a file that would be lost"));
            folder.refused(
                &command,
                &format!(".{ending} file, which is replaced, or --force"),
            );
            folder.succeeds(&[&command[..], &["--force"]].concat());
            assert_complete(&folder.read(name), ending);
        }
    }
    // By their own names too, and an empty file is a file.
    for (arguments, name) in [
        (&["run", "scene.toml", "--csv"], "notes.txt"),
        (&["report", "scene.toml", "-o"], "notes"),
    ] {
        for content in [PRECIOUS, ""] {
            folder.write(name, content);
            folder.refused(&[&arguments[..], &[name]].concat(), "--force");
        }
    }
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
    folder.write("empty.toml", "");
    for (name, part) in [
        ("scene.toml", "exists"),
        ("empty.toml", "exists"),
        ("notes.txt", "would be lost"),
    ] {
        folder.refused(&["new", name], part);
        folder.succeeds(&["new", name, "--force"]);
        assert_complete(&folder.read(name), "toml");
        assert!(folder.read(name) != SCENE.as_bytes());
    }
}
