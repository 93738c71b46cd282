//! Reference systems and figures: each is a ground, a load and the exact displacement at a set of points.

#![allow(dead_code, reason = "each test program uses its own part")]

use std::collections::BTreeMap;
use std::f64::consts::PI;

use ground_field::{Base, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad};

/// A ground and a load.
pub struct Case {
    pub profile: SoilProfile,
    pub load: SurfaceLoad,
}

/// Exact displacement at one point: radius \[m\], `u_r` \[m\], `u_z` \[m\].
#[derive(Clone, Copy)]
pub struct Point {
    pub radius: f64,
    pub radial: f64,
    pub vertical: f64,
}

/// Rows of points by case and by depth in micrometres.
pub type Table = BTreeMap<String, BTreeMap<u64, Vec<Point>>>;

/// Soil from `MPa`.
pub fn soil(young_modulus: f64, poisson_ratio: f64) -> Soil {
    testkit::soil(young_modulus * 1e6, poisson_ratio)
}

/// Uniform layer from metres and `MPa`.
pub fn layer(thickness: f64, young_modulus: f64, poisson_ratio: f64) -> SoilLayer {
    testkit::layer(thickness, soil(young_modulus, poisson_ratio))
}

/// Layer with linear modulus from metres and `MPa`.
pub fn graded(thickness: f64, top: f64, bottom: f64, poisson_ratio: f64) -> SoilLayer {
    let modulus = Modulus::Linear {
        top: top * 1e6,
        bottom: bottom * 1e6,
    };
    SoilLayer::new(thickness, modulus, poisson_ratio).unwrap()
}

/// Layers on a half-space (`MPa`).
pub fn on_soil(layers: Vec<SoilLayer>, young_modulus: f64, poisson_ratio: f64) -> SoilProfile {
    SoilProfile::new(layers, Base::HalfSpace(soil(young_modulus, poisson_ratio))).unwrap()
}

/// Layers on rock.
pub fn on_rock(layers: Vec<SoilLayer>) -> SoilProfile {
    SoilProfile::new(layers, Base::Rigid).unwrap()
}

fn ten_layers() -> SoilProfile {
    let layers = vec![
        layer(0.04, 6000.0, 0.35),
        layer(0.06, 800.0, 0.3),
        layer(0.2, 3000.0, 0.25),
        layer(0.15, 90.0, 0.4),
        layer(0.25, 400.0, 0.35),
        layer(0.3, 60.0, 0.45),
        layer(0.1, 2000.0, 0.2),
        layer(0.4, 150.0, 0.35),
        layer(0.5, 30.0, 0.49),
        layer(1.0, 300.0, 0.3),
    ];
    on_soil(layers, 80.0, 0.4)
}

/// The paper's road: 50 mm asphalt and 50 mm base course on subgrade.
pub fn task3() -> SoilProfile {
    on_soil(
        vec![layer(0.05, 4000.0, 0.35), layer(0.05, 800.0, 0.35)],
        800.0,
        0.4,
    )
}

fn five() -> SoilProfile {
    let layers = vec![
        layer(0.04, 6000.0, 0.35),
        layer(0.12, 3000.0, 0.35),
        layer(0.2, 400.0, 0.3),
        layer(0.6, 120.0, 0.35),
    ];
    on_soil(layers, 45.0, 0.4)
}

/// Load of `pressure` \[`MPa`\] on a disc.
fn disc(radius: f64, pressure: f64) -> SurfaceLoad {
    SurfaceLoad::new(pressure * 1e6 * PI * radius * radius, radius).unwrap()
}

