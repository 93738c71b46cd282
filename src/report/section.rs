//! The road's cross-section: lanes, layers of the ground, the duct.

use ground_field::{Base, Direction, Modulus};

use super::content::Report;
use super::figure::WIDTH;
use super::lanes::{Lane, lanes};
use super::quantity::{Shown, round_below, significant};
use crate::Scene;
use crate::figure::{Anchor, Drawing, Ink};
use crate::shown::words_if;

/// The ground's left and right edge \[px\].
const LEFT: f64 = 12.0;
const RIGHT: f64 = WIDTH - LEFT;
/// Where the road lies, below the title, two rows of signs and the vehicles, and height of a wheel \[px\].
const TITLE: f64 = 36.0;
const SURFACE: f64 = 96.0;
const WHEEL: f64 = 15.0;
/// Smallest half width of a wheel, and radius of a duct \[px\].
const SMALLEST: f64 = 3.5;
/// Lanes, and layers, that are drawn or named at most.
const MOST: usize = 6;
/// Road beside what lies outermost, and ground that is shown below the road \[depths of the duct\]; its height at most \[px\].
const BESIDE: f64 = 0.5;
const SHOWN: f64 = 1.4;
const DEEPEST: f64 = 250.0;
/// Rock that is drawn, and the longest bar of the scale \[px\].
const ROCK: f64 = 14.0;
const BAR: f64 = 70.0;
/// Opacity of the softest and of the stiffest layer.
const OPACITY: [f64; 2] = [0.1, 0.45];

/// The drawing, and its caption.
pub fn section(report: &Report) -> (String, String) {
    let Report { scene, shown, .. } = report;
    let all = lanes(scene);
    let drawn = &all[..all.len().min(MOST)];
    let across = Across::new(scene, drawn);
    let high = (across.scale * scene.duct.depth * SHOWN).min(DEEPEST);
    let mut names = names(&all);
    names.extend(layers(scene, shown));
    let bar = SURFACE + high + Drawing::LINE;
    let height = bar + Drawing::LINE * (names.len() as f64 + 1.0);

    let mut drawing = Drawing::new("Cross-section of the road", (WIDTH, height));
    drawing.title("Cross-section of the road", (0.5 * WIDTH, 0.5 * TITLE));
    ground(&mut drawing, scene, across.scale, high);
    // Signs stand in two rows; where both are taken, the list below alone names the lane.
    let mut signs: [Vec<f64>; 2] = Default::default();
    for (k, lane) in drawn.iter().enumerate() {
        vehicle(&mut drawing, &across, lane);
        sign(&mut drawing, &across, lane, k + 1, &mut signs);
    }
    let duct = (
        across.place(scene.duct.lateral_offset),
        SURFACE + across.scale * scene.duct.depth,
    );
    let inner = 0.5 * across.scale * scene.duct.inner_diameter.unwrap_or(0.0);
    drawing.area(&circle(duct, inner.max(SMALLEST)), Ink::Series(0), 1.0);
    let label = format!("duct, {} deep", shown.depth(scene.duct.depth));
    let beside = inner.max(SMALLEST) + 6.0;
    if duct.0 + beside + Drawing::text_width(&label) < RIGHT {
        drawing.text(&label, (duct.0 + beside, duct.1), Anchor::Start);
    } else {
        drawing.text(&label, (duct.0 - beside, duct.1), Anchor::End);
    }
    across.bar(&mut drawing, bar, shown);
    for (k, name) in names.iter().enumerate() {
        let y = bar + Drawing::LINE * (k as f64 + 1.2);
        drawing.text(name, (LEFT, y), Anchor::Start);
    }
    let enlarged = words_if(inner < SMALLEST, " The duct is drawn larger than it is.");
    let has_layers = scene.ground.thickness() > 0.0;
    let darker = words_if(has_layers, " Stiffer layers are darker.");
    let caption = format!(
        "The road seen along the duct toward growing x: ⊗ marks vehicles that drive away, ⊙ those that come. To scale but for the height of \
         wheels.{enlarged}{darker}"
    );
    (drawing.to_svg(), caption)
}

