//! Chart 3b: `creepage run` against OpenSees, a general code for structures, on the same scene.
//!
//! OpenSees is called from Python, so `examples/opensees/whole_run.py` computes the table and this file only draws it. Both codes have
//! the same equations, road, nodes and vehicle steps; the error is that of the force at the load cell, as in chart 3.

use std::error::Error;
use std::path::Path;

use creepage::figure::{Axis, Chart, Panels, Reference, Series};

use crate::passes::own_error;

/// Series as the table names them, and how each looks in chart 3 or here.
const SERIES: [(&str, usize); 4] = [
    ("creepage run, tolerance 10 % to 0.1 %", 0),
    ("creepage run, same mesh", 2),
    ("OpenSees", 1),
    ("OpenSees, half as many steps", 3),
];
const TRUTH: &str = "truth";
/// Processor time \[s\] and shares of the force that are drawn.
const TIMES: (f64, f64) = (3e-3, 200.0);
const ERRORS: (f64, f64) = (5e-6, 0.1);

/// Columns of the table.
const NAME: usize = 0;
const ERROR: usize = 6;
const SECONDS: usize = 7;

pub fn run(out: &Path) -> Result<(), Box<dyn Error + Send + Sync>> {
    let mut reader = csv::Reader::from_path(out.join("opensees.csv"))?;
    let rows = reader.records().collect::<Result<Vec<_>, _>>()?;
    let mut chart = Chart::new(
        "upper cable, 30 m, 5 passes",
        Axis::logarithmic("processor time, s").range(TIMES.0, TIMES.1),
        Axis::logarithmic("error, share of the force").range(ERRORS.0, ERRORS.1),
    )
    .refer(Reference::horizontal(1e-2, "1 %"))
    .refer(Reference::horizontal(1e-3, "0.1 %"));
    for row in rows.iter().filter(|row| &row[NAME] == TRUTH) {
        chart = chart.with(own_error(row[ERROR].parse()?, TIMES));
    }
    for (name, look) in SERIES {
        let points = rows
            .iter()
            .filter(|row| &row[NAME] == name)
            .map(|row| Ok((row[SECONDS].parse()?, row[ERROR].parse()?)))
            .collect::<Result<Vec<(f64, f64)>, std::num::ParseFloatError>>()?;
        chart = chart.with(Series::line_points(name, points).look(look));
    }
    let panels = Panels::new("The whole run by a general code: error against processor time").with(chart);
    std::fs::write(out.join("opensees.svg"), panels.to_svg()?)?;
    Ok(())
}
