//! Series as faulty cells and wrong settings make them: no parameter is called identifiable where its interval misses the truth, and the
//! fault is told.
//!
//! Readings are those of a run on a mesh twice as fine, 40 passes up to 480 N with Gaussian noise of 4 N. A drift of 0.8 N a pass makes the
//! fitted friction 0.3 to 0.5 where 0.25 is true, one of -1.2 N a pass 0.2, ground of 0.8 times the stiffness 0.33; outliers and a zero that is off by
//! 20 N widen the interval more than they move it.

use std::fmt::Write;
use std::sync::OnceLock;

use creepage::readings::ReadOptions;
use creepage::scene::Law;
use creepage::{CalibrateOptions, Calibrated, Readings, Scene};
use rayon::prelude::*;

const FRICTION: f64 = 0.25;
const SHAPE_FACTOR: f64 = 2e6;
const NOISE: f64 = 4.0;
const PASSES: usize = 40;

/// What is wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// The zero is off \[N\].
    ZeroOffset(f64),
    /// The cell drifts \[N a pass\].
    Drift(f64),
    /// Of so many readings each is off by this share, up and down by turns.
    Outliers(usize, f64),
    /// The file holds kN where its header says N.
    Unit,
    Sign,
    /// A second run went on from the first, and the file does not say so.
    TwoRuns,
    /// The true ground is this many times as stiff as the scene's.
    Ground(f64),
}

/// The scene with the ground so many times as stiff.
fn scene(stiffness: f64) -> Scene {
    let modulus = format!("ground.layers.0.young_modulus={} MPa", 800.0 * stiffness);
    let mut scene = crate::scenes::upper(&[&modulus]);
    // Coarse, for the mesh is not what is tried: what the next one says more is added, and the readings are of that one.
    scene.solver.node_spacing = Some(0.2);
    scene.solver.vehicle_step = Some(0.1);
    scene
}

/// Forces without noise over 80 passes, on ground so many times as stiff.
fn forces(stiffness: f64) -> Vec<f64> {
    let mut scene = scene(stiffness);
    scene.friction.dynamic_coefficient = FRICTION;
    (scene.friction.law, scene.friction.shape_factor) = (Law::ElasticPlastic, Some(SHAPE_FACTOR));
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.1), Some(0.05));
    scene.traffic.passes = 2 * PASSES as u64;
    crate::scenes::forces(&crate::scenes::run(&scene))
}

/// The file that the cell writes.
fn file(fault: Fault, seed: u64) -> String {
    static HERE: OnceLock<Vec<f64>> = OnceLock::new();
    static SOFT: OnceLock<Vec<f64>> = OnceLock::new();
    let forces = match fault {
        Fault::Ground(stiffness) => SOFT.get_or_init(|| forces(stiffness)),
        _ => HERE.get_or_init(|| forces(1.0)),
    };
    // A fork: generators of neighbouring seeds begin with related numbers.
    let mut random = fastrand::Rng::with_seed(seed).fork();
    let count = if fault == Fault::TwoRuns {
        2 * PASSES
    } else {
        PASSES
    };
    let mut readings: Vec<f64> = forces[..count]
        .iter()
        .map(|force| force + NOISE * testkit::gaussian(&mut random))
        .collect();
    if let Fault::Outliers(count, share) = fault {
        for k in 0..count {
            let place = (random.usize(..PASSES / count) + k * PASSES / count).max(5);
            readings[place] *= 1.0 + if k % 2 == 0 { share } else { -share };
        }
    }
    let mut text = String::from("pass,force_n\n");
    for (index, force) in readings.iter().enumerate() {
        let pass = index % PASSES + 1;
        let written = match fault {
            Fault::ZeroOffset(offset) => force + offset,
            Fault::Drift(drift) => force + drift * pass as f64,
            Fault::Unit => force / 1e3,
            Fault::Sign => -force,
            _ => *force,
        };
        let _ = writeln!(text, "{pass},{written}");
    }
    text
}

