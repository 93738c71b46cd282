//! Layered grounds whose displacements were computed elsewhere: the systems by name, and the tables of their figures.

use std::collections::BTreeMap;

use ground_field::{Base, Displacement, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad};

/// Name | thicknesses [mm] | Young's moduli [MPa], of a graded layer at its top and bottom, one more than layers where there is a half-space
/// and not rock below | Poisson's ratios | contact radius [mm] and pressure [MPa], or force [N].
const SYSTEMS: &str = "
hs1               |                 | 100                     | .35                | 150 0.7 MPa
hs2               |                 | 40                      | .5                 | 150 0.7 MPa
task3             | 50 50           | 4000 800 800            | .35 .35 .4         | 150 2.77471435141713 MPa
ellea3            | 150 600         | 3000 200 40             | .3 .35 .4          | 150 1.1 MPa
amad3_bb          | 260 500         | 5000 200 50             | .35 .4 .45         | 150.8 0.7 MPa
five              | 40 120 200 600  | 6000 3000 400 120 45    | .35 .35 .3 .35 .4  | 150 0.7 MPa
stiff1e4          | 200 300         | 30000 300 3             | .2 .35 .45         | 150 0.7 MPa
thick             | 5000 5000       | 200 80 20               | .35 .35 .4         | 150 0.7 MPa
rb_homog          | 6000            | 100                     | .35                | 150 0.7 MPa
rb_task3          | 50 50 5900      | 4000 800 800            | .35 .35 .4         | 150 2.77471435141713 MPa
pl_hs_E100_nu0.35 |                 | 100                     | .35                | 0 196133 N
pl_hs_E40_nu0.5   |                 | 40                      | .5                 | 0 196133 N
pl_hs_E100_nu0    |                 | 100                     | 0                  | 0 196133 N
pl_task3          | 50 50           | 4000 800 800            | .35 .35 .4         | 0 196133 N
pl_five           | 40 120 200 600  | 6000 3000 400 120 45    | .35 .35 .3 .35 .4  | 0 196133 N

soft_band         | 300 100         | 500 5 200               | .35 .45 .3         | 0 1 N
thin_interlayers  | 100 20 150 10 500 | 3000 20 1500 30000 200 60 | .35 .4 .3 .2 .35 .4 | 150 1 N
ten_layers \
    | 40 60 200 150 250 300 100 400 500 1000 \
    | 6000 800 3000 90 400 60 2000 150 30 300 80 \
    | .35 .3 .25 .4 .35 .45 .2 .35 .49 .3 .4 \
    | 150 1 N
ten_layers_point \
    | 40 60 200 150 250 300 100 400 500 1000 \
    | 6000 800 3000 90 400 60 2000 150 30 300 80 \
    | .35 .3 .25 .4 .35 .45 .2 .35 .49 .3 .4 \
    | 0 1 N
soft_on_rock      | 200 2800        | 8000 40                 | .3 .49             | 0 1 N
soft_top          | 200             | 3 30000                 | .45 .25            | 0 1 N
soft_top_disc     | 200             | 3 30000                 | .45 .25            | 300 1 N
linear            | 4000            | 20..200 200             | .35 .35            | 0 1 N
linear_crust      | 500 1500        | 5000..100 30..120       | .3 .4              | 200 1 N
linear_deep       | 100 20000       | 2000 50..500 500        | .35 .3 .3          | 150 1 N
incompressible    | 500 1000        | 50 20 100               | .5 .5 .5           | 0 1 N
steel_plate       | 5               | 200000 50               | .3 .4              | 0 1 N
paint             | 1 300           | 5 1000 50               | .3 .3 .4           | 0 1 N
deep_rock         | 20000           | 100                     | .499               | 0 1 N
band_at_depth     | 1150 100        | 200 2 200               | .3 .49 .3          | 0 1 N
stiff_band_at_depth | 1150 100      | 50 50000 50             | .3 .2 .3           | 0 1 N
small_disc        | 300             | 500 50                  | .35 .3             | 10 1 N
wide_disc         | 300             | 500 50                  | .35 .3             | 1000 1 N
";

