//! Random mixes: jumps and whatever the plan chooses against every pass.

use creepage::Error;
use creepage::scene::{Order, SolverMethod};
use rayon::prelude::*;

use super::scenes::{Difference, by, difference, random};

/// Share of the mixes in which every force and movement is within the stated error, which holds that of a coarse mesh too, and nine in
/// ten within the tolerance; and how far beyond the stated error none is.
const WITHIN: f64 = 0.97;
const NEVER: f64 = 2.0;
const TOLERANCE: f64 = 0.01;
const NEAR: f64 = 0.9;

/// One run of a mix beside that of every pass.
struct Judged {
    seed: u64,
    method: &'static str,
    /// The largest error, and the largest as a share of what is stated.
    off: f64,
    beyond: f64,
    line: String,
}

fn judge(seed: u64) -> Vec<Judged> {
    let mut scene = random(seed);
    scene.traffic.passes = scene.traffic.passes.min(1000);
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

/// Where every pass is simulated after all there is nothing to judge.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn mixes_agree_with_every_pass() {
    let seeds = 2..13_u64;
    let count = seeds.end - seeds.start;
    let judged: Vec<Judged> = seeds.into_par_iter().flat_map(judge).collect();
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
    let share = |bad: &[(u64, &str)]| bad.len() as f64 / judged.len() as f64;
    assert!(share(&beyond) <= 1.0 - WITHIN, "{beyond:?}");
    assert!(share(&off) <= 1.0 - NEAR, "{off:?}");
    let far = worse(&|one| one.beyond > NEVER);
    assert!(far.is_empty(), "{far:?}");
}
