//! Whatever is read: scene files, overrides, readings, quantities and varied keys. Good inputs are changed at random, and what
//! comes of each is an answer that keeps its own rules or an error that says where, never a panic.

mod mutate;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use creepage::presets::{self, PresetKind};
use creepage::scene::{Dimension, SceneError};
use creepage::sweep::{Axis, Distribution};
use creepage::{Readings, Scene, SceneFile};
use fastrand::Rng;

use mutate::mutated;

/// Inputs of the ordinary tests, and of the long one.
const FEW: u64 = 8_000;
const MANY: u64 = 2_500_000;

/// A kind of input: how many of it for every hundred that are asked for, good ones, and whether one is accepted, which checks
/// what must hold for any.
type Kind = (&'static str, u64, Vec<String>, fn(&str) -> bool);

fn kinds() -> [Kind; 5] {
    let scenes = scenes();
    let settings: Vec<String> = scenes.iter().flat_map(|text| settings(text)).collect();
    // Those that fit the example, one by one and in pairs.
    let mut fitting: Vec<String> = settings.into_iter().filter(|text| overrides(text)).collect();
    let pairs: Vec<String> = fitting.windows(2).map(|pair| pair.join("\n")).collect();
    fitting.extend(pairs.into_iter().filter(|pair| overrides(pair)));
    [
        ("scenes", 40, scenes, scene),
        ("overrides", 20, fitting, overrides),
        ("readings", 40, tables(), readings),
        ("quantities", 15, quantities(), quantity),
        ("axes", 10, AXES.lines().map(str::to_owned).collect(), axis),
    ]
}

fn files(folder: &str, ending: &str) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder of good inputs");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    // The same inputs on every machine.
    paths.sort();
    let read = |path| fs::read_to_string(path).expect("a good input");
    paths.iter().map(read).collect()
}

/// The examples, difficult grounds, a scene that uses every key, and new scenes with every preset.
fn scenes() -> Vec<String> {
    let mut scenes = files("examples/scenes", "toml");
    // A text has no folder in which a table of axles could lie.
    scenes.retain(|text| !text.contains("histogram"));
    scenes.extend(files("tests/data/difficult", "toml"));
    scenes.push(crate::scene::FULL.to_owned());
    for preset in presets::all() {
        let key = match preset.kind {
            PresetKind::Vehicle => "vehicles.preset",
            PresetKind::Cable => "cable.preset",
            PresetKind::Pavement => "ground.preset",
            PresetKind::Friction => continue,
        };
        // What a preset gives may stand in the file too; the template has a speed of its own.
        let text = creepage::template("fuzz.toml", &[(key, &preset.name)]).expect("a template");
        let values = preset.toml.lines().filter(|line| !line.starts_with("speed"));
        let values: Vec<&str> = values.collect();
        let named = format!("preset = \"{}\"", preset.name);
        scenes.push(text.replace(&named, &format!("{}\n", values.join("\n"))));
        scenes.push(text);
    }
    scenes
}

/// `KEY=VALUE` of a scene's own lines.
fn settings(text: &str) -> Vec<String> {
    let mut section = String::new();
    let mut settings = Vec::new();
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("[[") {
            section = format!("{}.0.", heading.split(']').next().unwrap_or_default());
        } else if let Some(heading) = line.strip_prefix('[') {
            section = format!("{}.", heading.split(']').next().unwrap_or_default());
        } else if let Some((key, value)) = line.split_once(" = ") {
            settings.push(format!("{section}{}={value}", key.trim()));
        }
    }
    settings
}

fn tables() -> Vec<String> {
    let series = fs::read_to_string("examples/data/synthetic-upper.csv").expect("a series");
    let short = "pass,force_n,sigma_n\n1,113.4,4\n2,168,4.5\n# later\n\n60,5.4e2,4\n";
    let bare = "\u{feff}1,113.4\r\n2,-168\r\n10,\r\n";
    [series, short.into(), bare.into()].into()
}

fn quantities() -> Vec<String> {
    Dimension::ALL
        .iter()
        .flat_map(|dimension| dimension.units())
        .flat_map(|unit| ["1.2", "-35.7e-6", "8.01E+6", ".5"].map(|number| format!("{number} {unit}")))
        .collect()
}

