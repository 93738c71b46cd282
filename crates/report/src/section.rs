//! The road's cross-section to scale: vehicles in their lanes, layers of the ground, the duct.

use ground_field::{Base, Direction, Modulus, SoilLayer};

use super::chart::WIDTH;
use super::content::Report;
use crate::words::{middle, range};
use creepage_plan::shown::words_if;
use creepage_scene::{Scene, TrafficVehicle};
use plain_figure::{Anchor, Drawing, Ink};

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
/// Opacity of the softest layer, by how much more that of the stiffest is, and that of rock.
const OPACITY: [f64; 2] = [0.1, 0.35];
const ROCK: f64 = 0.9;

/// The drawing, and its caption.
pub fn section(report: &Report) -> (String, String) {
    let Report { scene, reader, .. } = report;
    let across = Across::new(scene);
    let high = (across.scale * scene.duct.depth * SHOWN).min(DEEPEST);
    let size = (WIDTH, SURFACE + high + 0.5 * Drawing::LINE);
    let mut drawing = Drawing::new("Cross-section of the road", size);
    drawing.title("Cross-section of the road", (0.5 * WIDTH, 0.5 * TITLE));
    ground(&mut drawing, scene, across.scale, high);
    // Where signs stand, those of vehicles that drive away above the others.
    let mut signs: [Vec<f64>; 2] = Default::default();
    for vehicle in &scene.vehicles {
        across.vehicle(&mut drawing, vehicle, &mut signs);
    }
    let x = across.place(scene.duct.lateral_offset);
    let y = SURFACE + across.scale * scene.duct.depth;
    let inner = 0.5 * across.scale * scene.duct.inner_diameter.unwrap_or(0.0);
    let radius = inner.max(SMALLEST);
    drawing.area(&circle((x, y), radius), Ink::Series(0), 1.0);
    let label = format!("duct, {} deep", reader.depth(scene.duct.depth));
    let beside = radius + 6.0;
    if x + beside + Drawing::text_width(&label) < RIGHT {
        drawing.text(&label, (x + beside, y), Anchor::Start);
    } else {
        drawing.text(&label, (x - beside, y), Anchor::End);
    }
    let enlarged = words_if(inner < SMALLEST, " The duct is drawn larger than it is.");
    let darker = words_if(
        scene.ground.thickness() > 0.0,
        " Stiffer layers are darker, rock is the darkest.",
    );
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
        let [least, most] = range(sides.chain([duct.lateral_offset]));
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
            let tyre = rectangle((side - half, SURFACE - WHEEL), (side + half, SURFACE));
            drawing.line(&[(x, axle), (side, axle)], Ink::Dark, 2.0);
            drawing.area(&tyre, Ink::Dark, 1.0);
        }
        let (sign, row) = match vehicle.direction {
            Direction::Forward => ("⊗", 1),
            Direction::Reverse => ("⊙", 0),
        };
        let apart = Drawing::text_width(sign) + 8.0;
        if signs[row].iter().all(|other| (other - x).abs() > apart) {
            signs[row].push(x);
            let y = SURFACE - WHEEL - Drawing::LINE * (0.7 + row as f64);
            drawing.text(sign, (x, y), Anchor::Middle);
        }
    }
}

/// The layers, the stiffer the darker, and the base, as far as they are shown: rock is the darkest.
fn ground(drawing: &mut Drawing, scene: &Scene, scale: f64, high: f64) {
    let Ok(profile) = scene.ground.profile() else {
        return;
    };
    // Thickness \[m\] and logarithm of the modulus.
    let layer = |layer: &SoilLayer| {
        let modulus = match layer.modulus() {
            Modulus::Uniform(modulus) => modulus,
            Modulus::Linear { top, bottom } => 0.5 * (top + bottom),
        };
        (layer.thickness(), modulus.ln())
    };
    let mut layers: Vec<(f64, f64)> = profile.layers().iter().map(layer).collect();
    if let Base::HalfSpace(soil) = profile.base() {
        layers.push((f64::INFINITY, soil.young_modulus().ln()));
    }
    let [soft, stiff] = range(layers.iter().map(|(_, modulus)| *modulus));
    let shares = layers.iter().map(|(thickness, modulus)| {
        let share = (modulus - soft) / (stiff - soft);
        let share = if stiff > soft { share } else { 0.3 };
        (*thickness, OPACITY[0] + share * OPACITY[1])
    });
    let mut top = SURFACE;
    for (thickness, opacity) in shares.chain([(f64::INFINITY, ROCK)]) {
        let bottom = (top + scale * thickness).min(SURFACE + high);
        if bottom > top {
            let layer = rectangle((LEFT, top), (RIGHT, bottom));
            drawing.area(&layer, Ink::Grey, (100.0 * opacity).round() / 100.0);
            drawing.line(&[(LEFT, bottom), (RIGHT, bottom)], Ink::Grey, 0.8);
        }
        top = bottom;
    }
    drawing.line(&[(LEFT, SURFACE), (RIGHT, SURFACE)], Ink::Dark, 2.0);
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
