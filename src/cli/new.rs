//! `creepage new`: a commented scene to start from.

use std::io::{self, BufRead, IsTerminal, Write};
use std::path::PathBuf;

use super::failure::Failure;
use super::shared::Force;
use super::terminal;
use crate::Scene;
use crate::output::{Kind, OutputError};
use crate::template::{Template, TemplateGround};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "At a terminal, missing values are asked for interactively; otherwise defaults are used.

Examples:
  creepage new my-duct.toml
  creepage new my-duct.toml --length \"250 m\" --depth 0.9 --vehicle t-20 --friction 0.3
  creepage new my-duct.toml --pavement n6-cbr6 --downstream \"3 MN/m\" --passes 1000"
)]
pub struct Arguments {
    /// File to write; one that exists is replaced only with --force
    file: PathBuf,
    /// Title of the scene
    #[arg(long)]
    title: Option<String>,
    /// Length of the duct
    #[arg(long)]
    length: Option<String>,
    /// Depth of the cable below the road surface
    #[arg(long)]
    depth: Option<String>,
    /// Young's modulus of the ground, where it is one soil
    #[arg(long, conflicts_with = "pavement")]
    modulus: Option<String>,
    /// Preset of a pavement, in place of one soil
    #[arg(long, value_name = "PRESET")]
    pavement: Option<String>,
    /// Preset of the cable
    #[arg(long, value_name = "PRESET")]
    cable: Option<String>,
    /// Dynamic friction coefficient
    #[arg(long, value_name = "NUMBER")]
    friction: Option<String>,
    /// End at x = 0: free, fixed or a spring's stiffness
    #[arg(long, value_name = "END")]
    upstream: Option<String>,
    /// End at x = length: free, fixed or a spring's stiffness
    #[arg(long, value_name = "END")]
    downstream: Option<String>,
    /// Preset of the vehicle
    #[arg(long, value_name = "PRESET")]
    vehicle: Option<String>,
    /// Speed of the vehicle
    #[arg(long)]
    speed: Option<String>,
    /// Number of passes
    #[arg(long)]
    passes: Option<String>,
    #[command(flatten)]
    force: Force,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let name = arguments.file.display().to_string();
    let existing = |error| match error {
        OutputError::OtherKind { .. } => exists(&name),
        error => error.into(),
    };
    let file = arguments
        .force
        .files([])
        .output(&arguments.file, Kind::Scene)
        .map_err(existing)?;
    let mut template = Template::default();
    let at_terminal = io::stdin().is_terminal() && io::stderr().is_terminal();
    let mut ask = |question: &str, given: Option<&String>, answer: Answer| match given {
        None if at_terminal => ask_for(question, answer, &name, &mut template),
        None => Ok(()),
        Some(given) => {
            given.clone_into(answer(&mut template));
            Ok(())
        }
    };
    macro_rules! ask {
        ($words:literal, $field:ident) => {
            ask($words, arguments.$field.as_ref(), |t| &mut t.$field)?
        };
    }
    let ground = arguments.modulus.as_ref().or(arguments.pavement.as_ref());
    let words = "modulus of the ground, or a pavement's preset";
    ask!("title", title);
    ask!("length of the duct", length);
    ask!("depth of the cable below the road", depth);
    ask(words, ground, |t| t.ground.text_mut())?;
    ask!("cable (preset)", cable);
    ask!("friction coefficient", friction);
    ask!("upstream end: free, fixed or a stiffness", upstream);
    ask!("downstream end: free, fixed or a stiffness", downstream);
    ask!("vehicle (preset)", vehicle);
    ask!("its speed", speed);
    ask!("passes", passes);
    // A flag says which it is.
    if let Some(modulus) = &arguments.modulus {
        template.ground = TemplateGround::Modulus(modulus.clone());
    } else if let Some(pavement) = &arguments.pavement {
        template.ground = TemplateGround::Pavement(pavement.clone());
    }
    let text = template.to_toml(&name)?;
    crate::check(&Scene::from_toml(&name, &text)?)?;
    // Whoever made the file meanwhile keeps it.
    file.write(|out| out.write_all(text.as_bytes()))
        .map_err(existing)?;
    writeln!(
        terminal::out(),
        "{name} is written; to compute: creepage run {name}"
    )?;
    Ok(())
}

/// The place of an answer in the template.
type Answer = fn(&mut Template) -> &mut String;

/// Asks until the answer makes a scene; nothing keeps what is shown in brackets.
fn ask_for(question: &str, answer: Answer, name: &str, template: &mut Template) -> Result<(), Failure> {
    loop {
        let mut err = terminal::err();
        write!(err, "{question} [{}]: ", answer(template))?;
        err.flush()?;
        let mut line = String::new();
        let end = io::stdin().lock().read_line(&mut line)? == 0;
        let text = line.trim();
        if end || text.is_empty() {
            return Ok(());
        }
        let mut changed = template.clone();
        text.clone_into(answer(&mut changed));
        let ground = std::mem::take(changed.ground.text_mut());
        // A typed modulus begins with a digit.
        changed.ground = if ground.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            TemplateGround::Modulus(ground)
        } else {
            TemplateGround::Pavement(ground)
        };
        match changed.to_toml(name) {
            Ok(_) => {
                *template = changed;
                return Ok(());
            }
            Err(error) => writeln!(err, "{error}")?,
        }
    }
}

fn exists(name: &str) -> Failure {
    Failure::Usage {
        argument: "FILE",
        found: format!("{name}, which exists"),
        allowed: "the name of a new file: nothing is overwritten without --force".into(),
    }
}
