//! Every command that writes, with its output at every place, and what must hold after each: an oracle that knows the rules and no output.

use std::fs::{self, OpenOptions};
use std::os::unix::fs::{MetadataExt, chown};
use std::process::{Child, Stdio};

use super::common::{Folder, PRECIOUS, WRITERS, assert_complete, said};

/// What stands at an output's place: a file that ends as the output does is older, one that ends otherwise foreign.
type Place = &'static str;

const PLACES: &str = "nothing; older; older, in capitals; foreign; scene; scene by another way; hard link to scene; link to scene; \
    link to link to scene; readings; hard link to readings; link to older; link to foreign; link to nothing; link to itself; folder; \
    in no folder; null; standard output; pipe";

fn places() -> impl Iterator<Item = Place> {
    PLACES.split("; ")
}

/// An output of a command: its name, the file that is written there if any, and its ending.
#[derive(Debug)]
struct Out {
    place: Place,
    name: String,
    file: Option<String>,
    ending: &'static str,
}

impl Out {
    /// Makes the place in the folder; a file there has this content.
    fn make(place: Place, folder: &Folder, stem: &str, ending: &'static str, content: &str) -> Self {
        let own = format!("{stem}.{ending}");
        let target = if place == "link to foreign" {
            "sub/target".to_owned()
        } else {
            format!("sub/target-{own}")
        };
        let (name, file) = match place {
            "foreign" => (stem.to_owned(), stem.to_owned()),
            "older, in capitals" => (own.to_uppercase(), own.to_uppercase()),
            "scene" => ("scene.toml".into(), "scene.toml".into()),
            "scene by another way" => ("../places/scene.toml".into(), "scene.toml".into()),
            "link to scene" | "link to link to scene" => (own, "scene.toml".into()),
            "readings" => ("data.csv".into(), "data.csv".into()),
            "link to older" | "link to foreign" | "link to nothing" => (own, target),
            "in no folder" => (format!("nowhere/{own}"), String::new()),
            "null" => ("/dev/null".into(), String::new()),
            "standard output" => ("/dev/stdout".into(), String::new()),
            "link to itself" | "folder" | "pipe" => (own, String::new()),
            _ => (own.clone(), own),
        };
        match place {
            "older" | "older, in capitals" | "foreign" => folder.write(&file, content),
            "hard link to scene" => folder.hard_link("scene.toml", &name),
            "hard link to readings" => folder.hard_link("data.csv", &name),
            "folder" => fs::create_dir(folder.path(&name)).expect("a folder"),
            "link to itself" => folder.link(&name, &name),
            "pipe" => drop(folder.command("mkfifo", &[&name]).status().expect("mkfifo")),
            "link to link to scene" => {
                folder.link("scene.toml", &format!("soft-{stem}"));
                folder.link(&format!("soft-{stem}"), &name);
            }
            "link to scene" | "link to nothing" => folder.link(&file, &name),
            "link to older" | "link to foreign" => {
                folder.write(&file, content);
                folder.link(&file, &name);
            }
            _ => {}
        }
        Self {
            place,
            name,
            file: Some(file).filter(|file| !file.is_empty()),
            ending,
        }
    }

    /// Whether an output of the command may go there.
    fn is_allowed(&self, command: &str, force: bool) -> bool {
        let (is_new, ending) = (command.starts_with("new"), self.ending);
        let is_table_of_sweep = command.starts_with("sweep") && ending != "svg";
        let reads = command.contains("data.csv");
        // Whoever made a scene keeps it.
        let older = !is_new || force;
        let allowed = match self.place {
            "nothing" | "link to nothing" | "pipe" => true,
            "older" | "older, in capitals" | "link to older" => older,
            "foreign" | "link to foreign" => force,
            // A new scene reads none.
            "scene"
            | "scene by another way"
            | "hard link to scene"
            | "link to scene"
            | "link to link to scene" => is_new && force,
            "readings" => !reads && ending == "csv",
            "hard link to readings" => !reads && older,
            "link to itself" | "folder" | "in no folder" => false,
            // A workbook is no text.
            "standard output" if ending == "xlsx" => false,
            // These names do not tell a format.
            "null" | "standard output" => !is_table_of_sweep,
            _ => panic!("{}", self.place),
        };
        // A table of a sweep is known by its ending.
        allowed && (!is_table_of_sweep || self.name.to_lowercase().ends_with(ending))
    }
}

/// A process that takes out whatever goes into a pipe, which is open for both so that neither side waits for the other.
fn reader(folder: &Folder, name: &str) -> (fs::File, Child) {
    let both = OpenOptions::new().read(true).write(true).open(folder.path(name));
    let reader = folder.command("cat", &[name]).stdout(Stdio::piped()).spawn();
    (both.expect("a pipe"), reader.expect("cat"))
}

/// What went through a pipe.
fn taken_out((both, reader): (fs::File, Child), folder: &Folder) -> Vec<u8> {
    // The reader has opened the pipe before its last writer goes.
    let is_open = || match fs::read_dir(format!("/proc/{}/fd", reader.id())) {
        Ok(mut open) => open.any(|entry| {
            let path = entry.and_then(|entry| fs::read_link(entry.path()));
            path.is_ok_and(|path| path.starts_with(folder.path("")))
        }),
        Err(_) => true,
    };
    while !is_open() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    drop(both);
    reader.wait_with_output().expect("cat").stdout
}

