//! The tables behind docs/charts.md: they are sound, each has its figure on the page, and what the page concludes holds in them.

mod maps;
mod opensees;

use std::collections::BTreeSet;
use std::error::Error;
use std::path::PathBuf;

use creepage_validation::table;

type Tested = Result<(), Box<dyn Error>>;

/// Names of series.
const RUN: &str = "creepage run, tolerance 10 % to 0.1 %";
const CHAIN: &str = "fem and explicit";
const JUMPS: &str = "quasi-static with jumps";
const SIGMOID: &str = "explicit, sigmoid over b";

/// A row of a chart: where it belongs, what was set, its error and what it cost.
#[derive(Debug, Clone)]
struct Row {
    panel: String,
    method: String,
    knob: f64,
    error: f64,
    seconds: f64,
    /// Not counted by every method.
    count: Option<f64>,
}

fn folder() -> PathBuf {
    creepage_validation::file("docs/charts")
}

fn page() -> Result<String, Box<dyn Error>> {
    Ok(std::fs::read_to_string(folder().with_extension("md"))?)
}

/// Names of the files with this extension.
fn names(extension: &str) -> Result<BTreeSet<String>, Box<dyn Error>> {
    let mut names = BTreeSet::new();
    for entry in std::fs::read_dir(folder())? {
        let path = entry?.path();
        if path.extension().is_some_and(|found| found == extension) {
            names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    Ok(names)
}

/// The answered rows of a work-precision chart and the truth's own, in which time and count are missing.
fn rows(name: &str, panel: &[&str], cost: &str) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut reader = table::read(&folder().join(name).with_extension("csv"))?;
    let header = reader.headers()?.clone();
    let column = |wanted: &str| {
        let found = header.iter().position(|name| name == wanted);
        found.ok_or_else(|| format!("{name}.csv has no column {wanted}"))
    };
    let panel = panel
        .iter()
        .map(|part| column(part))
        .collect::<Result<Vec<_>, _>>()?;
    let (method, knob) = (
        column("method").or_else(|_| column("series"))?,
        column("knob").or_else(|_| column("accuracy_asked"))?,
    );
    let error = header
        .iter()
        .position(|name| name.starts_with("error_share"))
        .ok_or("no error")?;
    let (seconds, count) = (
        column("processor_seconds").or_else(|_| column("seconds"))?,
        column(cost)?,
    );
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        if record[error].is_empty() {
            assert!(record[seconds].is_empty(), "{record:?}");
            continue;
        }
        let truth = &record[method] == "truth";
        let row = Row {
            panel: panel
                .iter()
                .map(|&part| &record[part])
                .collect::<Vec<_>>()
                .join(", "),
            method: record[method].into(),
            knob: record[knob].parse()?,
            error: record[error].parse()?,
            seconds: if truth { 0.0 } else { record[seconds].parse()? },
            count: if record[count].is_empty() {
                None
            } else {
                Some(record[count].parse()?)
            },
        };
        assert!(row.error.is_finite() && row.error >= 0.0, "{row:?}");
        assert!(row.seconds.is_finite() && (truth || row.seconds > 0.0), "{row:?}");
        rows.push(row);
    }
    assert!(!rows.is_empty(), "{name}.csv is empty");
    Ok(rows)
}

fn ground() -> Result<Vec<Row>, Box<dyn Error>> {
    rows("ground", &["ground"], "count")
}

fn cable() -> Result<Vec<Row>, Box<dyn Error>> {
    rows("cable", &["duct_m", "passes"], "node_updates")
}

fn whole() -> Result<Vec<Row>, Box<dyn Error>> {
    rows("whole", &["scene"], "node_updates")
}

fn panels(rows: &[Row]) -> BTreeSet<&str> {
    rows.iter().map(|row| row.panel.as_str()).collect()
}

/// The rows of a method in a panel.
fn of<'a>(rows: &'a [Row], panel: &'a str, method: &'a str) -> impl Iterator<Item = &'a Row> {
    rows.iter()
        .filter(move |row| row.panel == panel && row.method == method)
}

/// The least time in which a method is at most so wrong; infinite if it never is.
fn seconds(rows: &[Row], panel: &str, method: &str, error: f64) -> f64 {
    of(rows, panel, method)
        .filter(|row| row.error <= error)
        .fold(f64::INFINITY, |least, row| least.min(row.seconds))
}

/// What runs cost in a panel of the chart of costs: work, seconds and node updates where they are counted.
fn cost(panel: &str, series: &str) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let mut reader = table::read(&folder().join("cost.csv"))?;
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record?;
        if &record[0] == panel && &record[1] == series {
            points.push((record[2].parse()?, record[3].parse()?));
        }
    }
    assert!(points.len() > 1, "{panel}, {series}: {points:?}");
    Ok(points)
}

