//! Random scenes over a wide range of every key: what comes of each, and whether it can be true.
//!
//! The first number says how many scenes, the file takes a row of each; `scene 13` prints one of them. One in twenty is computed
//! again, on far finer terms and seen in a mirror, and the forces must agree within the stated error. A third number is that of the
//! first scene, for work in parts.

mod again;
pub mod judged;
pub mod scenes;

use std::fmt::Write;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{available_parallelism, scope};
use std::time::Instant;

use again::{Again, again};
use judged::{Outcome, judged};

use crate::Failure;

/// One scene in so many is computed again.
const AGAIN: u64 = 20;

#[derive(Clone)]
struct Row {
    number: u64,
    outcome: Outcome,
    stated: Option<f64>,
    again: Again,
    seconds: f64,
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
    let mut table = "scene,outcome,stated,finer,mirror,seconds,words\n".to_owned();
    for row in &rows {
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.3e}"));
        let words = match &row.outcome {
            Outcome::Right => String::new(),
            Outcome::Long(seconds) => format!("{seconds:.0} s planned"),
            Outcome::Wrong(words)
            | Outcome::Input(words)
            | Outcome::Refused(words)
            | Outcome::Late(words) => words.lines().next().unwrap_or_default().replace('"', "'"),
        };
        let [stated, finer, mirror] = [row.stated, row.again.finer, row.again.mirror].map(number);
        writeln!(
            table,
            "{},{},{stated},{finer},{mirror},{:.2},\"{words}\"",
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
    let told = |words: &str, off: fn(&Again) -> Option<f64>| {
        let pairs = || {
            rows.iter()
                .filter_map(|row| Some((off(&row.again)?, row.stated?)))
        };
        let farther = pairs().filter(|(off, stated)| off > stated).count();
        println!(
            "{farther} of {} are farther from {words} than they state",
            pairs().count()
        );
    };
    told("a finer run", |again| again.finer);
    told("their mirror image", |again| again.mirror);
    Ok(())
}

/// A row of each scene: on every core one at a time, so that none waits for another.
fn rows(numbers: std::ops::Range<u64>) -> Result<Vec<Row>, Failure> {
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
    let again = if is_answer && number.is_multiple_of(AGAIN) {
        again(&text).unwrap_or_default()
    } else {
        Again::default()
    };
    Row {
        number,
        outcome,
        stated,
        again,
        seconds,
    }
}
