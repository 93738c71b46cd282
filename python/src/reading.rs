//! How a table of readings is to be read, by the names of the command's options.

use creepage::readings::ReadOptions;

use crate::failure::Failure;

/// The options with these names and values.
pub fn options(named: Vec<(String, String)>) -> Result<ReadOptions, Failure> {
    let mut options = ReadOptions::default();
    for (name, value) in named {
        let set = options.set(&name, &value);
        set.map_err(|why| Failure::argument(format!("read: {name}: {why}")))?;
    }
    Ok(options)
}
