//! The road's cross-section: lanes, layers of the ground, the duct.

use ground_field::{Base, Direction, Modulus};

use super::content::Report;
use super::figure::WIDTH;
use super::labels;
use super::lanes::{Lane, lanes};
use super::quantity::{Shown, round_below, significant};
use crate::Scene;
use crate::figure::{Anchor, Drawing, Ink};

/// The ground's left and right edge \[px\].
const LEFT: f64 = 12.0;
const RIGHT: f64 = 214.0;
/// Where the road lies, below the title and the vehicles, and height of a wheel \[px\].
const TITLE: f64 = 36.0;
const SURFACE: f64 = 84.0;
const WHEEL: f64 = 15.0;
/// Distance of lanes' signs with their numbers, at least \[px\].
const SIGN: f64 = 36.0;
/// Smallest half width of a wheel, and radius of a duct \[px\].
const SMALLEST: f64 = 3.5;
/// Lanes that are drawn at most.
const MOST: usize = 6;
/// Road beside what lies outermost, as a share of the depth.
const BESIDE: f64 = 0.5;
/// Most and least height of the ground: two lines of text for each label \[px\].
const DEEPEST: f64 = 250.0;
const SHALLOWEST: f64 = labels::ROOM * labels::MOST as f64;
/// Ground that is always shown \[depths of the duct\], half-space below its layers, and rock \[px\].
const SHOWN: f64 = 1.4;
const BELOW: f64 = 0.5;
const ROCK: f64 = 14.0;
/// Longest bar of the scale \[px\].
const BAR: f64 = 70.0;
/// Opacity of the softest and of the stiffest layer.
const OPACITY: [f64; 2] = [0.1, 0.45];

