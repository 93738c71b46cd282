//! Title and the most important numbers.

use super::content::Report;
use super::figure::{MICRO, MILLI};
use super::html::Html;
use super::measures::pressed_end;
use super::quantity::count;
use crate::design::Place;
use crate::shown::{percent, rounded};

pub fn headline(html: &mut Html, report: &Report) {
    let run = &report.run;
    html.element("h1", &report.scene.title);
    let version = env!("CARGO_PKG_VERSION");
    html.paragraph(&format!(
        "Creepage of the cable in its duct under traffic, computed by creepage {version}."
    ));
    let Some(last) = run.passes.last() else { return };
    let passes = count(last.pass);
    let (force, place) = match pressed_end(&report.scene, last) {
        None => (last.max_compression_n, "largest compression in the cable"),
        Some(Place::Upstream) => (last.upstream_force_n, "on the upstream end"),
        Some(_) => (last.downstream_force_n, "on the downstream end"),
    };
    let newtons = |force| format!("{} N", rounded(force, 1));
    // What a force does, where that is not what one expects.
    let place = |force| format!("{place}{}", if force < 0.0 { ", tension" } else { "" });
    html.raw("<dl class=\"headlines\">");
    if let Some(saturation) = &run.saturation {
        let force = saturation.force_n;
        html.headline("Saturated force", &newtons(force), &place(force));
        let reached = count(saturation.passes_to_95_percent);
        html.headline("Passes to 95 % of it", &reached, &format!("of {passes} computed"));
    } else {
        let note = format!("{}, not levelled off after {passes} passes", place(force));
        html.headline("Force after the last pass", &newtons(force), &note);
    }
    let (upstream, downstream) = (last.upstream_displacement_m, last.downstream_displacement_m);
    let (end, moved) = if upstream.abs() > downstream.abs() {
        ("upstream", upstream)
    } else {
        ("downstream", downstream)
    };
    let moved = format!("{} mm", rounded(MILLI * moved, 3));
    let note = format!("{end} end, after {passes} passes");
    html.headline("Movement of an end", &moved, &note);
    let motion = &run.duct_motion;
    let along = format!("{:.2} µm", MICRO * motion.peak_longitudinal_m);
    let down = format!("along its axis; {:.1} µm down", MICRO * motion.peak_vertical_m);
    html.headline("Peak motion of the duct", &along, &down);
    let error = percent(run.error_estimate.relative);
    let note = "of the forces, from the computation alone";
    html.headline("Estimated error", &error, note);
    html.raw("</dl>");
}
