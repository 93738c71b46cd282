//! Options by which commands read tables of readings.

use std::path::Path;

use crate::Error;
use crate::readings::{
    ColumnNames, Decimal, Encoding, ReadOptions, Readings, RunStart, Separator, TableOptions,
};

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Reading the table, where it is not recognised")]
pub struct TableArguments {
    /// What stands between cells: comma, semicolon, tab, space, |
    #[arg(long, value_name = "SIGN", allow_hyphen_values = true)]
    separator: Option<Separator>,
    /// What stands before the decimals: point, comma
    #[arg(long, value_name = "SIGN")]
    decimal: Option<Decimal>,
    /// How characters are written: utf-8, utf-16, latin-1, shift_jis, …
    #[arg(long, value_name = "NAME")]
    encoding: Option<Encoding>,
    /// Line with the names of the columns
    #[arg(long, value_name = "N")]
    header_line: Option<u64>,
    /// Rows below the names that hold no data, one of units among them
    #[arg(long, value_name = "N")]
    skip: Option<u64>,
    /// Sheet of a workbook
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
}

impl TableArguments {
    pub fn options(&self) -> TableOptions {
        TableOptions {
            separator: self.separator,
            decimal: self.decimal,
            encoding: self.encoding,
            header_line: self.header_line,
            skip: self.skip,
            sheet: self.sheet.clone(),
        }
    }
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Reading the table, where it is not recognised")]
pub struct ReadArguments {
    #[command(flatten)]
    table: TableArguments,
    /// Column with the number of the pass; 0 is the reading before the first
    #[arg(long, value_name = "NAME")]
    column_pass: Option<String>,
    /// Column with the vehicles counted since the row before, in place of passes
    #[arg(long, value_name = "NAME", conflicts_with = "column_pass")]
    column_vehicles: Option<String>,
    /// Column with the force; of two load cells upstream=NAME and downstream=NAME
    #[arg(long, value_name = "NAME")]
    column_force: Vec<String>,
    /// Column with the name of the run
    #[arg(long, value_name = "NAME")]
    column_run: Option<String>,
    /// Column with the movement of an end of the cable, positive downstream; also upstream=NAME, downstream=NAME
    #[arg(long, value_name = "NAME")]
    column_movement: Vec<String>,
    /// Column with the place along the duct where the row was measured, from the upstream end
    #[arg(long, value_name = "NAME")]
    column_position: Option<String>,
    /// Unit of the forces, whatever the header says: N, kN, daN, kgf, lbf, …
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// How a further run begins: rest (with a cable that no vehicle has passed), continue (as the run before left it). Default: rest
    /// where the passes begin anew
    #[arg(long, value_name = "HOW")]
    run_start: Option<RunStart>,
    /// The load cell counts tension as positive
    #[arg(long)]
    tension_positive: bool,
}

impl ReadArguments {
    fn options(&self) -> ReadOptions {
        ReadOptions {
            table: self.table.options(),
            columns: ColumnNames {
                pass: self.column_pass.clone(),
                vehicles: self.column_vehicles.clone(),
                force: self.column_force.clone(),
                run: self.column_run.clone(),
                movement: self.column_movement.clone(),
                position: self.column_position.clone(),
            },
            unit: self.unit.clone(),
            run_start: self.run_start,
            tension_positive: self.tension_positive,
        }
    }

    /// The readings in `file`.
    pub fn read(&self, file: &Path) -> Result<Readings, Error> {
        Ok(Readings::from_file_with(file, &self.options())?)
    }
}