/// How cost grows from one point to the last, as an exponent of the work.
fn growth(points: &[(f64, f64)], from: f64) -> f64 {
    let first = points
        .iter()
        .find(|(work, _)| *work >= from)
        .unwrap_or(&points[0]);
    let last = points[points.len() - 1];
    (last.1 / first.1).ln() / (last.0 / first.0).ln()
}

#[test]
fn no_cost_grows_faster_than_the_page_says() -> Tested {
    for (panel, series, from, most) in [
        ("passes", "one way", 1e4, 0.05),
        ("passes", "two ways", 1e4, 0.05),
        ("length", "10 passes", 30.0, 1.0),
        ("length", "1e6 passes", 30.0, 1.1),
        ("tolerance", "200 passes of 30 m", 20.0, 1.2),
        ("vehicles", "1000 passes of 30 m", 1.0, 1.0),
        ("layers", "10 passes of 30 m", 5.0, 0.2),
        ("threads", "16 runs at once", 1.0, -0.75),
    ] {
        let found = growth(&cost(panel, series)?, from);
        assert!(found <= most, "{panel}, {series}: {found}, not {most}");
    }
    Ok(())
}

#[test]
fn what_is_counted_takes_little_more_than_bare_solves() -> Tested {
    let mut reader = table::read(&folder().join("aims.csv"))?;
    let page = page()?;
    let mut counted = 0;
    for record in reader.records() {
        let record = record?;
        assert!(
            page.contains(&format!("| {} |", &record[0])),
            "not on the page: {record:?}"
        );
        let seconds: f64 = record[2].parse()?;
        if let Ok(least) = record[4].parse::<f64>() {
            assert!(seconds <= 2.0 * least, "{record:?}");
            counted += 1;
        }
    }
    assert_eq!(counted, 5);
    Ok(())
}

#[test]
fn every_table_is_sound_and_every_figure_on_the_page() -> Tested {
    for name in names("csv")? {
        let mut reader = table::read(&folder().join(&name).with_extension("csv"))?;
        let mut rows = 0;
        for record in reader.records() {
            // An unequal number of fields is an error.
            record.map_err(|error| format!("{name}.csv: {error}"))?;
            rows += 1;
        }
        assert!(rows > 0, "{name}.csv has no rows");
    }
    let page = page()?;
    let figures = names("svg")?;
    for name in &figures {
        let link = format!("(charts/{name}.svg)");
        assert!(page.contains(&link), "docs/charts.md does not show {link}");
    }
    for link in page.split("(charts/").skip(1) {
        let name = link.split(".svg)").next().unwrap_or_default();
        assert!(
            figures.contains(name),
            "docs/charts.md shows {name}, which is not there"
        );
    }
    Ok(())
}

/// How wrong what counts as right may be, in each panel, is far less than what it is to judge.
#[test]
fn the_truth_is_finer_than_what_it_judges() -> Tested {
    for rows in [cable()?, whole()?] {
        for panel in panels(&rows) {
            let truth: Vec<&Row> = of(&rows, panel, "truth").collect();
            assert_eq!(truth.len(), 1, "{panel}");
            // The long term is judged at 0.5 % and more, all else at 0.1 % too.
            let most = if panel.ends_with("5000 passes") {
                3e-4
            } else {
                2e-4
            };
            assert!(truth[0].error <= most, "{panel}: {truth:?}");
        }
    }
    // The mesh of a run stands in its row; every duct of this chart is 1.2 m deep.
    let mut reader = table::read(&folder().join("whole.csv"))?;
    let mut density = 0.0;
    for record in reader.records() {
        let record = record?;
        if &record[1] == "truth" {
            density = record[2].parse()?;
        } else if &record[1] == RUN {
            let spacing = record[7]
                .split(" at ")
                .nth(1)
                .and_then(|rest| rest.split(' ').next());
            let spacing: f64 = spacing.ok_or("no mesh")?.parse()?;
            assert!(density * spacing >= 2.0 * 1.2 - 1e-9, "{record:?}");
        }
    }
    // A method of another kind, on meshes of its own, comes to the same.
    let rows = cable()?;
    let finest = of(&rows, "30, 10", "explicit").find(|row| row.knob == 24.0);
    assert!(finest.is_some_and(|row| row.error <= 3e-4), "{finest:?}");
    Ok(())
}

#[test]
fn on_layers_burmister_is_cheaper_and_more_accurate_than_elements() -> Tested {
    let rows = ground()?;
    for panel in panels(&rows)
        .into_iter()
        .filter(|panel| !panel.starts_with("homogeneous"))
    {
        for (share, times) in [(1e-2, 20.0), (1e-3, 50.0), (1e-4, 100.0)] {
            let (transform, elements) = (
                seconds(&rows, panel, "burmister", share),
                seconds(&rows, panel, "fem", share),
            );
            assert!(
                times * transform < elements,
                "{panel}, {share}: {transform} s, {elements} s"
            );
        }
    }
    Ok(())
}

