//! Draws the design chart: saturation and advance against the friction number q z²/(EA max D_l).
//!
//! `cargo run --release --example design_chart`
//!
//! Under a point load on a homogeneous half-space the duct's motion has one shape, which depth and largest displacement
//! scale. What is left, beside Poisson's ratio, here 0.4, are the friction number q z²/(EA max D_l) and the sheath's shear
//! compliance EA γ/z², for which two values are drawn.

mod common;

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, Friction, FrictionLaw};
use creepage::figure::{Axis, Chart, Reference, Series};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{AdvanceLaw, LawError, Resolution};

const DEPTH: f64 = 1.2;
const STIFFNESS: f64 = 8.01e6;
/// Shear stiffness b q/2 of the sheath \[N/m²\]: EA γ/z² = 0.056 and 0.22 at this depth and stiffness.
const SHEAR: [f64; 2] = [1e8, 2.5e7];

fn main() -> Result<(), common::Failure> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(DEPTH, 0.0)?, 500.0, 1e-9)?;

    let mut chart = Chart::new(
        "Saturated friction f* and first advance G(0)",
        Axis::logarithmic("friction number  q z² / (EA · max D_l)").range(0.03, 5.0),
        Axis::linear("f*/q  and  G(0)/max D_l").range(0.0, 2.4),
    );

    // Table 2 and Table 3 of Kashiro et al.: friction coefficients, weight [N/m], EA [N], depth [m]; max D_l = 35.7 µm.
    let classes = [
        ("(1) 0.6 m", 5, [0.3, 0.5], 108.8, 8.01e6, 0.6),
        ("(1) 1.5 m", 5, [0.3, 0.5], 108.8, 8.01e6, 1.5),
        ("(2) 2.0 m", 4, [0.3, 0.5], 108.8, 8.01e6, 2.0),
        ("(3) triplex", 3, [0.3, 0.4], 112.7, 1.47e6, 1.5),
    ];
    for (label, colour, coefficients, weight, stiffness, depth) in classes {
        let number = |mu: f64| mu * weight * depth * depth / (stiffness * 35.7e-6);
        let (from, to) = (number(coefficients[0]), number(coefficients[1]));
        println!("{label}: {from:.3} to {to:.3}");
        chart = chart.refer(Reference::vertical_band(from, to, label).colour(colour));
    }

    for shear in SHEAR {
        let (mut saturation, mut advance) = (Vec::new(), Vec::new());
        let mut threshold = None;
        for k in 0..=44 {
            let number = 0.03 * (5.0_f64 / 0.03).powf(f64::from(k) / 44.0);
            let q = number * STIFFNESS * motion.peak_longitudinal() / (DEPTH * DEPTH);
            let law = FrictionLaw::ElasticPlastic {
                shape_factor: 2.0 * shear / q,
            };
            let cable = DuctedCable::new(100.0, STIFFNESS, Friction::new(law, q)?)?;
            let law = match AdvanceLaw::new(
                &cable,
                &motion,
                Resolution::new(DEPTH)?.with_nodes_per_depth(10.0)?,
            ) {
                Ok(law) => law,
                Err(error @ LawError::CellUnsettled { .. }) => {
                    println!("{number:.3}: {error}");
                    continue;
                }
                Err(error) => return Err(error.into()),
            };
            let share = law.free_advance() / motion.peak_longitudinal();
            println!(
                "{number:.4} {shear:.1e} f*/q {:.4} G(0)/D {share:.4}",
                law.saturation() / q
            );
            if law.saturation() == 0.0 && threshold.is_none() {
                threshold = Some(number);
            }
            saturation.push((number, law.saturation() / q));
            advance.push((number, share));
        }
        let sheath = STIFFNESS / (shear * DEPTH * DEPTH);
        let solid = |series: Series| {
            if shear == SHEAR[0] {
                series.solid()
            } else {
                series.dashed()
            }
        };
        let name = |what: &str| format!("{what}, sheath EA γ/z² = {sheath:.3}");
        chart = chart
            .with(solid(Series::line(name("f*/q"), saturation).colour(0)))
            .with(solid(Series::line(name("G(0)/max D_l"), advance).colour(1)));
        if let Some(number) = threshold {
            chart = chart.refer(Reference::vertical(
                number,
                if shear == SHEAR[0] { "shakedown" } else { "" },
            ));
        }
    }
    common::save("design-chart.svg", &chart.to_svg()?)
}
