//! What each section of the page says.

use super::Report;
use super::figures::{self, Areas};
use super::html::{Headline, Html, Table};
use super::measures::Way;
use super::words;
use crate::design::Place;
use crate::figure::Panels;
use crate::scene::End;
use crate::shown::{count, length, rounded, selected, share, time};
use crate::{FrictionProfile, PassRecord};

const MILLI: f64 = 1e3;
const MICRO: f64 = 1e6;

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
        share(run.error_estimate.relative),
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

pub fn warnings(html: &mut Html, report: &Report) {
    if report.warnings.is_empty() {
        html.paragraph("None.");
    } else {
        html.list(&report.warnings);
    }
}

pub fn scene(html: &mut Html, report: &Report) {
    html.list(&words::scene(&report.scene));
    html.table(&words::ground(&report.scene));
    if let Some(scaling) = words::scaling(&report.scene) {
        html.paragraph(&scaling);
    }
    html.table(&words::vehicles(&report.scene));
}

/// A figure, or why it could not be drawn.
fn figure(html: &mut Html, panels: &Panels, caption: &str) {
    match panels.to_svg() {
        Ok(svg) => html.figure(&svg, caption),
        Err(error) => html.paragraph(&format!("A figure could not be drawn: {error}. {caption}")),
    }
}

pub fn force(html: &mut Html, report: &Report) {
    html.raw("<div class=\"figures\">");
    let measured = match &report.agreement {
        None => String::new(),
        Some(agreement) => format!(
            " {} readings at the {} end; measured minus computed force of {} of them: mean {} N, root of the mean square {} N, \
             largest reading {} N.{}",
            agreement.readings.len(),
            agreement.end_name(),
            agreement.compared,
            rounded(agreement.mean_n, 1),
            rounded(agreement.rms_n, 1),
            rounded(agreement.largest_n, 1),
            if agreement.readings.iter().any(|reading| reading.sigma.is_some()) {
                " Bars are one standard deviation long to either side."
            } else {
                ""
            }
        ),
    };
    figure(
        html,
        &figures::force(report),
        &format!("Force after each pass, compression positive. A free end carries none.{measured}"),
    );
    figure(
        html,
        &figures::along(report),
        "Force along the cable after the passes named, compression positive.",
    );
    figure(
        html,
        &figures::movement(report),
        "Displacement of the cable’s ends, positive toward growing x, downstream.",
    );
    html.table(&passes(report));
    html.raw("</div>");
    for clamp in &report.run.restraints {
        html.paragraph(&format!(
            "The clamp at {} carries {} N.",
            length(clamp.position_m),
            rounded(clamp.force_n, 1)
        ));
    }
}

