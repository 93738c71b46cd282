//! The road's cross-section: lanes, layers of the ground, the duct.

use ground_field::{Base, Direction, Modulus};

use super::content::Report;
use super::depths::Depths;
use super::figure::WIDTH;
use super::labels::{Label, labels, spread};
use super::lanes::{Lane, lanes};
use super::quantity::{Shown, round_below, significant};
use crate::Scene;
use crate::figure::{Anchor, Drawing, Ink};

/// The ground's left and right edge \[px\].
const LEFT: f64 = 12.0;
const RIGHT: f64 = 214.0;
/// Height of the title, of a row of vehicles, and of a wheel \[px\].
const TITLE: f64 = 36.0;
const ROW: f64 = 46.0;
const WHEEL: f64 = 15.0;
/// Room that a lane's sign and number take to either side \[px\].
const SIGN: f64 = 20.0;
/// Smallest half width of a wheel, and radius of a duct \[px\].
const SMALLEST: f64 = 3.5;
/// Lanes that are drawn at most.
const MOST: usize = 6;
/// Road beside what lies outermost, as a share of the depth.
const BESIDE: f64 = 0.5;
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
    let depths = Depths::new(scene, across.scale);
    let rows = rows(&across, drawn, &wheels);
    let surface = TITLE + ROW * (1 + rows.iter().max().unwrap_or(&0)) as f64;
    let bottom = surface + depths.height();
    let mut labels = labels(report, &depths);
    spread(&mut labels, surface, bottom);
    let lowest = labels.last().map_or(bottom, Label::bottom).max(bottom);
    let scale = lowest + Drawing::LINE;
    let names = names(&all);
    let height = scale + Drawing::LINE * (names.len() as f64 + 1.0);

    let mut drawing = Drawing::new("Cross-section of the road", (WIDTH, height));
    drawing.title("Cross-section of the road", (0.5 * WIDTH, 0.5 * TITLE));
    ground(&mut drawing, scene, &depths, surface);
    for ((lane, wheels), (k, row)) in drawn.iter().zip(&wheels).zip(rows.iter().enumerate()) {
        let number = (all.len() > 1).then_some(k + 1);
        vehicle(
            &mut drawing,
            &across,
            lane,
            wheels,
            number,
            surface - ROW * *row as f64,
        );
    }
    let duct = (
        across.place(scene.duct.lateral_offset),
        surface + depths.place(scene.duct.depth),
    );
    let inner = 0.5 * across.scale * scene.duct.inner_diameter.unwrap_or(0.0);
    drawing.area(&circle(duct, inner.max(SMALLEST)), Ink::Series(0), 1.0);
    for label in &labels {
        label.draw(&mut drawing, duct.0 + SMALLEST, RIGHT);
    }
    across.bar(&mut drawing, scale, shown);
    for (k, name) in names.iter().enumerate() {
        let y = scale + Drawing::LINE * (k as f64 + 1.2);
        drawing.text(name, (LEFT, y), Anchor::Start);
    }
    let cut = if depths.is_cut() {
        "; the ground below the break is not"
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
            scale: ((RIGHT - LEFT) / wide).min(Depths::largest_scale(duct.depth)),
            middle: 0.5 * (least + most),
        }
    }

    /// Where something lies that is so far to the left of the scene's line \[px\].
    fn place(&self, left: f64) -> f64 {
        0.5 * (LEFT + RIGHT) + self.scale * (self.middle - left)
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

/// The row of each lane: 0 on the road, 1 above what it would cover, and so on.
fn rows(across: &Across, lanes: &[Lane], wheels: &[Vec<(f64, f64)>]) -> Vec<usize> {
    let mut rows: Vec<(usize, [f64; 2])> = Vec::new();
    for (lane, wheels) in lanes.iter().zip(wheels) {
        let sign = across.place(lane.middle);
        let from = wheels.iter().fold(sign - SIGN, |from, (place, half)| {
            from.min(across.place(*place) - across.scale * half)
        });
        let to = wheels.iter().fold(sign + SIGN, |to, (place, half)| {
            to.max(across.place(*place) + across.scale * half)
        });
        let free = |row: &usize| {
            let mut same = rows.iter().filter(|(other, _)| other == row);
            same.all(|(_, [left, right])| to < *left || from > *right)
        };
        let row = (0..rows.len()).find(free).unwrap_or(rows.len());
        rows.push((row, [from, to]));
    }
    rows.into_iter().map(|(row, _)| row).collect()
}

/// A vehicle from behind or in front, on a road at `road` \[px\].
fn vehicle(
    drawing: &mut Drawing,
    across: &Across,
    lane: &Lane,
    wheels: &[(f64, f64)],
    number: Option<usize>,
    road: f64,
) {
    let places = || wheels.iter().map(|(place, _)| across.place(*place));
    let (from, to) = (
        places().fold(f64::INFINITY, f64::min),
        places().fold(f64::NEG_INFINITY, f64::max),
    );
    let axle = road - 0.6 * WHEEL;
    drawing.line(&[(from, axle), (to, axle)], Ink::Dark, 2.0);
    for (place, half) in wheels {
        let (x, half) = (across.place(*place), (across.scale * half).max(SMALLEST));
        let box_of = rectangle((x - half, road - WHEEL), (x + half, road));
        drawing.area(&box_of, Ink::Dark, 1.0);
    }
    let centre = (across.place(lane.middle), road - WHEEL - 14.0);
    let radius = 7.0;
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

/// The layers, the stiffer the darker, and the base.
fn ground(drawing: &mut Drawing, scene: &Scene, depths: &Depths, surface: f64) {
    let profile = &scene.ground.profile;
    let stiffness = |modulus: Modulus| match modulus {
        Modulus::Uniform(modulus) => modulus,
        Modulus::Linear { top, bottom } => 0.5 * (top + bottom),
    };
    let mut layers: Vec<(f64, f64, f64)> = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let bottom = top + layer.thickness();
        layers.push((
            depths.place(top),
            depths.place(bottom),
            stiffness(layer.modulus()),
        ));
        top = bottom;
    }
    let below = (depths.place(top), depths.height());
    if let Base::HalfSpace(soil) = profile.base() {
        layers.push((below.0, below.1, soil.young_modulus()));
    }
    let all = || layers.iter().map(|(.., modulus)| modulus.ln());
    let (soft, stiff) = (
        all().fold(f64::INFINITY, f64::min),
        all().fold(f64::NEG_INFINITY, f64::max),
    );
    for (top, bottom, modulus) in &layers {
        let share = if stiff > soft {
            (modulus.ln() - soft) / (stiff - soft)
        } else {
            0.3
        };
        let opacity = OPACITY[0] + share * (OPACITY[1] - OPACITY[0]);
        let opacity = (100.0 * opacity).round() / 100.0;
        let layer = rectangle((LEFT, surface + top), (RIGHT, surface + bottom));
        drawing.area(&layer, Ink::Grey, opacity);
        drawing.line(
            &[(LEFT, surface + bottom), (RIGHT, surface + bottom)],
            Ink::Grey,
            0.8,
        );
    }
    if profile.base() == Base::Rigid {
        rock(drawing, surface + below.0, surface + below.1);
    }
    if let Some(cut) = depths.cut() {
        let count = 16;
        let step = (RIGHT - LEFT) / f64::from(count);
        let zigzag = |y: f64| -> Vec<(f64, f64)> {
            let point = |k: u32| {
                (
                    LEFT + step * f64::from(k),
                    y + if k.is_multiple_of(2) { -3.0 } else { 3.0 },
                )
            };
            (0..=count).map(point).collect()
        };
        for y in [cut - 3.0, cut + 3.0] {
            drawing.line(&zigzag(surface + y), Ink::Dark, 1.2);
        }
    }
    drawing.line(&[(LEFT, surface), (RIGHT, surface)], Ink::Dark, 2.0);
}

/// Hatching below a line.
fn rock(drawing: &mut Drawing, top: f64, bottom: f64) {
    drawing.line(&[(LEFT, top), (RIGHT, top)], Ink::Dark, 1.6);
    let (high, step) = (bottom - top, 9.0);
    let count = ((RIGHT - LEFT - high) / step).floor() as u32;
    for k in 0..=count {
        let x = LEFT + high + step * f64::from(k);
        drawing.line(&[(x, top), (x - high, bottom)], Ink::Dark, 0.8);
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
