//! The road's cross-section to scale: vehicles in their lanes, layers of the ground, the duct.

use ground_field::{Base, Direction, Modulus};

use super::chart::WIDTH;
use super::content::Report;
use crate::Scene;
use crate::figure::{Anchor, Drawing, Ink};
use crate::scene::TrafficVehicle;
use crate::shown::words_if;
use crate::words::{Reader, middle, round_below};

/// The ground's left and right edge \[px\].
const LEFT: f64 = 12.0;
const RIGHT: f64 = WIDTH - LEFT;
/// Where the road lies, below the title, two rows of signs and the vehicles, and height of a wheel \[px\].
const TITLE: f64 = 36.0;
const SURFACE: f64 = 96.0;
const WHEEL: f64 = 15.0;
/// Smallest half width of a wheel, and radius of a duct \[px\].
const SMALLEST: f64 = 3.5;
/// Road beside what lies outermost, and ground that is shown below the road \[depths of the duct\]; its height at most \[px\].
const BESIDE: f64 = 0.5;
const SHOWN: f64 = 1.4;
const DEEPEST: f64 = 250.0;
/// Rock that is drawn, and the longest bar of the scale \[px\].
const ROCK: f64 = 14.0;
const BAR: f64 = 70.0;
/// Opacity of the softest layer, and by how much more that of the stiffest is.
const OPACITY: [f64; 2] = [0.1, 0.35];

