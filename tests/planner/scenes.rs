//! Random scenes over the range of practice, as scene files.

use std::fmt::Write;

use fastrand::Rng;

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

/// A scene file over the whole range: 5 to 300 m, 0.4 to 4 m deep, friction from 0.05 to 1, stiff and soft cables and sheaths, layers
/// and rock, springs and clamps, up to three vehicles of up to six wheels, both ways; without a tolerance.
pub fn wide(seed: u64) -> String {
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
