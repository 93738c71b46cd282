//! Random mixes of vehicles, and by how much two runs of them differ.

use creepage::scene::SolverMethod;
use creepage::{Error, PassRecord, Run, Scene};
use fastrand::Rng;

use crate::answers::common::forces_after;
use crate::scenes;

/// Nodes a depth.
const NODES: f64 = 6.0;
/// Forces of a pass below this share of the largest of the run count as nothing, as in the estimate.
const SMALL: f64 = 0.1;
/// And so does the friction on a centimetre of cable \[m\].
const SHORT: f64 = 0.01;

/// These vehicles over a duct of 20 m whose downstream end is fixed.
pub fn under(vehicles: &str, traffic: &str) -> Scene {
    let text = format!(
        r#"
        duct = {{ length = 20, depth = 1.2 }}
        ground = {{ layers = [{{ young_modulus = "300 MPa", poisson_ratio = 0.4 }}] }}
        cable = {{ weight = 108.8, axial_stiffness = 8.01e6 }}
        friction = {{ dynamic_coefficient = 0.3, shape_factor = 6e6 }}
        ends = {{ upstream = "free", downstream = "fixed" }}
        vehicles = [{vehicles}]
        traffic = {{ {traffic} }}
        "#
    );
    Scene::from_toml("scene", &text).expect("a valid scene")
}

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
    let mut clamp = |_| {
        let (stiffness, position) = (10_f64.powf(between(4.5, 7.0)), length * between(0.1, 0.9));
        format!("{{ position = {position}, stiffness = {stiffness} }}")
    };
    let clamps: Vec<String> = (0..clamps as u8).map(&mut clamp).collect();
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
            let seldom = usize::from(between(0.0, 1.0) < 0.15);
            format!("\"v{}\"", seldom * between(0.0, kinds as f64) as usize)
        });
        format!(", sequence = [{}]", vehicles.collect::<Vec<_>>().join(", "))
    } else if order < 0.4 {
        format!(", order = \"random\", seed = {seed}")
    } else {
        String::new()
    };
    let (modulus, poisson) = (10_f64.powf(between(7.7, 8.9)), between(0.2, 0.45));
    let (weight, stiffness) = (between(50.0, 200.0), 10_f64.powf(between(6.5, 7.8)));
    let (friction, sheath) = (between(0.1, 0.6), 10_f64.powf(between(6.0, 7.5)));
    let lines = [
        format!("duct = {{ length = {length}, depth = {depth} }}"),
        format!("ground = {{ layers = [{{ young_modulus = {modulus}, poisson_ratio = {poisson} }}] }}"),
        format!("cable = {{ weight = {weight}, axial_stiffness = {stiffness} }}"),
        format!("friction = {{ dynamic_coefficient = {friction}, shape_factor = {sheath} }}"),
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
    let most = scenes::largest(every.passes.iter().flat_map(forces_during)).max(friction);
    // Where other vehicles stand in for the traffic, a pass after the first ones is shown by the mean over a period around it, or over
    // the last one.
    let period = creepage::plan(scene).expect("a plan").period;
    let (length, count) = (period.len(), every.passes.len());
    let of_pass = |record: &PassRecord| {
        let place = every.passes.iter().position(|other| other.pass == record.pass)?;
        let begin = place.saturating_sub((length - 1) / 2);
        let begin = begin.min(count.saturating_sub(length));
        let is_itself = period.is_own() || !record.interpolated || place < period.first.len();
        let (begin, length) = if is_itself { (place, 1) } else { (begin, length) };
        let shown = begin..(begin + length).min(count);
        let mean = |of: usize| {
            let passes = &every.passes[shown.clone()];
            passes.iter().map(|pass| forces_after(pass)[of]).sum::<f64>() / shown.len() as f64
        };
        let right = [0, 1, 2].map(mean);
        let pairs = right.into_iter().zip(forces_after(record));
        let scale = scenes::largest(right).max(SMALL * most);
        Some(scenes::largest(pairs.map(|(right, found)| right - found)) / scale)
    };
    let apart = |values: fn(&PassRecord) -> Vec<f64>, scale: f64| {
        let (right, found) = (extremes(every, values), extremes(found, values));
        scenes::largest(right.iter().zip(&found).map(|(right, found)| right - found)) / scale
    };
    let moved = extremes(every, movements).into_iter().fold(1e-7, f64::max);
    Difference {
        force: found.passes.iter().filter_map(of_pass).fold(0.0, f64::max),
        extreme: apart(|record| forces_during(record).into(), most),
        movement: apart(movements, moved),
    }
}

/// The largest of each of these values in all passes that a run shows.
fn extremes(run: &Run, values: fn(&PassRecord) -> Vec<f64>) -> Vec<f64> {
    let extremes = run.extremes.iter().map(|extreme| &extreme.after);
    let larger = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a.max(b)).collect();
    let shown = run.passes.iter().chain(extremes).map(values);
    shown.reduce(larger).unwrap_or_default()
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
