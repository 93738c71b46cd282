//! Which friction and which ground reproduce the two saturated forces of the paper's full-scale experiment, and how far the paper's
//! own values are off.
//!
//! The paper: K. Kashiro et al., Furukawa Review. Section 4.2: the upper cable levels off at about 550 N (μ_d = 0.25), the lower at
//! about 900 N (μ_d = 0.27, normal force 1.5 times the weight). Section 4.1: the duct went down by 90 to 140 µm.
//!
//! Two numbers read from a text have no scatter of their own. *Assumed* here: ±5 % (one standard deviation), and a deflection of
//! 115 ± 14.4 µm, the mean and standard deviation of an even spread over the measured range. The shape factor stays at the
//! scenes' value: a saturated force hardly depends on it.
//!
//! ```sh
//! cargo run --release --example calibrate_full_scale
//! ```

use creepage::calibration::{Calibrated, Deflection, Quantity, Unknown};
use creepage::{CalibrateOptions, Reading, Readings, Scene, Series, calibrate, calibrate_jointly};

type Failure = Box<dyn std::error::Error>;

/// Passes after which the force has levelled off.
const SATURATED: u64 = 200;
/// Assumed standard deviation of a force read from the text, as a share of it.
const FORCE_SIGMA: f64 = 0.05;
/// Measured deflections \[m\].
const DEFLECTIONS: [f64; 2] = [90e-6, 140e-6];

fn main() -> Result<(), Failure> {
    let scenes =
        ["upper", "lower"].map(|cable| Scene::from_file(format!("examples/scenes/full-scale-{cable}.toml")));
    let [upper, lower] = scenes;
    let scenes = [upper?, lower?];
    let forces = forces("examples/data/full-scale-saturation.csv")?;
    let readings: Vec<Readings> = forces.iter().map(|&force| saturated(force)).collect();
    let friction = [0, 1].map(|series| Unknown::of(Quantity::DynamicCoefficient, series));

    println!(
        "Friction that gives 550 N (upper) and 900 N (lower) where the duct goes down by so much, 95 % intervals"
    );
    for micrometres in [90.0, 100.0, 115.0, 125.0, 140.0] {
        for (scene, readings) in scenes.iter().zip(&readings) {
            let mut scene = scene.clone();
            scene.ground.vertical_peak = Some(1e-6 * micrometres);
            let answer = calibrate(&scene, readings, &only(Quantity::DynamicCoefficient))?;
            println!("{micrometres:>5} um  {}", told(&answer));
        }
    }

    println!();
    println!("The paper's friction (0.25 and 0.27) and one ground for both cables");
    let answer = fit(&scenes, &readings, &only(Quantity::GroundStiffness))?;
    let stiffness = answer.parameters[0].value;
    let table_1 = creepage::profile_at(&scenes[0], &[0.0])?.vertical_m[0];
    println!(
        "  stiffness {} of Table 1's, deflection {:.0} um   {}",
        value(&answer, 0),
        1e6 * table_1 / stiffness,
        misses(&answer)
    );

    println!();
    println!("Friction of both cables and the ground together, the measured deflection as prior knowledge");
    let [low, high] = DEFLECTIONS;
    let deflection = Deflection {
        value: 0.5 * (low + high),
        // Standard deviation of an even spread.
        sigma: (high - low) / 12.0_f64.sqrt(),
    };
    let mut unknowns = friction.to_vec();
    unknowns.push(Unknown::shared(Quantity::GroundStiffness));
    let options = CalibrateOptions {
        unknowns,
        deflection: Some(deflection),
        ..CalibrateOptions::default()
    };
    let answer = fit(&scenes, &readings, &options)?;
    for (index, paper) in [0.25, 0.27].into_iter().enumerate() {
        let parameter = &answer.parameters[index];
        let off = match parameter.standard_error.filter(|_| parameter.identifiable) {
            Some(error) => format!(" and {:+.1} standard errors", (paper - parameter.value) / error),
            None => String::new(),
        };
        println!(
            "  {:<22} {}   the paper's {paper} is {:+.0} %{off} off",
            parameter.name,
            value(&answer, index),
            100.0 * (paper / parameter.value - 1.0),
        );
    }
    println!(
        "  ground_stiffness       {}   deflection {:.0} um   {}",
        value(&answer, 2),
        1e6 * table_1 / answer.parameters[2].value,
        misses(&answer)
    );
    for warning in &answer.warnings {
        println!("  warning: {warning}");
    }
    Ok(())
}

fn fit(
    scenes: &[Scene; 2],
    readings: &[Readings],
    options: &CalibrateOptions,
) -> Result<Calibrated, Failure> {
    let series: Vec<Series<'_>> = scenes
        .iter()
        .zip(readings)
        .map(|(scene, readings)| Series { scene, readings })
        .collect();
    Ok(calibrate_jointly(&series, options)?)
}

/// Fits one quantity.
fn only(quantity: Quantity) -> CalibrateOptions<'static> {
    CalibrateOptions {
        unknowns: vec![Unknown::shared(quantity)],
        ..CalibrateOptions::default()
    }
}

/// The forces of both cables, the upper one first.
fn forces(file: &str) -> Result<Vec<f64>, Failure> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(file)?;
    let rows = reader.records().collect::<Result<Vec<_>, _>>()?;
    ["full-scale-upper", "full-scale-lower"]
        .into_iter()
        .map(|scene| {
            let row = rows
                .iter()
                .find(|row| &row[0] == scene)
                .ok_or("a cable is missing")?;
            Ok(row[1].parse()?)
        })
        .collect()
}

fn saturated(force: f64) -> Readings {
    let sigma = Some(FORCE_SIGMA * force);
    [Reading {
        sigma,
        ..Reading::force(SATURATED, force)
    }]
    .into_iter()
    .collect()
}

fn value(answer: &Calibrated, index: usize) -> String {
    let parameter = &answer.parameters[index];
    let end = |end: Option<f64>| end.map_or_else(|| "open".to_owned(), |end| format!("{end:.3}"));
    let [lower, upper] = parameter.interval_95;
    format!("{:.3} ({} to {})", parameter.value, end(lower), end(upper))
}

/// The first parameter, the forces that come out, and what to know.
fn told(answer: &Calibrated) -> String {
    let warnings = answer
        .warnings
        .iter()
        .map(|warning| format!("\n          {warning}"));
    format!(
        "{:<26} {}{}",
        value(answer, 0),
        misses(answer),
        warnings.collect::<String>()
    )
}

fn misses(answer: &Calibrated) -> String {
    let forces: Vec<String> = answer
        .fit
        .iter()
        .map(|reading| format!("{:.0} N", reading.fitted))
        .collect();
    format!("{} ({} runs)", forces.join(" and "), answer.evaluations)
}
