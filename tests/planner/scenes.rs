//! Random scenes over the range of practice.

use std::fmt::Display;

use creepage::Scene;
use fastrand::Rng;
use testkit::{between, log_between};

use crate::scenes::scene_of;

/// What is particular about a scene.
pub const KINDS: &str = "homogeneous layered base axles long short deep soft fast many mixed coulomb";

/// A scene of `kind`, drawn by `seed`; without a tolerance.
pub fn scene(kind: &str, seed: u64) -> Scene {
    let mut random = Rng::with_seed(seed);
    let random = &mut random;
    let mut lines = Vec::new();
    let mut set = |key: &str, value: &dyn Display| lines.push(format!("{key} = {value}"));
    let length = match kind {
        "long" => between(random, 150.0, 300.0),
        "short" => between(random, 8.0, 15.0),
        "many" => between(random, 40.0, 120.0),
        _ => between(random, 20.0, 80.0),
    };
    let (least, most) = if kind == "deep" { (1.8, 3.0) } else { (0.6, 1.6) };
    set("duct.length", &length);
    set("duct.depth", &between(random, least, most));
    let offset = random.choice([0.0, 0.0, 0.3, 0.9]);
    set("duct.lateral_offset", &offset.unwrap_or(0.0));
    if kind == "base" {
        set("ground.rigid_base_depth", &between(random, 5.0, 20.0));
    }
    if kind != "soft" && random.u8(0..4) == 0 {
        set("ground.vertical_peak", &between(random, 6e-5, 2e-4));
    }
    set("ground.layers", &ground(random, kind));
    if kind == "soft" && random.bool() {
        set("cable.weight", &between(random, 80.0, 160.0));
        set("cable.axial_stiffness", &log_between(random, 5e5, 2e6));
    } else {
        set("cable.weight", &between(random, 60.0, 200.0));
        set("cable.axial_stiffness", &log_between(random, 1.5e6, 2e7));
    }
    set("cable.normal_load_factor", &between(random, 0.8, 1.5));
    set("friction.dynamic_coefficient", &between(random, 0.2, 0.5));
    if kind == "coulomb" {
        set("friction.law", &"\"coulomb\"");
    } else {
        set("friction.shape_factor", &log_between(random, 1e6, 5e7));
    }
    let [free, fixed] = ["\"free\"", "\"fixed\""].map(str::to_owned);
    let ends = random.u8(0..if kind == "mixed" { 6 } else { 5 });
    let mut spring = || format!("{{ spring = {} }}", log_between(random, 1e5, 1e7));
    let (upstream, downstream) = match ends {
        0 | 1 => (free, fixed),
        2 => (free, spring()),
        3 => (spring(), spring()),
        4 => (fixed.clone(), fixed),
        _ => (spring(), free),
    };
    set("ends.upstream", &upstream);
    set("ends.downstream", &downstream);
    if kind == "mixed" && random.bool() {
        let (position, stiffness) = (length * between(random, 0.2, 0.9), log_between(random, 1e5, 1e7));
        let clamp = format!("[{{ position = {position}, stiffness = {stiffness} }}]");
        set("restraints", &clamp);
    }
    set("vehicles", &vehicles(random, kind));
    let passes = match kind {
        "many" => log_between(random, 2e3, 2e4) as u64,
        "long" => random.u64(20..100),
        _ => random.u64(20..200),
    };
    set("traffic.passes", &passes);
    scene_of(&lines.join("\n"), &[])
}

fn ground(random: &mut Rng, kind: &str) -> String {
    let layer = |thickness: String, modulus: f64, poisson: f64| {
        format!("{{ {thickness}young_modulus = {modulus}, poisson_ratio = {poisson} }}, ")
    };
    let mut layers = String::new();
    if kind == "layered" || (kind == "base" && random.bool()) {
        let moduli = [log_between(random, 1e9, 8e9), log_between(random, 1e8, 1e9)];
        for modulus in moduli.into_iter().take(random.usize(1..3)) {
            let thickness = format!("thickness = {}, ", between(random, 0.03, 0.4));
            layers += &layer(thickness, modulus, 0.35);
        }
    }
    let (least, most) = if kind == "soft" {
        (4e7, 1.5e8)
    } else {
        (1.5e8, 9e8)
    };
    let modulus = log_between(random, least, most);
    layers += &layer(String::new(), modulus, between(random, 0.25, 0.47));
    format!("[{layers}]")
}

fn vehicles(random: &mut Rng, kind: &str) -> String {
    let (slow, fast) = if kind == "fast" { (30.0, 60.0) } else { (5.0, 25.0) };
    let (speed, load) = (between(random, slow, fast), between(random, 1e5, 2.5e5));
    let count = if kind == "mixed" { random.usize(1..4) } else { 1 };
    let mut vehicles = Vec::new();
    for number in 0..count {
        let carried = if kind == "axles" || (kind != "homogeneous" && random.u8(0..4) == 0) {
            let radius = between(random, 0.1, 0.2);
            let axles = [(0.0, 0.275), (-5.0, 0.3625), (-6.3, 0.3625)].into_iter();
            let wheels = axles.flat_map(|(x, share)| [-0.9, 0.9].map(|y| (x, y, 0.5 * share * load)));
            let wheel =
                |(x, y, load)| format!("{{ x = {x}, y = {y}, load = {load}, contact_radius = {radius} }}, ");
            format!("wheels = [{}]", wheels.map(wheel).collect::<String>())
        } else {
            format!("load = {load}")
        };
        let is_reverse = number > 0 && random.bool();
        let direction = if is_reverse { "reverse" } else { "forward" };
        let share = between(random, 0.2, 1.0);
        vehicles.push(format!(
            "{{ name = \"v{number}\", speed = {speed}, {carried}, direction = \"{direction}\", share = {share} }}"
        ));
    }
    format!("[{}]", vehicles.join(", "))
}
