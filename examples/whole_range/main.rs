//! Random scenes over the whole allowed range of every key: what comes of each, and whether it can be true.
//!
//! ```sh
//! cargo run --release --example whole_range -- 10000 docs/charts/whole-range.csv
//! ```
//!
//! The first number says how many scenes, the file takes a row of each; `scene 13` prints one of them. One in twenty is computed again on far finer terms, and the forces
//! of both must agree within the stated error.

mod judged;
mod scenes;

use std::fmt::Write;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{available_parallelism, scope};
use std::time::Instant;

use creepage::{PassRecord, Scene};
use judged::{Outcome, judged};

/// One scene in so many is computed again with a smaller tolerance, and by what factor that is smaller.
const AGAIN: u64 = 20;
const FINER: f64 = 4.0;
/// What friction holds on this length of cable counts as nothing \[m\].
const SHORT: f64 = 0.01;

#[derive(Clone)]
struct Row {
    number: u64,
    outcome: Outcome,
    stated: Option<f64>,
    /// How far the forces lie from those of a finer run, as a share of these.
    off: Option<f64>,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [count, file, first @ ..] = &arguments[..] else {
        return Err("two arguments: how many scenes, and the file for their rows".into());
    };
    if count == "scene" {
        print!("{}", scenes::scene(file.parse()?));
        return Ok(());
    }
    let first: u64 = first.first().map_or(Ok(0), |first| first.parse())?;
    let numbers = first..first + count.parse::<u64>()?;
    let rows = rows(numbers)?;
    let mut table = "scene,outcome,stated,off,seconds,words\n".to_owned();
    for row in &rows {
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.3e}"));
        let words = match &row.outcome {
            Outcome::Right => String::new(),
            Outcome::Long(seconds) => format!("{seconds:.0} s foreseen"),
            Outcome::Wrong(words)
            | Outcome::Input(words)
            | Outcome::Refused(words)
            | Outcome::Late(words) => words.lines().next().unwrap_or_default().replace('"', "'"),
        };
        let (stated, off) = (number(row.stated), number(row.off));
        writeln!(
            table,
            "{},{},{stated},{off},{:.2},\"{words}\"",
            row.number,
            row.outcome.name(),
            row.seconds
        )?;
    }
    std::fs::write(file, table)?;
    for name in ["right", "wrong", "input", "refused", "late", "long"] {
        let count = rows.iter().filter(|row| row.outcome.name() == name).count();
        println!("{name:>8} {count:>6}");
    }
    let again = || rows.iter().filter_map(|row| Some((row.off?, row.stated?)));
    let understated = again().filter(|(off, stated)| off > stated).count();
    println!("{understated} of {} understate their error", again().count());
    Ok(())
}

/// A row of each scene: on every core one at a time, so that none waits for another.
fn rows(numbers: std::ops::Range<u64>) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let next = AtomicU64::new(numbers.start);
    let next = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|number| *number < numbers.end);
    let own = || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
        let told = |number| {
            eprintln!("scene {number} begins");
            let row = row(number);
            eprintln!("scene {number}: {}, {:.1} s", row.outcome.name(), row.seconds);
            row
        };
        Ok(pool.install(|| std::iter::from_fn(next).map(told).collect()))
    };
    let cores = available_parallelism()?.get();
    let mut rows = scope(|threads| {
        let threads: Vec<_> = (0..cores).map(|_| threads.spawn(own)).collect();
        let joined = threads
            .into_iter()
            .map(|thread| thread.join().expect("every panic of a scene is caught"));
        joined.collect::<Result<Vec<Vec<Row>>, rayon::ThreadPoolBuildError>>()
    })?
    .concat();
    rows.sort_by_key(|row| row.number);
    Ok(rows)
}

fn row(number: u64) -> Row {
    let text = scenes::scene(number);
    let begun = Instant::now();
    let (outcome, stated) = judged(&text);
    let seconds = begun.elapsed().as_secs_f64();
    let is_answer = matches!(outcome, Outcome::Right | Outcome::Late(_)) && stated.is_some();
    let off = if is_answer && number.is_multiple_of(AGAIN) {
        again(&text)
    } else {
        None
    };
    Row {
        number,
        outcome,
        stated,
        off,
        seconds,
    }
}

/// How far the forces lie from those of a run that is to be [`FINER`] times as exact, by the measure of the stated error: those on the ends and
/// the largest in the cable, beside the largest of their pass or a tenth of the largest of all; with heat those on the ends, beside the largest of
/// all. `None` where that run gives no answer in time.
fn again(text: &str) -> Option<f64> {
    let scene = Scene::from_toml("scene.toml", text).ok()?;
    let own = judged::run(&scene).ok()?;
    let mut finer = scene;
    finer.solver.tolerance = own.error_estimate.relative.max(1e-3) / FINER;
    let heated = finer.heat.is_some();
    let nothing = SHORT * finer.friction_limit();
    let finer = judged::run(&finer).ok()?;
    let forces = |pass: &PassRecord| {
        let inside = if heated { 0.0 } else { pass.max_compression_n };
        [pass.upstream_force_n, pass.downstream_force_n, inside]
    };
    let largest = |pass: &PassRecord| {
        let peaks = [pass.upstream_peak_n, pass.downstream_peak_n];
        let all = forces(pass).into_iter().chain(peaks);
        all.fold(nothing, |most, force| most.max(force.abs()))
    };
    let most = finer.passes.iter().map(largest).fold(nothing, f64::max);
    let least = if heated { most } else { 0.1 * most };
    let of_pass = |(own, finer): (&PassRecord, &PassRecord)| {
        let pairs = forces(own).into_iter().zip(forces(finer));
        let apart = pairs.fold(0.0_f64, |most, (own, finer)| most.max((own - finer).abs()));
        apart / largest(finer).max(least).max(f64::MIN_POSITIVE)
    };
    let passes = own.passes.iter().zip(&finer.passes);
    Some(passes.map(of_pass).fold(0.0, f64::max))
}