/// What lies how far across the road.
struct Across {
    /// Pixels a metre.
    scale: f64,
    /// The place at the middle of the drawing \[m\].
    middle: f64,
}

impl Across {
    fn new(scene: &Scene, lanes: &[Lane]) -> Self {
        let duct = &scene.duct;
        let sides = lanes.iter().flat_map(Lane::wheels);
        let sides = sides.flat_map(|(place, half)| [place - half, place + half]);
        let [least, most] = sides.fold([duct.lateral_offset; 2], |[least, most], side| {
            [least.min(side), most.max(side)]
        });
        let wide = most - least + 2.0 * BESIDE * duct.depth;
        Self {
            scale: ((RIGHT - LEFT) / wide).min(DEEPEST / (SHOWN * duct.depth)),
            middle: 0.5 * (least + most),
        }
    }

    /// Where something lies that is so far to the left of the scene's line \[px\].
    fn place(&self, left: f64) -> f64 {
        0.5 * WIDTH + self.scale * (self.middle - left)
    }

    /// How long a round length is.
    fn bar(&self, drawing: &mut Drawing, y: f64, shown: &Shown) {
        let unit = shown.units.length;
        let long = round_below(unit.of_si(BAR / self.scale)) / unit.of_si(1.0);
        let end = LEFT + self.scale * long;
        drawing.line(&[(LEFT, y), (end, y)], Ink::Dark, 2.0);
        for x in [LEFT, end] {
            drawing.line(&[(x, y - 4.0), (x, y + 4.0)], Ink::Dark, 1.2);
        }
        drawing.text(&shown.length(long), (end + 8.0, y), Anchor::Start);
    }
}

/// The heaviest vehicle of a lane, from behind or in front.
fn vehicle(drawing: &mut Drawing, across: &Across, lane: &Lane) {
    let wheels = lane.wheels();
    let ends = wheels
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], (place, _)| {
            let x = across.place(*place);
            [least.min(x), most.max(x)]
        });
    let axle = SURFACE - 0.6 * WHEEL;
    drawing.line(&ends.map(|x| (x, axle)), Ink::Dark, 2.0);
    for (place, half) in wheels {
        let (x, half) = (across.place(place), (across.scale * half).max(SMALLEST));
        drawing.area(
            &rectangle((x - half, SURFACE - WHEEL), (x + half, SURFACE)),
            Ink::Dark,
            1.0,
        );
    }
}

/// Which way a lane's vehicles drive and its number, above its middle in the first row of `signs` that has room there.
fn sign(drawing: &mut Drawing, across: &Across, lane: &Lane, number: usize, signs: &mut [Vec<f64>; 2]) {
    let way = match lane.direction {
        Direction::Forward => "⊗",
        Direction::Reverse => "⊙",
    };
    let (sign, x) = (format!("{way} {number}"), across.place(lane.middle));
    let room = Drawing::text_width(&sign) + 8.0;
    let is_free = |row: &usize| signs[*row].iter().all(|other| (other - x).abs() > room);
    if let Some(row) = (0..2).find(is_free) {
        signs[row].push(x);
        let y = SURFACE - WHEEL - Drawing::LINE * (0.7 + row as f64);
        drawing.text(&sign, (x, y), Anchor::Middle);
    }
}

/// Who drives in which lane.
fn names(lanes: &[Lane]) -> Vec<String> {
    let name = |(k, lane): (usize, &Lane)| {
        let rest = format!(", {}, {} %", lane.direction, significant(100.0 * lane.share));
        let whole = format!("{}: {}", k + 1, lane.name());
        // As much of a long name as there is room for.
        let mut room = RIGHT - LEFT - Drawing::text_width(&format!("…{rest}"));
        let has_room = |letter: &char| {
            room -= Drawing::text_width(letter.encode_utf8(&mut [0; 4]));
            room >= 0.0
        };
        let name: String = whole.chars().take_while(has_room).collect();
        let end = words_if(name.len() < whole.len(), "…");
        name + end + &rest
    };
    let mut names: Vec<String> = lanes.iter().take(MOST).enumerate().map(name).collect();
    if lanes.len() > MOST {
        names.push(format!(
            "and {} more lanes, which are not drawn",
            lanes.len() - MOST
        ));
    }
    names
}

