//! How the files lie: none of them is long, their imports run one way, and no test is forgotten.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Most lines of a file of code, its tests included.
const LONGEST: usize = 400;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Files of Rust below `folder`, as paths from the root.
fn rust_files(folder: &str) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(
                    path.strip_prefix(root())
                        .unwrap()
                        .to_string_lossy()
                        .replace('\\', "/"),
                );
            }
        }
    }
    files.sort();
    files
}

/// The folders of code: of the root package and of every crate.
fn sources() -> Vec<String> {
    let crates = fs::read_dir(root().join("crates")).unwrap().flatten();
    let folder = |name: PathBuf| format!("crates/{}/src", name.to_string_lossy());
    let crates = crates.map(|entry| folder(entry.file_name().into()));
    let mut sources: Vec<String> = crates.collect();
    sources.push("src".into());
    sources
}

#[test]
fn no_file_is_long() {
    let files = sources().into_iter().flat_map(|folder| rust_files(&folder));
    let lines = |file: &String| fs::read_to_string(root().join(file)).unwrap().lines().count();
    let long: Vec<String> = files
        .filter(|file| lines(file) > LONGEST)
        .map(|file| format!("{file}: {}", lines(&file)))
        .collect();
    assert!(long.is_empty(), "more than {LONGEST} lines: {long:#?}");
}

/// A scene is checked as data: only the page's digest of a scene without a file needs its text, and what `explore` saves.
#[test]
fn no_run_writes_its_scene_as_text() {
    let writes = |file: &String| {
        fs::read_to_string(root().join(file))
            .unwrap()
            .contains(".to_toml()")
    };
    let writers: Vec<String> = [
        "src",
        "crates/run/src",
        "crates/fit/src",
        "crates/study/src",
        "crates/report/src",
    ]
    .iter()
    .flat_map(|folder| rust_files(folder))
    .filter(writes)
    .collect();
    assert_eq!(
        writers,
        ["src/cli/explore/session.rs", "crates/report/src/content.rs"]
    );
}

/// Where a package names its test programs itself, only what `Cargo.toml` or `tests/main.rs` names is compiled.
#[test]
fn every_test_belongs_to_a_program() {
    let mut lost = Vec::new();
    for source in sources() {
        let package = root().join(source).parent().unwrap().to_owned();
        let read = |file: &str| fs::read_to_string(package.join(file)).unwrap_or_default();
        let named = read("Cargo.toml") + &read("tests/main.rs");
        if !named.contains("autotests = false") {
            continue;
        }
        for entry in fs::read_dir(package.join("tests"))
            .into_iter()
            .flatten()
            .flatten()
        {
            let name = entry.file_name().to_string_lossy().into_owned();
            let stem = name.trim_end_matches(".rs");
            let program = entry.path().join("main.rs").exists() || stem != name;
            let names = [stem.to_owned(), format!("{stem}.rs"), format!("{stem}/main.rs")];
            if program && !names.iter().any(|name| named.contains(&format!("\"{name}\""))) {
                lost.push(entry.path());
            }
        }
    }
    assert!(lost.is_empty(), "in no test program: {lost:#?}");
}

/// The names in a package's list of files to publish, each a file, a folder with `**` or a beginning with
/// `*`.
fn included(manifest: &str) -> Vec<String> {
    let (_, list) = manifest.split_once("\ninclude = [").expect("a list of files");
    let (list, _) = list.split_once(']').expect("its end");
    let names = list
        .split(',')
        .map(|name| name.trim().trim_matches('"').to_owned());
    names.filter(|name| !name.is_empty()).collect()
}

