//! Random mixes of vehicles, and by how much two runs of them differ.

use creepage::scene::SolverMethod;
use creepage::{Error, PassRecord, Run, Scene};
use fastrand::Rng;

/// Nodes a depth.
const NODES: f64 = 6.0;
/// Forces of a pass below this share of the largest of the run count as nothing, as in the estimate.
const SMALL: f64 = 0.1;
/// And so does the friction on a centimetre of cable \[m\].
const SHORT: f64 = 0.01;

/// Two to six vehicles with shares from 1 : 1 to 1 : 1000 and loads from 1 : 10, some against the common direction; evenly mixed, in a
/// sequence of 13 to 500 or at random; springs and clamps.
pub fn random(seed: u64, passes: Option<u64>) -> Scene {
    let mut rng = Rng::with_seed(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * rng.f64();
    let depth = between(0.7, 2.0);
    let length = 10.0 * 6_f64.powf(between(0.0, 1.0));
    let mut end = || match between(0.0, 3.0) as u8 {
        0 => "\"free\"".to_owned(),
        1 => "\"fixed\"".to_owned(),
        _ => format!("{{ spring = {} }}", 10_f64.powf(between(4.5, 7.0))),
    };
    let ends = format!("ends = {{ upstream = {}, downstream = {} }}", end(), end());
    let clamps = between(0.0, 1.0).round() * between(0.0, 2.99);
    let clamps: Vec<String> = (0..clamps as u8)
        .map(|_| {
            let stiffness = 10_f64.powf(between(4.5, 7.0));
            format!(
                "{{ position = {}, stiffness = {stiffness} }}",
                length * between(0.1, 0.9)
            )
        })
        .collect();
    let kinds = between(2.0, 6.99) as usize;
    let (load, whole) = (between(3e4, 8e4), between(0.0, 1.0) < 0.5);
    let vehicles: Vec<String> = (0..kinds)
        .map(|kind| {
            let share = 10_f64.powf(between(0.0, 3.0));
            let share = if whole { share.round() } else { (100.0 * share).round() / 100.0 };
            let load = load * 10_f64.powf(between(0.0, 1.0));
            let direction = if between(0.0, 1.0) < 0.25 { "reverse" } else { "forward" };
            format!(
                "{{ name = \"v{kind}\", speed = {}, load = {load}, direction = \"{direction}\", share = {share} }}",
                between(5.0, 20.0)
            )
        })
        .collect();
    let drawn = between(400.0, 3000.0) as u64;
    let order = between(0.0, 1.0);
    let order = if order < 0.3 {
        let vehicles = (0..between(13.0, 500.0) as usize).map(|_| {
            let seldom = between(0.0, 1.0) < 0.15;
            format!(
                "\"v{}\"",
                usize::from(seldom) * between(0.0, kinds as f64) as usize
            )
        });
        format!(", sequence = [{}]", vehicles.collect::<Vec<_>>().join(", "))
    } else if order < 0.4 {
        format!(", order = \"random\", seed = {seed}")
    } else {
        String::new()
    };
    let lines = [
        format!("duct = {{ length = {length}, depth = {depth} }}"),
        format!(
            "ground = {{ layers = [{{ young_modulus = {}, poisson_ratio = {} }}] }}",
            10_f64.powf(between(7.7, 8.9)),
            between(0.2, 0.45)
        ),
        format!(
            "cable = {{ weight = {}, axial_stiffness = {} }}",
            between(50.0, 200.0),
            10_f64.powf(between(6.5, 7.8))
        ),
        format!(
            "friction = {{ dynamic_coefficient = {}, shape_factor = {} }}",
            between(0.1, 0.6),
            10_f64.powf(between(6.0, 7.5))
        ),
        ends,
        format!("restraints = [{}]", clamps.join(", ")),
        format!("vehicles = [{}]", vehicles.join(", ")),
        format!("traffic = {{ passes = {}{order} }}", passes.unwrap_or(drawn)),
    ];
    Scene::from_toml("scene", &lines.join("\n")).expect("a valid scene")
}

/// The same by `method`, on one mesh of few nodes, which it shares with every other method.
pub fn by(scene: &Scene, method: SolverMethod) -> Result<Run, Error> {
    let spacing = scene.duct.depth / NODES;
    let mut scene = scene.clone();
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(spacing), Some(0.5 * spacing));
    scene.solver.method = method;
    creepage::run(&scene)
}