/// The drawing, and its caption.
pub fn section(report: &Report) -> (String, String) {
    let Report { scene, reader, .. } = report;
    let across = Across::new(scene);
    let high = (across.scale * scene.duct.depth * SHOWN).min(DEEPEST);
    let size = (WIDTH, SURFACE + high + 2.0 * Drawing::LINE);
    let mut drawing = Drawing::new("Cross-section of the road", size);
    drawing.title("Cross-section of the road", (0.5 * WIDTH, 0.5 * TITLE));
    ground(&mut drawing, scene, across.scale, high);
    // Where signs stand, those of vehicles that drive away above the others.
    let mut signs: [Vec<f64>; 2] = Default::default();
    for vehicle in &scene.vehicles {
        across.vehicle(&mut drawing, vehicle, &mut signs);
    }
    let (x, y) = (
        across.place(scene.duct.lateral_offset),
        SURFACE + across.scale * scene.duct.depth,
    );
    let inner = 0.5 * across.scale * scene.duct.inner_diameter.unwrap_or(0.0);
    let radius = inner.max(SMALLEST);
    drawing.area(&circle((x, y), radius), Ink::Series(0), 1.0);
    let label = format!("duct, {} deep", reader.depth(scene.duct.depth));
    let (beside, has_room) = (
        radius + 6.0,
        x + radius + 6.0 + Drawing::text_width(&label) < RIGHT,
    );
    let (x, anchor) = if has_room {
        (x + beside, Anchor::Start)
    } else {
        (x - beside, Anchor::End)
    };
    drawing.text(&label, (x, y), anchor);
    across.bar(&mut drawing, SURFACE + high + Drawing::LINE, reader);
    let enlarged = words_if(inner < SMALLEST, " The duct is drawn larger than it is.");
    let darker = words_if(scene.ground.thickness() > 0.0, " Stiffer layers are darker.");
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

/// Places of a vehicle's wheels to the left of the line from which the scene measures, and half their widths \[m\].
fn wheels(vehicle: &TrafficVehicle) -> impl Iterator<Item = (f64, f64)> {
    let wheels = vehicle.wheels().into_iter();
    wheels.map(|wheel| (wheel.y + vehicle.lateral_offset, wheel.contact_radius))
}

impl Across {
    fn new(scene: &Scene) -> Self {
        let duct = &scene.duct;
        let sides = scene.vehicles.iter().flat_map(wheels);
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

    /// A vehicle from behind or in front, and which way it drives where there is room beside the `signs` of others.
    fn vehicle(&self, drawing: &mut Drawing, vehicle: &TrafficVehicle, signs: &mut [Vec<f64>; 2]) {
        let axle = SURFACE - 0.6 * WHEEL;
        let x = self.place(middle(vehicle));
        for (place, half) in wheels(vehicle) {
            let (side, half) = (self.place(place), (self.scale * half).max(SMALLEST));
            drawing.line(&[(x, axle), (side, axle)], Ink::Dark, 2.0);
            drawing.area(
                &rectangle((side - half, SURFACE - WHEEL), (side + half, SURFACE)),
                Ink::Dark,
                1.0,
            );
        }
        let (sign, row) = match vehicle.direction {
            Direction::Forward => ("⊗", 1),
            Direction::Reverse => ("⊙", 0),
        };
        if signs[row]
            .iter()
            .all(|other| (other - x).abs() > Drawing::text_width(sign) + 8.0)
        {
            signs[row].push(x);
            let y = SURFACE - WHEEL - Drawing::LINE * (0.7 + row as f64);
            drawing.text(sign, (x, y), Anchor::Middle);
        }
    }

    /// How long a round length is.
    fn bar(&self, drawing: &mut Drawing, y: f64, reader: &Reader) {
        let unit = reader.units.length;
        let long = round_below(unit.of_si(BAR / self.scale)) / unit.of_si(1.0);
        let end = LEFT + self.scale * long;
        drawing.line(&[(LEFT, y), (end, y)], Ink::Dark, 2.0);
        for x in [LEFT, end] {
            drawing.line(&[(x, y - 4.0), (x, y + 4.0)], Ink::Dark, 1.2);
        }
        drawing.text(&reader.length(long), (end + 8.0, y), Anchor::Start);
    }
}

/// The layers, the stiffer the darker, and the base, as far as they are shown.
fn ground(drawing: &mut Drawing, scene: &Scene, scale: f64, high: f64) {
    let Ok(profile) = scene.ground.profile() else {
        return;
    };
    let mut layers: Vec<(f64, f64, f64)> = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let modulus = match layer.modulus() {
            Modulus::Uniform(modulus) => modulus,
            Modulus::Linear { top, bottom } => 0.5 * (top + bottom),
        };
        let bottom = top + scale * layer.thickness();
        layers.push((top, bottom, modulus.ln()));
        top = bottom;
    }
    if let Base::HalfSpace(soil) = profile.base() {
        layers.push((top, high.max(top), soil.young_modulus().ln()));
    }
    let moduli = || layers.iter().map(|(.., modulus)| *modulus);
    let (soft, stiff) = (
        moduli().fold(f64::INFINITY, f64::min),
        moduli().fold(f64::NEG_INFINITY, f64::max),
    );
    for (top, bottom, modulus) in layers.iter().filter(|(top, ..)| *top < high) {
        let share = if stiff > soft {
            (modulus - soft) / (stiff - soft)
        } else {
            0.3
        };
        let opacity = OPACITY[0] + share * OPACITY[1];
        let bottom = SURFACE + bottom.min(high);
        let layer = rectangle((LEFT, SURFACE + top), (RIGHT, bottom));
        drawing.area(&layer, Ink::Grey, (100.0 * opacity).round() / 100.0);
        drawing.line(&[(LEFT, bottom), (RIGHT, bottom)], Ink::Grey, 0.8);
    }
    if profile.base() == Base::Rigid && top < high {
        rock(drawing, SURFACE + top, (high - top).min(ROCK));
    }
    drawing.line(&[(LEFT, SURFACE), (RIGHT, SURFACE)], Ink::Dark, 2.0);
}

/// Hatching below a line.
fn rock(drawing: &mut Drawing, top: f64, high: f64) {
    drawing.line(&[(LEFT, top), (RIGHT, top)], Ink::Dark, 1.6);
    let step = 9.0;
    for k in 0..=((RIGHT - LEFT - high) / step) as u32 {
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
