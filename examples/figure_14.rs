//! Figure 14, Tables 2 to 4 of the paper: which cables creep at which depth, and what more friction does to that.
//!
//! K. Kashiro et al., section 5: 300 m of duct, held at both ends, at 0.6, 1.5 and 2.0 m depth, under vehicles that move the duct by 35.7 µm
//! at every depth (Table 3); a single-core cable with μ_d = 0.3, 0.4, 0.5 and a triplex cable with 0.3, 0.4 (Table 2). Figure
//! 14 shows the largest force in the cable against the passes; its numbers are not published. Table 4 states the tendencies, which are checked here.
//!
//! `cargo run --release --example figure_14`

mod common;

use common::{Failure, save, scene};
use creepage::figure::{Axis, Chart, Panels, Series};
use rayon::prelude::*;

/// Depth of the duct \[m\] and weight of the vehicle \[tf\], Table 3.
pub const DEPTHS: [(f64, f64); 3] = [(0.6, 8.57), (1.5, 20.0), (2.0, 27.17)];
/// Shear stiffness of the sheath b μ_d N′/2 \[N/m²\], as in the scenes of the experiment; not in the paper.
const SHEAR: f64 = 1e8;
const PASSES: u32 = 100;

/// A kind of cable, Table 2.
pub struct Kind {
    /// Name.
    pub name: &'static str,
    /// \[N/m\]
    pub weight: f64,
    /// EA \[N\].
    pub axial_stiffness: f64,
    /// μ_d
    pub frictions: &'static [f64],
}

/// The two kinds of Table 2.
pub const KINDS: [Kind; 2] = [
    Kind {
        name: "single core",
        weight: 108.8,
        axial_stiffness: 8.01e6,
        frictions: &[0.3, 0.4, 0.5],
    },
    Kind {
        name: "triplex",
        weight: 112.7,
        axial_stiffness: 1.47e6,
        frictions: &[0.3, 0.4],
    },
];

/// Largest compression along a cable after each pass.
pub struct Case {
    /// Name of the kind of cable.
    pub kind: &'static str,
    /// Depth of the duct \[m\].
    pub depth: f64,
    /// μ_d
    pub friction: f64,
    /// max|D_l| \[m\].
    pub duct_displacement: f64,
    /// After each pass \[N\].
    pub forces: Vec<f64>,
}

/// All cables at all depths, each case on a thread of its own.
///
/// # Errors
///
/// Those of the scenes and the runs.
pub fn cases(passes: u32) -> Result<Vec<Case>, Failure> {
    let cases: Vec<(f64, f64, &Kind, f64)> = DEPTHS
        .into_iter()
        .flat_map(|(depth, load)| {
            let of_kind =
                move |kind: &'static Kind| kind.frictions.iter().map(move |mu| (depth, load, kind, *mu));
            KINDS.iter().flat_map(of_kind)
        })
        .collect();
    let run = |case: &(f64, f64, &Kind, f64)| solve(case, passes).map_err(|error| error.to_string());
    Ok(cases.par_iter().map(run).collect::<Result<_, _>>()?)
}

fn solve(&(depth, load, kind, friction): &(f64, f64, &Kind, f64), passes: u32) -> Result<Case, Failure> {
    let shape_factor = 2.0 * SHEAR / (friction * kind.weight);
    let overrides = [
        "duct.length=300 m".into(),
        format!("duct.depth={depth} m"),
        "ground.longitudinal_peak=35.7 um".into(),
        format!("vehicles.0.load={load} tf"),
        format!("cable.weight={} N/m", kind.weight),
        format!("cable.axial_stiffness={} N", kind.axial_stiffness),
        format!("friction.dynamic_coefficient={friction}"),
        format!("friction.shape_factor={shape_factor} 1/m"),
        "ends.upstream=fixed".into(),
        format!("traffic.passes={passes}"),
        "solver.tolerance=2 %".into(),
    ];
    let run = creepage::run(&scene("full-scale-upper.toml", &overrides)?)?;
    Ok(Case {
        kind: kind.name,
        depth,
        friction,
        duct_displacement: run.duct_motion.peak_longitudinal_m,
        forces: run.passes.iter().map(|pass| pass.max_compression_n).collect(),
    })
}

impl Case {
    /// After the last pass \[N\].
    pub fn last(&self) -> f64 {
        self.forces[self.forces.len() - 1]
    }
}

/// Table 4: what it says of a kind of cable at a depth, and whether that came out.
///
/// "Almost zero" is taken as less than a tenth of the force in the single-core cable at the same depth and friction.
pub fn tendencies(cases: &[Case]) -> Vec<(String, bool)> {
    let last = |kind: &str, depth: f64| -> Vec<f64> {
        let there = cases
            .iter()
            .filter(|case| case.kind == kind && case.depth == depth);
        there.map(Case::last).collect()
    };
    let grows = |forces: &[f64]| forces.windows(2).all(|pair| pair[1] > pair[0]);
    let falls = |forces: &[f64]| forces.windows(2).all(|pair| pair[1] < pair[0]);
    let (shallow, middle, deep) = (
        last("single core", 0.6),
        last("single core", 1.5),
        last("single core", 2.0),
    );
    let triplex = last("triplex", 1.5);
    vec![
        (
            "(1) single core, 0.6 m: force grows with friction".into(),
            grows(&shallow),
        ),
        (
            "(1) single core, 1.5 m: force grows with friction".into(),
            grows(&middle),
        ),
        (
            "(2) single core, 2.0 m: force falls with friction".into(),
            falls(&deep),
        ),
        (
            "(3) triplex, 1.5 m, 0.4: almost zero".into(),
            triplex[1] < 0.1 * middle[1],
        ),
    ]
}

/// A panel a depth.
pub fn figure(cases: &[Case]) -> Panels {
    DEPTHS.iter().fold(
        Panels::new("Figure 14: largest force in 300 m of cable"),
        |panels, (depth, load)| {
            let chart = Chart::new(
                format!("{depth} m deep, {load} tf"),
                Axis::linear("passes"),
                Axis::linear("force, N").range(0.0, 2000.0),
            );
            let there = cases.iter().filter(|case| case.depth == *depth).enumerate();
            panels.with(there.fold(chart, |chart, (look, case)| {
                let points = (1u32..).map(f64::from).zip(case.forces.iter().copied());
                chart.with(Series::line(format!("{}, μ = {}", case.kind, case.friction), points).look(look))
            }))
        },
    )
}

fn main() -> Result<(), Failure> {
    let cases = cases(PASSES)?;
    let listed = [1, 5, 10, 20, 40, 60, 80, 100];
    print!("largest force, N          pass");
    for pass in &listed {
        print!("{pass:8}");
    }
    println!();
    for case in &cases {
        print!(
            "{:.1} m  {:11}  mu = {:.1}     ",
            case.depth, case.kind, case.friction
        );
        for pass in &listed {
            print!("{:8.1}", case.forces[pass - 1]);
        }
        println!();
    }
    println!("\nTable 4 of the paper, after {PASSES} passes:");
    for (tendency, found) in tendencies(&cases) {
        println!("{tendency}: {}", if found { "yes" } else { "NO" });
        if !found {
            return Err(format!("not as in the paper: {tendency}").into());
        }
    }
    save("figure-14.svg", &figure(&cases).to_svg()?)
}
