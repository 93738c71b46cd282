//! Random scenes over the range of practice, as scene files.

use std::fmt::Write;

use fastrand::Rng;
use testkit::{between, log_between};

/// A scene file over the whole range: 5 to 300 m, 0.4 to 4 m deep, friction from 0.05 to 1, stiff and soft cables and sheaths, layers
/// and rock, springs and clamps, up to three vehicles of up to six wheels, both ways; without a tolerance.
#[allow(clippy::too_many_lines, reason = "a list of what a scene may hold")]
pub fn scene(seed: u64) -> String {
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
