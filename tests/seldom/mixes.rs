//! Random mixes: jumps and whatever the plan chooses against every pass.

use std::time::{Duration, Instant};

use creepage::Error;
use creepage::scene::{Order, SolverMethod};
use rayon::prelude::*;

use super::scenes::{Difference, by, difference, random};
use crate::scenes::by_threads;

/// Share of the mixes in which every force and movement is within the stated error, which holds that of a coarse mesh too, and nine in
/// ten within the tolerance; and how far beyond the stated error none is.
const WITHIN: f64 = 0.97;
const NEVER: f64 = 2.0;
const TOLERANCE: f64 = 0.01;
const NEAR: f64 = 0.9;
/// A run with a million passes takes at most this long, in so many of the mixes.
const LONGEST: Duration = Duration::from_secs(20);
const QUICK: f64 = 0.95;

/// One run of a mix compared with that of every pass.
struct Judged {
    seed: u64,
    method: &'static str,
    /// The largest error, and the largest as a share of what is stated.
    off: f64,
    beyond: f64,
    line: String,
}

fn judge(seed: u64, most: u64) -> Vec<Judged> {
    let mut scene = random(seed, None);
    scene.traffic.passes = scene.traffic.passes.min(most);
    let every = match by(&scene, SolverMethod::QuasiStatic) {
        // The mesh of the test is too coarse.
        Err(Error::Inaccurate { .. }) => return Vec::new(),
        every => every.unwrap_or_else(|error| panic!("mix {seed}: {error}")),
    };
    let method = creepage::plan(&scene).expect("a plan").report().cable;
    let mut methods = Vec::new();
    if method == "pass-law" {
        methods.push((SolverMethod::Auto, "chosen"));
    } else {
        assert_eq!(method, "quasi-static", "mix {seed}");
    }
    // In random order jumps show means.
    if !matches!(scene.order(), Order::Random { .. }) {
        methods.push((SolverMethod::PassLaw, "jumps"));
    }
    let of_method = |&(method, name): &(SolverMethod, &'static str)| {
        let found = match by(&scene, method) {
            Err(Error::Inaccurate { .. }) => return None,
            found => found.unwrap_or_else(|error| panic!("mix {seed}, {name}: {error}")),
        };
        if found.cost.simulated_passes >= scene.traffic.passes {
            return None;
        }
        let Difference {
            force,
            extreme,
            movement,
        } = difference(&scene, &every, &found);
        let (stated, moved) = (found.error_estimate.relative, found.error_estimate.parts.movement);
        Some(Judged {
            seed,
            method: name,
            off: force.max(extreme).max(movement),
            beyond: (force.max(extreme) / stated).max(movement / moved),
            line: {
                let (simulated, passes) = (found.cost.simulated_passes, scene.traffic.passes);
                let percent = [force, extreme, movement].map(|share| 100.0 * share);
                format!("{seed} {name}: {simulated} of {passes}; force, largest, movement: {percent:.2?} %")
            },
        })
    };
    methods.iter().filter_map(of_method).collect()
}

/// Judges the jumps of these mixes with at most so many passes; where every pass is simulated after all there is nothing to judge.
fn assert_right(seeds: std::ops::Range<u64>, most: u64) {
    let count = seeds.end - seeds.start;
    let judged = seeds.into_par_iter().flat_map(|seed| judge(seed, most));
    let judged: Vec<Judged> = judged.collect();
    for one in &judged {
        println!("{}", one.line);
    }
    let jumped = judged.len() as u64;
    assert!(2 * jumped > count, "{jumped} of {count} mixes have jumps");
    let worse = |is_bad: &dyn Fn(&Judged) -> bool| -> Vec<(u64, &str)> {
        let bad = judged.iter().filter(|one| is_bad(one));
        bad.map(|one| (one.seed, one.method)).collect()
    };
    let beyond = worse(&|one| one.beyond > 1.0);
    let off = worse(&|one| one.off > TOLERANCE);
    println!("{jumped} judged; beyond what is stated: {beyond:?}, beyond 1 %: {off:?}");
    for (seed, _) in &beyond {
        println!("{}", random(*seed, None).to_toml());
    }
    let share = |bad: &[(u64, &str)]| bad.len() as f64 / judged.len() as f64;
    assert!(share(&beyond) <= 1.0 - WITHIN, "{beyond:?}");
    assert!(share(&off) <= 1.0 - NEAR, "{off:?}");
    let far = worse(&|one| one.beyond > NEVER);
    assert!(far.is_empty(), "{far:?}");
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn mixes_agree_with_every_pass() {
    assert_right(2..13, 1000);
}

#[test]
#[ignore = "150 random mixes, every pass simulated: ten minutes; FIRST and MIXES choose others"]
fn many_mixes_are_those_of_every_pass() {
    let first = chosen("FIRST", 0);
    assert_right(first..first + chosen("MIXES", 150), u64::MAX);
}

/// A number that whoever runs the tests chooses.
fn chosen(name: &str, usual: u64) -> u64 {
    let text = std::env::var(name).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// Nearly every mix with a million passes is answered in seconds of one core; the others take longer, or are refused for what is no answer.
#[test]
#[ignore = "150 random mixes with a million passes: half an hour; FIRST and MIXES choose them; on a quiet machine"]
fn a_million_passes_of_a_mix_take_seconds() {
    let (first, count) = (chosen("FIRST", 0), chosen("MIXES", 150));
    let (mut slow, mut refused) = (Vec::new(), Vec::new());
    for seed in first..first + count {
        let scene = random(seed, Some(1_000_000));
        let begun = Instant::now();
        let run = by_threads(1, || creepage::run(&scene));
        let took = begun.elapsed();
        match run {
            Ok(run) => {
                let (simulated, stated) = (run.cost.simulated_passes, run.error_estimate.relative);
                println!("{seed}: {took:.1?}, {simulated} passes simulated, stated {stated:.4}");
            }
            Err(error @ (Error::Inaccurate { .. } | Error::Jumps(_))) => {
                println!("{seed}: {took:.1?}, {error}");
                refused.push(seed);
                continue;
            }
            Err(error) => panic!("mix {seed}: {error}"),
        }
        if took > LONGEST {
            slow.push(seed);
        }
    }
    let not_quick = (slow.len() + refused.len()) as f64;
    let most = (1.0 - QUICK) * count as f64;
    assert!(not_quick <= most, "slow: {slow:?}, refused: {refused:?}");
}

/// The largest single passes come early, where every mix begins with the traffic's own vehicles; later rows are means over a mix. Compared
/// with each other alone, two mixes were 166 % apart.
#[test]
fn the_largest_pass_may_come_before_the_mix() {
    let mut scene = random(100, Some(4000));
    (scene.solver.method, scene.solver.tolerance) = (SolverMethod::PassLaw, 0.05);
    let run = creepage::run(&scene).expect("an answer");
    assert!(run.cost.simulated_passes < 1000, "{:?}", run.cost);
    let passes = run.error_estimate.parts.passes;
    // Most of it is how far means over stretches of the mix scatter.
    assert!(passes < 0.1, "{passes}");
}
