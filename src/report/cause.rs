//! Why the cable creeps: motion of the duct under the first vehicle, its velocity, and friction on the cable (Kashiro et al., Figures 2
//! to 7).

use super::content::{Report, reach};
use super::figure::{MICRO, MILLI, figure};
use super::friction::positive_area;
use super::html::Html;
use super::quantity::count;
use crate::FrictionProfile;
use crate::figure::{Axis, Chart, Reference, Series};
use crate::shown::rounded;

pub fn cause(html: &mut Html, report: &Report) {
    html.paragraph(
        "The ground bends under every vehicle, and the duct moves along its axis: with the vehicle over a long way and slowly, \
         against it over a short way and fast. Friction does not depend on speed, so it drags the cable further with the vehicle \
         than against it.",
    );
    html.raw("<div class=\"figures\">");
    let vehicle = if report.scene.vehicles.len() == 1 {
        "the vehicle"
    } else {
        "the first vehicle"
    };
    figure(
        html,
        motion(report),
        &format!(
            "Displacement of a point of the duct as {vehicle} drives by, by the ground model {}; along the axis positive toward \
             growing x.",
            report.motion.ground
        ),
    );
    let [forward, backward] = ways(report).map(|way| MICRO * way);
    figure(
        html,
        [velocity(report)],
        &format!(
            "Velocity of that point. The areas are how far it moves: {forward:.1} µm with the vehicle and {backward:.1} µm against \
             it within this figure; they are equal when the vehicle is far away.",
        ),
    );
    let passes = &report.friction.passes;
    if !passes.is_empty() {
        let words: Vec<String> = passes.iter().map(|(pass, seen)| areas(*pass, seen)).collect();
        figure(
            html,
            friction(report),
            &format!(
                "Friction on the cable with the vehicle over the middle of the duct, positive toward growing x. {}",
                words.join(" ")
            ),
        );
    }
    html.raw("</div>");
    if let Some(remark) = &report.friction.remark {
        html.paragraph(remark);
    }
}

/// Values of a point of the duct against the vehicle's position past it: at x_v the vehicle is x_v − x = −ξ past the point at x.
fn past(report: &Report, values: &[f64], scale: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let pairs = report.motion.positions_m.iter().zip(values).rev();
    pairs.map(|(xi, value)| (-xi, scale(*value))).collect()
}

/// The axis of the vehicle's position.
fn position(report: &Report) -> Axis {
    let half = reach(&report.scene);
    Axis::linear("vehicle past the point looked at, m").range(-half, half)
}

/// The displacement of a point of the duct, as the vehicle drives by.
fn motion(report: &Report) -> [Chart; 2] {
    let motion = &report.motion;
    let chart = |title, label, values: &[f64], look| {
        let points = past(report, values, |value| MICRO * value);
        let line = Series::line("", points).look(look).solid();
        Chart::new(title, position(report), Axis::linear(label)).with(line)
    };
    let along = "Motion of the duct along its axis";
    [
        chart(along, "D_l, µm", &motion.longitudinal_m, 0),
        chart("and down", "D_v, µm", &motion.vertical_m, 1),
    ]
}

fn velocity(report: &Report) -> Chart {
    let velocity = &report.motion.longitudinal_velocity_m_per_s;
    let [forward, backward] = ways(report).map(|way| MICRO * way);
    let sign = report.scene.vehicles[0].vehicle.direction().sign();
    let part = |name: String, sign: f64| {
        let points = past(report, velocity, |v| MILLI * sign * (sign * v).max(0.0));
        Series::area(name, points).solid()
    };
    let label = Axis::linear("velocity, mm/s");
    Chart::new("Velocity of the duct along its axis", position(report), label)
        .with(part(format!("with the vehicle, {forward:.1} µm"), sign))
        .with(part(format!("against it, {backward:.1} µm"), -sign))
}

/// How far the duct moves with the vehicle and against it as it drives by: ∫ V_l dt of either sign \[m\].
fn ways(report: &Report) -> [f64; 2] {
    let motion = &report.motion;
    let vehicle = &report.scene.vehicles[0].vehicle;
    [vehicle.direction().sign(), -vehicle.direction().sign()].map(|sign| {
        let velocities = motion.longitudinal_velocity_m_per_s.iter();
        positive_area(&motion.positions_m, velocities.map(|v| sign * v)) / vehicle.speed()
    })
}

fn friction(report: &Report) -> impl Iterator<Item = Chart> {
    let limit = report.scene.friction_limit();
    let half = reach(&report.scene);
    report.friction.passes.iter().map(move |(pass, friction)| {
        let from_vehicle = friction
            .positions_m
            .iter()
            .map(|x| x - friction.vehicle_position_m);
        let points = from_vehicle.zip(friction.friction_n_per_m.iter().copied());
        Chart::new(
            format!("Friction on the cable, pass {}", count(*pass)),
            Axis::linear("place from the vehicle, m").range(-half, half),
            Axis::linear("friction, N/m").range(-1.5 * limit, 1.5 * limit),
        )
        .refer(Reference::horizontal(limit, "+μ N′"))
        .refer(Reference::horizontal(-limit, "−μ N′"))
        .with(Series::area("", points.filter(|(place, _)| place.abs() <= half)))
    })
}

/// Lengths at the limit, and the two areas of friction.
fn areas(pass: u64, friction: &FrictionProfile) -> String {
    let [forward, backward] = [1.0, -1.0].map(|sign| {
        let values = friction.friction_n_per_m.iter().map(|f| sign * f);
        rounded(positive_area(&friction.positions_m, values), 1)
    });
    let lengths = &friction.slip_lengths;
    format!(
        "Pass {}: at its limit over {:.1} m forward and {:.1} m backward; in total over the whole cable {forward} N forward and {backward} N \
         backward.",
        count(pass),
        lengths.forward_m,
        lengths.backward_m,
    )
}
