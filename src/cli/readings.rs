//! Options by which commands read tables.

use std::path::Path;

use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};

use crate::Error;
use crate::readings::{ReadOptions, Readings};

const HEADING: &str = "Reading the table, where it is not recognised";

/// An option: its name, that of its value, what it does.
type Named = (&'static str, &'static str, &'static str);

#[rustfmt::skip]
const OF_TABLES: &[Named] = &[
    ("separator", "SIGN", "What stands between cells: comma, semicolon, tab, space, |"),
    ("decimal", "SIGN", "What stands before the decimals: point, comma"),
    ("encoding", "NAME", "How characters are written: utf-8, utf-16, latin-1, shift_jis, …"),
    ("header-line", "N", "Line with the names of the columns"),
    ("skip", "N", "Rows below the names that hold no data, one of units among them"),
    ("sheet", "NAME", "Sheet of a workbook"),
];
#[rustfmt::skip]
const OF_READINGS: &[Named] = &[
    ("column-pass", "NAME", "Column with the number of the pass; 0 is the reading before the first"),
    ("column-vehicles", "NAME", "Column with the vehicles counted since the row before, in place of passes"),
    ("column-force", "NAME", "Column with the force; of two load cells upstream=NAME and downstream=NAME"),
    ("column-run", "NAME", "Column with the name of the run"),
    ("column-movement", "NAME", "Column with the movement of an end of the cable, positive downstream; also upstream=NAME, downstream=NAME"),
    ("column-position", "NAME", "Column with the place along the duct where the row was measured, from the upstream end"),
    ("unit", "UNIT", "Unit of the forces, whatever the header says: N, kN, daN, kgf, lbf, …"),
    ("run-start", "HOW", "How a further run begins: rest (with a cable that no vehicle has passed), continue (as the run before left it). Default: rest \
        where the passes begin anew"),
];
const TENSION_POSITIVE: &str = "tension-positive";

/// Options by which a table is read, if `READINGS` one of readings.
#[derive(Debug)]
pub struct ReadArguments<const READINGS: bool = true>(pub ReadOptions);

/// Those of a table of anything else.
pub type TableArguments = ReadArguments<false>;

impl ReadArguments {
    /// The readings in `file`.
    pub fn read(&self, file: &Path) -> Result<Readings, Error> {
        Ok(Readings::from_file(file, &self.0)?)
    }
}

impl<const READINGS: bool> ReadArguments<READINGS> {
    fn named() -> impl Iterator<Item = &'static Named> {
        let of_readings = if READINGS { OF_READINGS } else { &[] };
        OF_TABLES.iter().chain(of_readings)
    }
}

impl<const READINGS: bool> Args for ReadArguments<READINGS> {
    fn augment_args(command: Command) -> Command {
        let argument = |name, help: &'static str| Arg::new(name).long(name).help(help).help_heading(HEADING);
        let command = Self::named().fold(command, |command, &(name, value, help)| {
            let key = name.replace('-', "_");
            let checked = move |text: &str| ReadOptions::default().set(&key, text).map(|()| text.to_owned());
            let (action, other) = match name {
                "column-force" | "column-movement" => (ArgAction::Append, None),
                "column-vehicles" => (ArgAction::Set, Some("column-pass")),
                _ => (ArgAction::Set, None),
            };
            let argument = argument(name, help)
                .value_name(value)
                .value_parser(checked)
                .action(action);
            command.arg(argument.conflicts_with_all(other))
        });
        let help = "The load cell counts tension as positive";
        let flag = READINGS.then(|| argument(TENSION_POSITIVE, help).action(ArgAction::SetTrue));
        command.args(flag)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const READINGS: bool> FromArgMatches for ReadArguments<READINGS> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut options = ReadOptions::default();
        for (name, ..) in Self::named() {
            for text in matches.get_many::<String>(name).into_iter().flatten() {
                let set = options.set(&name.replace('-', "_"), text);
                set.map_err(|why| clap::Error::raw(clap::error::ErrorKind::InvalidValue, why))?;
            }
        }
        options.tension_positive = READINGS && matches.get_flag(TENSION_POSITIVE);
        Ok(Self(options))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        Self::from_arg_matches(matches).map(|read| *self = read)
    }
}
