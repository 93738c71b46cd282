//! Random scenes over the whole range that scene files allow in practice, against far finer runs: the stated error of forces after
//! passes and during them, of forces on clamps and of movements is an upper bound but for a few, and the tolerance is kept.

use std::fmt::Write;
use std::time::{Duration, Instant};

use creepage::scene::{GroundModel, SolverMethod};
use creepage::{Run, Scene};
use creepage_validation::whole_range::differences::{Errors, KINDS, errors, stated};
use fastrand::Rng;
use rayon::prelude::*;

const TOLERANCES: [f64; 3] = [0.05, 0.01, 0.002];
/// A run that takes longer counts as a miss \[s\].
const LONGEST: Duration = Duration::from_secs(60);
/// Nodes eliminated for a reference at most.
const REFERENCE_WORK: f64 = 4e8;
/// A mesh twice as fine takes so many times the work.
const REFINEMENT: f64 = 4.5;
/// One scene at one tolerance.
#[derive(Debug)]
enum Case {
    Judged {
        tolerance: f64,
        found: Errors,
        stated: Errors,
    },
    /// The run took too long.
    Cut,
    /// The run refused to answer.
    Refused,
    /// No reference can be had that is finer.
    Unjudged,
}

/// The finest run that can be had, at least as fine as `spacing` \[m\]; `work` is what a run at that spacing took.
fn reference(scene: &Scene, spacing: f64, work: f64, inertia: bool) -> Option<Run> {
    let refinements = ((REFERENCE_WORK / work).ln() / REFINEMENT.ln())
        .floor()
        .clamp(0.0, 3.0);
    let mut scene = scene.clone();
    let spacing = spacing / 2_f64.powf(refinements);
    scene.solver.node_spacing = Some(spacing);
    scene.solver.vehicle_step = Some(0.5 * spacing);
    // Nothing is left out of the ground, and no answer is refused.
    scene.ground.model = if scene.ground.profile().expect("layers").homogeneous().is_some() {
        GroundModel::Boussinesq
    } else {
        GroundModel::Burmister
    };
    scene.solver.tolerance = 0.5;
    scene.solver.method = if inertia {
        SolverMethod::Explicit
    } else {
        SolverMethod::QuasiStatic
    };
    creepage::run(&scene).ok()
}

fn cases(seed: u64) -> Vec<Case> {
    let mut scene = Scene::from_toml("scene", &wide(seed)).expect("a valid scene");
    let runs: Vec<(f64, Duration, Result<Run, creepage::Error>)> = TOLERANCES
        .iter()
        .map(|&tolerance| {
            scene.solver.tolerance = tolerance;
            let start = Instant::now();
            let run = creepage::run(&scene);
            (tolerance, start.elapsed(), run)
        })
        .collect();
    let finest = runs
        .iter()
        .filter_map(|(_, _, run)| run.as_ref().ok())
        .min_by(|a, b| a.plan.node_spacing_m.total_cmp(&b.plan.node_spacing_m));
    let Some(finest) = finest else {
        return runs.iter().map(|_| Case::Refused).collect();
    };
    let inertia = finest.plan.cable == "explicit";
    let exact = reference(
        &scene,
        finest.plan.node_spacing_m,
        finest.cost.node_updates as f64,
        inertia,
    );
    runs.into_iter()
        .map(|(tolerance, time, run)| {
            let case = match (run, &exact) {
                (_, _) if time > LONGEST => Case::Cut,
                (Err(error), _) => {
                    println!("{seed}: {error}");
                    assert!(
                        matches!(error, creepage::Error::Inaccurate { .. }),
                        "{seed}: {error}"
                    );
                    Case::Refused
                }
                (Ok(run), Some(exact)) if exact.plan.node_spacing_m < 0.55 * run.plan.node_spacing_m => {
                    Case::Judged {
                        tolerance,
                        found: errors(&scene, &run, exact),
                        stated: stated(&run),
                    }
                }
                _ => Case::Unjudged,
            };
            println!("{seed} {tolerance} {:.1} s {case:?}", time.as_secs_f64());
            case
        })
        .collect()
}

#[test]
#[ignore = "half an hour of references on two cores: cargo test --release -p creepage-validation honest:: -- --ignored --nocapture"]
fn the_stated_error_is_above_the_true_one_and_the_tolerance_is_kept() {
    let number = |name: &str, default: u64| {
        std::env::var(name)
            .ok()
            .and_then(|n| n.parse().ok())
            .unwrap_or(default)
    };
    let (first, count) = (number("FIRST", 0), number("SCENES", 200));
    let all: Vec<Case> = (first..first + count)
        .into_par_iter()
        .flat_map_iter(cases)
        .collect();
    let runs = all.len() as f64;
    let share = |holds: &dyn Fn(&Case) -> bool| all.iter().filter(|case| holds(case)).count() as f64 / runs;
    let cut = share(&|case| matches!(case, Case::Cut));
    println!(
        "{runs} runs: cut {cut:.4}, refused {:.4}, unjudged {:.4}",
        share(&|case| matches!(case, Case::Refused)),
        share(&|case| matches!(case, Case::Unjudged)),
    );
    for (kind, name) in KINDS.into_iter().enumerate() {
        let understated =
            share(&|case| matches!(case, Case::Judged { found, stated, .. } if found[kind] > stated[kind]));
        // An answer that says itself that it exceeds the tolerance deceives nobody.
        let exceeded = share(
            &|case| matches!(case, Case::Judged { tolerance, found, stated } if found[kind] > *tolerance && stated[kind] <= *tolerance),
        );
        println!("{name}: understated {understated:.4}, beyond the tolerance {exceeded:.4}");
        assert!(understated + cut <= 0.02 && exceeded + cut <= 0.01, "{name}");
    }
}

