//! Does a cable creep, and how much force can there be? Friction locked in at saturation and the advance of the first passes
//! as functions of one number, Q = q z²/(EA D), with D = max|D_l|.
//!
//! One concentrated load on a half-space moves the duct in a shape that depth and peak scale; what is left, for
//! ν = 0.4 and a given sheath, is Q. It compares the stretch that friction can impose on the cable over a depth with the displacement of
//! the duct. Every value comes from runs of a long duct, pass after pass: f* is the slope of the force about the middle of a duct
//! of 50 depths, free upstream and fixed downstream, once a hundred passes change the force on the fixed end by less than 1e-5 q L;
//! G(0) is how far one of the passes 2 to 6 moves the middle of a free duct of 100 depths.
//!

use std::path::Path;

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic,
};
use creepage::figure::{Axis, Chart, Reference, Series};
use creepage::occurrence;
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use rayon::prelude::*;

use crate::Failure;

/// Depth of the duct \[m\].
pub const DEPTH: f64 = 1.2;
/// EA \[N\].
pub const AXIAL_STIFFNESS: f64 = 8.01e6;
/// Shear stiffness of the sheath S = q b/2 \[N/m²\]: that of the experiment's scenes, EA/(S z²) = 0.056, and ten times as much.
pub const SHEAR: [f64; 2] = [1e8, 1e9];
/// Beyond the outermost turn of D_l \[depths\].
const APPROACH: f64 = 12.5;
/// Lengths of the ducts \[depths\]: for f*, and for G(0).
const LENGTHS: (f64, f64) = (50.0, 100.0);
const NODES_PER_DEPTH: f64 = 24.0;
/// Change of the force in a hundred passes at which nothing changes any more, as a share of q L.
const SETTLED: f64 = 1e-5;
const MAX_PASSES: u32 = 10_000;
/// Up to this Q the stiffer sheath is computed. Its shear acts over 0.09 m, which hardly shows on this mesh: near shakedown not
/// well enough.
const STIFF_TO: f64 = 2.0;

/// One value of Q under one concentrated load.
pub struct Case {
    /// Q.
    pub number: f64,
    /// q = μ_d N′ \[N/m\].
    limit: f64,
    law: FrictionLaw,
    motion: DuctMotion,
}

impl Case {
    /// A sheath of shear stiffness `shear` \[N/m²\].
    pub fn new(number: f64, shear: f64) -> Result<Self, Failure> {
        let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
        let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
        let reach = (LENGTHS.1 + 2.0 * APPROACH) * DEPTH;
        let motion = DuctMotion::new(&ground, &truck, DuctLine::new(DEPTH, 0.0)?, reach, 1e-9)?;
        let limit = number * AXIAL_STIFFNESS * motion.peak_longitudinal() / (DEPTH * DEPTH);
        let law = FrictionLaw::ElasticPlastic {
            shape_factor: 2.0 * shear / limit,
        };
        Ok(Self {
            number,
            limit,
            law,
            motion,
        })
    }

    /// A duct of so many depths with so many nodes a depth, free upstream.
    fn duct(&self, depths: f64, nodes_per_depth: f64, downstream: End) -> Result<Duct, CableError> {
        let length = depths * DEPTH;
        let cable = DuctedCable::new(length, AXIAL_STIFFNESS, Friction::new(self.law, self.limit)?)?
            .with_ends(End::Free, downstream)?;
        let mesh = Mesh::for_depth(length, DEPTH, nodes_per_depth)?;
        Ok(Duct {
            passage: Passage::new(&cable, &mesh, &self.motion, APPROACH * DEPTH)?,
            solver: QuasiStatic::new(cable.clone(), mesh)?,
            state: CableState::at_rest(&mesh),
            cable,
            mesh,
        })
    }

    /// f*/q about the middle of a duct of so many depths, and the force on its fixed end in EA D/z.
    pub fn saturated(&self, depths: f64, nodes_per_depth: f64) -> Result<(f64, f64), Failure> {
        let mut duct = self.duct(depths, nodes_per_depth, End::Fixed)?;
        let mut force = 0.0_f64;
        for _ in 0..MAX_PASSES / 100 {
            let before = force;
            for _ in 0..100 {
                force = duct.solver.pass(&duct.passage, &mut duct.state)?.force.downstream;
            }
            if (force - before).abs() < SETTLED * self.limit * duct.cable.length() {
                let forces: Vec<f64> = duct.state.element_forces(&duct.cable)?.collect();
                let (from, to) = (forces.len() / 3, 2 * forces.len() / 3);
                let slope = (forces[to] - forces[from]) / ((to - from) as f64 * duct.mesh.spacing());
                let scale = AXIAL_STIFFNESS * self.motion.peak_longitudinal() / DEPTH;
                return Ok((slope / self.limit, force / scale));
            }
        }
        Err(format!("Q = {}: not saturated after {MAX_PASSES} passes", self.number).into())
    }

