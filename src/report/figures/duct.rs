//! Motion of the duct under the first vehicle, its velocity, and friction on the cable (Kashiro et al., Figures 2 to 7).

use crate::FrictionProfile;
use crate::figure::{Axis, Chart, Panels, Reference, Series};
use crate::report::quantity::count;
use crate::report::{Report, reach};

use super::{single, stacked};

/// Metres to micrometres, and to millimetres.
const MICRO: f64 = 1e6;
const MILLI: f64 = 1e3;

/// A quantity in the vehicle's direction and against it, both positive.
#[derive(Debug, Clone, Copy)]
pub struct Areas {
    pub forward: f64,
    pub backward: f64,
}

/// The displacement of a point of the duct, as the vehicle drives by.
pub fn motion(report: &Report) -> Panels {
    let motion = &report.motion;
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        // The vehicle at x_v is x_v − x = −ξ past the point at x.
        let pairs = motion.positions_m.iter().zip(values).rev();
        pairs.map(|(xi, value)| (-xi, MICRO * value)).collect()
    };
    let chart = |title, label: &str, values: &[f64], look| {
        Chart::new(title, position(report), Axis::linear(label))
            .with(Series::line("", points(values)).look(look).solid())
    };
    stacked([
        chart(
            "Motion of the duct along its axis",
            "D_l, µm",
            &motion.longitudinal_m,
            0,
        ),
        chart("and down", "D_v, µm", &motion.vertical_m, 1),
    ])
}

/// Velocity of a point of the duct along its axis.
pub fn velocity(report: &Report) -> Panels {
    let motion = &report.motion;
    let sign = direction(report);
    let part = |wanted: f64| {
        let pairs = motion
            .positions_m
            .iter()
            .zip(&motion.longitudinal_velocity_m_per_s)
            .rev();
        pairs.map(move |(xi, v)| (-xi, MILLI * wanted * (wanted * v).max(0.0)))
    };
    let Areas { forward, backward } = areas(report);
    let chart = Chart::new(
        "Velocity of the duct along its axis",
        position(report),
        Axis::linear("velocity, mm/s"),
    )
    .with(Series::area(format!("with the vehicle, {:.1} µm", MICRO * forward), part(sign)).solid())
    .with(Series::area(format!("against it, {:.1} µm", MICRO * backward), part(-sign)).solid());
    single(chart)
}

/// The axis of the vehicle's position.
fn position(report: &Report) -> Axis {
    let half = reach(&report.scene);
    Axis::linear("vehicle past the point looked at, m").range(-half, half)
}

/// How far the duct runs with the vehicle and against it as it drives by: ∫ V_l dt of either sign \[m\].
pub fn areas(report: &Report) -> Areas {
    let motion = &report.motion;
    let speed = report.scene.vehicles[0].vehicle.speed();
    let sign = direction(report);
    let area = |wanted: f64| {
        let part = |k: usize| (wanted * motion.longitudinal_velocity_m_per_s[k]).max(0.0);
        let positions = motion.positions_m.windows(2).enumerate();
        positions
            .map(|(k, x)| 0.5 * (x[1] - x[0]) * (part(k) + part(k + 1)) / speed)
            .sum::<f64>()
    };
    Areas {
        forward: area(sign),
        backward: area(-sign),
    }
}

fn direction(report: &Report) -> f64 {
    report.scene.vehicles[0].vehicle.direction().sign()
}

/// Friction on the cable near the vehicle; `None` where it was not seen.
pub fn friction(report: &Report) -> Option<Panels> {
    let passes = &report.friction.passes;
    if passes.is_empty() {
        return None;
    }
    let limit = report.scene.friction_limit();
    let half = reach(&report.scene);
    let charts = passes.iter().map(|(pass, friction)| {
        Chart::new(
            format!("Friction on the cable, pass {}", count(*pass)),
            Axis::linear("place from the vehicle, m").range(-half, half),
            Axis::linear("friction, N/m").range(-1.5 * limit, 1.5 * limit),
        )
        .refer(Reference::horizontal(limit, "+μ N′"))
        .refer(Reference::horizontal(-limit, "−μ N′"))
        .with(Series::area("", near(friction, half)))
    });
    Some(stacked(charts))
}

/// Friction within `half` \[m\] of the vehicle.
fn near(friction: &FrictionProfile, half: f64) -> Vec<(f64, f64)> {
    let places = friction
        .positions_m
        .iter()
        .map(|x| x - friction.vehicle_position_m);
    places
        .zip(friction.friction_n_per_m.iter().copied())
        .filter(|(place, _)| place.abs() <= half)
        .collect()
}
