//! Why the cable creeps: motion of the duct under the first vehicle, its velocity, and friction on the cable (Kashiro et al., Figures 2
//! to 7).

use super::chart::{ALONE, MICRO, MILLI, STACKED, figure};
use super::content::{Report, reach};
use super::html::Html;
use crate::words::{count, round_below, significant};
use creepage_plan::shown::words_if;
use creepage_run::{FrictionProfile, Units};
use plain_figure::{Axis, Chart, Reference, Series};

pub fn cause(html: &mut Html, report: &Report) {
    html.paragraph(
        "The ground bends under every vehicle and moves the duct along its axis: slowly with the vehicle over a long stretch, \
         fast against it over a short one. Friction does not depend on speed, so it drags the cable a little further with the \
         vehicle than against it.",
    );
    html.raw("<div class=\"figures\">");
    let (which, ground) = (
        words_if(report.scene.vehicles.len() > 1, "first "),
        &report.motion.ground,
    );
    let caption = format!(
        "Displacement of a point of the duct as the {which}vehicle drives by, by the ground model {ground}; along the axis positive toward \
         growing x."
    );
    figure(html, STACKED, motion(report), &caption);
    let ways = ways(report).map(|way| MICRO * way);
    let [forward, backward] = ways;
    let caption = format!(
        "Velocity of that point. The areas are how far it moves: {forward:.1} µm with the vehicle and {backward:.1} µm against it within \
         this figure; they are equal when the vehicle is far away.",
    );
    figure(html, ALONE, [velocity(report, ways)], &caption);
    let passes = friction_of_passes(report);
    if !passes.is_empty() {
        let charts = passes
            .iter()
            .map(|(pass, friction)| friction_chart(report, *pass, friction));
        let words = passes
            .iter()
            .map(|(pass, friction)| areas(report, *pass, friction));
        let words = words.collect::<Vec<_>>().join(" ");
        let is_pair = passes.len() > 1;
        let which = words_if(
            is_pair,
            ", in the first pass and the last one above that was simulated",
        );
        let caption = format!(
            "Friction on the cable with the vehicle over the middle of the duct, positive toward growing x{which}. {words}"
        );
        figure(html, if is_pair { STACKED } else { ALONE }, charts, &caption);
    }
    html.raw("</div>");
    if report.scene.friction_limit() == 0.0 {
        html.paragraph("There is no friction here, so nothing drags the cable along.");
    }
}

/// The first and the last pass of which the run shows friction; none without any, and none of a heated cable.
fn friction_of_passes(report: &Report) -> Vec<(u64, &FrictionProfile)> {
    let stages = report.run.stages.iter();
    let stages = stages.filter(|_| report.scene.friction_limit() > 0.0);
    let passes = stages.filter_map(|stage| Some((stage.pass, stage.friction.as_ref()?)));
    let mut passes: Vec<_> = passes.collect();
    if passes.len() > 2 {
        passes.drain(1..passes.len() - 1);
    }
    passes
}

/// ∫ of the positive part of `values` over `places`, by the trapezoidal rule.
fn positive_area(places: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.map(|value| value.max(0.0)).collect();
    let widths = places.windows(2).map(|x| x[1] - x[0]);
    let means = values.windows(2).map(|v| 0.5 * (v[0] + v[1]));
    widths.zip(means).map(|(width, mean)| width * mean).sum()
}

/// Values of a point of the duct against the vehicle's position past it: at x_v the vehicle is x_v − x = −ξ past the point at x.
fn past(report: &Report, values: &[f64], scale: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let pairs = report.motion.positions_m.iter().zip(values).rev();
    let length = report.reader.units.length;
    pairs
        .map(|(xi, value)| (length.of_si(-xi), scale(*value)))
        .collect()
}

/// An axis of places to either side, with ticks on both sides.
fn either_side(report: &Report, name: &str) -> Axis {
    let half = reach(&report.scene, report.reader.units.length);
    let step = round_below(half);
    let most = (half / step).floor() as i32;
    let ticks = (-most..=most).map(|k| step * f64::from(k));
    Axis::linear(report.reader.in_length(name))
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
    let chart = |title, values: &[f64], look| {
        let line = Series::line("", past(report, values, |value| MICRO * value));
        Chart::new(title, position(report), Axis::linear("displacement, µm")).with(line.look(look).solid())
    };
    [
        chart("Motion of the duct along its axis", &motion.longitudinal_m, 0),
        chart("Motion of the duct down", &motion.vertical_m, 1),
    ]
}

/// The velocity of that point, in the direction of the vehicle and against it, with both ways \[µm\].
fn velocity(report: &Report, [forward, backward]: [f64; 2]) -> Chart {
    let velocity = &report.motion.longitudinal_velocity_m_per_s;
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

fn friction_chart(report: &Report, pass: u64, friction: &FrictionProfile) -> Chart {
    let Units { length, weight, .. } = report.reader.units;
    let limit = weight.of_si(report.scene.friction_limit());
    let half = reach(&report.scene, length);
    let from_vehicle = |x: &f64| length.of_si(x - friction.vehicle_position_m);
    let values = friction.friction_n_per_m.iter().map(|value| weight.of_si(*value));
    let points = friction.positions_m.iter().map(from_vehicle).zip(values);
    Chart::new(
        format!("Friction on the cable, pass {}", count(pass)),
        either_side(report, "place from the vehicle"),
        Axis::linear(format!("friction, {}", weight.symbol())).range(-1.5 * limit, 1.5 * limit),
    )
    .refer(Reference::horizontal(limit, "+μ N′"))
    .refer(Reference::horizontal(-limit, "−μ N′"))
    .with(Series::area("", points.filter(|(place, _)| place.abs() <= half)))
}

/// Lengths at the limit, and the two areas of friction.
fn areas(report: &Report, pass: u64, friction: &FrictionProfile) -> String {
    let [forward, backward] = [1.0, -1.0].map(|sign| {
        let values = friction.friction_n_per_m.iter().map(|f| sign * f);
        report.reader.force(positive_area(&friction.positions_m, values))
    });
    let (lengths, unit) = (&friction.slip_lengths, report.reader.units.length);
    let [ahead, back] = [lengths.forward, lengths.backward].map(|length| unit.of_si(length));
    let (pass, metres) = (count(pass), unit.symbol());
    format!(
        "Pass {pass}: at its limit over {ahead:.1} {metres} forward and {back:.1} {metres} backward; in total over the whole cable {forward} \
         forward and {backward} backward."
    )
}