    /// G(0)/D, the mean over the passes 2 to 6.
    pub fn advance(&self, depths: f64, nodes_per_depth: f64) -> Result<f64, Failure> {
        let mut duct = self.duct(depths, nodes_per_depth, End::Free)?;
        let middle = duct.mesh.nodes() / 2;
        let mut after_one = 0.0;
        for pass in 1..=6 {
            duct.solver.pass(&duct.passage, &mut duct.state)?;
            if pass == 1 {
                after_one = duct.state.displacement()[middle];
            }
        }
        let moved = duct.state.displacement()[middle] - after_one;
        Ok(moved / 5.0 / self.motion.peak_longitudinal())
    }
}

/// A cable in its duct, and where it stands.
struct Duct {
    passage: Passage,
    solver: QuasiStatic,
    state: CableState,
    cable: DuctedCable,
    mesh: Mesh,
}

/// Q, f*/q, G(0)/D and the force on the fixed end in EA D/z.
struct Found {
    number: f64,
    locked: f64,
    advance: f64,
    force: f64,
}

fn find(number: f64, shear: f64) -> Result<Found, Failure> {
    let case = Case::new(number, shear)?;
    let (locked, force) = case.saturated(LENGTHS.0, NODES_PER_DEPTH)?;
    Ok(Found {
        number,
        locked,
        advance: case.advance(LENGTHS.1, NODES_PER_DEPTH)?,
        force,
    })
}

/// Name and colour, friction coefficients, weight \[N/m\], EA \[N\], depth \[m\].
type Class = (&'static str, usize, [f64; 2], f64, f64, f64);

/// Tables 2 and 3 of Kashiro et al.; max|D_l| = 35.7 µm.
const CLASSES: [Class; 4] = [
    ("0.6 m", 5, [0.3, 0.5], 108.8, 8.01e6, 0.6),
    ("1.5 m", 5, [0.3, 0.5], 108.8, 8.01e6, 1.5),
    ("2.0 m", 4, [0.3, 0.5], 108.8, 8.01e6, 2.0),
    ("triplex, 1.5 m", 3, [0.3, 0.4], 112.7, 1.47e6, 1.5),
];

pub fn run(out: &Path) -> Result<(), Failure> {
    let cases: Vec<(f64, f64)> = SHEAR
        .into_iter()
        .flat_map(|shear| occurrence::TABLE.map(|row| (row.number, shear)))
        .filter(|&(number, shear)| shear == SHEAR[0] || number <= STIFF_TO)
        .collect();
    let solve = |&(number, shear): &(f64, f64)| find(number, shear).map_err(|error| error.to_string());
    let found: Vec<Found> = cases.par_iter().map(solve).collect::<Result<_, _>>()?;

    let mut chart = Chart::new(
        "Occurrence of creepage: one load on a half-space, ν = 0.4",
        Axis::logarithmic("Q = q z² / (EA · max|D_l|)").range(0.04, 4.0),
        Axis::linear("f*/q  and  G(0)/max|D_l|").range(0.0, 2.4),
    );
    for (label, colour, coefficients, weight, stiffness, depth) in CLASSES {
        let number = |mu: f64| mu * weight * depth * depth / (stiffness * 35.7e-6);
        let (from, to) = (number(coefficients[0]), number(coefficients[1]));
        println!("Table 4, {label}: Q = {from:.3} to {to:.3}");
        chart = chart.refer(Reference::vertical_band(from, to, label).colour(colour));
    }
    for (k, rows) in found.chunks(occurrence::TABLE.len()).enumerate() {
        let sheath = AXIAL_STIFFNESS / (SHEAR[k] * DEPTH * DEPTH);
        println!(
            "\nEA/(S z²) = {sheath:.4}\n     Q    f*/q  Q f*/q  G(0)/D  force on the fixed end less f* L, in EA D/z"
        );
        for row in rows {
            println!(
                "{:6.2}  {:6.4}  {:6.4}  {:6.4}  {:6.3}",
                row.number,
                row.locked,
                row.number * row.locked,
                row.advance,
                row.force - row.number * row.locked * LENGTHS.0
            );
        }
        let style = |series: Series| {
            if k == 0 { series.solid() } else { series.dashed() }
        };
        let name = |what: &str| format!("{what}, EA/(S z²) = {sheath:.3}");
        let points = |value: fn(&Found) -> f64| rows.iter().map(move |row| (row.number, value(row)));
        chart = chart
            .with(style(
                Series::line_points(name("f*/q"), points(|row| row.locked)).colour(0),
            ))
            .with(style(
                Series::line_points(name("G(0)/max|D_l|"), points(|row| row.advance)).colour(1),
            ));
    }
    std::fs::write(
        out.with_file_name("figures").join("occurrence.svg"),
        chart.to_svg()?,
    )?;
    Ok(())
}
