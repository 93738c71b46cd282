//! Series as faulty cells and wrong settings make them: no parameter is called identifiable where its interval misses the truth, and the
//! fault is told.
//!
//! Readings are those of a run on a mesh twice as fine, 40 passes with Gaussian noise of 4 N. A fault is so large that the fitted friction
//! leaves its interval on average, which each kind states.

use std::fmt::Write;
use std::sync::OnceLock;

use creepage::readings::ReadOptions;
use creepage::scene::FrictionLaw;
use creepage::{CalibrateOptions, Calibrated, Readings, Scene, SceneFile};

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
    let file = SceneFile::read("examples/scenes/full-scale-upper.toml").unwrap();
    let mut scene = file.with(&[modulus]).unwrap().scene().unwrap();
    // Coarse, so that a fit takes a tenth of a second; what the mesh adds is corrected.
    scene.solver.node_spacing = Some(0.4);
    scene.solver.vehicle_step = Some(0.2);
    scene
}

/// Forces without noise over 80 passes, on ground so many times as stiff.
fn forces(stiffness: f64) -> Vec<f64> {
    let mut scene = scene(stiffness);
    scene.friction.dynamic_coefficient = FRICTION;
    scene.friction.law = FrictionLaw::ElasticPlastic {
        shape_factor: SHAPE_FACTOR,
    };
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.2), Some(0.1));
    scene.traffic.passes = 2 * PASSES as u64;
    let run = creepage::run(&scene).unwrap();
    run.passes.iter().map(|pass| pass.downstream_force_n).collect()
}

/// The file that the cell writes.
fn file(fault: Fault, seed: u64) -> String {
    static HERE: OnceLock<Vec<f64>> = OnceLock::new();
    static SOFT: OnceLock<Vec<f64>> = OnceLock::new();
    let forces = match fault {
        Fault::Ground(stiffness) => SOFT.get_or_init(|| forces(stiffness)),
        _ => HERE.get_or_init(|| forces(1.0)),
    };
    let mut random = fastrand::Rng::with_seed(seed);
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
    /// The fitted friction's interval misses the truth, and one that is called identifiable does.
    missed: usize,
    claimed_and_missed: usize,
    warned: usize,
    /// The report says that the data cannot show it.
    told: usize,
    off: f64,
}

/// Faults, and words of the warning that names each.
const KINDS: [(Fault, &[&str]); 8] = [
    (Fault::None, &[]),
    (Fault::ZeroOffset(20.0), &["zero offset", "follow"]),
    (Fault::Drift(1.0), &["drift", "follow"]),
    (Fault::Outliers(3, 0.3), &["--robust"]),
    (Fault::Unit, &["--unit kN"]),
    (Fault::Sign, &["--tension-positive"]),
    (Fault::TwoRuns, &["--run-start continue"]),
    (Fault::Ground(0.8), &["ground"]),
];

fn count(fault: Fault, words: &[&str], draws: u64) -> Count {
    let mut count = Count::default();
    for seed in 0..draws {
        let answer = fit(&file(fault, seed));
        let friction = &answer.parameters[0];
        let [lower, upper] = friction.interval_95;
        let covers =
            lower.is_none_or(|lower| lower <= FRICTION) && upper.is_none_or(|upper| FRICTION <= upper);
        count.draws += 1;
        count.off += friction.value / FRICTION - 1.0;
        count.missed += usize::from(!covers);
        count.claimed_and_missed += usize::from(friction.identifiable && !covers);
        let warned = |word: &&str| answer.warnings.iter().any(|warning| warning.contains(word));
        count.warned += usize::from(words.iter().any(warned));
        count.told += usize::from(
            answer
                .assumptions
                .iter()
                .any(|assumption| assumption.contains("cannot show")),
        );
        if std::env::var("SHOW").is_ok() && seed < 2 {
            println!(
                "{fault:?} {:?} {:?} {:?} rms {} {}",
                answer.parameters[0].value,
                answer.parameters[0].standard_error,
                friction.interval_95,
                answer.residual_rms_n,
                answer.evaluations
            );
            println!(
                "{:#?} {:#?} {:?}",
                answer.warnings, answer.assumptions, answer.lack_of_fit
            );
        }
    }
    count
}

fn judge(draws: u64) {
    let mut wrong = Vec::new();
    for (fault, words) in KINDS {
        let begun = std::time::Instant::now();
        let found = count(fault, words, draws);
        println!(
            "{fault:?}: {found:?}; {:.2} s each",
            begun.elapsed().as_secs_f64() / draws as f64
        );
        let share = |part: usize| part as f64 / found.draws as f64;
        // A few draws may miss by chance: three standard deviations of the binomial.
        let chance = 3.0 * (0.07 * 0.93 / found.draws as f64).sqrt();
        let shown = !matches!(fault, Fault::Ground(_));
        let fails = match fault {
            Fault::None => share(found.claimed_and_missed) > 0.07 + chance || share(found.warned) > 0.0,
            _ if shown => share(found.claimed_and_missed) > 0.07 || share(found.warned) < 0.9,
            _ => share(found.told) < 1.0,
        };
        if fails {
            wrong.push(format!("{fault:?}: {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn faults_are_told_and_never_called_identifiable() {
    judge(6);
}

#[test]
#[ignore = "400 fits"]
fn faults_are_told_in_four_hundred_series() {
    judge(57);
}