/// The systems of the shared tables.
pub fn shared_case(name: &str) -> Option<Case> {
    let road = 2.77471435141713;
    let point = SurfaceLoad::point(testkit::TRUCK).unwrap();
    let (profile, load) = match name {
        "hs1" => (on_soil(vec![], 100.0, 0.35), disc(0.15, 0.7)),
        "hs2" => (on_soil(vec![], 40.0, 0.5), disc(0.15, 0.7)),
        "task3" => (task3(), disc(0.15, road)),
        "ellea3" => {
            let layers = vec![layer(0.15, 3000.0, 0.3), layer(0.6, 200.0, 0.35)];
            (on_soil(layers, 40.0, 0.4), disc(0.15, 1.1))
        }
        "amad3_bb" => {
            let layers = vec![layer(0.26, 5000.0, 0.35), layer(0.5, 200.0, 0.4)];
            (on_soil(layers, 50.0, 0.45), disc(0.1508, 0.7))
        }
        "five" => (five(), disc(0.15, 0.7)),
        "stiff1e4" => {
            let layers = vec![layer(0.2, 30000.0, 0.2), layer(0.3, 300.0, 0.35)];
            (on_soil(layers, 3.0, 0.45), disc(0.15, 0.7))
        }
        "thick" => {
            let layers = vec![layer(5.0, 200.0, 0.35), layer(5.0, 80.0, 0.35)];
            (on_soil(layers, 20.0, 0.4), disc(0.15, 0.7))
        }
        "rb_homog" => (on_rock(vec![layer(6.0, 100.0, 0.35)]), disc(0.15, 0.7)),
        "rb_task3" => {
            let layers = vec![
                layer(0.05, 4000.0, 0.35),
                layer(0.05, 800.0, 0.35),
                layer(5.9, 800.0, 0.4),
            ];
            (on_rock(layers), disc(0.15, road))
        }
        "pl_task3" => (task3(), point),
        "pl_five" => (five(), point),
        "pl_hs_E100_nu0.35" => (on_soil(vec![], 100.0, 0.35), point),
        "pl_hs_E40_nu0.5" => (on_soil(vec![], 40.0, 0.5), point),
        "pl_hs_E100_nu0" => (on_soil(vec![], 100.0, 0.0), point),
        _ => return None,
    };
    Some(Case { profile, load })
}

/// Further systems, under a unit load: soft and stiff bands, thin layers, rock, moduli that vary, incompressible soil.
pub fn further_case(name: &str) -> Option<Case> {
    let (profile, contact_radius) = match name {
        "soft_band" => (
            on_soil(vec![layer(0.3, 500.0, 0.35), layer(0.1, 5.0, 0.45)], 200.0, 0.3),
            0.0,
        ),
        "thin_interlayers" => {
            let layers = vec![
                layer(0.1, 3000.0, 0.35),
                layer(0.02, 20.0, 0.4),
                layer(0.15, 1500.0, 0.3),
                layer(0.01, 30000.0, 0.2),
                layer(0.5, 200.0, 0.35),
            ];
            (on_soil(layers, 60.0, 0.4), 0.15)
        }
        "ten_layers" => (ten_layers(), 0.15),
        "ten_layers_point" => (ten_layers(), 0.0),
        "soft_on_rock" => (
            on_rock(vec![layer(0.2, 8000.0, 0.3), layer(2.8, 40.0, 0.49)]),
            0.0,
        ),
        "soft_top" => (on_soil(vec![layer(0.2, 3.0, 0.45)], 30000.0, 0.25), 0.0),
        "soft_top_disc" => (on_soil(vec![layer(0.2, 3.0, 0.45)], 30000.0, 0.25), 0.3),
        "linear" => (on_soil(vec![graded(4.0, 20.0, 200.0, 0.35)], 200.0, 0.35), 0.0),
        "linear_crust" => {
            let layers = vec![graded(0.5, 5000.0, 100.0, 0.3), graded(1.5, 30.0, 120.0, 0.4)];
            (on_rock(layers), 0.2)
        }
        "linear_deep" => {
            let layers = vec![layer(0.1, 2000.0, 0.35), graded(20.0, 50.0, 500.0, 0.3)];
            (on_soil(layers, 500.0, 0.3), 0.15)
        }
        "incompressible" => (
            on_soil(vec![layer(0.5, 50.0, 0.5), layer(1.0, 20.0, 0.5)], 100.0, 0.5),
            0.0,
        ),
        "steel_plate" => (on_soil(vec![layer(0.005, 200000.0, 0.3)], 50.0, 0.4), 0.0),
        "paint" => (
            on_soil(vec![layer(0.001, 5.0, 0.3), layer(0.3, 1000.0, 0.3)], 50.0, 0.4),
            0.0,
        ),
        "deep_rock" => (on_rock(vec![layer(20.0, 100.0, 0.499)]), 0.0),
        "band_at_depth" => (
            on_soil(vec![layer(1.15, 200.0, 0.3), layer(0.1, 2.0, 0.49)], 200.0, 0.3),
            0.0,
        ),
        "stiff_band_at_depth" => (
            on_soil(vec![layer(1.15, 50.0, 0.3), layer(0.1, 50000.0, 0.2)], 50.0, 0.3),
            0.0,
        ),
        "small_disc" => (on_soil(vec![layer(0.3, 500.0, 0.35)], 50.0, 0.3), 0.01),
        "wide_disc" => (on_soil(vec![layer(0.3, 500.0, 0.35)], 50.0, 0.3), 1.0),
        _ => return None,
    };
    let load = SurfaceLoad::new(1.0, contact_radius).unwrap();
    Some(Case { profile, load })
}

