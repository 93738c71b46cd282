//! Commands with outputs at random places, and what must hold after each: an oracle that knows the rules and no output.

use std::fs;
use std::process::Stdio;

use super::common::{Folder, PRECIOUS, WRITERS, assert_complete, said};

/// What stands at an output's place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Fresh,
    /// A file that ends as the output does.
    Older,
    /// A file that ends otherwise.
    Foreign,
    Input,
    HardLinkToInput,
    LinkToInput,
    LinkToOlder,
    LinkToForeign,
    Dangling,
    Folder,
    Nowhere,
    Null,
    StandardOutput,
    Pipe,
}

const PLACES: [Place; 14] = [
    Place::Fresh,
    Place::Older,
    Place::Foreign,
    Place::Input,
    Place::HardLinkToInput,
    Place::LinkToInput,
    Place::LinkToOlder,
    Place::LinkToForeign,
    Place::Dangling,
    Place::Folder,
    Place::Nowhere,
    Place::Null,
    Place::StandardOutput,
    Place::Pipe,
];
const CONTENTS: [&str; 2] = [PRECIOUS, ""];
const MODES: [u32; 4] = [0o600, 0o640, 0o644, 0o666];

impl Place {
    /// Makes the place in the folder; returns its name and that of the file which an output there would become.
    fn make(
        self,
        folder: &Folder,
        stem: &str,
        ending: &str,
        content: &str,
        mode: u32,
    ) -> (String, Option<String>) {
        let name = if self == Self::Foreign {
            stem.to_owned()
        } else {
            format!("{stem}.{ending}")
        };
        let target = if self == Self::LinkToForeign {
            format!("{stem}-target")
        } else {
            format!("{stem}-target.{ending}")
        };
        let file = |name: &str| {
            folder.write(name, content);
            folder.set_mode(name, mode);
        };
        let linked = match self {
            Self::Fresh => false,
            Self::Older | Self::Foreign => {
                file(&name);
                false
            }
            Self::Input => return ("scene.toml".into(), Some("scene.toml".into())),
            Self::HardLinkToInput => {
                folder.hard_link("scene.toml", &name);
                return (name, None);
            }
            Self::LinkToInput => {
                folder.link("scene.toml", &name);
                return (name, Some("scene.toml".into()));
            }
            Self::LinkToOlder | Self::LinkToForeign => {
                file(&target);
                true
            }
            Self::Dangling => true,
            Self::Folder => {
                fs::create_dir(folder.path(&name)).expect("a folder");
                return (name, None);
            }
            Self::Nowhere => return (format!("nowhere/{name}"), None),
            Self::Null => return ("/dev/null".into(), None),
            Self::StandardOutput => return ("/dev/stdout".into(), None),
            Self::Pipe => {
                assert!(
                    folder
                        .command("mkfifo", &[&name])
                        .status()
                        .expect("mkfifo")
                        .success()
                );
                return (name, None);
            }
        };
        if linked {
            folder.link(&target, &name);
            return (name, Some(target));
        }
        (name.clone(), Some(name))
    }

    /// Whether an output may go there.
    fn is_allowed(self, command: &str, ending: &str, force: bool) -> bool {
        let is_table_of_sweep = command == "sweep" && ending != "svg";
        match self {
            Self::Fresh | Self::Dangling | Self::Pipe => true,
            // Whoever made a scene keeps it.
            Self::Older | Self::LinkToOlder => command != "new" || force,
            Self::Foreign | Self::LinkToForeign => force,
            // A new scene reads none.
            Self::Input | Self::HardLinkToInput | Self::LinkToInput => command == "new" && force,
            Self::Folder | Self::Nowhere => false,
            // A workbook is no text.
            Self::StandardOutput if ending == "xlsx" => false,
            // These names do not tell a format.
            Self::Null | Self::StandardOutput => !is_table_of_sweep,
        }
    }
}

/// One command.
struct Case {
    arguments: Vec<String>,
    /// Place, name, the file that is written, ending.
    outputs: Vec<(Place, String, Option<String>, &'static str)>,
    force: bool,
}

fn case(folder: &Folder, random: &mut fastrand::Rng) -> Case {
    let n = random.usize(..=WRITERS.len());
    let (words, ending) = WRITERS.get(n).copied().unwrap_or((&["new"], "toml"));
    let mut arguments: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
    let mut outputs = Vec::new();
    let mut place = |stem: &str, ending: &'static str| {
        let content = CONTENTS[random.usize(..CONTENTS.len())];
        let place = PLACES[random.usize(..PLACES.len())];
        let mode = MODES[random.usize(..MODES.len())];
        let (name, file) = place.make(folder, stem, ending, content, mode);
        outputs.push((place, name.clone(), file, ending));
        name
    };
    if ending == "svg" {
        let out = arguments
            .iter()
            .position(|word| word == "table.csv")
            .expect("a table");
        arguments[out] = place("table", "csv");
    }
    arguments.push(place("out", ending));
    let force = random.bool();
    if force {
        arguments.push("--force".to_owned());
    }
    Case {
        arguments,
        outputs,
        force,
    }
}

