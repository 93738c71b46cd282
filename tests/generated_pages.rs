//! Pages of docs/ whose part below a mark is generated: docs/scene.md is what `creepage explain` says of every key,
//! docs/commands.md what every command says of itself, docs/architecture.md which crate uses which.
//! `WRITE_PAGES=1 cargo test --test main generated_pages::` writes them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::Path;

use creepage::scene::key_meanings;

use crate::command::{answer, command};

/// Ends what is written by hand.
const MARK: &str = "<!-- What follows is generated: see tests/generated_pages.rs. -->\n";

/// Compares what follows the mark on a page with `generated`, or writes it.
fn compare(page: &str, generated: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(page);
    let text = fs::read_to_string(&path).expect("a page");
    let (written, found) = text.split_once(MARK).expect("a page with its mark");
    if std::env::var_os("WRITE_PAGES").is_some() {
        fs::write(&path, format!("{written}{MARK}{generated}")).expect("a written page");
        return;
    }
    assert!(found == generated, "{page}");
}

#[test]
fn the_page_on_scenes_has_every_key_with_its_meaning() {
    let mut page = String::new();
    let keys = key_meanings();
    for (index, key) in keys.iter().enumerate() {
        let default = key
            .default
            .map_or("required".to_owned(), |default| format!("if omitted: {default}"));
        let row = [&key.key, key.meaning, &key.allowed, &default].map(|cell| cell.replace('|', "\\|"));
        if key.key.contains('.') {
            writeln!(page, "| `{}` | {} | {} | {} |", row[0], row[1], row[2], row[3]).unwrap();
            continue;
        }
        write!(page, "\n## `{}`\n\n{} ({})\n", key.key, row[1], row[3]).unwrap();
        if keys.get(index + 1).is_some_and(|next| next.key.contains('.')) {
            page += "\n| key | meaning | allowed | default |\n|---|---|---|---|\n";
        }
    }
    compare("scene.md", &page);
}

/// What a command says of itself, in lines of 140 characters, without the exit status, which ends every help.
fn help(arguments: &[&str]) -> String {
    let mut command = command("");
    command.args(arguments).arg("--help").env("COLUMNS", "140");
    let (_, help, _) = answer(command.output().expect("the command"));
    let (help, _) = help.split_once("\n\nExit status: ").expect("an exit status");
    let lines = help.lines().map(str::trim_end);
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_page_on_commands_has_every_command_with_its_options() {
    let all = help(&[]);
    let (_, commands) = all.split_once("\nCommands:\n").expect("a list of commands");
    let names = commands.lines().map_while(|line| line.split_whitespace().next());
    let mut page = String::new();
    for name in names.filter(|name| *name != "help") {
        write!(page, "\n## `{name}`\n\n```console\n{}\n```\n", help(&[name])).unwrap();
    }
    assert!(page.contains("## `run`"), "{page}");
    compare("commands.md", &page);
}

/// The packages of the workspace that are published, with those of them that each uses.
fn packages() -> BTreeMap<String, BTreeSet<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(root.join("crates")).expect("crates/");
    let mut folders: Vec<_> = crates.map(|entry| entry.expect("an entry").path()).collect();
    folders.push(root.to_owned());
    let mut packages = BTreeMap::new();
    for folder in folders {
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        let manifest: toml::Table = manifest.parse().expect("TOML");
        let package = manifest["package"].as_table().expect("a package");
        let uses = manifest.get("dependencies").and_then(toml::Value::as_table);
        if !package.contains_key("publish") {
            let name = package["name"].as_str().expect("a name").to_owned();
            let uses = uses.into_iter().flat_map(toml::Table::keys).cloned();
            packages.insert(name, uses.collect::<BTreeSet<_>>());
        }
    }
    let names: BTreeSet<String> = packages.keys().cloned().collect();
    for uses in packages.values_mut() {
        uses.retain(|name| names.contains(name));
    }
    packages
}

/// Whether `package` uses `other` by way of a third one.
fn uses_indirectly(packages: &BTreeMap<String, BTreeSet<String>>, package: &str, other: &str) -> bool {
    let mut between = packages[package].iter();
    between.any(|third| packages[third].contains(other) || uses_indirectly(packages, third, other))
}

#[test]
fn the_page_on_architecture_draws_which_crate_uses_which() {
    let packages = packages();
    let mut page = "\n```mermaid\ngraph LR\n".to_owned();
    for (package, uses) in &packages {
        for used in uses {
            if !uses_indirectly(&packages, package, used) {
                writeln!(page, "    {used} --> {package}").unwrap();
            }
        }
    }
    page += "```\n";
    compare("architecture.md", &page);
}
