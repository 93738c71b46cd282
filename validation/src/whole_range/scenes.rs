//! Random scenes over a wide range of every key: most values as a road has them, some from far beyond that.

use std::fmt::Write;

use fastrand::Rng;

/// Share of the values that come from the wide range.
const ANYWHERE: f64 = 0.06;

/// Draws values.
struct Draw {
    rng: Rng,
}

impl Draw {
    fn chance(&mut self, share: f64) -> bool {
        self.rng.f64() < share
    }

    fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * self.rng.f64()
    }

    /// Evenly over powers of ten.
    fn power(&mut self, [low, high]: [f64; 2]) -> f64 {
        10_f64.powf(self.between([low.log10(), high.log10()]))
    }

    /// From the range that is usual, or from a wide one.
    fn value(&mut self, usual: [f64; 2], wide: [f64; 2]) -> f64 {
        let range = if self.chance(ANYWHERE) { wide } else { usual };
        self.power(range)
    }

    fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.rng.usize(..of.len())]
    }
}

/// The scene of this number, as text.
pub fn scene(number: u64) -> String {
    let mut draw = Draw {
        rng: Rng::with_seed(number),
    };
    let mut text = String::new();
    let depth = draw.value([0.6, 3.0], [0.05, 50.0]);
    let length = draw.value([4.0, 300.0], [0.5, 3000.0]);
    duct(&mut draw, &mut text, length, depth);
    ground(&mut draw, &mut text, depth);
    cable(&mut draw, &mut text);
    held(&mut draw, &mut text, length);
    let is_heated = draw.chance(0.12);
    let names = vehicles(&mut draw, &mut text);
    traffic(&mut draw, &mut text, &names, is_heated);
    if is_heated {
        heat(&mut draw, &mut text);
    }
    solver(&mut draw, &mut text);
    text
}

fn line(text: &mut String, key: &str, value: impl std::fmt::Display) {
    writeln!(text, "{key} = {value}").expect("a text grows");
}

fn duct(draw: &mut Draw, text: &mut String, length: f64, depth: f64) {
    text.push_str("[duct]\n");
    line(text, "length", length);
    line(text, "depth", depth);
    if draw.chance(0.2) {
        let offset = draw.between([-4.0, 4.0]);
        line(text, "lateral_offset", offset);
    }
    if draw.chance(0.2) {
        let range = if draw.chance(ANYWHERE) {
            [-1.0, 1.0]
        } else {
            [-0.08, 0.08]
        };
        let slope = draw.between(range);
        line(text, "slope", slope);
    }
}

fn ground(draw: &mut Draw, text: &mut String, depth: f64) {
    text.push_str("[ground]\n");
    if draw.chance(0.1) {
        let model = draw.one(&["auto", "burmister", "burmister"]);
        line(text, "model", format!("\"{model}\""));
    }
    if draw.chance(0.25) {
        let rock = depth + draw.value([0.5, 20.0], [0.01, 5000.0]);
        line(text, "rigid_base_depth", rock);
    }
    match draw.rng.u8(..20) {
        0 => line(text, "vertical_peak", draw.value([30e-6, 600e-6], [1e-9, 0.01])),
        1 => line(
            text,
            "longitudinal_peak",
            draw.value([5e-6, 100e-6], [1e-9, 0.01]),
        ),
        _ => {}
    }
    let layers = match draw.rng.u8(..20) {
        0 => 1 + draw.rng.u8(..30),
        1..=10 => 1,
        _ => 2 + draw.rng.u8(..3),
    };
    for layer in 1..=layers {
        text.push_str("[[ground.layers]]\n");
        if layer < layers {
            line(text, "thickness", draw.value([0.05, 0.6], [0.005, 20.0]));
        }
        line(text, "young_modulus", draw.value([2e7, 3e9], [1e4, 1e12]));
        let range = if draw.chance(ANYWHERE) {
            [0.0, 0.5]
        } else {
            [0.15, 0.48]
        };
        let ratio = draw.between(range);
        line(text, "poisson_ratio", ratio);
    }
}

fn cable(draw: &mut Draw, text: &mut String) {
    text.push_str("[cable]\n");
    line(text, "weight", draw.value([20.0, 400.0], [0.1, 1e5]));
    line(text, "axial_stiffness", draw.value([2e6, 5e8], [1e3, 1e12]));
    if draw.chance(0.2) {
        line(text, "normal_load_factor", draw.value([1.0, 2.0], [0.01, 100.0]));
    }
    text.push_str("[friction]\n");
    line(text, "dynamic_coefficient", draw.value([0.1, 0.6], [1e-4, 10.0]));
    if draw.chance(0.3) {
        line(text, "law", "\"coulomb\"");
    } else {
        line(text, "shape_factor", draw.value([1e6, 1e8], [1.0, 1e18]));
    }
}