fn fit(text: &str) -> Calibrated {
    let readings = Readings::from_bytes("cell.csv", text.as_bytes(), &ReadOptions::default()).unwrap();
    creepage::calibrate(&scene(1.0), &readings, &CalibrateOptions::default()).unwrap()
}

/// What came out of the draws of one kind.
#[derive(Debug, Default)]
struct Count {
    draws: usize,
    /// Draws whose interval misses the true friction, and those of them that are called identifiable.
    missed: usize,
    claimed: usize,
    /// Draws in which a warning holds one of the words.
    warned: usize,
    /// Draws that call a parameter not identifiable, or say what the readings do not show.
    told: usize,
    /// Mean error of the friction, as a share.
    off: f64,
}

/// Faults, and words of the warning that names each. The last is one that forces alone cannot show.
const KINDS: [(Fault, &[&str]); 10] = [
    (Fault::None, &[]),
    (Fault::ZeroOffset(20.0), &["a zero offset"]),
    (Fault::ZeroOffset(-20.0), &["a zero offset"]),
    (Fault::Drift(0.8), &["a drift", "a zero offset"]),
    (Fault::Drift(-1.2), &["a drift", "a zero offset"]),
    (Fault::Outliers(3, 0.3), &["--robust"]),
    (Fault::Unit, &["--unit kN"]),
    (Fault::Sign, &["--tension-positive"]),
    (Fault::TwoRuns, &["--run-start continue"]),
    (Fault::Ground(0.8), &["does not follow"]),
];

fn count(fault: Fault, words: &[&str], draws: u64) -> Count {
    let answers: Vec<Calibrated> = (0..draws)
        .into_par_iter()
        .map(|seed| fit(&file(fault, seed)))
        .collect();
    let mut count = Count::default();
    for answer in answers {
        let friction = &answer.parameters[0];
        let [lower, upper] = friction.interval_95;
        let covers =
            lower.is_none_or(|lower| lower <= FRICTION) && upper.is_none_or(|upper| FRICTION <= upper);
        let warned = |word: &&str| answer.warnings.iter().any(|warning| warning.contains(word));
        count.draws += 1;
        count.off += (friction.value / FRICTION - 1.0) / draws as f64;
        count.missed += usize::from(!covers);
        count.claimed += usize::from(friction.identifiable && !covers);
        count.warned += usize::from(words.iter().any(warned));
        let assumed = answer
            .assumptions
            .iter()
            .any(|assumption| assumption.contains("the ground is that of the scene"));
        count.told += usize::from(assumed);
    }
    count
}

/// Of so many draws of each kind at most 7 % claim a wrong interval, or 9 % where nothing is wrong and all are identifiable, and at least 90 % are
/// warned of; `spare` draws more may fail by chance.
fn judge(draws: u64, spare: f64) {
    let mut wrong = Vec::new();
    for (fault, words) in KINDS {
        let found = count(fault, words, draws);
        println!("{fault:?}: {found:?}");
        let all = found.draws as f64;
        let most = if fault == Fault::None { 0.09 } else { 0.07 };
        let claims = found.claimed as f64 > most * all + spare;
        let silent = fault != Fault::None && (found.warned as f64) < 0.9 * all - spare;
        if claims || silent || found.told < found.draws {
            wrong.push(format!("{fault:?}: {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn faults_are_told_and_never_called_identifiable() {
    judge(4, 1.0);
}

/// `DRAWS=25` in front takes fewer of each kind, of which more may fail by chance.
#[test]
#[ignore = "1000 fits: see CONTRIBUTING.md for the command"]
fn faults_are_told_in_a_thousand_series() {
    let draws = std::env::var("DRAWS").ok().and_then(|draws| draws.parse().ok());
    let draws: u64 = draws.unwrap_or(100);
    judge(draws, if draws < 100 { 2.0 } else { 0.0 });
}
