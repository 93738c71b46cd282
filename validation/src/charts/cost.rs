//! Chart 5: what an answer costs as the work grows: passes, length of the duct, tolerance, kinds of vehicles, layers of the ground, threads.
//!
//! Every point is a run of the upper cable of the full-scale experiment with a few keys changed, as `creepage run` carries it out: plan, coarser
//! meshes, jumps and the estimate of the error among it. One thread, but where threads are what varies. The exponent of a panel is the
//! slope of a straight line through all of its points in the logarithms.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use creepage::figure::{Axis, Chart, Panels, Series};
use creepage::{Run, Scene};
use rayon::prelude::*;

use crate::stopwatch::timed;
use crate::{Failure, upper};

type Work<'a> = &'a (dyn Fn() -> Result<(), creepage::Error> + Sync);

/// Second vehicle of a road with traffic in both directions.
const BACK: &str = "vehicles=[{ name = \"there\", load = \"20 tf\", speed = \"40 km/h\", share = 0.6 }, \
    { name = \"back\", load = \"12 tf\", speed = \"40 km/h\", share = 0.4, direction = \"reverse\" }]";
/// Scenes that are run at once where threads are counted.
const AT_ONCE: usize = 16;

struct Panel {
    name: &'static str,
    label: &'static str,
    series: &'static [Line],
    work: &'static [f64],
}

/// One curve: a name, and what is set for an amount of work.
struct Line {
    name: &'static str,
    set: fn(f64) -> Vec<String>,
}

const PANELS: [Panel; 5] = [
    Panel {
        name: "passes",
        label: "passes over 100 m",
        series: &[
            Line {
                name: "one way",
                set: |passes| owned(&["duct.length=100 m"], &format!("traffic.passes={passes}")),
            },
            Line {
                name: "two ways",
                set: |passes| owned(&["duct.length=100 m", BACK], &format!("traffic.passes={passes}")),
            },
        ],
        work: &[1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8],
    },
    Panel {
        name: "length",
        label: "length of the duct, m",
        series: &[
            Line {
                name: "10 passes",
                set: |length| owned(&["traffic.passes=10"], &format!("duct.length={length}")),
            },
            Line {
                name: "1e6 passes",
                set: |length| owned(&["traffic.passes=1000000"], &format!("duct.length={length}")),
            },
        ],
        work: &[10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0],
    },
    Panel {
        name: "tolerance",
        label: "1/tolerance",
        series: &[Line {
            name: "200 passes of 30 m",
            set: |inverse| owned(&[], &format!("solver.tolerance={}", 1.0 / inverse)),
        }],
        work: &[20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0],
    },
    Panel {
        name: "vehicles",
        label: "kinds of vehicles",
        series: &[Line {
            name: "1000 passes of 30 m",
            set: |kinds| owned(&["traffic.passes=1000"], &vehicles(kinds as usize)),
        }],
        work: &[1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0],
    },
    Panel {
        name: "layers",
        label: "layers of the ground",
        series: &[Line {
            name: "10 passes of 30 m",
            set: |layers| owned(&["traffic.passes=10"], &ground(layers as usize)),
        }],
        work: &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0],
    },
];

struct Point {
    panel: &'static str,
    series: &'static str,
    work: f64,
    seconds: f64,
    /// Nodes eliminated on all meshes, and passes simulated on that of the answer; not counted where several runs are one point.
    counts: Option<(u64, u64)>,
    error: Option<f64>,
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut points = Vec::new();
    let one = pool(1)?;
    for panel in &PANELS {
        for line in panel.series {
            for &work in panel.work {
                let scene = upper(&(line.set)(work))?;
                let (run, seconds) = timed(|| one.install(|| creepage::run(&scene)))?;
                println!("{}, {}, {work}: {seconds:.3} s", panel.name, line.name);
                points.push(Point::of(panel.name, line.name, (work, seconds), &run));
            }
        }
    }
    threads(&mut points)?;
    crate::table::write(&out.join("cost.csv"), &table(&points))?;
    std::fs::write(out.join("cost.svg"), figure(&points).to_svg()?)?;
    Ok(())
}

pub fn pool(threads: usize) -> Result<rayon::ThreadPool, Failure> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?)
}

fn owned(fixed: &[&str], varied: &str) -> Vec<String> {
    fixed
        .iter()
        .chain([&varied])
        .map(|&text| text.to_owned())
        .collect()
}