fn try_cases(count: usize, seed: u64) {
    let mut random = fastrand::Rng::with_seed(seed);
    let (mut done, mut refused) = (0, 0);
    for _ in 0..count {
        let folder = Folder::new(&format!("random-{seed}"));
        let Case {
            arguments,
            outputs,
            force,
        } = case(&folder, &mut random);
        let command = arguments[0].as_str();
        let allowed = outputs.iter().all(|(place, name, _, ending)| {
            let is_table_of_sweep = command == "sweep" && *ending != "svg";
            // The scene's own name asks for no format of a table.
            let named = !is_table_of_sweep || name.ends_with(ending);
            named && place.is_allowed(command, ending, force)
        });
        let before = folder.contents();
        let modes: Vec<Option<u32>> = outputs
            .iter()
            .map(|(_, _, file, _)| {
                file.as_ref()
                    .filter(|file| before.contains_key(*file))
                    .map(|file| folder.mode(file))
            })
            .collect();
        // Whatever goes into a pipe is taken out.
        let pipes: Vec<_> = outputs
            .iter()
            .filter(|(place, ..)| *place == Place::Pipe)
            .map(|(_, name, _, ending)| {
                // Open for both, so that neither side waits for the other.
                let both = fs::OpenOptions::new()
                    .read(true)
                    .write(true)
                    .open(folder.path(name))
                    .expect("a pipe");
                let reader = folder
                    .command("cat", &[name])
                    .stdout(Stdio::piped())
                    .spawn()
                    .expect("cat");
                (both, reader, *ending)
            })
            .collect();
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = folder.creepage(&words);
        let tell = || format!("seed {seed}: {arguments:?} {outputs:?}\n{}", said(&output));
        assert_eq!(
            output.status.code(),
            Some(if allowed { 0 } else { 2 }),
            "{}",
            tell()
        );
        for (both, reader, ending) in pipes {
            // The reader has opened the pipe before its last writer goes.
            while !is_open(reader.id(), &folder) {
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            drop(both);
            let read = reader.wait_with_output().expect("cat");
            if allowed {
                assert_complete(&read.stdout, ending);
            }
        }
        let mut after = folder.contents();
        if !allowed {
            refused += 1;
            assert!(after == before, "{}", tell());
            continue;
        }
        done += 1;
        let mut expected = before.clone();
        for ((_, _, file, ending), mode) in outputs.iter().zip(modes) {
            let Some(file) = file else { continue };
            let content = after
                .remove(file)
                .unwrap_or_else(|| panic!("no {file}: {}", tell()));
            expected.remove(file);
            assert_complete(&content, ending);
            if let Some(mode) = mode {
                assert_eq!(folder.mode(file), mode, "{}", tell());
            }
        }
        // A forced new scene at another name of the file leaves the file as it was.
        if outputs[0].0 == Place::HardLinkToInput {
            after.remove(&outputs[0].1);
            expected.remove(&outputs[0].1);
        }
        assert!(after == expected, "{:?}: {}", after.keys(), tell());
        if outputs.iter().any(|(place, ..)| *place == Place::StandardOutput) {
            let (.., ending) = outputs[outputs.len() - 1];
            if ending != "csv" {
                assert!(!output.stdout.is_empty(), "{}", tell());
            }
        }
    }
    assert!(
        done > count / 5 && refused > count / 5,
        "{done} done, {refused} refused"
    );
}

/// Whether the process has opened a pipe in the folder or is over.
fn is_open(process: u32, folder: &Folder) -> bool {
    let Ok(open) = fs::read_dir(format!("/proc/{process}/fd")) else {
        return true;
    };
    open.filter_map(|entry| fs::read_link(entry.ok()?.path()).ok())
        .any(|path| path.starts_with(folder.path("")))
}

#[test]
fn whatever_stands_at_the_outputs_nothing_is_lost() {
    try_cases(80, 1);
}

#[test]
#[ignore = "a minute or more"]
fn whatever_stands_at_the_outputs_nothing_is_lost_in_a_thousand_cases() {
    try_cases(1000, 2);
}
