//! Random scenes over a wide range of every key: what comes of each, and whether it can be true.
//!
//! The first number says how many scenes, the file takes a row of each; `scene 13` prints one of them. One in fourteen is computed
//! again, on far finer terms, seen in a mirror and at four times its size, and forces and movements must agree within the stated error. A
//! third number is that of the first scene, for work in parts.

pub mod differences;
pub mod judged;
pub mod scenes;
pub mod twins;

use std::ops::RangeInclusive;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{available_parallelism, scope};
use std::time::Instant;

use creepage::Scene;
use differences::{AFTER, Errors, KINDS, MOVEMENT};
use judged::{Outcome, judged};
use twins::{Twins, twins};

use crate::{Failure, largest};

/// One scene in so many is computed again.
const TWINS: u64 = 14;

struct Row {
    number: u64,
    outcome: Outcome,
    stated: Option<f64>,
    twins: Option<Twins>,
    seconds: f64,
}

impl Row {
    /// Its line of the table.
    fn line(&self) -> String {
        let words = match &self.outcome {
            Outcome::Right => String::new(),
            Outcome::Long(seconds) => format!("{seconds:.0} s planned"),
            Outcome::Wrong(words)
            | Outcome::Input(words)
            | Outcome::Refused(words)
            | Outcome::Late(words) => words.lines().next().unwrap_or_default().replace('"', "'"),
        };
        let twins = self.twins.as_ref();
        let mut errors = vec![self.stated, twins.map(|twins| twins.stated[MOVEMENT])];
        let finer = twins.and_then(|twins| twins.finer);
        errors.extend((0..KINDS.len()).map(|kind| finer.map(|(finer, _)| finer[kind])));
        errors.extend([AFTER, MOVEMENT].map(|kind| finer.map(|(_, stated)| stated[kind])));
        for twin in [
            twins.and_then(|twins| twins.mirror),
            twins.and_then(|twins| twins.larger),
        ] {
            errors.push(twin.map(|errors| largest(errors[..MOVEMENT].iter().copied())));
            errors.push(twin.map(|errors| errors[MOVEMENT]));
        }
        let shown = |error: Option<f64>| error.map_or(String::new(), |error| format!("{error:.3e}"));
        let errors: Vec<String> = errors.into_iter().map(shown).collect();
        let (number, name, errors) = (self.number, self.outcome.name(), errors.join(","));
        format!("{number},{name},{errors},{:.2},\"{words}\"\n", self.seconds)
    }
}

pub fn run(arguments: &[String]) -> Result<(), Failure> {
    let [count, file, first @ ..] = arguments else {
        return Err("two arguments: how many scenes, and the file for their rows".into());
    };
    if count == "scene" {
        print!("{}", scenes::scene(file.parse()?));
        return Ok(());
    }
    let first: u64 = first.first().map_or(Ok(0), |first| first.parse())?;
    let numbers = first..first + count.parse::<u64>()?;
    let rows = rows(numbers)?;
    let lines: String = rows.iter().map(Row::line).collect();
    crate::table::write(Path::new(file), &(header() + &lines))?;
    for name in ["right", "wrong", "input", "refused", "late", "long"] {
        let count = rows.iter().filter(|row| row.outcome.name() == name).count();
        println!("{name:>8} {count:>6}");
    }
    for (kind, name) in KINDS.iter().enumerate() {
        let other = format!("a finer run: {name}");
        compare(&rows, &other, kind..=kind, |twins| Some(twins.finer?.0));
    }
    compare(&rows, "their mirror image", 0..=MOVEMENT, |twins| twins.mirror);
    compare(&rows, "the same at four times the size", 0..=MOVEMENT, |twins| {
        twins.larger
    });
    Ok(())
}

fn header() -> String {
    format!(
        "scene,outcome,stated,stated_movement,{},finer_stated,finer_stated_movement,mirror,mirror_movement,larger,larger_movement,seconds,words\n",
        KINDS.join(",")
    )
}

/// Says how many answers are farther from another run than they state.
fn compare(rows: &[Row], other: &str, kinds: RangeInclusive<usize>, errors: fn(&Twins) -> Option<Errors>) {
    let pairs = || {
        let twins = rows.iter().filter_map(|row| row.twins.as_ref());
        twins.filter_map(|twins| Some((errors(twins)?, twins.stated)))
    };
    let is_farther =
        |(found, stated): &(Errors, Errors)| kinds.clone().any(|kind| found[kind] > stated[kind]);
    let farther = pairs().filter(is_farther).count();
    println!(
        "{farther} of {} are farther from {other} than they state",
        pairs().count()
    );
}

/// A row of each scene: on every core one at a time, so that none waits for another.
fn rows(numbers: std::ops::Range<u64>) -> Result<Vec<Row>, Failure> {
    let next = AtomicU64::new(numbers.start);
    let next = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|number| *number < numbers.end);
    let own = || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
        let judged = |number| {
            eprintln!("scene {number} begins");
            let row = row(number);
            eprintln!("scene {number}: {}, {:.1} s", row.outcome.name(), row.seconds);
            row
        };
        Ok(pool.install(|| std::iter::from_fn(next).map(judged).collect()))
    };
    let cores = available_parallelism()?.get();
    let rows = scope(|threads| {
        let threads: Vec<_> = (0..cores).map(|_| threads.spawn(own)).collect();
        let joined = threads
            .into_iter()
            .map(|thread| thread.join().expect("every panic of a scene is caught"));
        joined.collect::<Result<Vec<Vec<Row>>, rayon::ThreadPoolBuildError>>()
    })?;
    let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
    rows.sort_by_key(|row| row.number);
    Ok(rows)
}

fn row(number: u64) -> Row {
    let text = scenes::scene(number);
    let begun = Instant::now();
    let (mut outcome, run) = judged(&text);
    let seconds = begun.elapsed().as_secs_f64();
    let has_twins = outcome == Outcome::Right && number.is_multiple_of(TWINS);
    let scene = Scene::from_toml("scene.toml", &text).ok().filter(|_| has_twins);
    let twins = scene.zip(run.as_ref()).and_then(|(scene, run)| {
        let twins = catch_unwind(AssertUnwindSafe(|| twins(&scene, run)));
        twins
            .map_err(|_| outcome = Outcome::Wrong("panic of a twin".to_owned()))
            .ok()
    });
    Row {
        number,
        outcome,
        stated: run.map(|run| run.error_estimate.relative),
        twins,
        seconds,
    }
}