/// Vehicles of 5 to 20 tf in equal shares.
fn vehicles(kinds: usize) -> String {
    let each = (0..kinds).map(|kind| {
        let load = 20.0 - 15.0 * kind as f64 / kinds as f64;
        format!("{{ name = \"kind {kind}\", load = \"{load} tf\", speed = \"40 km/h\", share = 1 }}")
    });
    format!("vehicles=[{}]", each.collect::<Vec<_>>().join(", "))
}

/// Layers over 2 m whose modulus falls from 4000 to 800 MPa, on a half-space.
fn ground(layers: usize) -> String {
    let upper = layers - 1;
    let layer = |at: usize| {
        let share = at as f64 / upper.max(1) as f64;
        let thickness = if at < upper {
            format!("thickness = {}, ", 2.0 / upper as f64)
        } else {
            String::new()
        };
        let modulus = 4000.0 * 0.2_f64.powf(share);
        let modulus = if upper == 0 { 800.0 } else { modulus };
        format!("{{ {thickness}young_modulus = \"{modulus} MPa\", poisson_ratio = 0.4 }}")
    };
    format!(
        "ground.layers=[{}]",
        (0..layers).map(layer).collect::<Vec<_>>().join(", ")
    )
}

/// Time on the wall of one run that is refined far, and of many runs.
fn threads(points: &mut Vec<Point>) -> Result<(), Failure> {
    let fine = upper(&owned(&[], "solver.tolerance=0.002"))?;
    let many: Vec<Scene> = (0..AT_ONCE)
        .map(|k| {
            upper(&owned(
                &[],
                &format!("friction.dynamic_coefficient={}", 0.2 + 0.01 * k as f64),
            ))
        })
        .collect::<Result<_, _>>()?;
    let works: [(&str, Work<'_>); 2] = [
        ("one run at 0.2 %", &|| creepage::run(&fine).map(drop)),
        ("16 runs at once", &|| {
            many.par_iter()
                .try_for_each(|scene| creepage::run(scene).map(drop))
        }),
    ];
    for (name, work) in works {
        for threads in [1, 2] {
            let pool = pool(threads)?;
            let mut seconds = f64::INFINITY;
            for _ in 0..3 {
                let begun = Instant::now();
                pool.install(work)?;
                seconds = seconds.min(begun.elapsed().as_secs_f64());
            }
            println!("threads, {name}, {threads}: {seconds:.3} s on the wall");
            points.push(Point {
                panel: "threads",
                series: name,
                work: threads as f64,
                seconds,
                counts: None,
                error: None,
            });
        }
    }
    Ok(())
}

impl Point {
    fn of(panel: &'static str, series: &'static str, (work, seconds): (f64, f64), run: &Run) -> Self {
        Self {
            panel,
            series,
            work,
            seconds,
            counts: Some((run.cost.node_updates, run.cost.simulated_passes)),
            error: Some(run.error_estimate.relative),
        }
    }
}

/// Slope of the straight line through the points' logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logarithms: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logarithms.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logarithms.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let above: f64 = logarithms.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let below: f64 = logarithms.iter().map(|p| (p.0 - x).powi(2)).sum();
    above / below
}

fn table(points: &[Point]) -> String {
    let mut table = String::from("panel,series,work,seconds,node_updates,simulated_passes,error_stated\n");
    for point in points {
        let (updates, passes) = point.counts.map_or_else(Default::default, |(updates, passes)| {
            (updates.to_string(), passes.to_string())
        });
        let error = point
            .error
            .map(|error| format!("{error:.3e}"))
            .unwrap_or_default();
        let Point {
            panel,
            series,
            work,
            seconds,
            ..
        } = point;
        let _ = writeln!(
            table,
            "{panel},{series},{work},{seconds:.4e},{updates},{passes},{error}"
        );
    }
    table
}

fn figure(points: &[Point]) -> Panels {
    let labels = PANELS.iter().map(|panel| (panel.name, panel.label));
    let mut panels =
        Panels::new("Processor time of a run against its work; threads: time on the wall").columns(2);
    for (name, label) in labels.chain([("threads", "threads")]) {
        let mut chart = Chart::new(name, Axis::logarithmic(label), Axis::logarithmic("time, s"));
        let mut series: Vec<&str> = points
            .iter()
            .filter(|p| p.panel == name)
            .map(|p| p.series)
            .collect();
        series.dedup();
        for (look, series) in series.into_iter().enumerate() {
            let line: Vec<(f64, f64)> = points
                .iter()
                .filter(|point| point.panel == name && point.series == series)
                .map(|point| (point.work, point.seconds))
                .collect();
            let name = format!("{series}: exponent {:.2}", exponent(&line));
            chart = chart.with(Series::line_points(name, line).look(look));
        }
        panels = panels.with(chart);
    }
    panels
}
