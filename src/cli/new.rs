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
    let ask = io::stdin().is_terminal() && io::stderr().is_terminal();
    for question in questions(arguments) {
        match question.given {
            Some(given) => (question.set)(&mut template, given),
            None if ask => answer(&question, &name, &mut template)?,
            None => {}
        }
    }
    // A typed answer is a modulus if it begins with a digit; a flag says which it is.
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

/// How an answer goes into the template, and what is there now.
type Set = fn(&mut Template, &str);
type Now = fn(&Template) -> &str;

struct Question<'a> {
    words: &'static str,
    given: Option<&'a String>,
    now: Now,
    set: Set,
}

macro_rules! question {
    ($words:expr, $given:ident, $field:ident) => {
        Question {
            words: $words,
            given: $given.$field.as_ref(),
            now: |template| &template.$field,
            set: |template, text| text.clone_into(&mut template.$field),
        }
    };
}

fn questions(given: &Arguments) -> [Question<'_>; 11] {
    [
        question!("title", given, title),
        question!("length of the duct", given, length),
        question!("depth of the cable below the road", given, depth),
        Question {
            words: "modulus of the ground, or a pavement's preset",
            given: given.modulus.as_ref().or(given.pavement.as_ref()),
            now: |template| match &template.ground {
                TemplateGround::Modulus(text) | TemplateGround::Pavement(text) => text,
            },
            set: |template, text| {
                template.ground = if text.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
                    TemplateGround::Modulus(text.to_owned())
                } else {
                    TemplateGround::Pavement(text.to_owned())
                };
            },
        },
        question!("cable (preset)", given, cable),
        question!("friction coefficient", given, friction),
        question!("upstream end: free, fixed or a stiffness", given, upstream),
        question!("downstream end: free, fixed or a stiffness", given, downstream),
        question!("vehicle (preset)", given, vehicle),
        question!("its speed", given, speed),
        question!("passes", given, passes),
    ]
}

/// Asks until the answer makes a scene; nothing keeps what is shown in brackets.
fn answer(question: &Question, name: &str, template: &mut Template) -> Result<(), Failure> {
    loop {
        let mut err = terminal::err();
        write!(err, "{} [{}]: ", question.words, (question.now)(template))?;
        err.flush()?;
        let mut line = String::new();
        let end = io::stdin().lock().read_line(&mut line)? == 0;
        let text = line.trim();
        if end || text.is_empty() {
            return Ok(());
        }
        let mut changed = template.clone();
        (question.set)(&mut changed, text);
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