/// Largest differences of two runs, as shares of the larger force or of the largest movement.
#[derive(Debug, Clone, Copy, Default)]
pub struct Difference {
    /// Of forces after passes that both show.
    pub force: f64,
    /// Of the largest and least force of all passes, during them too.
    pub extreme: f64,
    /// Of the largest movement either way.
    pub movement: f64,
}

/// By how much `found` differs from `every` pass simulated.
pub fn difference(scene: &Scene, every: &Run, found: &Run) -> Difference {
    let friction = SHORT * scene.friction.dynamic_coefficient * scene.normal_load();
    let largest = every
        .passes
        .iter()
        .flat_map(forces_during)
        .fold(friction, |most, f| most.max(f.abs()));
    // Where other vehicles stand in for the traffic, a pass after the first ones is shown by the mean over a period around it, or over
    // the last one.
    let period = creepage::plan(scene).expect("a plan").period;
    let (length, count) = (period.len(), every.passes.len());
    let of_pass = |record: &PassRecord| {
        let place = every
            .passes
            .binary_search_by_key(&record.pass, |other| other.pass)
            .ok()?;
        let shown = if period.is_own() || !record.interpolated || place < period.first.len() {
            place..place + 1
        } else {
            let begin = place
                .saturating_sub((length - 1) / 2)
                .min(count.saturating_sub(length));
            begin..(begin + length).min(count)
        };
        let mean = |of: usize| {
            let forces = every.passes[shown.clone()]
                .iter()
                .map(|pass| forces_after(pass)[of]);
            forces.sum::<f64>() / shown.len() as f64
        };
        let right = [0, 1, 2].map(mean);
        let scale = right
            .iter()
            .fold(SMALL * largest, |most, force| most.max(force.abs()));
        let pairs = right.into_iter().zip(forces_after(record));
        Some(pairs.fold(0.0_f64, |most, (right, found)| {
            most.max((right - found).abs() / scale)
        }))
    };
    let apart = |values: fn(&PassRecord) -> Vec<f64>, scale: f64| {
        let (right, found) = (extremes(every, values), extremes(found, values));
        let pairs = right.iter().zip(&found);
        pairs.fold(0.0_f64, |most, (right, found)| {
            most.max((right - found).abs() / scale)
        })
    };
    let moved = extremes(every, movements).into_iter().fold(1e-7, f64::max);
    Difference {
        force: found.passes.iter().filter_map(of_pass).fold(0.0, f64::max),
        extreme: apart(|record| forces_during(record).into(), largest),
        movement: apart(movements, moved),
    }
}

/// The largest of each of these values in all passes that a run shows.
fn extremes(run: &Run, values: fn(&PassRecord) -> Vec<f64>) -> Vec<f64> {
    let shown = run
        .passes
        .iter()
        .chain(run.extremes.iter().map(|extreme| &extreme.after));
    shown
        .map(values)
        .reduce(|a, b| a.iter().zip(b).map(|(a, b)| a.max(b)).collect())
        .unwrap_or_default()
}

fn forces_after(record: &PassRecord) -> [f64; 3] {
    [
        record.downstream_force_n,
        record.upstream_force_n,
        record.max_compression_n,
    ]
}

/// Each as large as it is when it is worst: the least force counts with the other sign.
fn forces_during(record: &PassRecord) -> [f64; 5] {
    [
        record.downstream_peak_n,
        record.upstream_peak_n,
        -record.downstream_least_n,
        -record.upstream_least_n,
        record.max_compression_n,
    ]
}

fn movements(record: &PassRecord) -> Vec<f64> {
    let ends = [record.upstream_displacement_m, record.downstream_displacement_m];
    ends.into_iter().flat_map(|moved| [moved, -moved]).collect()
}
