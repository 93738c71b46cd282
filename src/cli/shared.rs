//! The scene that a command reads, and what is set on top of it.

use std::path::PathBuf;

use super::failure::Failure;
pub use super::outputs::{Force, Json, OutputArguments};
use super::terminal;
use crate::scene::{DAYS_PER_YEAR, PER_DAY, Quantity, YEARS, quoted};
use crate::{Error, Scene, SceneFile};

#[derive(Debug, clap::Args)]
pub struct SceneArguments {
    /// Scene file (TOML)
    pub scene: PathBuf,
    /// Override a key of the scene (`creepage explain` lists them), such as friction.dynamic_coefficient=0.3; a number without a unit is
    /// SI; may be repeated
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true, value_parser = key_and_value)]
    pub set: Vec<String>,
}

/// Says at once that an override has no `=`, before what stands behind it is taken for an argument.
fn key_and_value(text: &str) -> Result<String, String> {
    if text.contains('=') {
        return Ok(text.to_owned());
    }
    Err(format!(
        "found `--set {text}` without `=`; allowed: KEY=VALUE without a space, such as friction.dynamic_coefficient=0.3"
    ))
}

/// How many threads compute. [`limit_threads`](super::limit_threads) finds it in the arguments of whatever command has it.
#[derive(Debug, clap::Args)]
pub struct Threads {
    /// Compute in at most N threads; on all cores if omitted
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// A scene whose traffic may be given in years.
#[derive(Debug, clap::Args)]
pub struct TrafficArguments {
    #[command(flatten)]
    pub file: SceneArguments,
    #[command(flatten)]
    threads: Threads,
    /// Years of traffic in place of the scene's passes, as traffic.years; of 365.25 days
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = |text: &str| within(YEARS, text, 1.0, "years", "20, or --days 30"))]
    years: Option<f64>,
    /// Days of traffic in place of --years
    #[arg(long, value_name = "N", allow_negative_numbers = true, conflicts_with = "years",
        value_parser = |text: &str| within(YEARS, text, DAYS_PER_YEAR, "days", "30"))]
    days: Option<f64>,
    /// Vehicles a day, as traffic.per_day
    #[arg(long, value_name = "N", allow_negative_numbers = true,
        value_parser = |text: &str| within(PER_DAY, text, 1.0, "vehicles a day", "800"))]
    trucks_per_day: Option<f64>,
}

impl TrafficArguments {
    /// The scene file with all that was set on top of it.
    pub fn read(&self) -> Result<SceneFile, Failure> {
        let file = SceneFile::read(&self.file.scene)?.with(&self.overrides())?;
        let lasts = self.years.or(self.days).is_some();
        if lasts && !file.names("traffic.per_day") {
            let found = "none, and `traffic.per_day` is missing in the scene";
            let allowed = "how many vehicles a day there are in that time, such as --trucks-per-day 800";
            return Err(Failure::usage("--trucks-per-day", found, allowed));
        }
        Ok(file)
    }

    /// All that is set on top of the scene file.
    pub fn overrides(&self) -> Vec<String> {
        let keys = [
            ("per_day", self.trucks_per_day),
            ("years", self.years.or(self.days)),
        ];
        let given = keys
            .iter()
            .filter_map(|(key, value)| Some(format!("traffic.{key}={}", (*value)?)));
        self.file.set.iter().cloned().chain(given).collect()
    }
}

/// A number of `things`, so many of which are one of a key of the scene, in the range of that key.
fn within(key: Quantity, text: &str, per_unit: f64, things: &str, example: &str) -> Result<f64, String> {
    let number = text.trim().parse().map(|number: f64| number / per_unit);
    number.ok().filter(|number| key.contains(*number)).ok_or_else(|| {
        let (least, most) = (per_unit * key.least, per_unit * key.most);
        format!("allowed: a number of {things} greater than 0, from {least:e} to {most:e}, such as {example}")
    })
}

