//! Random scenes over the range of practice, as scene files.

use std::fmt::Write;

use fastrand::Rng;
use testkit::{between, log_between};

/// What is particular about a scene.
pub const KINDS: [&str; 12] = [
    "homogeneous",
    "layered",
    "base",
    "axles",
    "long",
    "short",
    "deep",
    "soft",
    "fast",
    "many",
    "mixed",
    "coulomb",
];

/// A scene file of `kind`, drawn by `seed`; without a tolerance.
pub fn scene(kind: &str, seed: u64) -> String {
    let mut random = Rng::with_seed(seed);
    let random = &mut random;
    let mut text = String::new();
    let mut line = |content: String| {
        let _ = writeln!(text, "{content}");
    };
    let length = match kind {
        "long" => between(random, 150.0, 300.0),
        "short" => between(random, 8.0, 15.0),
        "many" => between(random, 40.0, 120.0),
        _ => between(random, 20.0, 80.0),
    };
    let depth = if kind == "deep" {
        between(random, 1.8, 3.0)
    } else {
        between(random, 0.6, 1.6)
    };
    let offset = *random.choice([0.0, 0.0, 0.3, 0.9].iter()).unwrap_or(&0.0);
    line(format!(
        "[duct]\nlength = {length}\ndepth = {depth}\nlateral_offset = {offset}"
    ));
    ground(random, kind, &mut line);
    let soft = kind == "soft" && random.bool();
    let (weight, stiffness) = if soft {
        (between(random, 80.0, 160.0), log_between(random, 5e5, 2e6))
    } else {
        (between(random, 60.0, 200.0), log_between(random, 1.5e6, 2e7))
    };
    line(format!(
        "[cable]\nweight = {weight}\naxial_stiffness = {stiffness}"
    ));
    line(format!("normal_load_factor = {}", between(random, 0.8, 1.5)));
    let friction = between(random, 0.2, 0.5);
    if kind == "coulomb" {
        line(format!(
            "[friction]\nlaw = \"coulomb\"\ndynamic_coefficient = {friction}"
        ));
    } else {
        let shape = log_between(random, 1e6, 5e7);
        line(format!(
            "[friction]\ndynamic_coefficient = {friction}\nshape_factor = {shape}"
        ));
    }
    ends(random, kind, &mut line);
    if kind == "mixed" && random.bool() {
        let position = length * between(random, 0.2, 0.9);
        let stiffness = log_between(random, 1e5, 1e7);
        line(format!(
            "[[restraints]]\nposition = {position}\nstiffness = {stiffness}"
        ));
    }
    vehicles(random, kind, &mut line);
    let passes = match kind {
        "many" => log_between(random, 2e3, 2e4) as u64,
        "long" => random.u64(20..100),
        _ => random.u64(20..200),
    };
    line(format!("[traffic]\npasses = {passes}"));
    text
}

fn ground(random: &mut Rng, kind: &str, line: &mut impl FnMut(String)) {
    line("[ground]".into());
    if kind == "base" {
        line(format!("rigid_base_depth = {}", between(random, 5.0, 20.0)));
    }
    if kind != "soft" && random.u8(0..4) == 0 {
        line(format!("vertical_peak = {}", between(random, 6e-5, 2e-4)));
    }
    if kind == "layered" || (kind == "base" && random.bool()) {
        for modulus in [log_between(random, 1e9, 8e9), log_between(random, 1e8, 1e9)]
            .iter()
            .take(random.usize(1..3))
        {
            line(format!(
                "[[ground.layers]]\nthickness = {}\nyoung_modulus = {modulus}\npoisson_ratio = 0.35",
                between(random, 0.03, 0.4)
            ));
        }
    }
    let modulus = if kind == "soft" {
        log_between(random, 4e7, 1.5e8)
    } else {
        log_between(random, 1.5e8, 9e8)
    };
    line(format!(
        "[[ground.layers]]\nyoung_modulus = {modulus}\npoisson_ratio = {}",
        between(random, 0.25, 0.47)
    ));
}

fn ends(random: &mut Rng, kind: &str, line: &mut impl FnMut(String)) {
    let spring = |random: &mut Rng| format!("{{ spring = {} }}", log_between(random, 1e5, 1e7));
    let fixed = || "\"fixed\"".to_owned();
    let free = || "\"free\"".to_owned();
    let (upstream, downstream) = match random.u8(0..if kind == "mixed" { 6 } else { 5 }) {
        0 | 1 => (free(), fixed()),
        2 => (free(), spring(random)),
        3 => (spring(random), spring(random)),
        4 => (fixed(), fixed()),
        _ => (spring(random), free()),
    };
    line(format!(
        "[ends]\nupstream = {upstream}\ndownstream = {downstream}"
    ));
}

fn vehicles(random: &mut Rng, kind: &str, line: &mut impl FnMut(String)) {
    let speed = if kind == "fast" {
        between(random, 30.0, 60.0)
    } else {
        between(random, 5.0, 25.0)
    };
    let load = between(random, 1e5, 2.5e5);
    let count = if kind == "mixed" { random.usize(1..4) } else { 1 };
    for number in 0..count {
        line(format!("[[vehicles]]\nname = \"v{number}\"\nspeed = {speed}"));
        if kind == "axles" || (kind != "homogeneous" && random.u8(0..4) == 0) {
            let radius = between(random, 0.1, 0.2);
            let mut wheels = String::new();
            for (x, share) in [(0.0, 0.275), (-5.0, 0.3625), (-6.3, 0.3625)] {
                for y in [-0.9, 0.9] {
                    let _ = write!(
                        wheels,
                        "{{ x = {x:?}, y = {y:?}, load = {}, contact_radius = {radius} }},",
                        0.5 * share * load
                    );
                }
            }
            line(format!("wheels = [{wheels}]"));
        } else {
            line(format!("load = {load}"));
        }
        if number > 0 && random.bool() {
            line("direction = \"reverse\"".into());
        }
        line(format!("share = {}", between(random, 0.2, 1.0)));
    }
}