fn held(draw: &mut Draw, text: &mut String, length: f64) {
    text.push_str("[ends]\n");
    for end in ["upstream", "downstream"] {
        let held = match draw.rng.u8(..3) {
            0 => "\"free\"".to_owned(),
            1 => "\"fixed\"".to_owned(),
            _ => format!("{{ spring = {} }}", draw.value([1e4, 1e8], [1e-3, 1e15])),
        };
        line(text, end, held);
    }
    if draw.chance(0.2) {
        for _ in 0..=draw.rng.u8(..4) {
            text.push_str("[[restraints]]\n");
            let position = draw.between([0.0, length]);
            line(text, "position", position);
            line(text, "stiffness", draw.value([1e4, 1e8], [1e-3, 1e15]));
        }
    }
}

fn vehicles(draw: &mut Draw, text: &mut String) -> Vec<String> {
    let count = match draw.rng.u8(..20) {
        0 => 4 + draw.rng.u8(..8),
        1..=10 => 1,
        _ => 2 + draw.rng.u8(..2),
    };
    let two_way = draw.chance(0.4);
    let names: Vec<String> = (1..=count).map(|number| format!("v{number}")).collect();
    for name in &names {
        text.push_str("[[vehicles]]\n");
        line(text, "name", format!("\"{name}\""));
        line(text, "speed", draw.value([5.0, 30.0], [0.01, 200.0]));
        if two_way && draw.chance(0.5) {
            line(text, "direction", "\"reverse\"");
        }
        if draw.chance(0.3) {
            let lane = draw.between([-6.0, 6.0]);
            line(text, "lateral_offset", lane);
        }
        if count > 1 {
            line(text, "share", 1 + draw.rng.u32(..3));
        }
        if draw.chance(0.3) {
            line(text, "load", draw.value([2e4, 3e5], [1.0, 1e7]));
            continue;
        }
        let axles = 1 + draw.rng.u8(..4);
        let mut x = 0.0;
        let wheels: Vec<String> = (0..axles)
            .flat_map(|_| {
                let load = draw.value([1e4, 6e4], [1.0, 1e6]);
                let radius = draw.value([0.08, 0.25], [0.001, 2.0]);
                let gauge = draw.between([0.8, 1.1]);
                let wheel =
                    |y: f64| format!("{{ x = {x}, y = {y}, load = {load}, contact_radius = {radius} }}");
                let pair = [wheel(gauge), wheel(-gauge)];
                x -= draw.between([1.2, 6.0]);
                pair
            })
            .collect();
        line(text, "wheels", format!("[{}]", wheels.join(", ")));
    }
    names
}

fn traffic(draw: &mut Draw, text: &mut String, names: &[String], is_heated: bool) {
    text.push_str("[traffic]\n");
    if is_heated {
        let per_day = draw.value([50.0, 3000.0], [1.0, 1e5]).round();
        line(text, "per_day", per_day);
        let days = draw.value([1.0, 10_000.0], [0.1, 1e6]);
        line(text, "passes", (days * per_day).ceil().max(1.0));
    } else {
        line(text, "passes", draw.value([1.0, 1e7], [1.0, 1e12]).round());
    }
    match draw.rng.u8(..12) {
        0 => {
            line(text, "order", "\"random\"");
            line(text, "seed", draw.rng.u16(..));
        }
        1 if names.len() > 1 => {
            let places = 2 + draw.rng.usize(..8);
            let sequence: Vec<String> = (0..places)
                .map(|_| format!("\"{}\"", names[draw.rng.usize(..names.len())]))
                .collect();
            line(text, "sequence", format!("[{}]", sequence.join(", ")));
        }
        _ => {}
    }
}

fn heat(draw: &mut Draw, text: &mut String) {
    text.push_str("[heat]\n");
    line(text, "expansion", draw.value([8e-6, 25e-6], [1e-8, 1e-3]));
    line(text, "daily_swing", draw.value([2.0, 40.0], [0.01, 500.0]));
    if draw.chance(0.3) {
        let offset = draw.between([-30.0, 30.0]);
        line(text, "offset", offset);
    }
}

fn solver(draw: &mut Draw, text: &mut String) {
    text.push_str("[solver]\n");
    line(text, "tolerance", draw.value([0.01, 0.05], [0.0005, 0.5]));
    if draw.chance(0.04) {
        let method = draw.one(&["quasi-static", "explicit", "pass-law"]);
        line(text, "method", format!("\"{method}\""));
    }
    if draw.chance(0.02) {
        line(text, "node_spacing", draw.value([0.05, 0.5], [0.001, 10.0]));
    }
}
