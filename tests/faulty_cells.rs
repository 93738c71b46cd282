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

/// What is wrong, words of the warning that names it, how many times as stiff the true ground is as the scene's, how many readings there are,
/// whose passes begin anew after 40 without a word of the file, and what the cell writes of a pass and its force. The last is one that forces alone cannot show.
#[rustfmt::skip]
type Fault = (&'static str, &'static [&'static str], f64, usize, fn(f64, f64) -> f64);

#[rustfmt::skip]
const FAULTS: [Fault; 10] = [
    ("nothing", &[], 1.0, PASSES, |_, force| force),
    ("a zero off by 20 N", &["a zero offset"], 1.0, PASSES, |_, force| force + 20.0),
    ("a zero off by -20 N", &["a zero offset"], 1.0, PASSES, |_, force| force - 20.0),
    ("a drift", &["a drift", "a zero offset"], 1.0, PASSES, |pass, force| force + 0.8 * pass),
    ("a drift down", &["a drift", "a zero offset"], 1.0, PASSES, |pass, force| force - 1.2 * pass),
    (OUTLIERS, &["--robust"], 1.0, PASSES, |_, force| force),
    ("kN under a header of N", &["--unit kN"], 1.0, PASSES, |_, force| force / 1e3),
    ("a sign", &["--tension-positive"], 1.0, PASSES, |_, force| -force),
    ("two runs", &["--run-start continue"], 1.0, 2 * PASSES, |_, force| force),
    ("softer ground", &["does not follow"], 0.8, PASSES, |_, force| force),
];
const OUTLIERS: &str = "three readings of 40 off by 30 % each";

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
fn file(&(name, _, stiffness, count, written): &Fault, seed: u64) -> String {
    static HERE: OnceLock<Vec<f64>> = OnceLock::new();
    static SOFT: OnceLock<Vec<f64>> = OnceLock::new();
    let known = if stiffness == 1.0 { &HERE } else { &SOFT };
    let forces = &known.get_or_init(|| forces(stiffness))[..count];
    // A fork: generators of neighbouring seeds begin with related numbers.
    let mut random = fastrand::Rng::with_seed(seed).fork();
    let noisy = forces
        .iter()
        .map(|force| force + NOISE * testkit::gaussian(&mut random));
    let mut readings: Vec<f64> = noisy.collect();
    for k in (0..3).filter(|_| name == OUTLIERS) {
        let place = (random.usize(..PASSES / 3) + k * PASSES / 3).max(5);
        readings[place] *= if k % 2 == 0 { 1.3 } else { 0.7 };
    }
    let mut text = String::from("pass,force_n\n");
    for (index, force) in readings.into_iter().enumerate() {
        let pass = index % PASSES + 1;
        let _ = writeln!(text, "{pass},{}", written(pass as f64, force));
    }
    text
}

fn fit(text: &str) -> Calibrated {
    let readings = Readings::from_bytes("cell.csv", text.as_bytes(), &ReadOptions::default()).unwrap();
    creepage::calibrate(&scene(1.0), &readings, &CalibrateOptions::default()).unwrap()
}

/// Of so many draws of each kind at most 7 % claim a wrong interval, or 9 % where nothing is wrong and all are identifiable, and at least 90 % are
/// warned of; `spare` draws more may fail by chance.
fn judge(draws: u64, spare: f64) {
    let mut wrong = Vec::new();
    for fault in FAULTS {
        let (name, words, ..) = fault;
        let series = (0..draws).into_par_iter();
        let answers: Vec<Calibrated> = series.map(|seed| fit(&file(&fault, seed))).collect();
        let count =
            |is: &dyn Fn(&Calibrated) -> bool| answers.iter().filter(|answer| is(answer)).count() as f64;
        // The interval misses the true friction, and the friction is called identifiable.
        let claimed = count(&|answer| {
            let friction = &answer.parameters[0];
            let [lower, upper] = friction.interval_95;
            let covers =
                lower.is_none_or(|lower| lower <= FRICTION) && upper.is_none_or(|upper| FRICTION <= upper);
            friction.identifiable && !covers
        });
        let holds = |texts: &[String], word: &str| texts.iter().any(|text| text.contains(word));
        let warned = count(&|answer| words.iter().any(|word| holds(&answer.warnings, word)));
        let assumed = "the ground is that of the scene";
        let told = count(&|answer| holds(&answer.assumptions, assumed));
        let found = format!(
            "{name}: {claimed} claim a wrong interval, {warned} are warned of, {told} tell what is assumed"
        );
        println!("{found}");
        let (all, is_sound) = (draws as f64, words.is_empty());
        let most = if is_sound { 0.09 } else { 0.07 };
        let claims = claimed > most * all + spare;
        let silent = !is_sound && warned < 0.9 * all - spare;
        if claims || silent || told < all {
            wrong.push(found);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn faults_are_told_and_never_called_identifiable() {
    judge(2, 0.0);
}

/// `DRAWS=25` in front takes fewer of each kind, of which more may fail by chance.
#[test]
#[ignore = "1000 fits: see CONTRIBUTING.md for the command"]
fn faults_are_told_in_a_thousand_series() {
    let draws = std::env::var("DRAWS").ok().and_then(|draws| draws.parse().ok());
    let draws: u64 = draws.unwrap_or(100);
    judge(draws, if draws < 100 { 2.0 } else { 0.0 });
}
