//! Figure 6 of the paper: velocity of the duct along itself, whose forward and backward areas are equal.
//!
//! K. Kashiro et al., section 2.2: V_l = −v dD_l/dξ, Equation (1), at 40 km/h. Near the vehicle the duct runs backward, fast over a short
//! length; before and behind it forward, slowly over a long one. As the duct returns to its place, ∫V_l dξ = 0. The paper's
//! ground (Table 1) lies here on rock at 12 m, where the duct's motion ends within the figure; on an endless half-space its tail
//! is longer than any figure.
//!
//! `cargo run --release --example figure_6`

mod common;

use common::{Failure, even, save, scene};
use creepage::figure::{Axis, Chart, Series};
use creepage::{Profile, profile_at};

/// Half the length looked at \[m\], and the distance of points on it.
const HALF: f64 = 40.0;
const STEPS: u32 = 16_000;
const TABLE_1_ON_ROCK: [&str; 2] = [
    r#"ground.layers=[{thickness="50 mm", young_modulus="4000 MPa", poisson_ratio=0.35}, {thickness="50 mm", young_modulus="800 MPa", poisson_ratio=0.35}, {young_modulus="800 MPa", poisson_ratio=0.4}]"#,
    "ground.rigid_base_depth=12 m",
];

/// The velocity and its areas.
pub struct Velocity {
    /// The duct's motion.
    pub profile: Profile,
    /// Largest forward and backward velocity \[m/s\].
    pub peaks: (f64, f64),
    /// ∫ of the forward and of the backward velocity over their lengths \[m²/s\], both positive.
    pub areas: (f64, f64),
    /// Length of the backward run below the vehicle \[m\].
    pub backward_length: f64,
    /// Length of both forward runs beside it, up to where the velocity falls below a hundredth of its forward peak \[m\].
    pub forward_length: f64,
}

/// At 40 km/h.
///
/// # Errors
///
/// Those of the scene and the model.
pub fn velocity() -> Result<Velocity, Failure> {
    let scene = scene("full-scale-upper.toml", &TABLE_1_ON_ROCK.map(Into::into))?;
    let positions: Vec<f64> = even(-HALF, HALF, STEPS).collect();
    let profile = profile_at(&scene, &positions)?;
    let v = &profile.longitudinal_velocity_m_per_s;
    let spacing = positions[1] - positions[0];
    // Trapezoidal rule; the velocity is next to nothing at both ends.
    let area = |sign: f64| spacing * v.iter().map(|v| (sign * v).max(0.0)).sum::<f64>();
    let peak = |sign: f64| v.iter().fold(0.0_f64, |peak, v| peak.max(sign * v));
    let middle = v.len() / 2;
    let backward = v[middle..].iter().position(|v| *v >= 0.0).unwrap_or(0);
    // From the zero beside the vehicle over the forward peak to where next to nothing is left.
    let top = v[middle..]
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))
        .map_or(0, |(k, _)| k);
    let slow = v[middle + top..]
        .iter()
        .position(|v| *v < 0.01 * peak(1.0))
        .unwrap_or(0);
    Ok(Velocity {
        peaks: (peak(1.0), peak(-1.0)),
        areas: (area(1.0), area(-1.0)),
        backward_length: 2.0 * spacing * backward as f64,
        forward_length: 2.0 * spacing * (top + slow - backward) as f64,
        profile,
    })
}

/// The velocity along the duct.
pub fn figure(velocity: &Velocity) -> Chart {
    let points = velocity
        .profile
        .positions_m
        .iter()
        .zip(&velocity.profile.longitudinal_velocity_m_per_s);
    let shown: Vec<(f64, f64)> = points
        .map(|(x, v)| (*x, v * 1e3))
        .filter(|(x, _)| x.abs() <= 10.0 + 1e-9)
        .collect();
    let part = |sign: f64| shown.iter().copied().filter(move |(_, v)| sign * v >= 0.0);
    Chart::new(
        "Figure 6: velocity of the duct under a vehicle at 40 km/h",
        Axis::linear("place from the vehicle, m"),
        Axis::linear("velocity along the duct, mm/s"),
    )
    .with(
        Series::area(
            format!("forward, area {:.3} mm m/s", velocity.areas.0 * 1e3),
            part(1.0),
        )
        .solid(),
    )
    .with(
        Series::area(
            format!("backward, area {:.3} mm m/s", velocity.areas.1 * 1e3),
            part(-1.0),
        )
        .solid(),
    )
}

fn main() -> Result<(), Failure> {
    let velocity = velocity()?;
    let (forward, backward) = velocity.areas;
    println!("            paper     length       largest         area");
    println!(
        "forward     long    {:6.2} m   {:6.3} mm/s   {:.4} mm m/s",
        velocity.forward_length,
        velocity.peaks.0 * 1e3,
        forward * 1e3
    );
    println!(
        "backward    short   {:6.2} m   {:6.3} mm/s   {:.4} mm m/s",
        velocity.backward_length,
        velocity.peaks.1 * 1e3,
        backward * 1e3
    );
    println!(
        "Areas: equal in the paper; here they differ by {:.2} %.",
        100.0 * (forward / backward - 1.0).abs()
    );
    save("figure-6.svg", &figure(&velocity).to_svg()?)
}
