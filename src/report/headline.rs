//! Title and the most important numbers.

use super::content::Report;
use super::figure::{MICRO, MILLI};
use super::html::{Headline, Html};
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
    let tension = |force| if force < 0.0 { ", tension" } else { "" };
    let mut headlines = match &run.saturation {
        Some(saturation) => vec![
            Headline {
                name: "Saturated force",
                value: newtons(saturation.force_n),
                note: format!("{place}{}", tension(saturation.force_n)),
            },
            Headline {
                name: "Passes to 95 % of it",
                value: count(saturation.passes_to_95_percent),
                note: format!("of {passes} computed"),
            },
        ],
        None => vec![Headline {
            name: "Force after the last pass",
            value: newtons(force),
            note: format!(
                "{place}{}, not levelled off after {passes} passes",
                tension(force)
            ),
        }],
    };
    let (upstream, downstream) = (last.upstream_displacement_m, last.downstream_displacement_m);
    let (end, moved) = if upstream.abs() > downstream.abs() {
        ("upstream", upstream)
    } else {
        ("downstream", downstream)
    };
    let motion = &run.duct_motion;
    headlines.extend([
        Headline {
            name: "Movement of an end",
            value: format!("{} mm", rounded(MILLI * moved, 3)),
            note: format!("{end} end, after {passes} passes"),
        },
        Headline {
            name: "Peak motion of the duct",
            value: format!("{:.2} µm", MICRO * motion.peak_longitudinal_m),
            note: format!("along its axis; {:.1} µm down", MICRO * motion.peak_vertical_m),
        },
        Headline {
            name: "Estimated error",
            value: percent(run.error_estimate.relative),
            note: "of the forces, from the computation alone".into(),
        },
    ]);
    html.headlines(&headlines);
}
