//! Systems of the reference tables, and the tables' reader.

#![allow(dead_code, reason = "each test binary uses a part of it")]

use std::collections::BTreeMap;
use std::fs;

use burmister::LayeredHalfSpace;
use ground_field::{Base, Displacement, Soil, SoilLayer, SoilProfile, SurfaceLoad};

/// Ground from thicknesses \[mm\], moduli \[`MPa`\] and Poisson's ratios; without a last soil it stands on rock.
pub fn profile(thickness_mm: &[f64], modulus_mpa: &[f64], poisson_ratio: &[f64]) -> SoilProfile {
    let soil = |i: usize| Soil::new(modulus_mpa[i] * 1e6, poisson_ratio[i]).expect("soil");
    let layers = thickness_mm
        .iter()
        .enumerate()
        .map(|(i, h)| SoilLayer::uniform(h * 1e-3, soil(i)).expect("layer"))
        .collect();
    let base = if modulus_mpa.len() > thickness_mm.len() {
        Base::HalfSpace(soil(thickness_mm.len()))
    } else {
        Base::Rigid
    };
    SoilProfile::new(layers, base).expect("profile")
}

pub fn ground(thickness_mm: &[f64], modulus_mpa: &[f64], poisson_ratio: &[f64]) -> LayeredHalfSpace {
    LayeredHalfSpace::new(&profile(thickness_mm, modulus_mpa, poisson_ratio)).expect("ground")
}

/// Disc of radius \[mm\] under pressure \[`MPa`\].
pub fn disc(radius_mm: f64, pressure_mpa: f64) -> SurfaceLoad {
    let radius = radius_mm * 1e-3;
    SurfaceLoad::new(
        pressure_mpa * 1e6 * std::f64::consts::PI * radius * radius,
        radius,
    )
    .expect("load")
}

/// Ground and load of a named case of the tables.
pub fn case(name: &str) -> (LayeredHalfSpace, SurfaceLoad) {
    let task3_pressure = 2.77471435141713;
    let point = || SurfaceLoad::point(196_133.0).expect("load");
    let five = || {
        ground(
            &[40.0, 120.0, 200.0, 600.0],
            &[6000.0, 3000.0, 400.0, 120.0, 45.0],
            &[0.35, 0.35, 0.3, 0.35, 0.4],
        )
    };
    let task3 = || ground(&[50.0, 50.0], &[4000.0, 800.0, 800.0], &[0.35, 0.35, 0.4]);
    match name {
        "hs1" => (ground(&[], &[100.0], &[0.35]), disc(150.0, 0.7)),
        "hs2" => (ground(&[], &[40.0], &[0.5]), disc(150.0, 0.7)),
        "task3" => (task3(), disc(150.0, task3_pressure)),
        "ellea3" => (
            ground(&[150.0, 600.0], &[3000.0, 200.0, 40.0], &[0.3, 0.35, 0.4]),
            disc(150.0, 1.1),
        ),
        "amad3_bb" => (
            ground(&[260.0, 500.0], &[5000.0, 200.0, 50.0], &[0.35, 0.4, 0.45]),
            disc(150.8, 0.7),
        ),
        "five" => (five(), disc(150.0, 0.7)),
        "stiff1e4" => (
            ground(&[200.0, 300.0], &[30000.0, 300.0, 3.0], &[0.2, 0.35, 0.45]),
            disc(150.0, 0.7),
        ),
        "thick" => (
            ground(&[5000.0, 5000.0], &[200.0, 80.0, 20.0], &[0.35, 0.35, 0.4]),
            disc(150.0, 0.7),
        ),
        "rb_homog" => (ground(&[6000.0], &[100.0], &[0.35]), disc(150.0, 0.7)),
        "rb_task3" => (
            ground(&[50.0, 50.0, 5900.0], &[4000.0, 800.0, 800.0], &[0.35, 0.35, 0.4]),
            disc(150.0, task3_pressure),
        ),
        "pl_hs_E100_nu0.35" => (ground(&[], &[100.0], &[0.35]), point()),
        "pl_hs_E40_nu0.5" => (ground(&[], &[40.0], &[0.5]), point()),
        "pl_hs_E100_nu0" => (ground(&[], &[100.0], &[0.0]), point()),
        "pl_task3" => (task3(), point()),
        "pl_five" => (five(), point()),
        other => panic!("unknown case {other}"),
    }
}

/// Points of one case and one depth: radius \[m\] and displacement \[m\].
pub struct Row {
    pub case: String,
    pub depth: f64,
    pub points: Vec<(f64, Displacement)>,
}

/// A table of tests/data, grouped by case and depth. A table without the columns `case` and `z_mm` is of `alone`.
pub fn table(file: &str, alone: (&str, f64)) -> Vec<Row> {
    let path = format!("{}/tests/data/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).expect("reference table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("header").split(',').collect();
    let column = |name: &str| header.iter().position(|title| *title == name);
    let number =
        |fields: &[&str], name: &str| -> f64 { fields[column(name).expect(name)].parse().expect("number") };
    let mut groups: BTreeMap<(String, u64), Row> = BTreeMap::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let case = column("case").map_or(alone.0, |i| fields[i]).to_owned();
        let depth = column("z_mm").map_or(alone.1, |_| number(&fields, "z_mm") * 1e-3);
        let value = Displacement {
            radial: number(&fields, "ur_mm") * 1e-3,
            vertical: number(&fields, "uz_mm") * 1e-3,
        };
        groups
            .entry((case.clone(), depth.to_bits()))
            .or_insert_with(|| Row {
                case,
                depth,
                points: Vec::new(),
            })
            .points
            .push((number(&fields, "r_mm") * 1e-3, value));
    }
    groups.into_values().collect()
}

/// Largest error of `values`, as a share of the reference's peak, radial and vertical.
pub fn error(points: &[(f64, Displacement)], values: &[Displacement]) -> (f64, f64) {
    let largest = |of: &dyn Fn(usize) -> f64| (0..points.len()).map(of).fold(0.0, f64::max);
    let peak_r = largest(&|i| points[i].1.radial.abs());
    let peak_z = largest(&|i| points[i].1.vertical.abs());
    let gap_r = largest(&|i| (points[i].1.radial - values[i].radial).abs());
    let gap_z = largest(&|i| (points[i].1.vertical - values[i].vertical).abs());
    let share = |gap: f64, peak: f64| if gap == 0.0 { 0.0 } else { gap / peak };
    (share(gap_r, peak_r), share(gap_z, peak_z))
}