/// Reads a table; `names` are its columns for r, z, `u_r`, `u_z` and `unit` what one of their units is in metres.
pub fn read(text: &str, names: [&str; 4], unit: f64) -> Table {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let places = names.map(|name| header.iter().position(|column| *column == name).unwrap());
    let mut table = Table::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let value = |k: usize| fields[places[k]].parse::<f64>().unwrap() * unit;
        table
            .entry(fields[0].to_owned())
            .or_default()
            .entry((value(1) * 1e6).round() as u64)
            .or_default()
            .push(Point {
                radius: value(0),
                radial: value(2),
                vertical: value(3),
            });
    }
    table
}

const MILLIMETRES: [&str; 4] = ["r_mm", "z_mm", "ur_mm", "uz_mm"];

/// Every shared table's systems and points.
pub fn shared() -> Vec<(String, Case, BTreeMap<u64, Vec<Point>>)> {
    [
        include_str!("../data/computed_layered.csv"),
        include_str!("../data/computed_point_load.csv"),
        include_str!("../data/computed_rigid_base.csv"),
    ]
    .into_iter()
    .flat_map(|text| read(text, MILLIMETRES, 1e-3))
    .map(|(name, rows)| {
        let case = shared_case(&name).unwrap();
        (name, case, rows)
    })
    .collect()
}

/// The further systems and points.
pub fn further() -> Vec<(String, Case, BTreeMap<u64, Vec<Point>>)> {
    let names = ["r_m", "z_m", "ur_m_per_N", "uz_m_per_N"];
    read(include_str!("../data/computed_further.csv"), names, 1.0)
        .into_iter()
        .map(|(name, rows)| {
            let case = further_case(&name).unwrap();
            (name, case, rows)
        })
        .collect()
}

/// Largest errors of `u_r` and `u_z` within `reach`, as shares of the largest exact values at that depth.
pub fn errors(found: &[ground_field::Displacement], exact: &[Point], reach: f64) -> [f64; 2] {
    let mut peak = [0.0_f64; 2];
    let mut worst = [0.0_f64; 2];
    for (u, point) in found.iter().zip(exact) {
        peak = [peak[0].max(point.radial.abs()), peak[1].max(point.vertical.abs())];
        if point.radius <= reach {
            worst = [
                worst[0].max((u.radial - point.radial).abs()),
                worst[1].max((u.vertical - point.vertical).abs()),
            ];
        }
    }
    [worst[0] / peak[0], worst[1] / peak[1]]
}

/// The 200 radii of the road at 1.2 m depth.
pub fn task3_points() -> Vec<Point> {
    let text = include_str!("../data/computed_task3_z1200_200pts.csv");
    text.lines()
        .skip(1)
        .map(|line| {
            let mut values = line.split(',').map(|field| field.parse::<f64>().unwrap() * 1e-3);
            let mut next = || values.next().unwrap();
            Point {
                radius: next(),
                radial: next(),
                vertical: next(),
            }
        })
        .collect()
}