/// The planner keeps its tolerance, and nothing of the chain of elements and explicit steps is both cheaper and more accurate than
/// one of its choices.
#[test]
fn the_planner_keeps_its_word_and_is_never_beaten_by_the_papers_chain() -> Tested {
    let rows = whole()?;
    for panel in panels(&rows) {
        let rivals: Vec<&Row> = of(&rows, panel, CHAIN).collect();
        for choice in of(&rows, panel, RUN) {
            assert!(choice.error <= choice.knob, "{choice:?}");
            // A third of the tolerance that the page advises.
            assert!(choice.knob != 1e-2 || choice.error <= 1e-2 / 3.0, "{choice:?}");
            for rival in rivals.iter().filter(|rival| rival.error < choice.error) {
                assert!(rival.seconds >= choice.seconds, "{rival:?} beats {choice:?}");
                assert!(rival.count >= choice.count, "{rival:?} beats {choice:?}");
            }
        }
    }
    Ok(())
}

/// Where the chain gets below 1 % and 0.1 % at all, the planner is there in a fortieth and a fourteenth of the time; to be sure of it
/// takes it a tenth of the time, and nearly all of it.
#[test]
fn one_percent_and_a_tenth_of_it_cost_the_planner_a_small_part_of_the_chain() -> Tested {
    let rows = whole()?;
    let mut compared = 0;
    for panel in panels(&rows) {
        for (error, times, sure) in [(1e-2, 40.0, 10.0), (1e-3, 14.0, 1.1)] {
            let chain = seconds(&rows, panel, CHAIN, error);
            if chain.is_finite() {
                let planner = seconds(&rows, panel, RUN, error);
                assert!(
                    times * planner <= chain,
                    "{panel}, {error}: {planner} s, {chain} s"
                );
                let asked = of(&rows, panel, RUN).find(|row| row.knob == error);
                assert!(
                    asked.is_some_and(|row| sure * row.seconds <= chain),
                    "{panel}, {error}: {asked:?}, {chain} s"
                );
                compared += 1;
            }
        }
    }
    assert!(compared >= 5, "{compared} comparisons");
    Ok(())
}

#[test]
fn few_passes_go_quasi_statically_and_many_with_jumps() -> Tested {
    let rows = cable()?;
    let time = |panel, method, error| seconds(&rows, panel, method, error);
    for panel in ["30, 10", "30, 100", "300, 10"] {
        for error in [1e-2, 1e-3] {
            let (best, other) = (time(panel, "quasi-static", error), time(panel, "explicit", error));
            assert!(best <= other, "{panel}, {error}: {best} s, {other} s");
        }
    }
    for (panel, error, times) in [
        ("30, 1000", 1e-3, 8.0),
        ("300, 1000", 1e-2, 4.0),
        ("300, 1000", 1e-3, 8.0),
    ] {
        let (jumps, one_by_one) = (time(panel, JUMPS, error), time(panel, "quasi-static", error));
        assert!(
            one_by_one.is_finite() && times * jumps <= one_by_one,
            "{panel}, {error}: {jumps} s, {one_by_one} s"
        );
    }
    for panel in panels(&rows) {
        for row in of(&rows, panel, "quasi-static") {
            assert!(row.knob < 8.0 || row.error <= 1e-2, "{row:?}");
            assert!(row.knob < 12.0 || row.error <= 1e-3, "{row:?}");
        }
    }
    Ok(())
}

/// On the same mesh, jumps change the error by a small part of 0.1 %.
#[test]
fn jumps_leave_the_error_of_the_mesh() -> Tested {
    let rows = cable()?;
    let mut compared = 0;
    for panel in panels(&rows) {
        for jumps in of(&rows, panel, JUMPS) {
            if let Some(every) = of(&rows, panel, "quasi-static").find(|row| row.knob == jumps.knob) {
                assert!((jumps.error - every.error).abs() <= 3e-4, "{jumps:?} {every:?}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 20, "{compared} comparisons");
    Ok(())
}

/// However large its b, it has lost most of the force.
#[test]
fn the_sigmoid_law_does_not_converge() -> Tested {
    let rows = cable()?;
    let sigmoid: Vec<&Row> = rows.iter().filter(|row| row.method == SIGMOID).collect();
    assert!(sigmoid.iter().any(|row| row.knob >= 1e10));
    assert!(sigmoid.iter().all(|row| row.error > 0.7), "{sigmoid:?}");
    Ok(())
}