/// What one does not know of a scene.
#[derive(Debug, clap::Args)]
pub struct UncertainArguments {
    /// A key of which only the lowest and the highest value are known, friction.dynamic_coefficient=0.2:0.5 or
    /// ground.vertical_peak=90um:150um, as in [uncertain]; may be repeated
    #[arg(long, value_name = "KEY=LOW:HIGH", value_parser = interval)]
    uncertain: Vec<String>,
}

impl UncertainArguments {
    /// The file with these too.
    pub fn on(&self, file: &SceneFile) -> Result<SceneFile, Failure> {
        Ok(file.with(&self.uncertain)?)
    }
}

/// The override of an interval, such as `uncertain.ground.vertical_peak=["90um", "150um"]`.
fn interval(text: &str) -> Result<String, String> {
    let parts = text
        .split_once('=')
        .and_then(|(key, both)| Some((key, both.split_once(':')?)));
    let value = |text: &str| match text.trim().parse::<f64>() {
        Ok(number) => format!("{number:?}"),
        Err(_) => quoted(text.trim()),
    };
    let set =
        parts.map(|(key, (low, high))| format!("uncertain.{}=[{}, {}]", key.trim(), value(low), value(high)));
    set.ok_or_else(|| {
        format!("found `{text}`; allowed: KEY=LOW:HIGH without spaces, such as friction.dynamic_coefficient=0.2:0.5")
    })
}

/// A scene and the file it came from.
pub struct Input {
    file: SceneFile,
    pub scene: Scene,
    /// What looks like a slip in the file.
    pub warnings: Vec<String>,
}

impl Input {
    /// Reads the scene and warns of numbers that look like slips.
    pub fn read(arguments: &SceneArguments) -> Result<Self, Failure> {
        Self::of(SceneFile::read(&arguments.scene)?.with(&arguments.set)?)
    }

    /// The same of a scene that is read.
    pub fn of(file: SceneFile) -> Result<Self, Failure> {
        Ok(Self {
            scene: file.scene()?,
            warnings: warn_of_slips(&file),
            file,
        })
    }

    /// The scene's file.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    /// The table that the scene reads beside its file, which no output may replace.
    pub fn table(&self) -> Option<PathBuf> {
        self.file.histogram()
    }

    /// The answer, or the error with the line of the key at fault.
    pub fn located<T>(&self, answer: Result<T, Error>) -> Result<T, Failure> {
        answer.map_err(|error| Failure::Analysis(error.located(&self.file)))
    }

    /// Warns of what an answer warns of, with the line of the key that a warning begins with.
    pub fn warn_all(&self, warnings: &[String]) {
        for warning in warnings.iter().filter(|warning| !self.is_told(warning)) {
            match key_of(warning).and_then(|key| self.file.locate(key)) {
                Some(location) => terminal::warn(format_args!("{location}: {warning}{}", location.excerpt())),
                None => terminal::warn(warning),
            }
        }
    }

    /// Warns of what the answer warns of, and adds to it the warnings of the scene.
    pub fn warn(&self, warnings: &mut Vec<String>) {
        self.warn_all(warnings);
        warnings.retain(|warning| !self.is_told(warning));
        warnings.splice(0..0, self.warnings.iter().cloned());
    }

    /// Whether the warning is of a key that a slip was found at.
    fn is_told(&self, warning: &str) -> bool {
        let key = key_of(warning).map(|key| format!("`{key}`"));
        key.is_some_and(|key| self.warnings.iter().any(|slip| slip.contains(&key)))
    }
}

/// The key in backticks that a warning begins with.
fn key_of(warning: &str) -> Option<&str> {
    warning.strip_prefix('`')?.split('`').next()
}

/// Warns of numbers that look like slips.
pub fn warn_of_slips(file: &SceneFile) -> Vec<String> {
    let warned = file.slips().into_iter().map(|(location, words)| {
        let warning = format!("{location}: {words}");
        terminal::warn(format_args!("{warning}{}", location.excerpt()));
        warning
    });
    warned.collect()
}