/// A scene file over the whole range: 5 to 300 m, 0.4 to 4 m deep, friction from 0.05 to 1, stiff and soft cables and sheaths, layers
/// and rock, springs and clamps, up to three vehicles of up to six wheels, both ways; without a tolerance.
#[allow(clippy::too_many_lines, reason = "a list of what a scene may hold")]
fn wide(seed: u64) -> String {
    let mut random = Rng::with_seed(seed);
    let random = &mut random;
    let length = log_between(random, 5.0, 300.0);
    let depth = log_between(random, 0.4, 4.0);
    let mut text = format!(
        "[duct]\nlength = {length}\ndepth = {depth}\nlateral_offset = {}\n[ground]\n",
        random.choice([0.0, 0.0, 0.5, 1.0]).unwrap_or(0.0)
    );
    let mut line = |content: String| {
        let _ = writeln!(text, "{content}");
    };
    let upper = random.usize(0..4).saturating_sub(1);
    let thicknesses: Vec<f64> = (0..upper).map(|_| log_between(random, 0.03, 0.6)).collect();
    if random.u8(0..3) == 0 {
        let cover = depth.max(thicknesses.iter().sum());
        line(format!(
            "rigid_base_depth = {}",
            1.3 * cover + log_between(random, 1.0, 20.0)
        ));
    }
    for thickness in thicknesses {
        let modulus = log_between(random, 1e8, 8e9);
        line(format!(
            "[[ground.layers]]\nthickness = {thickness}\nyoung_modulus = {modulus}\npoisson_ratio = {}",
            between(random, 0.2, 0.45)
        ));
    }
    line(format!(
        "[[ground.layers]]\nyoung_modulus = {}\npoisson_ratio = {}",
        log_between(random, 4e7, 9e8),
        between(random, 0.2, 0.48)
    ));
    let extreme = random.u8(0..3) == 0;
    line(format!(
        "[cable]\nweight = {}\naxial_stiffness = {}\nnormal_load_factor = {}",
        log_between(random, 40.0, 400.0),
        if extreme {
            log_between(random, 1e6, 1e9)
        } else {
            log_between(random, 2e6, 3e7)
        },
        random.choice([1.0, 1.0, 1.5]).unwrap_or(1.0)
    ));
    line(format!(
        "[friction]\ndynamic_coefficient = {}",
        between(random, 0.05, 1.0)
    ));
    if random.u8(0..5) == 0 {
        line("law = \"coulomb\"".into());
    } else {
        line(format!("shape_factor = {}", log_between(random, 1e5, 1e9)));
    }
    let end = |random: &mut Rng| match random.u8(0..3) {
        0 => "\"free\"".to_owned(),
        1 => "\"fixed\"".to_owned(),
        _ => format!("{{ spring = {} }}", log_between(random, 1e4, 1e8)),
    };
    let (upstream, downstream) = (end(random), end(random));
    line(format!(
        "[ends]\nupstream = {upstream}\ndownstream = {downstream}"
    ));
    for _ in 0..random.usize(0..5).saturating_sub(2) {
        line(format!(
            "[[restraints]]\nposition = {}\nstiffness = {}",
            length * between(random, 0.02, 0.98),
            log_between(random, 1e4, 1e8)
        ));
    }
    let vehicles = random.choice([1, 1, 1, 2, 3]).unwrap_or(1);
    for number in 0..vehicles {
        let wheels = random.choice([1, 1, 2, 3, 4, 6]).unwrap_or(1);
        let speed = between(random, 5.0, 17.0);
        line(format!("[[vehicles]]\nname = \"v{number}\"\nspeed = {speed}"));
        if wheels == 1 {
            line(format!("load = {}", log_between(random, 3e4, 3e5)));
        } else {
            let mut x = 0.0;
            let mut list = String::new();
            for _ in 0..wheels {
                let y = random.choice([-0.9, 0.9, 0.0]).unwrap_or(0.0);
                let radius = random.choice([0.0, 0.1, 0.15, 0.25]).unwrap_or(0.0);
                let load = log_between(random, 1e4, 8e4);
                let _ = write!(
                    list,
                    "{{ x = {x}, y = {y:?}, load = {load}, contact_radius = {radius:?} }},"
                );
                if random.bool() {
                    x -= between(random, 1.2, 5.0);
                }
            }
            line(format!("wheels = [{list}]"));
        }
        if random.u8(0..3) == 0 {
            line("direction = \"reverse\"".into());
        }
        line(format!("share = {}", between(random, 0.2, 1.0)));
    }
    let most = if length < 40.0 { 200 } else { 40 };
    let passes = random.choice([1, 2, 3, 5, 8, 12, 12, 12, most]).unwrap_or(1);
    line(format!("[traffic]\npasses = {passes}"));
    if vehicles > 1 && random.u8(0..3) == 0 {
        line("order = \"random\"\nseed = 3".into());
    }
    text
}

fn between(random: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.f64()
}

fn log_between(random: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.f64())
}
