//! Where methods fail, mapped: `cargo run --release --example stability [NAME]` writes CSV and SVG to `docs/charts/`.
//!
//! Each map is a file here: a grid of runs coloured by outcome. Without a name all maps are drawn.

#[path = "../shared/bilinear.rs"]
mod bilinear;
#[path = "../shared/cable_map.rs"]
mod cable_map;
#[path = "../shared/ground_map.rs"]
mod ground_map;
#[path = "../shared/ground_reference.rs"]
mod ground_reference;

mod burmister;
mod calibration;
mod explicit;
mod fem;
mod heat;
mod implicit;
mod long_term;
mod sigmoid;

use std::error::Error;
use std::path::Path;

/// A map's name and what draws it into a folder.
type Entry = (&'static str, fn(&Path) -> Result<(), Box<dyn Error>>);

const MAPS: &[Entry] = &[
    ("explicit", explicit::run),
    ("implicit", implicit::run),
    ("fem", fem::run),
    ("burmister", burmister::run),
    ("long-term", long_term::run),
    ("heat", heat::run),
    ("calibration", calibration::run),
];

fn main() -> Result<(), Box<dyn Error>> {
    let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/charts");
    std::fs::create_dir_all(&out)?;
    let wanted = std::env::args().nth(1);
    if let Some(name) = &wanted
        && MAPS.iter().all(|(known, _)| known != name)
    {
        let names: Vec<&str> = MAPS.iter().map(|(name, _)| *name).collect();
        return Err(format!("no map {name}; there are: {}", names.join(", ")).into());
    }
    for (name, draw) in MAPS {
        if wanted.as_deref().is_none_or(|wanted| wanted == *name) {
            draw(&out)?;
            println!("{name}: drawn");
        }
    }
    Ok(())
}
