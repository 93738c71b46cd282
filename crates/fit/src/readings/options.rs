//! What a user says about a file of readings; the rest is recognised.

use creepage_tables::Options;

use creepage_scene::{CableEnd, words};

/// How to read a table of readings. What is `None` or empty is recognised.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// How the file is written; which of its columns hold `pass`, `vehicles`, `force`, `run`,
    /// `movement`, `position`; the unit of the forces.
    pub table: Options,
    /// Columns of forces and movements by their names, and the ends at which they were measured.
    pub ends: Vec<(String, CableEnd)>,
    /// How a further run begins.
    pub run_start: Option<RunStart>,
    /// Whether the cell counts tension as positive.
    pub tension_positive: bool,
}

impl ReadOptions {
    /// The names that [`ReadOptions::set`] takes.
    pub const NAMES: &str = "separator, decimal, encoding, header_line, skip, sheet, unit, run_start, tension_positive, column_pass, \
                             column_vehicles, column_force, column_run, column_movement, column_position";

    /// Sets the option of this name. A force or a movement may say its end: `upstream=NAME`.
    ///
    /// # Errors
    ///
    /// What was found and what is allowed.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), String> {
        let of_end = |end: CableEnd| Some((end, text.strip_prefix(end.name())?.strip_prefix('=')?));
        match (name, text) {
            ("tension_positive", "True" | "False") => self.tension_positive = text == "True",
            ("tension_positive", _) => return Err(format!("found `{text}`; allowed: True or False")),
            ("run_start", _) => self.run_start = Some(text.parse()?),
            ("column_force" | "column_movement", _) => {
                let said = CableEnd::ALL.into_iter().find_map(of_end);
                self.ends
                    .extend(said.map(|(end, column)| (column.to_owned(), end)));
                self.table.set(name, said.map_or(text, |(_, column)| column))?;
            }
            _ if Self::NAMES.split(", ").any(|known| known == name) => self.table.set(name, text)?,
            _ => return Err(format!("allowed: {}", Self::NAMES)),
        }
        Ok(())
    }
}

/// How a further run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunStart {
    /// With a cable at rest that no vehicle has passed.
    Rest,
    /// As the run before left the cable.
    Continue,
}

words!(RunStart: Rest "rest", Continue "continue");
