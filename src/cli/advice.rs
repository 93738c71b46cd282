//! What was probably meant by arguments that are none.

use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

use super::terminal;
use crate::scene::{key_meanings, nearest};

/// Advice for who typed `arguments`; advice of clap that would lead nowhere is taken out of the error.
pub fn advice(error: &mut Error, program: &Command, arguments: &[String]) -> Option<String> {
    let command = arguments.iter().find_map(|name| program.find_subcommand(name));
    let any = |names: &[&str]| {
        let mut given = arguments.iter();
        given.any(|argument| names.contains(&argument.as_str()))
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let typed = arguments.get(1)?;
            if ends_as_a_scene(typed) {
                error.remove(ContextKind::SuggestedSubcommand);
                let scene = terminal::line(typed);
                return Some(format!(
                    "A command stands before the scene: creepage run {scene}"
                ));
            }
            let names = program.get_subcommands().map(Command::get_name);
            if let (None, Some(meant)) = (error.get(ContextKind::SuggestedSubcommand), nearest(typed, names)) {
                error.insert(
                    ContextKind::SuggestedSubcommand,
                    ContextValue::String(meant.to_owned()),
                );
            }
            None
        }
        ErrorKind::MissingRequiredArgument if command?.get_name() == "sweep" && !any(&["--vary", "--rows"]) => Some(
            "Values of a key are given by --vary KEY=VALUES, ducts in a table, a row each, by --rows FILE"
                .to_owned(),
        ),
        ErrorKind::UnknownArgument => {
            without_dashes_alone(error);
            let command = command?;
            if any(&["run", "profile"]) && any(&["-o", "--out", "--output"]) {
                return Some(
                    "A table is written with --csv FILE; a workbook by `creepage run`, with --xlsx FILE".to_owned(),
                );
            }
            if any(&["calibrate"]) && !any(&["--data"]) {
                return Some("Readings stand behind --data: --data load-cell.csv".to_owned());
            }
            let Some(ContextValue::String(unknown)) = error.get(ContextKind::InvalidArg) else {
                return None;
            };
            let unknown = unknown.clone();
            let place = arguments.iter().position(|argument| argument.starts_with(&unknown))?;
            let typed = &arguments[place];
            let before = arguments[place - 1].as_str();
            let name = typed.split('=').next()?.trim_start_matches(['-', '—', '–', '−', '/']);
            match typed.starts_with("--") {
                false if typed.starts_with(['-', '—', '–', '−', '/']) && has(command, name) => {
                    Some(format!("Options begin with two dashes: --{name}"))
                }
                true => elsewhere(error, command, program, name),
                false if ends_as_a_scene(typed) => {
                    Some(format!("`creepage {}` takes one scene at a time", command.get_name()))
                }
                false if before == "--json" => Some(format!(
                    "--json prints to standard output; into a file: --json > {}",
                    terminal::line(typed)
                )),
                false => without_spaces(arguments),
            }
        }
        _ => None,
    }
}

fn ends_as_a_scene(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending == "toml")
}

fn has(command: &Command, name: &str) -> bool {
    let mut options = command.get_arguments();
    options.any(|option| option.get_long() == Some(name))
}

/// Takes out clap's advice to write an unknown option behind `--`, which makes it a second scene.
fn without_dashes_alone(error: &mut Error) {
    if let Some(ContextValue::StyledStrs(mut tips)) = error.remove(ContextKind::Suggested) {
        tips.retain(|tip| !tip.to_string().contains("as a value"));
        if !tips.is_empty() {
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
        }
    }
}

/// The key of a scene of that name, or else the commands that have the option.
fn elsewhere(error: &mut Error, command: &Command, program: &Command, name: &str) -> Option<String> {
    if has(command, name) {
        // It stands before the command, which clap says.
        return None;
    }
    let lists = ["ground.layers.", "restraints.", "vehicles."];
    let ending = format!(".{}", name.replace('-', "_"));
    let keys = key_meanings().into_iter().map(|key| key.key);
    let keys: Vec<String> = keys.filter(|key| key.ends_with(&ending)).collect();
    let advice = match &keys[..] {
        [key] if has(command, "set") && !lists.iter().any(|list| key.starts_with(list)) => {
            format!("A key of the scene is set with --set {key}=VALUE")
        }
        _ => {
            // The options of `new` are what it writes into a scene.
            let others = program
                .get_subcommands()
                .filter(|other| other.get_name() != "new" && has(other, name));
            let others: Vec<String> = others
                .map(|other| format!("`creepage {}`", other.get_name()))
                .collect();
            let last = others.last()?;
            match &others[..others.len() - 1] {
                [] => format!("--{name} is an option of {last}"),
                first => format!("--{name} is an option of {} and {last}", first.join(", ")),
            }
        }
    };
    // What only looks alike would mislead.
    error.remove(ContextKind::SuggestedArg);
    error.remove(ContextKind::Usage);
    Some(advice)
}

/// An override that was typed with spaces, as it is to be typed.
fn without_spaces(arguments: &[String]) -> Option<String> {
    let place = arguments.iter().position(|argument| argument == "--set")?;
    let typed = arguments.get(place + 1..)?;
    let (key, value) = match typed {
        [key, sign, value, ..] if sign == "=" => (key, value),
        [key, value, ..] => (key, value),
        _ => return None,
    };
    let (key, value) = (terminal::line(key), terminal::line(value));
    let (key, value) = (key.trim_end_matches('='), value.trim_start_matches('='));
    let parted = !key.contains('=') && !value.starts_with('-') && !value.is_empty();
    parted.then(|| format!("--set takes KEY=VALUE without a space: --set {key}={value}"))
}
