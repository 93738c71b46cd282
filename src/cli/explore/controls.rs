//! What of a scene can be changed by hand: a slider for each of its numbers that a designer turns.

use serde::Serialize;

use crate::SceneFile;
use crate::scene::{Dimension as D, Typed, Unit};

/// A number of the scene.
#[derive(Serialize)]
pub struct Slider {
    /// The heading that it stands under.
    group: &'static str,
    key: String,
    name: String,
    unit: &'static str,
    /// The number in its unit; none of an end that is free or fixed.
    value: Option<f64>,
    /// Of an end: free, spring or fixed.
    held: Option<String>,
    /// Where the slider begins and ends, in the unit; it is logarithmic where it begins above zero.
    least: f64,
    most: f64,
}

/// Heading; key without the numbers of lists; name, with `#` for that number; dimension; where the slider begins and ends in this unit.
type Row = (
    &'static str,
    &'static str,
    &'static str,
    Option<D>,
    [f64; 2],
    &'static str,
);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("Duct", "duct.length", "length", Some(D::Length), [5.0, 2000.0], "m"),
    ("Duct", "duct.depth", "depth", Some(D::Length), [0.4, 5.0], "m"),
    ("Duct", "duct.slope", "slope", Some(D::Slope), [-15.0, 15.0], "%"),
    ("Duct", "duct.lateral_offset", "offset from the lane", Some(D::Length), [-6.0, 6.0], "m"),
    ("Ground", "ground.layers.thickness", "layer #, thickness", Some(D::Length), [0.02, 10.0], "m"),
    ("Ground", "ground.layers.young_modulus", "layer #, Young’s modulus", Some(D::Pressure), [10.0, 20_000.0], "MPa"),
    ("Ground", "ground.layers.young_modulus.top", "layer #, modulus at its top", Some(D::Pressure), [10.0, 20_000.0], "MPa"),
    ("Ground", "ground.layers.young_modulus.bottom", "layer #, at its bottom", Some(D::Pressure), [10.0, 20_000.0], "MPa"),
    ("Ground", "ground.rigid_base_depth", "depth of rock", Some(D::Length), [1.0, 100.0], "m"),
    ("Ground", "ground.vertical_peak", "deflection measured", Some(D::Length), [10.0, 1000.0], "um"),
    ("Ground", "ground.longitudinal_peak", "peak motion along the axis", Some(D::Length), [1.0, 200.0], "um"),
    ("Cable", "cable.weight", "weight", Some(D::Weight), [10.0, 1000.0], "N/m"),
    ("Cable", "cable.axial_stiffness", "axial stiffness EA", Some(D::Force), [5e5, 5e8], "N"),
    ("Cable", "cable.young_modulus", "Young’s modulus", Some(D::Pressure), [1.0, 200.0], "GPa"),
    ("Cable", "cable.conductor_area", "conductor area", Some(D::Area), [50.0, 3000.0], "mm2"),
    ("Cable", "cable.normal_load_factor", "normal load factor", None, [0.5, 5.0], ""),
    ("Cable", "friction.dynamic_coefficient", "friction coefficient", None, [0.0, 0.8], ""),
    ("Cable", "friction.shape_factor", "shape factor", Some(D::InverseLength), [1e4, 1e9], "1/m"),
    ("Ends and clamps", "ends.upstream", "upstream end", Some(D::ForcePerLength), [10.0, 1e6], "kN/m"),
    ("Ends and clamps", "ends.downstream", "downstream end", Some(D::ForcePerLength), [10.0, 1e6], "kN/m"),
    ("Ends and clamps", "restraints.position", "clamp #, place", Some(D::Length), [0.0, 10.0], "m"),
    ("Ends and clamps", "restraints.stiffness", "clamp #, stiffness", Some(D::ForcePerLength), [10.0, 1e6], "kN/m"),
    ("Ends and clamps", "restraints.holds", "clamp #, slips above", Some(D::Force), [0.05, 50.0], "kN"),
    ("Traffic", "vehicles.load", "vehicle #, load", Some(D::Force), [10.0, 500.0], "kN"),
    ("Traffic", "vehicles.share", "vehicle #, share", None, [0.01, 100.0], ""),
    ("Traffic", "traffic.passes", "passes", None, [1.0, 1e7], ""),
    ("Traffic", "traffic.years", "years", None, [0.1, 100.0], ""),
    ("Traffic", "traffic.per_day", "vehicles a day", None, [1.0, 20_000.0], ""),
    ("Heat", "heat.expansion", "expansion", Some(D::InverseTemperature), [5e-6, 3e-5], "1/K"),
    ("Heat", "heat.daily_swing", "daily swing", Some(D::Temperature), [0.0, 60.0], "K"),
    ("Heat", "heat.offset", "coldest above laying", Some(D::Temperature), [-40.0, 60.0], "K"),
];

/// The sliders of a scene, in the order of the table.
pub fn sliders(file: &SceneFile) -> Vec<Slider> {
    let typed = file.typed();
    let of_row = |row| typed.iter().map(move |typed| (row, typed));
    let pairs = ROWS.iter().flat_map(of_row);
    pairs
        .filter_map(|(row, typed)| Slider::new(row, typed, file))
        .collect()
}

impl Slider {
    /// The slider of a row for what was typed, if it is the row of that.
    fn new(row: &'static Row, typed: &Typed, file: &SceneFile) -> Option<Self> {
        let (group, key, name, dimension, range, usual) = *row;
        let is_end = key.starts_with("ends.");
        let (numbers, mut names): (Vec<&str>, Vec<&str>) = typed
            .key
            .split('.')
            .partition(|part| part.parse::<usize>().is_ok());
        names.truncate(if is_end { 2 } else { names.len() });
        let names = names
            .join(".")
            .replace("restraints.spring", "restraints.stiffness");
        let usual = dimension.and_then(|dimension| Unit::of(dimension, usual));
        let unit = dimension.and_then(|dimension| file.typed_unit(&typed.key, dimension));
        let unit = unit.or(usual);
        let in_unit = |si: f64| unit.map_or(si, |unit| unit.of_si(si));
        let parsed = |text: &str| match dimension {
            Some(dimension) => dimension.parse_argument(text).ok().map(in_unit),
            None => text.parse().ok(),
        };
        let is_held = ["free", "fixed"].contains(&&*typed.text);
        let value = parsed(&typed.text);
        if names != key || value.is_none() && !is_held {
            return None;
        }
        let [mut least, mut most] = range.map(|number| {
            let text = usual.map_or(number.to_string(), |usual| format!("{number} {}", usual.symbol()));
            parsed(&text).unwrap_or(number)
        });
        // What was typed has its place on the slider.
        if let Some(value) = value.filter(|value| least <= 0.0 || *value > 0.0) {
            (least, most) = (least.min(value), most.max(value));
        }
        let number = numbers.first().and_then(|number| number.parse::<usize>().ok());
        let held = if is_held { &typed.text } else { "spring" };
        Some(Self {
            group,
            name: name.replace('#', &(1 + number.unwrap_or_default()).to_string()),
            unit: unit.map_or("", |unit| unit.symbol()),
            value,
            held: is_end.then(|| held.to_owned()),
            least,
            most,
            key: if is_end { names } else { typed.key.clone() },
        })
    }
}
