//! Title and the numbers that count.

use crate::PassRecord;
use crate::report::Report;
use crate::report::html::{Headline, Html};
use crate::report::quantity::count;
use crate::scene::End;
use crate::shown::{percent, rounded};

use super::{MICRO, MILLI};

fn headline(name: &str, value: String, note: impl Into<String>) -> Headline {
    Headline {
        name: name.into(),
        value,
        note: note.into(),
    }
}

/// Title and the numbers that count.
pub fn heading(html: &mut Html, report: &Report) {
    let run = &report.run;
    html.element("h1", &report.scene.title);
    html.paragraph(&format!(
        "Creepage of the cable in its duct under traffic, computed by creepage {}.",
        env!("CARGO_PKG_VERSION")
    ));
    let Some(last) = run.passes.last() else { return };
    let (force, place) = pressed(report, last);
    let mut headlines = Vec::new();
    if let Some(saturation) = &run.saturation {
        let force = format!("{} N", rounded(saturation.force_n, 1));
        headlines.push(headline(
            "Saturated force",
            force,
            format!("{place}{}", tension(saturation.force_n)),
        ));
        headlines.push(headline(
            "Passes to 95 % of it",
            count(saturation.passes_to_95_percent),
            format!("of {} computed", count(last.pass)),
        ));
    } else {
        headlines.push(headline(
            "Force after the last pass",
            format!("{} N", rounded(force, 1)),
            format!(
                "{place}{}, not levelled off after {} passes",
                tension(force),
                count(last.pass)
            ),
        ));
    }
    let (upstream, downstream) = (last.upstream_displacement_m, last.downstream_displacement_m);
    let (end, moved) = if upstream.abs() > downstream.abs() {
        ("upstream", upstream)
    } else {
        ("downstream", downstream)
    };
    headlines.push(headline(
        "Movement of an end",
        format!("{} mm", rounded(MILLI * moved, 3)),
        format!("{end} end, after {} passes", count(last.pass)),
    ));
    headlines.push(headline(
        "Peak motion of the duct",
        format!("{:.2} µm", MICRO * run.duct_motion.peak_longitudinal_m),
        format!(
            "along its axis; {:.1} µm down",
            MICRO * run.duct_motion.peak_vertical_m
        ),
    ));
    headlines.push(headline(
        "Estimated error",
        percent(run.error_estimate.relative),
        "of the forces, by the computation alone",
    ));
    html.headlines(&headlines);
}

/// The force of the headline after the last pass \[N\], and where it is.
fn pressed(report: &Report, last: &PassRecord) -> (f64, &'static str) {
    let upstream = (last.upstream_force_n, "on the upstream end");
    let downstream = (last.downstream_force_n, "on the downstream end");
    match (report.scene.ends.upstream, report.scene.ends.downstream) {
        (End::Free, End::Free) => (last.max_compression_n, "largest compression in the cable"),
        (_, End::Free) => upstream,
        (End::Free, _) => downstream,
        _ if upstream.0.abs() > downstream.0.abs() => upstream,
        _ => downstream,
    }
}

/// What a force does, where that is not what one expects.
fn tension(force: f64) -> &'static str {
    if force < 0.0 { ", tension" } else { "" }
}
