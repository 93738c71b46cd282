//! What was probably meant by arguments that are none: the two cases in which clap's own words lead nowhere.

use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

use super::terminal;
use crate::scene::key_meanings;

/// Advice for who typed `arguments`; advice of clap that would mislead is taken out of the error.
pub fn advice(error: &mut Error, program: &Command, arguments: &[String]) -> Option<String> {
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let typed = arguments.get(1)?;
            Path::new(typed).extension().filter(|ending| *ending == "toml")?;
            error.remove(ContextKind::SuggestedSubcommand);
            let scene = terminal::line(typed);
            Some(format!("A command stands before the scene: creepage run {scene}"))
        }
        ErrorKind::UnknownArgument => {
            // Behind `--`, as clap advises, an unknown option would be a second scene.
            if let Some(ContextValue::StyledStrs(mut tips)) = error.remove(ContextKind::Suggested) {
                tips.retain(|tip| !tip.to_string().contains("as a value"));
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
            }
            let Some(ContextValue::String(unknown)) = error.get(ContextKind::InvalidArg) else {
                return None;
            };
            let key = key_of_scene(unknown.strip_prefix("--")?)?;
            let command = arguments.iter().find_map(|name| program.find_subcommand(name))?;
            let mut options = command.get_arguments();
            options.find(|option| option.get_long() == Some("set"))?;
            error.remove(ContextKind::SuggestedArg);
            Some(format!("A key of the scene is set with --set {key}=VALUE"))
        }
        _ => None,
    }
}

/// The one key of a scene that ends in the name of this option, outside of lists.
fn key_of_scene(option: &str) -> Option<String> {
    let ending = format!(".{}", option.replace('-', "_"));
    let keys = key_meanings().into_iter().map(|key| key.key);
    let keys: Vec<String> = keys.filter(|key| key.ends_with(&ending)).collect();
    let is_of_a_list = |key: &&String| {
        ["ground.layers.", "restraints.", "vehicles."]
            .iter()
            .any(|list| key.starts_with(list))
    };
    match &keys[..] {
        [key] if !is_of_a_list(&key) => Some(key.clone()),
        _ => None,
    }
}
