//! The command line: parsing, printing, and the exit status. Everything it does is a call of the library.

mod arguments;
mod calibrate;
mod design;
mod input;
mod new;
mod presets;
mod print;
mod progress;
#[cfg(feature = "plot")]
mod report;
mod signals;
mod sweep;
mod terminal;
mod write;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use crate::output::{Kind, OutputError};
use crate::{Run, RunOptions, Scene};
use arguments::{Arguments, Command};
use input::Input;
use progress::{PER_MILLE, PERCENT, with_bar};

/// Something that keeps a command from finishing.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Analysis(#[from] crate::Error),
    #[error(transparent)]
    Sweep(#[from] crate::sweep::SweepError),
    #[cfg(feature = "plot")]
    #[error("the figure: {0}")]
    Figure(#[from] crate::figure::FigureError),
    #[error(transparent)]
    Design(#[from] crate::design::DesignError),
    #[error("no point of the sweep has an answer")]
    Nothing,
    #[error("bad usage, which has been told")]
    Unparsed,
    #[error("{argument}: found {found}; allowed: {allowed}")]
    Usage {
        argument: String,
        found: String,
        allowed: String,
    },
    #[error(transparent)]
    File(OutputError),
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

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::StandardOutput(error) => Self::Output(error),
            error => Self::File(error),
        }
    }
}

/// Runs the command with the process's arguments. Exit status: 0 done; 1 the computation failed; 2 bad input or usage.
pub fn main() -> ExitCode {
    match Arguments::try_parse()
        .map_or_else(|error| unparsed(&error), |arguments| execute(&arguments.command))
    {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of a pipe has gone: it has what it wanted.
        Err(Failure::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            if !matches!(failure, Failure::Unparsed) {
                terminal::fail(&failure);
            }
            match failure {
                Failure::Usage { .. } | Failure::Unparsed => ExitCode::from(2),
                Failure::File(error) if error.is_bad_input() => ExitCode::from(2),
                Failure::Design(error) if error.is_bad_input() => ExitCode::from(2),
                Failure::Sweep(error) if error.is_bad_input() => ExitCode::from(2),
                Failure::Analysis(error) if error.is_bad_input() => ExitCode::from(2),
                _ => ExitCode::from(1),
            }
        }
    }
}

/// Prints help, or what is wrong with the arguments.
fn unparsed(error: &clap::Error) -> Result<(), Failure> {
    if !error.use_stderr() {
        return Ok(error.print()?);
    }
    let text = error.render().to_string();
    let is_hidden = |argument: OsString| argument.to_string_lossy().contains(terminal::is_hidden);
    if terminal::cut(&text) == text && !std::env::args_os().any(is_hidden) {
        // With its colours.
        let _ = error.print();
    } else {
        let _ = writeln!(terminal::err(), "{}", terminal::cut(text.trim_end()));
    }
    Err(Failure::Unparsed)
}

fn execute(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Run {
            scene,
            verify,
            output,
        } => {
            let input = Input::read(scene)?;
            let table = write::table(output, Kind::Passes, [&*scene.scene])?;
            let mut answer = input.judged(run(&input.scene, *verify))?;
            warn(&answer.warnings);
            answer.warnings.splice(0..0, input.warnings);
            if let Some(table) = table {
                table.write(&answer.passes)?;
            }
            if output.json {
                write::json(&answer)
            } else if output.is_on_stdout() {
                Ok(())
            } else {
                print::run(&answer)
            }
        }
        Command::Profile {
            scene,
            positions,
            output,
        } => {
            let input = Input::read(scene)?;
            let table = write::table(output, Kind::Motion, [&*scene.scene])?;
            let answer = input.judged(match positions {
                Some(positions) => crate::profile_at(&input.scene, positions),
                None => crate::profile(&input.scene),
            })?;
            if let Some(table) = table {
                table.write(write::motion(&answer))?;
            }
            if output.json {
                write::json(&answer)
            } else if output.is_on_stdout() {
                Ok(())
            } else {
                print::profile(&answer)
            }
        }
        Command::Plan { scene, json } => {
            let input = Input::read(scene)?;
            let mut plan = input.judged(crate::plan(&input.scene).map(|plan| plan.report()))?;
            warn(&plan.warnings);
            plan.warnings.splice(0..0, input.warnings);
            if *json {
                write::json(&plan)
            } else {
                print::plan(&plan)
            }
        }
        Command::Calibrate {
            scene,
            calibrate,
            output,
        } => calibrate::execute(scene, calibrate, output),
        Command::Check { scene } => {
            let input = Input::read(scene)?;
            let plan = input.located(crate::plan(&input.scene))?;
            warn(&plan.report().warnings);
            print::checked(&input.scene)
        }
        #[cfg(feature = "plot")]
        Command::Report(arguments) => report::execute(arguments),
        Command::Design(arguments) => design::execute(arguments),
        Command::Sweep(arguments) => sweep::execute(arguments),
        Command::Presets(arguments) => presets::execute(arguments),
        Command::New(arguments) => new::execute(arguments),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "creepage", &mut script);
            Ok(std::io::stdout().lock().write_all(&script)?)
        }
    }
}

/// Tells warnings on standard error.
fn warn(warnings: &[String]) {
    for warning in warnings {
        terminal::warn(warning);
    }
}

/// Runs the scene, with a progress bar on a terminal.
fn run(scene: &Scene, verify: bool) -> Result<Run, crate::Error> {
    with_bar(PERCENT, PER_MILLE, |progress| {
        let options = RunOptions {
            verify,
            progress,
            ..RunOptions::default()
        };
        crate::run_with(scene, &options)
    })
}
