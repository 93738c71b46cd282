//! Why the cable creeps: motion of the duct under the first vehicle, its velocity, and friction on the cable (Kashiro et al., Figures 2
//! to 7).

use super::content::{Report, reach};
use super::figure::{MICRO, MILLI, figure};
use super::friction::positive_area;
use super::html::Html;
use super::quantity::{Shown, count, round_below, significant};
use crate::figure::{Axis, Chart, Reference, Series};
use crate::{FrictionProfile, Units};

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
        let which = match passes.len() {
            1 => "",
            _ => ", in the first pass and the last one above that was simulated",
        };
        let words: Vec<String> = passes
            .iter()
            .map(|(pass, seen)| areas(*pass, seen, &report.shown))
            .collect();
        figure(
            html,
            friction(report),
            &format!(
                "Friction on the cable with the vehicle over the middle of the duct, positive toward growing x{which}. {}",
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
    let length = report.shown.units.length;
    pairs
        .map(|(xi, value)| (length.of_si(-xi), scale(*value)))
        .collect()
}

/// An axis of places to either side, with ticks on both sides.
fn either_side(report: &Report, name: &str) -> Axis {
    let half = reach(&report.scene, report.shown.units.length);
    let step = round_below(half);
    let most = (half / step).floor() as i32;
    let ticks = (-most..=most).map(|k| step * f64::from(k));
    Axis::linear(report.shown.in_length(name))
        .range(-half, half)
        .ticks(ticks.map(|place| (place, significant(place).replace('-', "−"))))
}

/// The axis of the vehicle's position.
fn position(report: &Report) -> Axis {
    either_side(report, "vehicle past the point looked at")
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
    let sign = report.scene.vehicles[0].direction.sign();
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
    let vehicle = &report.scene.vehicles[0];
    [vehicle.direction.sign(), -vehicle.direction.sign()].map(|sign| {
        let velocities = motion.longitudinal_velocity_m_per_s.iter();
        positive_area(&motion.positions_m, velocities.map(|v| sign * v)) / vehicle.speed
    })
}

fn friction(report: &Report) -> impl Iterator<Item = Chart> {
    let Units { length, weight, .. } = report.shown.units;
    let limit = weight.of_si(report.scene.friction_limit());
    let half = reach(&report.scene, length);
    report.friction.passes.iter().map(move |(pass, friction)| {
        let from_vehicle = friction
            .positions_m
            .iter()
            .map(|x| length.of_si(x - friction.vehicle_position_m));
        let friction = friction.friction_n_per_m.iter();
        let points = from_vehicle.zip(friction.map(|friction| weight.of_si(*friction)));
        Chart::new(
            format!("Friction on the cable, pass {}", count(*pass)),
            either_side(report, "place from the vehicle"),
            Axis::linear(format!("friction, {}", weight.symbol())).range(-1.5 * limit, 1.5 * limit),
        )
        .refer(Reference::horizontal(limit, "+μ N′"))
        .refer(Reference::horizontal(-limit, "−μ N′"))
        .with(Series::area("", points.filter(|(place, _)| place.abs() <= half)))
    })
}

/// Lengths at the limit, and the two areas of friction.
fn areas(pass: u64, friction: &FrictionProfile, shown: &Shown) -> String {
    let [forward, backward] = [1.0, -1.0].map(|sign| {
        let values = friction.friction_n_per_m.iter().map(|f| sign * f);
        shown.force(positive_area(&friction.positions_m, values))
    });
    let (lengths, unit) = (&friction.slip_lengths, shown.units.length);
    format!(
        "Pass {}: at its limit over {:.1} {metres} forward and {:.1} {metres} backward; in total over the whole cable {forward} forward and \
         {backward} backward.",
        count(pass),
        unit.of_si(lengths.forward_m),
        unit.of_si(lengths.backward_m),
        metres = unit.symbol(),
    )
}
