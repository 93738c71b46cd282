//! `creepage run` against OpenSees: the same forces on the same mesh, and what they cost.

use std::collections::BTreeMap;
use std::error::Error;

use creepage_validation::table;

use super::{RUN, Row, Tested, folder, of, rows, seconds};

const MESH: &str = "creepage run, same mesh";
const GENERAL: [&str; 2] = ["OpenSees", "OpenSees, half as many steps"];

fn table() -> Result<Vec<Row>, Box<dyn Error>> {
    rows("opensees", &[], "node_updates")
}

/// Forces after every pass, by the nodes a depth.
fn forces(series: &str) -> Result<BTreeMap<String, Vec<f64>>, Box<dyn Error>> {
    let mut reader = table::read(&folder().join("opensees.csv"))?;
    let header = reader.headers()?.clone();
    let mut found = BTreeMap::new();
    for record in reader.records() {
        let record = record?;
        if &record[0] == series {
            let forces = header.iter().zip(&record);
            let forces = forces.filter(|(name, _)| name.starts_with("force_"));
            let forces = forces.map(|(_, force)| force.parse()).collect::<Result<_, _>>()?;
            found.insert(record[3].to_owned(), forces);
        }
    }
    Ok(found)
}

#[test]
fn opensees_finds_the_same_forces_on_the_same_mesh() -> Tested {
    let (ours, theirs) = (forces(MESH)?, forces(GENERAL[0])?);
    assert!(ours.keys().eq(theirs.keys()) && ours.len() == 7, "{ours:?}");
    for (density, ours) in ours {
        assert_eq!((ours.len(), theirs[&density].len()), (5, 5));
        // On the finest mesh the windows of the quasi-static solver leave out the most.
        let most = if density == "48" { 5e-6 } else { 3e-6 };
        for (ours, theirs) in ours.iter().zip(&theirs[&density]) {
            assert!(
                (ours / theirs - 1.0).abs() <= most,
                "{density}: {ours} N, {theirs} N"
            );
        }
    }
    Ok(())
}

#[test]
fn the_general_code_comes_to_the_truth() -> Tested {
    let table = table()?;
    let truth: Vec<&Row> = of(&table, "", "truth").collect();
    assert!(truth.len() == 1 && truth[0].error <= 1e-5, "{truth:?}");
    for series in GENERAL {
        let finest = of(&table, "", series).find(|row| row.knob == 48.0);
        assert!(finest.is_some_and(|row| row.error <= 2e-4), "{finest:?}");
    }
    Ok(())
}

/// What the page says of costs: on the same mesh, at the errors it names, and at any point.
#[test]
fn the_general_code_takes_many_times_as_long() -> Tested {
    let table = table()?;
    for theirs in of(&table, "", GENERAL[0]) {
        let ours = of(&table, "", MESH).find(|row| row.knob == theirs.knob);
        let ratio = theirs.seconds / ours.ok_or("no such mesh")?.seconds;
        let least = if theirs.knob >= 12.0 { 150.0 } else { 25.0 };
        assert!((least..=400.0).contains(&ratio), "{theirs:?}: {ratio}");
    }
    for error in [1e-2, 1e-3] {
        let general = GENERAL.map(|series| seconds(&table, "", series, error));
        let (best, run) = (general[0].min(general[1]), seconds(&table, "", RUN, error));
        assert!(
            best.is_finite() && 50.0 * run <= best,
            "{error}: {run} s, {best} s"
        );
    }
    for rival in GENERAL.into_iter().flat_map(|series| of(&table, "", series)) {
        let run = seconds(&table, "", RUN, rival.error);
        assert!(20.0 * run <= rival.seconds, "{rival:?}: {run} s");
    }
    for choice in of(&table, "", RUN) {
        assert!(choice.error <= choice.knob, "{choice:?}");
    }
    Ok(())
}
