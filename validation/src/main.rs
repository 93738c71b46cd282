//! Draws charts and maps: `cargo run --release -p creepage-validation [NAME]` writes CSV and SVG to `docs/charts/`.
//!
//! Without a name all of them are drawn; `whole-range COUNT FILE [FIRST]` judges random scenes.

use std::path::Path;

use creepage_validation::{Failure, charts, file, occurrence, stability, whole_range};

/// A name and what draws it into a folder.
type Entry = (&'static str, fn(&Path) -> Result<(), Failure>);

const ALL: [Entry; 17] = [
    ("ground", charts::ground::run),
    ("cable", charts::cable::run),
    ("whole", charts::whole::run),
    ("opensees", charts::opensees::run),
    ("discrepancy", charts::discrepancy::run),
    ("cost", charts::cost::run),
    ("aims", charts::aims::run),
    ("bends", stability::bends::run),
    ("sections", stability::sections::run),
    ("explicit", stability::explicit::run),
    ("implicit", stability::implicit::run),
    ("fem", stability::fem::run),
    ("burmister", stability::burmister::run),
    ("long-term", stability::long_term::run),
    ("heat", stability::heat::run),
    ("calibration", stability::calibration::run),
    ("occurrence", occurrence::run),
];

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [name, rest @ ..] = &arguments[..]
        && name == "whole-range"
    {
        return whole_range::run(rest);
    }
    let wanted = |name: &&Entry| arguments.is_empty() || arguments.iter().any(|wanted| wanted == name.0);
    if let Some(unknown) = arguments
        .iter()
        .find(|&name| ALL.iter().all(|entry| entry.0 != name))
    {
        let names = ALL.map(|(name, _)| name).join(", ");
        return Err(format!("nothing is called {unknown}; there are: {names}, whole-range").into());
    }
    let out = file("docs/charts");
    std::fs::create_dir_all(&out)?;
    for (name, draw) in ALL.iter().filter(wanted) {
        draw(&out)?;
        println!("{name}: drawn");
    }
    Ok(())
}