/// Every package that may be published has both licences, and names no file to publish that is not there.
#[test]
fn every_package_has_its_licences_and_what_it_includes() {
    let crates = fs::read_dir(root().join("crates")).unwrap().flatten();
    let mut packages: Vec<PathBuf> = crates.map(|entry| entry.path()).collect();
    packages.push(root().to_owned());
    for package in packages {
        let manifest = fs::read_to_string(package.join("Cargo.toml")).unwrap();
        if manifest.contains("\npublish = false\n") {
            continue;
        }
        let names = included(&manifest);
        assert!(names.contains(&"/LICENSE-*".to_owned()), "{}", package.display());
        for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
            let own = fs::read(package.join(licence));
            let own = own.unwrap_or_else(|error| panic!("{}: {licence}: {error}", package.display()));
            assert!(
                own == fs::read(root().join(licence)).unwrap(),
                "{}: {licence}",
                package.display()
            );
        }
        for name in &names {
            // `LICENSE-*` was looked at, `*.rs` and `**` are what lies in the folder before.
            let fixed = name.trim_start_matches('/').split('*').next().unwrap();
            let there = fixed == "LICENSE-" || package.join(fixed).exists();
            assert!(
                there,
                "{}: includes {name}, which is not there",
                package.display()
            );
        }
    }
}

/// The front page of every published crate is its README: problem, equation, assumptions, limits, reference, example.
#[test]
fn readmes_are_front_pages() {
    for source in sources()
        .into_iter()
        .filter(|source| source != "src" && !source.contains("testkit"))
    {
        let code = fs::read_to_string(root().join(&source).join("lib.rs")).unwrap();
        assert!(
            code.starts_with("#![doc = include_str!(\"../README.md\")]"),
            "{source}"
        );
        let page = fs::read_to_string(root().join(&source).join("../README.md")).unwrap();
        assert!(page.contains("```rust"), "{source}: no example");
        if ["figure", "report", "scene", "tables"]
            .iter()
            .any(|name| source.contains(name))
        {
            continue;
        }
        for part in ["*Problem.*", "*Equation", "*Assumptions", "imits.*", "*Reference"] {
            assert!(page.contains(part), "{source}: {part}");
        }
    }
}

#[test]
fn imports_run_one_way() {
    let mut circles = Vec::new();
    for folder in sources() {
        circles.extend(Package::read(&folder).circles());
    }
    assert!(
        circles.is_empty(),
        "circles of imports:\n{}",
        circles.join("\n\n")
    );
}

/// A test of the test: in a package of four files, one circle of files and one of rooms.
#[test]
fn a_circle_is_seen_through_what_a_module_hands_on() {
    let files = [
        ("lib.rs", "mod a;\nmod b;\npub use a::Seen;\n"),
        (
            "a/mod.rs",
            "mod inner;\npub use inner::Seen;\nuse crate::b::helper;\nstruct Own;\n",
        ),
        (
            "a/inner.rs",
            "pub struct Seen;\n#[cfg(test)]\nmod tests { use crate::b::helper; }\n",
        ),
        (
            "b.rs",
            "use crate::{Seen, a};\npub fn helper() { let _ = a::Own; } // crate::nothing::here\n",
        ),
    ];
    let files = files.map(|(name, text)| (name.to_owned(), text.to_owned()));
    let circles = Package::new("", files).circles();
    let of_files = "/a/mod.rs -> /b.rs: helper\n  /b.rs -> /a/mod.rs: Own";
    let of_rooms = "/a -> /b.rs: helper\n  /b.rs -> /a: Own, Seen";
    assert_eq!(circles, [of_files, of_rooms]);
}

/// A path as it is written: `crate::a::b`.
type Names = Vec<String>;

/// One file: what it imports and names.
#[derive(Default)]
struct Source {
    file: String,
    /// Path from the top of its package.
    module: Names,
    /// Names that `use` brings in, and what they stand for; `*` for all of a module.
    imports: Vec<(String, Names)>,
    /// Of these, what it only hands on.
    handed_on: BTreeSet<String>,
    /// Every path in its code.
    paths: Vec<Names>,
    /// Names that it defines.
    defined: BTreeSet<String>,
}

/// The files of a package by their modules.
struct Package {
    folder: String,
    sources: BTreeMap<Names, Source>,
}

impl Package {
    fn read(folder: &str) -> Self {
        let files = rust_files(folder).into_iter().map(|file| {
            let text = fs::read_to_string(root().join(&file)).unwrap();
            (file[folder.len() + 1..].to_owned(), text)
        });
        Self::new(folder, files)
    }

