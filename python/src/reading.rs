//! How a table of readings is to be read, by the names of the command's options.

use creepage::readings::ReadOptions;

use crate::failure::Failure;

const NAMES: &str = "separator, decimal, encoding, header_line, skip, sheet, unit, run_start, tension_positive, column_pass, column_vehicles, \
                     column_force, column_run, column_movement, column_position";

/// The options with these names and values.
pub fn options(named: Vec<(String, String)>) -> Result<ReadOptions, Failure> {
    let mut options = ReadOptions::default();
    for (name, value) in named {
        set(&mut options, &name, value).map_err(|why| Failure::argument(format!("read: {name}: {why}")))?;
    }
    Ok(options)
}

fn set(options: &mut ReadOptions, name: &str, value: String) -> Result<(), String> {
    let whole = || {
        value
            .parse()
            .map_err(|_| format!("found `{value}`; allowed: a whole number"))
    };
    let (table, columns) = (&mut options.table, &mut options.columns);
    match name {
        "separator" => table.separator = Some(value.parse()?),
        "decimal" => table.decimal = Some(value.parse()?),
        "encoding" => table.encoding = Some(value.parse()?),
        "header_line" => table.header_line = Some(whole()?),
        "skip" => table.skip = Some(whole()?),
        "sheet" => table.sheet = Some(value),
        "unit" => options.unit = Some(value),
        "run_start" => options.run_start = Some(value.parse()?),
        "tension_positive" => match &*value {
            "True" => options.tension_positive = true,
            "False" => {}
            _ => return Err(format!("found `{value}`; allowed: True or False")),
        },
        "column_pass" => columns.pass = Some(value),
        "column_vehicles" => columns.vehicles = Some(value),
        "column_force" => columns.force.push(value),
        "column_run" => columns.run = Some(value),
        "column_movement" => columns.movement.push(value),
        "column_position" => columns.position = Some(value),
        _ => return Err(format!("allowed: {NAMES}")),
    }
    Ok(())
}
