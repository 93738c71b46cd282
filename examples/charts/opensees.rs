//! The first passes by a general structural code: draws what `examples/opensees/whole_run.py` has measured.

use std::error::Error;
use std::path::Path;

use creepage::figure::{Axis, Chart, Reference, Series};

type Failure = Box<dyn Error + Send + Sync>;

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut series: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    let mut reader = csv::Reader::from_path(out.join("opensees.csv"))?;
    for record in reader.records() {
        let record = record?;
        let point = (record[2].parse()?, record[4].parse()?);
        match series.iter_mut().find(|(name, _)| *name == record[0]) {
            Some((_, points)) => points.push(point),
            None => series.push((record[0].to_owned(), vec![point])),
        }
    }
    let mut chart = Chart::new(
        "Five passes of the full-scale experiment: error against processor time",
        Axis::logarithmic("processor time, s").range(1e-3, 100.0),
        Axis::logarithmic("error, share of the force").range(1e-5, 0.1),
    )
    .refer(Reference::horizontal(1e-2, "1 %"))
    .refer(Reference::horizontal(1e-3, "0.1 %"));
    for (look, (name, points)) in series.into_iter().enumerate() {
        chart = chart.with(Series::line_points(name, points).look(look));
    }
    std::fs::write(out.join("opensees.svg"), chart.to_svg()?)?;
    Ok(())
}