/// Ground and load of one line of a table of systems.
fn read(system: &str) -> (SoilProfile, SurfaceLoad) {
    let columns: Vec<Vec<&str>> = system
        .split('|')
        .map(|column| column.split_whitespace().collect())
        .collect();
    let number = |text: &str| -> f64 { text.parse().expect("a number") };
    let modulus = |i: usize| match columns[2][i].split_once("..") {
        Some((top, bottom)) => Modulus::Linear {
            top: 1e6 * number(top),
            bottom: 1e6 * number(bottom),
        },
        None => Modulus::Uniform(1e6 * number(columns[2][i])),
    };
    let poisson = |i: usize| number(columns[3][i]);
    let count = columns[1].len();
    let layer =
        |i: usize| SoilLayer::new(1e-3 * number(columns[1][i]), modulus(i), poisson(i)).expect("a layer");
    let base = match columns[2].get(count) {
        Some(young) => Base::HalfSpace(Soil::new(1e6 * number(young), poisson(count)).expect("a soil")),
        None => Base::Rigid,
    };
    let [radius, size, unit] = columns[4][..] else {
        panic!("no load in {system}");
    };
    let radius = 1e-3 * number(radius);
    let area = if unit == "MPa" {
        1e6 * std::f64::consts::PI * radius * radius
    } else {
        1.0
    };
    (
        SoilProfile::new((0..count).map(layer).collect(), base).expect("a profile"),
        SurfaceLoad::new(area * number(size), radius).expect("a load"),
    )
}

/// Ground and load of the system of this name in `systems`, lines of the form of the systems that are known here.
pub fn system_of(systems: &str, name: &str) -> (SoilProfile, SurfaceLoad) {
    let found = systems
        .lines()
        .find(|line| line.split('|').next().is_some_and(|first| first.trim() == name));
    read(found.unwrap_or_else(|| panic!("no system {name}")))
}

/// Ground and load of a system that is known here.
pub fn system(name: &str) -> (SoilProfile, SurfaceLoad) {
    system_of(SYSTEMS, name)
}

/// Exact displacements of one system at one depth.
pub struct Row {
    /// Name of the system.
    pub case: String,
    /// \[m\]
    pub depth: f64,
    /// Radii \[m\] and the displacements there \[m\].
    pub points: Vec<(f64, Displacement)>,
}

impl Row {
    /// \[m\]
    pub fn radii(&self) -> Vec<f64> {
        self.points.iter().map(|point| point.0).collect()
    }

    /// Largest errors of `u_r` and `u_z` within `reach`, as shares of the largest exact values.
    pub fn errors(&self, found: &[Displacement], reach: f64) -> [f64; 2] {
        let parts: [fn(&Displacement) -> f64; 2] = [|u| u.radial, |u| u.vertical];
        parts.map(|part| {
            let peak = self
                .points
                .iter()
                .fold(0.0_f64, |most, (_, exact)| most.max(part(exact).abs()));
            let near = self
                .points
                .iter()
                .zip(found)
                .filter(|((radius, _), _)| *radius <= reach);
            let error = near.fold(0.0_f64, |most, ((_, exact), found)| {
                most.max((part(exact) - part(found)).abs())
            });
            if error == 0.0 { 0.0 } else { error / peak }
        })
    }
}

/// The figures of a table, by system and depth. Its columns are `case`, `r`, `z`, `ur` and `uz` with their units; without the first or third they
/// are of `alone`.
pub fn table(text: &str, alone: (&str, f64)) -> Vec<Row> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let unit = if header.contains(&"r_mm") { 1e-3 } else { 1.0 };
    let column = |name: &str| {
        header
            .iter()
            .position(|title| title.split('_').next() == Some(name))
    };
    let mut rows: BTreeMap<(String, u64), Row> = BTreeMap::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |name| column(name).map(|place| unit * fields[place].parse::<f64>().expect("a number"));
        let case = column("case").map_or(alone.0, |place| fields[place]).to_owned();
        let depth = number("z").unwrap_or(alone.1);
        let exact = Displacement {
            radial: number("ur").expect("u_r"),
            vertical: number("uz").expect("u_z"),
        };
        let row = rows
            .entry((case.clone(), depth.to_bits()))
            .or_insert_with(|| Row {
                case,
                depth,
                points: Vec::new(),
            });
        row.points.push((number("r").expect("r"), exact));
    }
    rows.into_values().collect()
}
