//! Pages of docs/ that the program writes itself: below a mark, docs/scene.md is what `creepage explain` says of every key,
//! docs/commands.md what every command says of itself. `WRITE_PAGES=1 cargo test --test main generated_pages::` writes them.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use creepage::scene::key_meanings;

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
    assert!(
        found == generated,
        "docs/{page} is not what the program says: WRITE_PAGES=1 cargo test --test main generated_pages::"
    );
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
    let output = Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
        .args(arguments)
        .arg("--help")
        .env("COLUMNS", "140")
        .stdin(Stdio::null())
        .output()
        .expect("the command");
    let help = String::from_utf8(output.stdout).expect("UTF-8");
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