/// Mode, owner and number of a file.
fn identity(folder: &Folder, name: &str) -> (u32, u32, u64) {
    let found = fs::metadata(folder.path(name)).expect("a file");
    (folder.mode(name), found.uid(), found.ino())
}

/// Whether both outputs would be written to one file, by one name or by two.
fn are_one(folder: &Folder, one: &Out, other: &Out) -> bool {
    let (Some(one), Some(other)) = (&one.file, &other.file) else {
        return false;
    };
    let number = |file: &String| Some(fs::metadata(folder.path(file)).ok()?.ino());
    one == other || number(one).is_some_and(|found| number(other) == Some(found))
}

/// Runs the command with its outputs at these places; whether it was allowed.
fn try_case(command: &str, places: &[(Place, &str, &'static str)], force: bool, number: usize) -> bool {
    let folder = Folder::new("places");
    let content = [PRECIOUS, ""][number % 2];
    let make = |&(place, stem, ending): &(Place, &str, &'static str)| {
        Out::make(place, &folder, stem, ending, content)
    };
    let outputs: Vec<Out> = places.iter().map(make).collect();
    let before = folder.contents();
    let standing = outputs.iter().filter_map(|out| out.file.as_ref());
    let standing: Vec<&String> = standing.filter(|file| before.contains_key(*file)).collect();
    for file in &standing {
        // Only root may give a file away.
        let _ = chown(folder.path(file), Some(65534), Some(65534));
        folder.set_mode(file, [0o600, 0o640, 0o664, 0o666][number % 4]);
    }
    let identities: Vec<_> = standing.iter().map(|file| identity(&folder, file)).collect();
    let is_twice = matches!(&outputs[..], [one, other] if are_one(&folder, one, other));
    let allowed = !is_twice && outputs.iter().all(|out| out.is_allowed(command, force));

    let last = outputs.last().expect("an output");
    let line = format!(
        "{} {}{}",
        command.replace("OUT", &outputs[0].name),
        last.name,
        if force { " --force" } else { "" }
    );
    let pipes = outputs.iter().filter(|out| out.place == "pipe");
    let pipes: Vec<_> = pipes
        .map(|out| (reader(&folder, &out.name), out.ending))
        .collect();
    let output = folder.creepage_after("umask 027", &line);
    let tell = || format!("{line}: {outputs:?}\n{}", said(&output));
    let expected = if allowed { 0 } else { 2 };
    assert_eq!(output.status.code(), Some(expected), "{}", tell());
    for (pipe, ending) in pipes {
        let read = taken_out(pipe, &folder);
        if allowed {
            assert_complete(&read, ending);
        }
    }
    let mut after = folder.contents();
    if !allowed {
        assert!(after == before, "{}", tell());
        return false;
    }
    let mut kept = before.clone();
    for out in &outputs {
        let Some(file) = &out.file else { continue };
        let written = after
            .remove(file)
            .unwrap_or_else(|| panic!("no {file}: {}", tell()));
        assert_complete(&written, out.ending);
        if kept.remove(file).is_none() {
            assert_eq!(folder.mode(file), 0o640, "{}", tell());
        }
    }
    assert!(after == kept, "{:?}: {}", after.keys(), tell());
    // A file is replaced by another with its mode and owner, and not written into.
    for (file, (mode, owner, number)) in standing.into_iter().zip(identities) {
        let found = identity(&folder, file);
        assert_eq!((found.0, found.1), (mode, owner), "{}", tell());
        assert_ne!(found.2, number, "{}", tell());
    }
    if last.place == "standard output" {
        assert!(last.ending == "csv" || !output.stdout.is_empty(), "{}", tell());
        if last.ending == "html" {
            assert_complete(&output.stdout, "html");
        }
    }
    true
}

#[test]
fn whatever_stands_at_the_output_nothing_is_lost() {
    let mut count = [0, 0];
    for (command, ending) in WRITERS.into_iter().chain([("new", "toml")]) {
        for (index, place) in places().enumerate() {
            // A table may be replaced, and no other output has its ending.
            if place == "readings" && ending != "csv" && !command.contains("data.csv") {
                continue;
            }
            for force in [false, true] {
                let number = 2 * index + usize::from(force);
                let mut outputs = vec![(place, "out", ending)];
                if ending == "svg" {
                    // The table of a map stands at other places in turn.
                    let table = places().nth((7 * number) % 20).filter(|_| index % 2 == 0);
                    outputs.insert(0, (table.unwrap_or("nothing"), "table", "csv"));
                }
                count[usize::from(try_case(command, &outputs, force, number))] += 1;
            }
        }
    }
    assert!(count.iter().all(|count| *count > 100), "{count:?}");
}

#[test]
#[ignore = "all pairs of places of a table and its map: a minute"]
fn whatever_stands_at_two_outputs_nothing_is_lost() {
    let (command, ending) = WRITERS[6];
    for (number, table) in places().enumerate() {
        for map in places().filter(|map| *map != "readings") {
            let outputs = [(table, "table", "csv"), (map, "out", ending)];
            for force in [false, true] {
                try_case(command, &outputs, force, number);
            }
        }
    }
}
