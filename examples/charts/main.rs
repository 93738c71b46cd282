//! Speed against accuracy, drawn: `cargo run --release --example charts [NAME]` writes CSV and SVG to `docs/charts/`.
//!
//! Each chart is a file here. Accuracy is measured against independent or far finer answers, cost in seconds and in a count that
//! knows no machine. Without a name all charts are drawn.

#[path = "../shared/aims.rs"]
mod computations;
#[path = "../shared/ground_reference.rs"]
mod ground_reference;
#[path = "../shared/passes.rs"]
mod passes;
#[path = "../shared/stopwatch.rs"]
mod stopwatch;

mod aims;
mod cable;
mod cost;
mod discrepancy;
mod ground;
mod opensees;
mod whole;

use std::error::Error;
use std::path::Path;

/// A chart's name and what draws it into a folder.
type Entry = (
    &'static str,
    fn(&Path) -> Result<(), Box<dyn Error + Send + Sync>>,
);

const CHARTS: &[Entry] = &[
    ("ground", ground::run),
    ("cable", cable::run),
    ("whole", whole::run),
    ("opensees", opensees::run),
    ("discrepancy", discrepancy::run),
    ("cost", cost::run),
    ("aims", aims::run),
];

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/charts");
    std::fs::create_dir_all(&out)?;
    let wanted = std::env::args().nth(1);
    if let Some(name) = &wanted
        && CHARTS.iter().all(|(known, _)| known != name)
    {
        let names: Vec<&str> = CHARTS.iter().map(|(name, _)| *name).collect();
        return Err(format!("no chart {name}; there are: {}", names.join(", ")).into());
    }
    for (name, draw) in CHARTS {
        if wanted.as_deref().is_none_or(|wanted| wanted == *name) {
            draw(&out)?;
            println!("{name}: drawn");
        }
    }
    Ok(())
}