    fn new(folder: &str, files: impl IntoIterator<Item = (String, String)>) -> Self {
        let sources = files
            .into_iter()
            .filter(|(name, _)| name != "main.rs")
            .map(|(name, text)| {
                let source = Source::new(format!("{folder}/{name}"), &name, &text);
                (source.module.clone(), source)
            });
        Self {
            folder: folder.to_owned(),
            sources: sources.collect(),
        }
    }

    /// The file that defines what `path` in `source` names, and the name; `None` where it is not of this package, or a module.
    fn definition<'a>(
        &'a self,
        source: &'a Source,
        path: &[String],
        depth: usize,
    ) -> Option<(&'a Source, String)> {
        let (mut module, mut rest) = (source.module.clone(), path);
        match path.first()?.as_str() {
            "crate" => (module, rest) = (Names::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|name| name == "super") {
                    module.pop();
                    rest = &rest[1..];
                }
            }
            first => {
                let child = [module.as_slice(), &[first.to_owned()]].concat();
                if !self.sources.contains_key(&child) {
                    let (_, meant) = source.imports.iter().find(|(name, _)| name == first)?;
                    let whole = [meant.as_slice(), &path[1..]].concat();
                    return (depth > 0 && meant.as_slice() != &path[..1])
                        .then(|| self.definition(source, &whole, depth - 1))?;
                }
            }
        }
        while let Some(name) = rest.first() {
            let child = [module.as_slice(), std::slice::from_ref(name)].concat();
            if !self.sources.contains_key(&child) {
                break;
            }
            (module, rest) = (child, &rest[1..]);
        }
        let (home, name) = (self.sources.get(&module)?, rest.first()?);
        if home.defined.contains(name) || depth == 0 {
            return Some((home, name.clone()));
        }
        let imports = home
            .imports
            .iter()
            .filter(|(known, _)| known == name || known == "*");
        let mut handed_on = imports.filter_map(|(known, meant)| {
            let last = if known == "*" { rest } else { &rest[1..] };
            let found = self.definition(home, &[meant.as_slice(), last].concat(), depth - 1)?;
            (known != "*" || found.0.defined.contains(name)).then_some(found)
        });
        handed_on.next().or_else(|| Some((home, name.clone())))
    }

    /// The files that each file imports from, with the names.
    fn arrows(&self) -> BTreeMap<(&str, &str), BTreeSet<String>> {
        let mut arrows: BTreeMap<(&str, &str), BTreeSet<String>> = BTreeMap::new();
        for source in self.sources.values() {
            let imports = source
                .imports
                .iter()
                .filter(|(name, _)| !source.handed_on.contains(name));
            for path in imports.map(|(_, path)| path).chain(&source.paths) {
                if let Some((home, name)) = self.definition(source, path, 8)
                    && home.file != source.file
                {
                    arrows.entry((&source.file, &home.file)).or_default().insert(name);
                }
            }
        }
        arrows
    }

    /// Each circle in a line: what every one of its files takes from the others.
    /// Circles of files, and of the folders at the top.
    fn circles(&self) -> Vec<String> {
        let of_files = self.arrows();
        let mut of_folders: BTreeMap<(&str, &str), BTreeSet<String>> = BTreeMap::new();
        for (&(from, to), names) in &of_files {
            let (from, to) = (self.room(from), self.room(to));
            if from != to {
                of_folders
                    .entry((from, to))
                    .or_default()
                    .extend(names.iter().cloned());
            }
        }
        [of_files, of_folders].iter().flat_map(circles).collect()
    }

    /// The folder at the top in which a file lies; a file there is a room of its own.
    fn room<'f>(&self, file: &'f str) -> &'f str {
        let inner = &file[self.folder.len() + 1..];
        let end = inner
            .find('/')
            .map_or(file.len(), |end| self.folder.len() + 1 + end);
        &file[..end]
    }
}

