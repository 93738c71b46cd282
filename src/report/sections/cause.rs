//! Why the cable creeps: motion of the duct, its velocity, friction.

use crate::FrictionProfile;
use crate::report::Report;
use crate::report::figures::{self, Areas};
use crate::report::html::Html;
use crate::shown::rounded;

use super::{MICRO, figure};

pub fn cause(html: &mut Html, report: &Report) {
    html.paragraph(
        "The ground bends under every vehicle, and the duct moves along its axis: with the vehicle over a long way and slowly, \
         against it over a short way and fast. Friction does not ask for speed, so it drags the cable further with the vehicle \
         than against it.",
    );
    html.raw("<div class=\"figures\">");
    let motion = &report.motion;
    figure(
        html,
        &figures::motion(report),
        &format!(
            "Displacement of a point of the duct as {} drives by, by the ground model {}; along the axis positive toward growing x.",
            if report.scene.vehicles.len() == 1 {
                "the vehicle"
            } else {
                "the first vehicle"
            },
            motion.ground
        ),
    );
    let Areas { forward, backward } = figures::areas(report);
    figure(
        html,
        &figures::velocity(report),
        &format!(
            "Velocity of that point. The areas are how far it runs: {:.1} µm with the vehicle and {:.1} µm against it within \
             this figure; they are equal when the vehicle is far away.",
            MICRO * forward,
            MICRO * backward
        ),
    );
    if let Some(panels) = figures::friction(report) {
        let passes = &report.friction.passes;
        let words: Vec<String> = passes.iter().map(|(pass, seen)| areas(*pass, seen)).collect();
        figure(
            html,
            &panels,
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

/// Lengths at the limit, and the two areas of friction.
fn areas(pass: u64, friction: &FrictionProfile) -> String {
    let area = |sign: f64| {
        friction
            .positions_m
            .windows(2)
            .zip(friction.friction_n_per_m.windows(2))
            .map(|(x, f)| 0.5 * (x[1] - x[0]) * ((sign * f[0]).max(0.0) + (sign * f[1]).max(0.0)))
            .sum::<f64>()
    };
    format!(
        "Pass {pass}: at its limit over {:.1} m forward and {:.1} m backward; areas {} N forward, {} N backward.",
        friction.slip_lengths.forward_m,
        friction.slip_lengths.backward_m,
        rounded(area(1.0), 1),
        rounded(area(-1.0), 1)
    )
}
