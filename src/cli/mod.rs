//! The command line: parsing, printing, and the exit status. Everything it does is a call of the library.

mod arguments;
mod calibrate;
mod print;
mod write;

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::Parser;

use crate::{Profile, Run, RunOptions, Scene};
use arguments::{Arguments, Command, SceneArguments};

/// Something that keeps a command from finishing.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Analysis(#[from] crate::Error),
    #[error("{file}: cannot be written: {source}")]
    Unwritable { file: String, source: std::io::Error },
    #[error("{file}: cannot be written: {source}")]
    Write { file: String, source: csv::Error },
    #[error("standard output: cannot be written: {0}")]
    Output(#[from] std::io::Error),
    #[error("standard output: cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<crate::SceneError> for Failure {
    fn from(error: crate::SceneError) -> Self {
        Self::Analysis(error.into())
    }
}

/// Runs the command with the process's arguments. Exit status: 0 done; 1 the computation failed; 2 bad input or usage.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match execute(&arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of a pipe has gone: it has what it wanted.
        Err(Failure::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            // A closed standard error leaves nobody to tell.
            let _ = writeln!(std::io::stderr(), "error: {failure}");
            match failure {
                Failure::Unwritable { .. } => ExitCode::from(2),
                Failure::Analysis(error) if error.is_bad_input() => ExitCode::from(2),
                _ => ExitCode::from(1),
            }
        }
    }
}

fn execute(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Run {
            scene,
            verify,
            output,
        } => {
            let scene = read(scene)?;
            write::writable(output.csv.as_deref())?;
            let answer = run(&scene, *verify)?;
            for warning in &answer.warnings {
                let _ = writeln!(std::io::stderr(), "warning: {warning}");
            }
            if let Some(file) = &output.csv {
                write::passes(file, &answer.passes)?;
            }
            if output.json {
                write::json(&answer)
            } else {
                print::run(&answer)
            }
        }
        Command::Profile {
            scene,
            positions,
            output,
        } => {
            let scene = read(scene)?;
            write::writable(output.csv.as_deref())?;
            let answer: Profile = match positions {
                Some(positions) => crate::profile_at(&scene, positions).map_err(Failure::from)?,
                None => crate::profile(&scene)?,
            };
            if let Some(file) = &output.csv {
                write::profile(file, &answer)?;
            }
            if output.json {
                write::json(&answer)
            } else {
                print::profile(&answer)
            }
        }
        Command::Calibrate {
            scene,
            calibrate,
            output,
        } => calibrate::execute(scene, calibrate, output),
        Command::Check { scene } => {
            let scene = read(scene)?;
            crate::check(&scene)?;
            print::checked(&scene)
        }
    }
}

fn read(arguments: &SceneArguments) -> Result<Scene, Failure> {
    Ok(Scene::from_file_with(&arguments.scene, &arguments.set)?)
}

/// Runs the scene, with a progress bar on a terminal.
fn run(scene: &Scene, verify: bool) -> Result<Run, Failure> {
    const TICKS: f64 = 1000.0;
    let bar = if std::io::stderr().is_terminal() {
        indicatif::ProgressBar::new(TICKS as u64)
    } else {
        indicatif::ProgressBar::hidden()
    };
    let progress = |share: f64| bar.set_position((TICKS * share) as u64);
    let options = RunOptions {
        verify,
        progress: Some(&progress),
        ground: None,
    };
    let answer = crate::run_with(scene, &options);
    bar.finish_and_clear();
    Ok(answer?)
}