/// Thickness and modulus of the layers from above to below, and the base.
fn layers(scene: &Scene, shown: &Shown) -> Vec<String> {
    let Ok(profile) = scene.ground.profile() else {
        return Vec::new();
    };
    let layer = |layer: &ground_field::SoilLayer| {
        format!(
            "{}, {}",
            shown.depth(layer.thickness()),
            shown.moduli(layer.modulus())
        )
    };
    let mut names: Vec<String> = profile.layers().iter().take(MOST).map(layer).collect();
    if profile.layers().len() > MOST {
        names.push(format!("and {} more layers", profile.layers().len() - MOST));
    }
    names.push(match profile.base() {
        Base::HalfSpace(soil) => {
            let below = if names.is_empty() { "ground of" } else { "below," };
            format!("{below} {}", shown.moduli(Modulus::Uniform(soil.young_modulus())))
        }
        Base::Rigid => format!("rock from {} on", shown.depth(profile.base_depth())),
    });
    names
}

/// The layers, the stiffer the darker, and the base, as far as they are shown.
fn ground(drawing: &mut Drawing, scene: &Scene, scale: f64, high: f64) {
    let Ok(profile) = scene.ground.profile() else {
        return;
    };
    let stiffness = |modulus: Modulus| match modulus {
        Modulus::Uniform(modulus) => modulus,
        Modulus::Linear { top, bottom } => 0.5 * (top + bottom),
    };
    let mut layers: Vec<(f64, f64, f64)> = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let bottom = top + scale * layer.thickness();
        layers.push((top, bottom, stiffness(layer.modulus())));
        top = bottom;
    }
    if let Base::HalfSpace(soil) = profile.base() {
        layers.push((top, high.max(top), soil.young_modulus()));
    }
    let [soft, stiff] = layers.iter().fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[least, most], (.., modulus)| [least.min(modulus.ln()), most.max(modulus.ln())],
    );
    for (top, bottom, modulus) in layers.iter().filter(|(top, ..)| *top < high) {
        let share = if stiff > soft {
            (modulus.ln() - soft) / (stiff - soft)
        } else {
            0.3
        };
        let opacity = OPACITY[0] + share * (OPACITY[1] - OPACITY[0]);
        let bottom = SURFACE + bottom.min(high);
        let layer = rectangle((LEFT, SURFACE + top), (RIGHT, bottom));
        drawing.area(&layer, Ink::Grey, (100.0 * opacity).round() / 100.0);
        drawing.line(&[(LEFT, bottom), (RIGHT, bottom)], Ink::Grey, 0.8);
    }
    if profile.base() == Base::Rigid && top < high {
        rock(drawing, SURFACE + top, SURFACE + high);
    }
    drawing.line(&[(LEFT, SURFACE), (RIGHT, SURFACE)], Ink::Dark, 2.0);
}

/// Hatching below a line.
fn rock(drawing: &mut Drawing, top: f64, bottom: f64) {
    drawing.line(&[(LEFT, top), (RIGHT, top)], Ink::Dark, 1.6);
    let (high, step) = ((bottom - top).min(ROCK), 9.0);
    let count = ((RIGHT - LEFT - high) / step).floor() as u32;
    for k in 0..=count {
        let x = LEFT + high + step * f64::from(k);
        drawing.line(&[(x, top), (x - high, top + high)], Ink::Dark, 0.8);
    }
}

fn rectangle((left, top): (f64, f64), (right, bottom): (f64, f64)) -> [(f64, f64); 4] {
    [(left, top), (right, top), (right, bottom), (left, bottom)]
}

fn circle((x, y): (f64, f64), radius: f64) -> Vec<(f64, f64)> {
    let corner = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
        (x + radius * cosine, y + radius * sine)
    };
    (0..24).map(corner).collect()
}