const AXES: &str = "\
duct.depth=0.6m:2m:0.2m
friction.dynamic_coefficient=0.2,0.3,0.4
ends.downstream={ spring = \"3 MN/m\" },fixed,free
friction.dynamic_coefficient=normal(0.25, 0.03)
ground.layers.2.young_modulus=lognormal(60 MPa, 0.4)
vehicles.0.load=uniform(10 tf, 20 tf)
cable.weight=normal(11 kg/m, 2 kg/m, min=5 kg/m, max=20 kg/m)
cable.conductor_area=triangular(600 mm2, 800 mm2, 1000 mm2)
vehicles.0.preset=t-25,t-20
traffic.passes=10:100:10";

// What must hold.

fn scene(text: &str) -> bool {
    let read = SceneFile::from_toml("fuzz.toml", text).and_then(|file| {
        file.slips();
        file.scene()
    });
    match &read {
        Ok(scene) => valid(scene),
        Err(error) => located(error, text),
    }
    read.is_ok()
}

/// What was read is valid, and the same when it is written and read again.
fn valid(scene: &Scene) {
    scene.validate().expect("what was read is valid");
    let text = scene.to_toml();
    let again = Scene::from_toml("written.toml", &text).expect(&text);
    assert_eq!(again, *scene, "{text}");
}

/// The error names a line of the file, and says what the line is.
fn located(error: &SceneError, text: &str) {
    let location = error.location().expect("a place");
    let line = location.line().expect("a line");
    assert!(line >= 1 && line <= 1 + text.matches('\n').count(), "{error}");
    let message = error.to_string();
    let begin = format!("fuzz.toml, line {line}: ");
    assert!(message.starts_with(&begin), "{message}");
    location.excerpt();
}

/// Overrides, one a line, on top of an example.
fn overrides(text: &str) -> bool {
    thread_local! {
        static FILE: SceneFile = SceneFile::read("examples/scenes/full-scale-lower.toml").expect("an example");
    }
    let list: Vec<&str> = text.split('\n').collect();
    let read = FILE.with(|file| file.with(&list)).and_then(|file| file.scene());
    match &read {
        Ok(scene) => valid(scene),
        Err(error) => {
            let location = error.location().expect("a place");
            let is_named = |begin: &&str| location.file().starts_with(begin);
            assert!(location.line().is_some() || ["--set ", "preset "].iter().any(is_named));
            let message = error.to_string();
            let is_told = message.contains("found ") || message.contains("is missing");
            assert!(is_told && message.contains("; allowed: "), "{message}");
        }
    }
    read.is_ok()
}

fn readings(text: &str) -> bool {
    let read = Readings::from_csv("fuzz.csv", text.as_bytes());
    match &read {
        Ok(readings) => {
            for reading in &readings.list {
                assert!(reading.value.is_finite(), "{reading:?}");
                let is_positive = |sigma: f64| sigma.is_finite() && sigma > 0.0;
                assert!(reading.sigma.is_none_or(is_positive), "{reading:?}");
            }
            assert!(readings.last_pass() >= 1);
        }
        Err(error) => {
            let message = error.to_string();
            let rest = message.strip_prefix("fuzz.csv:").expect("the file");
            if let Ok(line) = rest.split(':').next().unwrap_or_default().parse::<usize>() {
                assert!(line <= 1 + text.matches(['\n', '\r']).count(), "{message}");
            }
        }
    }
    read.is_ok()
}

fn quantity(text: &str) -> bool {
    let mut accepted = false;
    for dimension in Dimension::ALL {
        let Ok(value) = dimension.parse(text) else {
            continue;
        };
        accepted = true;
        if value == 0.0 || (1e-290..1e290).contains(&value.abs()) {
            // The same value is read back in the first unit.
            let unit = dimension.units().next().expect("a unit");
            let factor = dimension.parse(&format!("1 {unit}")).expect("a unit");
            let again = dimension.parse(&format!("{:e} {unit}", value / factor));
            let again = again.expect("a quantity");
            assert!((again - value).abs() <= 1e-12 * value.abs(), "{value} {again}");
        }
        assert!(!value.is_nan() || text.to_ascii_lowercase().contains("nan"));
        assert!(dimension.parse_argument(text).is_ok());
    }
    accepted
}

fn axis(text: &str) -> bool {
    let read = Axis::parse(text);
    match &read {
        Ok(axis) => {
            assert!(!axis.key.is_empty() && (1..=1_000_001).contains(&axis.values.len()));
            for value in &axis.values {
                assert!(!value.is_empty());
                if let Some(Ok(distribution)) = Distribution::parse(value) {
                    let (low, high) = (distribution.quantile(0.1), distribution.quantile(0.9));
                    assert!(low.0 <= high.0, "{low:?} {high:?}");
                }
            }
        }
        Err(error) => assert!(error.to_string().contains("allowed: "), "{error}"),
    }
    read.is_ok()
}

// The tests.

/// Checks so many inputs, and shows the one that fails.
fn fuzz(count: u64, seed: u64, longest: Duration) {
    for (name, share, all, check) in kinds() {
        for good in &all {
            assert!(check(good), "{name}: {good}");
        }
        let mut random = Rng::with_seed(seed);
        let (count, mut accepted) = (count * share / 100, 0);
        for number in 0..count {
            let good = random.choice(&all).expect("a good input");
            let input = mutated(&mut random, good, &all);
            let begin = Instant::now();
            let fine = catch_unwind(AssertUnwindSafe(|| check(&input)))
                .unwrap_or_else(|_| panic!("{name} {number} of seed {seed}:\n{input}\n{input:?}"));
            assert!(begin.elapsed() < longest, "{name} {number} of seed {seed}");
            accepted += u64::from(fine);
        }
        // Where nearly all or nearly none are accepted the other half was not looked at.
        let share = accepted as f64 / count as f64;
        println!("{name}: {count} inputs, {:.0} % accepted", 100.0 * share);
        assert!((0.02..0.98).contains(&share), "{name}: {share}");
    }
}

#[test]
fn thousands_of_inputs_are_read_or_refused() {
    fuzz(FEW, 1, Duration::from_secs(60));
}

#[test]
#[ignore = "some ten minutes, cargo test --release --test main fuzz:: -- --ignored"]
fn a_million_scenes_and_a_million_tables_are_read_or_refused() {
    fuzz(MANY, 2, Duration::from_secs(1));
}