/// What lies on circles of `arrows` with the names that make them, a text for each.
fn circles(arrows: &BTreeMap<(&str, &str), BTreeSet<String>>) -> Vec<String> {
    let mut reached: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for &(from, _) in arrows.keys() {
        let mut open = vec![from];
        let seen = reached.entry(from).or_default();
        while let Some(file) = open.pop() {
            let next = arrows
                .keys()
                .filter(|(start, _)| *start == file)
                .map(|(_, end)| *end);
            open.extend(next.filter(|end| seen.insert(end)));
        }
    }
    let together = |a: &str, b: &str| reached.get(a).is_some_and(|seen| seen.contains(b));
    let mut circles: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (&(from, to), names) in arrows.iter().filter(|((from, to), _)| together(to, from)) {
        let first = reached[from]
            .iter()
            .find(|file| together(file, from))
            .unwrap_or(&to);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let line = format!("{from} -> {to}: {}", names.join(", "));
        circles.entry(first).or_default().push(line);
    }
    circles.into_values().map(|lines| lines.join("\n  ")).collect()
}

impl Source {
    fn new(file: String, name: &str, text: &str) -> Self {
        let parts = name.trim_end_matches(".rs").split('/');
        let module = parts
            .filter(|part| !matches!(*part, "lib" | "mod"))
            .map(str::to_owned)
            .collect();
        let mut source = Self {
            file,
            module,
            ..Self::default()
        };
        // Tests stand at the end, and may import what they like.
        let code = text.lines().take_while(|line| line.trim() != "#[cfg(test)]");
        let code: Vec<&str> = code
            .map(|line| line.split("//").next().unwrap_or_default())
            .collect();
        let tokens = tokens(&code.join("\n"));
        let mut at = 0;
        while at < tokens.len() {
            let token = tokens[at].as_str();
            if token == "use" {
                let before = source.imports.len();
                let public = at > 0 && matches!(tokens[at - 1].as_str(), "pub" | ")");
                at = source.import(&tokens, at + 1, Names::new());
                if public {
                    let names = source.imports[before..].iter().map(|(name, _)| name.clone());
                    source.handed_on.extend(names);
                }
            } else if matches!(
                token,
                "struct" | "enum" | "fn" | "trait" | "type" | "const" | "static"
            ) {
                source.defined.extend(tokens.get(at + 1).cloned());
                at += 1;
            } else if is_name(token) && tokens.get(at + 1).is_some_and(|next| next == "::") {
                let mut path = vec![tokens[at].clone()];
                while tokens.get(at + 1).is_some_and(|next| next == "::")
                    && tokens.get(at + 2).is_some_and(|next| is_name(next))
                {
                    path.push(tokens[at + 2].clone());
                    at += 2;
                }
                source.paths.push(path);
                at += 1;
            } else {
                at += 1;
            }
        }
        source
    }

    /// Reads one tree of `use` from `at` on, behind the path `before`; returns the place of what follows it.
    fn import(&mut self, tokens: &[String], mut at: usize, before: Names) -> usize {
        let mut path = before;
        while let Some(token) = tokens.get(at).map(String::as_str) {
            match token {
                "::" => {}
                "{" => {
                    while tokens.get(at).is_some_and(|token| token != "}") {
                        at = self.import(tokens, at + 1, path.clone());
                    }
                    return at + 1;
                }
                "," | ";" | "}" => break,
                "as" => {
                    let name = tokens.get(at + 1).cloned().unwrap_or_default();
                    self.imports.push((name, path));
                    return at + 2;
                }
                "*" => {
                    self.imports.push(("*".into(), path));
                    return at + 1;
                }
                name => path.push(name.to_owned()),
            }
            at += 1;
        }
        if path.last().is_some_and(|name| name == "self") {
            path.pop();
        }
        if let Some(name) = path.last().cloned() {
            self.imports.push((name, path));
        }
        at
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Names, `::`, and every other sign on its own.
fn tokens(code: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = if first.is_alphanumeric() || first == '_' {
            rest.find(|c: char| !c.is_alphanumeric() && c != '_')
                .unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        tokens.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    tokens
}
