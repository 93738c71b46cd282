//! Chart 3b: `creepage run` against OpenSees, a general code for structures, on the same scene.
//!
//! OpenSees is called from Python, so `validation/opensees/whole_run.py` computes the table and this file only draws it. Both codes have
//! the same equations, road, nodes and vehicle steps; the error is that of the force at the load cell, as in chart 3.

use std::path::Path;

use crate::Failure;
use crate::precision::{Figure, Point};

/// Series as the table names them, and how each looks in chart 3 or here.
const SERIES: [&str; 4] = [
    "creepage run, tolerance 10 % to 0.1 %",
    "OpenSees",
    "creepage run, same mesh",
    "OpenSees, half as many steps",
];
const TRUTH: &str = "truth";
/// Columns of the table.
const NAME: usize = 0;
const ERROR: usize = 6;
const SECONDS: usize = 7;

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut reader = crate::table::read(&out.join("opensees.csv"))?;
    let (mut points, mut own_error) = (Vec::new(), 0.0);
    for row in reader.records() {
        let row = row?;
        let series = SERIES.iter().position(|name| *name == &row[NAME]);
        match series {
            Some(series) => points.push(Point {
                panel: 0,
                series,
                knob: 0.0,
                error: row[ERROR].parse()?,
                seconds: row[SECONDS].parse()?,
                count: None,
            }),
            None if &row[NAME] == TRUTH => own_error = row[ERROR].parse()?,
            None => {}
        }
    }
    let figure = Figure {
        title: "The whole run by a general code: error against processor time",
        cost: ("processor time, s", (3e-3, 200.0)),
        error: ("error, share of the force", (5e-6, 0.1)),
    };
    let panel = [("upper cable, 30 m, 5 passes".to_owned(), own_error)];
    let series = SERIES.map(str::to_owned);
    let svg = figure.draw(&panel, &series, &points, |point| Some(point.seconds))?;
    std::fs::write(out.join("opensees.svg"), svg)?;
    Ok(())
}
