//! Draws the design chart: saturation and advance against the friction number q z²/(EA max D_l).
//!
//! `cargo run --release -p pass-law --example design_chart -- docs/design-chart.svg`
//!
//! Under a point load on a homogeneous half-space the duct's motion has one shape, which depth and largest displacement
//! scale. What is left, beside Poisson's ratio, here 0.4, are the friction number q z²/(EA max D_l) and the sheath's shear
//! compliance EA γ/z², for which two values are drawn.

mod plot;

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, Friction, FrictionLaw};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{AdvanceLaw, LawError, Resolution};
use plot::{Axis, Plot};

const DEPTH: f64 = 1.2;
const STIFFNESS: f64 = 8.01e6;
/// Shear stiffness b q/2 of the sheath \[N/m²\]: EA γ/z² = 0.056 and 0.22 at this depth and stiffness.
const SHEAR: [f64; 2] = [1e8, 2.5e7];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "docs/design-chart.svg".into());
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(DEPTH, 0.0)?, 500.0, 1e-9)?;

    let ticks = |values: &[f64]| values.iter().map(|v| (*v, v.to_string())).collect();
    let mut plot = Plot::new(
        Axis {
            from: 0.03,
            to: 5.0,
            logarithmic: true,
            ticks: ticks(&[0.03, 0.1, 0.3, 1.0, 3.0]),
            title: "friction number  q z² / (EA · max D_l)",
        },
        Axis {
            from: 0.0,
            to: 2.4,
            logarithmic: false,
            ticks: ticks(&[0.0, 0.5, 1.0, 1.5, 2.0]),
            title: "f*/q  and  G(0)/max D_l",
        },
    );

    // Table 2 and Table 3 of Kashiro et al.: friction coefficients, weight [N/m], EA [N], depth [m]; max D_l = 35.7 µm.
    let classes = [
        ("(1) 0.6 m", "#e3eefb", [0.3, 0.5], 108.8, 8.01e6, 0.6),
        ("(1) 1.5 m", "#e3eefb", [0.3, 0.5], 108.8, 8.01e6, 1.5),
        ("(2) 2.0 m", "#fdebd2", [0.3, 0.5], 108.8, 8.01e6, 2.0),
        ("(3) triplex", "#f7dedd", [0.3, 0.4], 112.7, 1.47e6, 1.5),
    ];
    for (label, colour, coefficients, weight, stiffness, depth) in classes {
        let number = |mu: f64| mu * weight * depth * depth / (stiffness * 35.7e-6);
        let (from, to) = (number(coefficients[0]), number(coefficients[1]));
        println!("{label}: {from:.3} to {to:.3}");
        plot.band(from, to, colour);
        plot.text((from * to).sqrt(), 2.27, "middle", "#333", label);
    }

    for (shear, dash) in SHEAR.into_iter().zip(["none", "7 4"]) {
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
        plot.curve(&saturation, "#1b5fa8", dash);
        plot.curve(&advance, "#c04a12", dash);
        if let Some(number) = threshold {
            plot.curve(&[(number, 0.0), (number, 0.6)], "#777", "2 3");
        }
    }
    plot.text(2.6, 0.66, "middle", "#555", "shakedown");
    plot.text(0.072, 2.1, "start", "#c04a12", "G(0)/max D_l");
    plot.text(0.072, 0.66, "start", "#1b5fa8", "f*/q");
    plot.text(
        0.034,
        0.18,
        "start",
        "#555",
        "sheath EA γ/z²: 0.056 solid, 0.22 dashed",
    );
    std::fs::write(path, plot.svg())?;
    Ok(())
}