/// Some passes, as the terminal shows them; without what stays zero, as the force on a free end.
fn passes(report: &Report) -> Table {
    type Column = (&'static str, fn(&PassRecord) -> f64, usize);
    // Soft hyphens: a phone is narrow.
    const COLUMNS: [Column; 4] = [
        ("force up\u{ad}stream, N", |record| record.upstream_force_n, 1),
        ("force down\u{ad}stream, N", |record| record.downstream_force_n, 1),
        (
            "moved up\u{ad}stream, mm",
            |record| MILLI * record.upstream_displacement_m,
            4,
        ),
        (
            "moved down\u{ad}stream, mm",
            |record| MILLI * record.downstream_displacement_m,
            4,
        ),
    ];
    let passes = &report.run.passes;
    let is_told = |(_, value, _): &Column| passes.iter().any(|record| value(record) != 0.0);
    let columns: Vec<Column> = if COLUMNS.iter().any(is_told) {
        COLUMNS.into_iter().filter(is_told).collect()
    } else {
        COLUMNS.to_vec()
    };
    let row = |record: &PassRecord| {
        let values = columns
            .iter()
            .map(|(_, value, decimals)| rounded(value(record), *decimals));
        std::iter::once(count(record.pass)).chain(values).collect()
    };
    let names = columns.iter().map(|(name, ..)| *name);
    Table {
        head: std::iter::once("pass").chain(names).map(str::to_owned).collect(),
        rows: selected(passes).into_iter().map(row).collect(),
        numbers: vec![true; 1 + columns.len()],
    }
}

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

pub fn measures(html: &mut Html, report: &Report) {
    let comparison = &report.measures;
    let end = match comparison.end {
        Place::Upstream => "upstream",
        _ => "downstream",
    };
    html.paragraph(&format!(
        "The same traffic with the {end} end held in other ways, and with a clamp beside what the scene has. Force and movement are the \
         largest at either end during all passes. Each row is a run of its own at a tolerance of {} %, all on one mesh: good for \
         comparing, rougher than the numbers above. The command “creepage design” finds the stiffness for given limits.",
        100.0 * comparison.tolerance
    ));
    if let Some(failure) = &comparison.failure {
        html.paragraph(&format!("The comparison failed: {failure}"));
        return;
    }
    html.raw("<div class=\"figures\">");
    if let Some(panels) = figures::measures(report) {
        figure(
            html,
            &panels,
            "Largest force against largest movement: a softer end moves more and is pressed less.",
        );
    }
    let rows = comparison.ways.iter().map(|way| {
        let mut row = vec![way.name()];
        row.extend(match &way.answer {
            Ok(answer) => [
                rounded(answer.force_n, 1),
                rounded(MILLI * answer.movement_m, 3),
                answer.clamp_force_n.map_or("–".into(), |force| rounded(force, 1)),
                share(answer.error_estimate),
            ],
            Err(_) => ["failed", "–", "–", "–"].map(str::to_owned),
        });
        row
    });
    html.table(&Table {
        head: ["held by", "force, N", "movement, mm", "on clamp, N", "error"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
        numbers: vec![false, true, true, true, true],
    });
    html.raw("</div>");
    html.list(&failures(&comparison.ways));
}

/// Ways that failed and why, those with the same reason together.
fn failures(ways: &[Way]) -> Vec<String> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for way in ways {
        let Err(error) = &way.answer else { continue };
        let error = error.to_string();
        match reasons.iter_mut().find(|(reason, _)| *reason == error) {
            Some((_, names)) => names.push(way.name()),
            None => reasons.push((error, vec![way.name()])),
        }
    }
    reasons
        .into_iter()
        .map(|(reason, names)| format!("Failed: {}: {reason}", names.join("; ")))
        .collect()
}

pub fn plan(html: &mut Html, report: &Report) {
    let (run, plan) = (&report.run, &report.plan);
    html.paragraph(&format!(
        "Ground {}, cable {}, node spacing {:.3} m, vehicle step {:.3} m.",
        run.plan.ground, run.plan.cable, run.plan.node_spacing_m, run.plan.vehicle_step_m
    ));
    html.list(&run.plan.reasons);
    html.element("h3", "What was weighed");
    let rows = plan.ladder.iter().map(|rung| {
        let cost = [rung.estimated_error.map(share), rung.estimated_seconds.map(time)];
        vec![
            format!(
                "{} {}: {}",
                rung.part,
                rung.name,
                if rung.chosen { "taken" } else { "rejected" }
            ),
            cost.into_iter().flatten().collect::<Vec<_>>().join(", "),
            rung.reason.clone(),
        ]
    });
    html.table(&Table {
        head: ["model", "error, time", "why, or why not"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
        numbers: vec![false; 3],
    });
    html.element("h3", "Error of the forces");
    let error = &run.error_estimate;
    html.paragraph(&format!(
        "{} in all, {}. How well the equations are solved, not how well they describe a duct.",
        share(error.relative),
        error.method
    ));
    let parts = error.parts;
    let row = |name: &str, part: f64| vec![name.to_owned(), share(part)];
    html.table(&Table {
        head: vec!["part".into(), "error".into()],
        rows: vec![
            row("node spacing and vehicle step", parts.mesh),
            row("ground model", parts.ground),
            row("inertia of the cable", parts.inertia),
            row("law of many passes", parts.law),
        ],
        numbers: vec![false, true],
    });
}

pub fn limits(html: &mut Html, _: &Report) {
    html.paragraph(
        "Heat (a loaded cable expands every day, and may press on its ends harder than creepage does), bends and slopes of the route, \
         vehicles near the speed of the ground’s waves, and any change of the ground with time.",
    );
    html.paragraph(
        "Method: K. Kashiro, K. Iwamura, T. Kamibayashi, T. Nagayama, H. Nishikubo, “Development of an Analysis Method for Power \
         Cable Creepage Phenomenon in the Duct”, Furukawa Review.",
    );
}
