//! `creepage explain`: what the keys of a scene mean.

use std::io::Write;

use super::failure::Failure;
use super::outputs::Json;
use super::terminal;
use crate::scene::{KeyMeaning, key_meanings, nearest_key};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage explain
  creepage explain duct.depth
  creepage explain stiffness")]
pub struct Arguments {
    /// A key with its section, or its last word; all keys if omitted
    key: Option<String>,
    #[command(flatten)]
    json: Json,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let all = key_meanings();
    let Some(asked) = &arguments.key else {
        return arguments.json.print(&all, || list(all));
    };
    let is_name = |part: &&str| part.parse::<usize>().is_err();
    let wanted = asked.split('.').filter(is_name).collect::<Vec<_>>().join(".");
    let [inside, section] = [format!(".{wanted}"), format!("{wanted}.")];
    let is_meant = |key: &&KeyMeaning| key.key == wanted || key.key.ends_with(&inside);
    let mut found: Vec<&KeyMeaning> = all.iter().filter(is_meant).collect();
    // A section is told with its keys.
    found.extend(all.iter().filter(|key| key.key.starts_with(&section)));
    found.dedup();
    if found.is_empty() {
        let meant = nearest_key(&wanted).map_or_else(String::new, |key| format!("; did you mean {key}?"));
        let allowed = format!("a key that `creepage explain` lists{meant}");
        return Err(Failure::usage("KEY", format!("`{asked}`"), allowed));
    }
    arguments.json.print(&found, || explain(&found))
}

/// A line for each key.
fn list(keys: &[KeyMeaning]) -> Result<(), Failure> {
    let mut out = terminal::out();
    let row = |key: &KeyMeaning| {
        let required = if key.default.is_none() { "*" } else { "" };
        vec![required.to_owned(), key.key.clone(), key.meaning.to_owned()]
    };
    let rows: Vec<Vec<String>> = keys.iter().map(row).collect();
    terminal::table(&mut out, &["", "key", "meaning"].map(str::to_owned), &rows)?;
    let more = "* is required. To see units, range and default: creepage explain KEY";
    Ok(writeln!(out, "\n{more}")?)
}

fn explain(keys: &[&KeyMeaning]) -> Result<(), Failure> {
    let mut out = terminal::out();
    for (index, key) in keys.iter().enumerate() {
        if index > 0 {
            writeln!(out)?;
        }
        writeln!(out, "{}\n  {}", key.key, key.meaning)?;
        writeln!(out, "  allowed: {}", key.allowed)?;
        match key.default {
            None => writeln!(out, "  required")?,
            Some(default) => writeln!(out, "  if omitted: {default}")?,
        }
    }
    Ok(())
}