/// The drawing, and its caption.
pub fn section(report: &Report) -> (String, String) {
    let Report { scene, shown, .. } = report;
    let all = lanes(scene);
    let drawn = &all[..all.len().min(MOST)];
    let wheels: Vec<Vec<(f64, f64)>> = drawn.iter().map(Lane::wheels).collect();
    let across = Across::new(scene, &wheels);
    let high = across.height(scene);
    let place = |depth: f64| (across.scale * depth).min(high);
    let scale = SURFACE + high + Drawing::LINE;
    let names = names(&all);
    let height = scale + Drawing::LINE * (names.len() as f64 + 1.0);

    let mut drawing = Drawing::new("Cross-section of the road", (WIDTH, height));
    drawing.title("Cross-section of the road", (0.5 * WIDTH, 0.5 * TITLE));
    let is_cut = ground(&mut drawing, scene, &across, high);
    let signs = signs(&across, drawn);
    for (k, (lane, wheels)) in drawn.iter().zip(&wheels).enumerate() {
        let number = (all.len() > 1).then_some(k + 1);
        vehicle(&mut drawing, &across, lane, wheels, number, signs[k]);
    }
    let duct = (
        across.place(scene.duct.lateral_offset),
        SURFACE + place(scene.duct.depth),
    );
    let inner = 0.5 * across.scale * scene.duct.inner_diameter.unwrap_or(0.0);
    drawing.area(&circle(duct, inner.max(SMALLEST)), Ink::Series(0), 1.0);
    labels::draw(
        &mut drawing,
        report,
        (SURFACE, high),
        (duct.0 + SMALLEST, RIGHT),
        place,
    );
    across.bar(&mut drawing, scale, shown);
    for (k, name) in names.iter().enumerate() {
        let y = scale + Drawing::LINE * (k as f64 + 1.2);
        drawing.text(name, (LEFT, y), Anchor::Start);
    }
    let cut = if is_cut {
        "; what lies deeper than the drawing is named beside it"
    } else {
        ""
    };
    let enlarged = if inner < SMALLEST {
        " The duct is drawn larger than it is."
    } else {
        ""
    };
    let darker = if scene.ground.profile.layers().is_empty() {
        ""
    } else {
        " Stiffer layers are darker."
    };
    let caption = format!(
        "The road seen along the duct toward growing x. A cross marks vehicles that drive away, a dot those that come. To scale but for \
         the height of wheels{cut}.{enlarged}{darker}"
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
    fn new(scene: &Scene, wheels: &[Vec<(f64, f64)>]) -> Self {
        let Scene { duct, .. } = scene;
        let sides = wheels.iter().flatten();
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
        0.5 * (LEFT + RIGHT) + self.scale * (self.middle - left)
    }

    /// Height of the ground that is shown \[px\].
    fn height(&self, scene: &Scene) -> f64 {
        let (profile, depth) = (&scene.ground.profile, scene.duct.depth);
        let layers: f64 = profile
            .layers()
            .iter()
            .map(ground_field::SoilLayer::thickness)
            .sum();
        let wanted = match profile.base() {
            Base::Rigid => self.scale * layers + ROCK,
            Base::HalfSpace(_) => self.scale * (layers + BELOW * depth),
        };
        wanted.max(self.scale * SHOWN * depth).clamp(SHALLOWEST, DEEPEST)
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

/// Where the signs of lanes stand \[px\]: above the lane, or beside the sign of the next lane to the left.
fn signs(across: &Across, lanes: &[Lane]) -> Vec<f64> {
    let mut places: Vec<f64> = lanes.iter().map(|lane| across.place(lane.middle)).collect();
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    for pair in order.windows(2) {
        places[pair[1]] = places[pair[1]].max(places[pair[0]] + SIGN);
    }
    places
}

/// A vehicle from behind or in front, with its sign at `sign` \[px\].
fn vehicle(
    drawing: &mut Drawing,
    across: &Across,
    lane: &Lane,
    wheels: &[(f64, f64)],
    number: Option<usize>,
    sign: f64,
) {
    let places = || wheels.iter().map(|(place, _)| across.place(*place));
    let (from, to) = (
        places().fold(f64::INFINITY, f64::min),
        places().fold(f64::NEG_INFINITY, f64::max),
    );
    let axle = SURFACE - 0.6 * WHEEL;
    drawing.line(&[(from, axle), (to, axle)], Ink::Dark, 2.0);
    for (place, half) in wheels {
        let (x, half) = (across.place(*place), (across.scale * half).max(SMALLEST));
        let box_of = rectangle((x - half, SURFACE - WHEEL), (x + half, SURFACE));
        drawing.area(&box_of, Ink::Dark, 1.0);
    }
    let centre = (sign, SURFACE - WHEEL - 18.0);
    let radius = 7.0;
    let foot = (across.place(lane.middle), axle);
    drawing.line(&[(centre.0, centre.1 + radius), foot], Ink::Grey, 0.8);
    let mut ring = circle(centre, radius);
    ring.extend(ring.first().copied());
    drawing.line(&ring, Ink::Dark, 1.4);
    match lane.direction {
        Direction::Forward => {
            let arm = radius * std::f64::consts::FRAC_1_SQRT_2;
            for sign in [-1.0, 1.0] {
                let ends = [-arm, arm].map(|x| (centre.0 + x, centre.1 + sign * x));
                drawing.line(&ends, Ink::Dark, 1.4);
            }
        }
        Direction::Reverse => drawing.area(&circle(centre, 2.4), Ink::Dark, 1.0),
    }
    if let Some(number) = number {
        let place = (centre.0 - radius - 4.0, centre.1);
        drawing.text(&number.to_string(), place, Anchor::End);
    }
}

/// Who drives in which lane.
fn names(lanes: &[Lane]) -> Vec<String> {
    let room = WIDTH - 2.0 * LEFT;
    let name = |(k, lane): (usize, &Lane)| {
        let number = if lanes.len() > 1 {
            format!("{}: ", k + 1)
        } else {
            String::new()
        };
        let way = format!(", {}, {} %", lane.direction, significant(100.0 * lane.share()));
        let mut name = lane.name();
        let mut text = format!("{number}{name}{way}");
        while Drawing::text_width(&text) > room && name.pop().is_some() {
            text = format!("{number}{name}…{way}");
        }
        text
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

/// The layers, the stiffer the darker, and the base, as far as they are shown; whether there is more.
fn ground(drawing: &mut Drawing, scene: &Scene, across: &Across, high: f64) -> bool {
    let profile = &scene.ground.profile;
    let stiffness = |modulus: Modulus| match modulus {
        Modulus::Uniform(modulus) => modulus,
        Modulus::Linear { top, bottom } => 0.5 * (top + bottom),
    };
    let mut layers: Vec<(f64, f64, f64)> = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let bottom = top + across.scale * layer.thickness();
        layers.push((top, bottom, stiffness(layer.modulus())));
        top = bottom;
    }
    if let Base::HalfSpace(soil) = profile.base() {
        layers.push((top, high.max(top), soil.young_modulus()));
    }
    let all = || layers.iter().map(|(.., modulus)| modulus.ln());
    let (soft, stiff) = (
        all().fold(f64::INFINITY, f64::min),
        all().fold(f64::NEG_INFINITY, f64::max),
    );
    for (top, bottom, modulus) in layers.iter().filter(|(top, ..)| *top < high) {
        let share = if stiff > soft {
            (modulus.ln() - soft) / (stiff - soft)
        } else {
            0.3
        };
        let opacity = OPACITY[0] + share * (OPACITY[1] - OPACITY[0]);
        let opacity = (100.0 * opacity).round() / 100.0;
        let bottom = SURFACE + bottom.min(high);
        let layer = rectangle((LEFT, SURFACE + top), (RIGHT, bottom));
        drawing.area(&layer, Ink::Grey, opacity);
        drawing.line(&[(LEFT, bottom), (RIGHT, bottom)], Ink::Grey, 0.8);
    }
    if profile.base() == Base::Rigid && top < high {
        rock(drawing, SURFACE + top, SURFACE + high);
    }
    drawing.line(&[(LEFT, SURFACE), (RIGHT, SURFACE)], Ink::Dark, 2.0);
    top >= high
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
