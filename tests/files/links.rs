//! Links, permissions, pipes and devices.

use std::fs::{self, OpenOptions};
use std::os::unix::fs::{FileTypeExt, MetadataExt, chown};

use super::common::{Folder, PRECIOUS, WRITERS, assert_complete, said};

#[test]
fn what_a_link_points_to_is_replaced_and_the_link_stays() {
    let folder = Folder::new("links");
    fs::create_dir(folder.path("sub")).expect("a folder");
    for (arguments, ending) in WRITERS {
        let [link, target] = [
            format!("link.{ending}"),
            format!("sub/target-{}.{ending}", arguments[0]),
        ];
        let _ = fs::remove_file(folder.path(&link));
        folder.link(&target, &link);
        // The first time nothing is there.
        for _ in 0..2 {
            folder.succeeds(&[arguments, &[&*link]].concat());
            assert_eq!(
                fs::read_link(folder.path(&link)).expect("a link").to_str(),
                Some(&*target)
            );
            assert_complete(&folder.read(&target), ending);
        }
    }
    folder.link("round", "circle");
    folder.link("circle", "round");
    folder.refused(&["run", "scene.toml", "--csv", "round"], "cannot be written");
}

#[test]
fn permissions_are_kept_and_new_files_follow_the_umask() {
    let folder = Folder::new("modes");
    for (arguments, ending) in WRITERS {
        let name = format!("target.{ending}");
        let command = [arguments, &[&*name]].concat();
        let _ = fs::remove_file(folder.path(&name));
        let output = folder.creepage_after("umask 027", &command);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert_eq!(folder.mode(&name), 0o640, "{command:?}");
        for mode in [0o600, 0o664] {
            folder.set_mode(&name, mode);
            let number = fs::metadata(folder.path(&name)).expect("a file").ino();
            folder.succeeds(&command);
            assert_eq!(folder.mode(&name), mode, "{command:?}");
            let replaced = fs::metadata(folder.path(&name)).expect("a file").ino();
            assert_ne!(number, replaced, "{command:?} wrote into the file");
        }
        // Only root may give a file away.
        if chown(folder.path(&name), Some(65534), Some(65534)).is_ok() {
            folder.succeeds(&command);
            let found = fs::metadata(folder.path(&name)).expect("a file");
            assert_eq!(
                (found.uid(), found.gid(), folder.mode(&name)),
                (65534, 65534, 0o664),
                "{command:?}"
            );
        }
    }
}

#[test]
fn devices_and_pipes_are_written_as_they_are() {
    let folder = Folder::new("devices");
    let page = ["report", "scene.toml", "-o"];
    let table = ["run", "scene.toml", "--csv"];
    folder.succeeds(&[&page[..], &["/dev/null"]].concat());
    let null = fs::metadata("/dev/null").expect("the null device");
    assert!(null.file_type().is_char_device());
    let out = folder.succeeds(&[&page[..], &["/dev/stdout"]].concat()).stdout;
    assert_complete(&out, "html");

    folder.refused(
        &[&table[..], &["/dev/stdout", "--json"]].concat(),
        "where --json prints",
    );

    // Into a file as well, where the table is followed by the answer in words.
    let out = OpenOptions::new()
        .create(true)
        .append(true)
        .open(folder.path("both"));
    let mut command = folder.command(
        super::common::creepage(),
        &[&table[..], &["/dev/stdout"]].concat(),
    );
    assert!(
        command
            .stdout(out.expect("a file"))
            .status()
            .expect("the command")
            .success()
    );
    let both = String::from_utf8(folder.read("both")).expect("UTF-8");
    assert!(
        both.starts_with("pass,") && both.contains("\nSmall\n") && both.contains("estimated error"),
        "{both}"
    );

    assert!(
        folder
            .command("mkfifo", &["pipe"])
            .status()
            .expect("mkfifo")
            .success()
    );
    let reader = folder
        .command("cat", &["pipe"])
        .stdout(std::process::Stdio::piped())
        .spawn();
    folder.succeeds(&[&table[..], &["pipe"]].concat());
    let read = reader
        .expect("cat")
        .wait_with_output()
        .expect("what went through");
    assert_complete(&read.stdout, "csv");
    assert!(
        fs::metadata(folder.path("pipe"))
            .expect("a pipe")
            .file_type()
            .is_fifo()
    );
}

#[test]
fn a_sweep_follows_no_link_to_its_own_files() {
    let folder = Folder::new("unfinished");
    let sweep = [
        "sweep",
        "scene.toml",
        "--vary",
        "duct.depth=1,2",
        "--out",
        "out.csv",
    ];
    for victim in ["", PRECIOUS] {
        folder.write("victim", victim);
        let _ = fs::remove_file(folder.path("out.csv.unfinished"));
        folder.link("victim", "out.csv.unfinished");
        folder.refused(&sweep, "found a link");
    }
    fs::remove_file(folder.path("out.csv.unfinished")).expect("the link");
    folder.link("nowhere", "out.csv.unfinished");
    folder.refused(&sweep, "found a link");
    fs::remove_file(folder.path("out.csv.unfinished")).expect("the link");

    folder.link("victim", "out.csv.partial");
    folder.succeeds(&sweep);
    assert_eq!(folder.read("victim"), PRECIOUS.as_bytes());
    assert!(
        !fs::symlink_metadata(folder.path("out.csv"))
            .expect("a table")
            .is_symlink()
    );
    fs::remove_file(folder.path("out.csv.partial")).expect("the link");
    folder.write("out.csv.partial", PRECIOUS);
    folder.succeeds(&sweep);
    assert_eq!(folder.read("out.csv.partial"), PRECIOUS.as_bytes());
}
