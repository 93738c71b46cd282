//! The command line: parsing, printing, and the exit status. Everything it does is a call of the library.

mod calibrate;
mod check;
mod completions;
mod design;
mod design_words;
mod explain;
#[cfg(feature = "explore")]
mod explore;
mod failure;
mod limits;
mod measures;
mod new;
mod outputs;
mod plan;
mod presets;
mod profile;
mod progress;
mod readings;
mod report;
mod run;
mod shared;
mod signals;
mod state;
mod sweep;
mod terminal;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use failure::Failure;

/// Predicts how power cables in underground ducts creep under traffic.
#[derive(Debug, Parser)]
#[command(
    name = "creepage",
    version,
    about,
    after_help = "Examples:
  creepage new my-duct.toml
  creepage run my-duct.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --csv forces.csv
  creepage profile my-duct.toml --positions -1.5,0,1.5 --json
  creepage calibrate my-duct.toml --data load-cell.csv --robust
  creepage report my-duct.toml -o my-duct.html
  creepage explore my-duct.toml"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute the force in the cable after every pass
    Run(run::Arguments),
    /// Show the motion of the duct under the first vehicle
    Profile(profile::Arguments),
    /// Show the chosen ground model, method and mesh, the alternatives, and why
    Plan(plan::Arguments),
    /// Fit friction and ground to what a load cell measured
    Calibrate(Box<calibrate::Arguments>),
    /// Check a scene without computing
    Check(check::Arguments),
    /// Compute a scene with many values of some keys, on all cores
    Sweep(Box<sweep::Arguments>),
    /// Find the springs or the clamp that stay within limits of force and movement
    Design(Box<design::Arguments>),
    /// Compare measures, whatever is not known: does each hold, and which to take
    Measures(Box<measures::Arguments>),
    /// Write a self-contained HTML report with figures
    Report(Box<report::Arguments>),
    /// Show a page on this machine with the scene's numbers as sliders, whose answer follows the hand
    #[cfg(feature = "explore")]
    Explore(Box<explore::Arguments>),
    /// Write a commented scene to start from
    New(Box<new::Arguments>),
    /// List named values for vehicles, cables, friction and pavements, with their sources
    Presets(presets::Arguments),
    /// Explain the keys of a scene: meaning, units, range, default
    Explain(explain::Arguments),
    /// Print the JSON Schema of a scene, by which editors complete and check it
    #[command(after_help = "Examples:\n  creepage schema > creepage.schema.json")]
    Schema,
    /// Print a script that completes commands and flags in a shell
    Completions(completions::Arguments),
}

/// Stands at the end of every help.
const EXIT_STATUS: &str = "Exit status: 0 done; 1 the computation failed; 2 bad input or usage; 3 a limit is exceeded and --check is given; 130 stopped by Ctrl-C.";

/// The command line, whose every help ends with the exit status.
fn command_line() -> clap::Command {
    fn with_status(command: clap::Command) -> clap::Command {
        let help = command.get_after_help().map(|help| format!("{help}\n\n"));
        command.after_help(help.unwrap_or_default() + EXIT_STATUS)
    }
    with_status(Arguments::command()).mut_subcommands(with_status)
}

/// Runs the command with the process's arguments; the exit status stands at the end of every help.
pub fn main() -> ExitCode {
    let parsed = command_line().try_get_matches().and_then(|mut matches| {
        limit_threads(&matches);
        Arguments::from_arg_matches_mut(&mut matches)
    });
    match parsed {
        Ok(arguments) => failure::status(execute(&arguments.command)),
        Err(error) => failure::unparsed(&error),
    }
}

/// Makes rayon's threads, in which everything is computed, as many as `--threads` says.
fn limit_threads(matches: &clap::ArgMatches) {
    let command = matches.subcommand().map(|(_, command)| command);
    let threads = command.and_then(|command| command.try_get_one::<u16>("threads").ok()?);
    if let Some(&threads) = threads {
        // There are none yet, so they can be made.
        let _ = rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global();
    }
}

fn execute(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::execute(arguments),
        Command::Profile(arguments) => profile::execute(arguments),
        Command::Plan(arguments) => plan::execute(arguments),
        Command::Calibrate(arguments) => calibrate::execute(arguments),
        Command::Check(arguments) => check::execute(arguments),
        Command::Sweep(arguments) => sweep::execute(arguments),
        Command::Design(arguments) => design::execute(arguments),
        Command::Measures(arguments) => measures::execute(arguments),
        Command::Report(arguments) => report::execute(arguments),
        #[cfg(feature = "explore")]
        Command::Explore(arguments) => explore::execute(arguments),
        Command::New(arguments) => new::execute(arguments),
        Command::Presets(arguments) => presets::execute(arguments),
        Command::Explain(arguments) => explain::execute(arguments),
        Command::Schema => Ok(writeln!(terminal::out(), "{:#}", crate::scene::schema())?),
        Command::Completions(arguments) => completions::execute(arguments, &mut Arguments::command()),
    }
}
