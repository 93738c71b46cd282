//! The page: its head, its style, and its sections in their order.

use super::cause::cause;
use super::content::Report;
use super::figure::{MICRO, MILLI};
use super::force::force;
use super::heat::heat;
use super::holding::holding;
use super::html::{Html, escaped};
use super::measures::pressed_end;
use super::plan::plan;
use super::quantity::count;
use super::words;
use crate::PassRecord;
use crate::answer::{CableEnd, DayExtremes, after};
use crate::design::Place;
use crate::figure::dark_style;
use crate::shown::{percent, rounded};

const STYLE: &str = include_str!("style.css");

/// Only of a cable that is heated.
const HEAT: &str = "Heat, day by day";

type Section = (&'static str, fn(&mut Html, &Report));

const SECTIONS: [Section; 8] = [
    ("Warnings", warnings),
    ("Scene", scene),
    ("Force and movement", force),
    (HEAT, heat),
    ("Why the cable creeps", cause),
    ("Ways to hold the cable", holding),
    ("How it was computed", plan),
    ("What is left out", limits),
];

impl Report {
    /// The page.
    pub fn to_html(&self) -> String {
        let mut html = Html::default();
        html.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>");
        html.raw("<meta charset=\"utf-8\"/>");
        html.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>");
        // Nothing is ever loaded, whatever a text on the page may say.
        html.raw("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\"/>");
        html.raw("<meta name=\"color-scheme\" content=\"light dark\"/>");
        // This identifies our own pages.
        let version = env!("CARGO_PKG_VERSION");
        html.raw(&format!(
            "<meta name=\"generator\" content=\"creepage {version}\"/>"
        ));
        let title = escaped(&self.scene.title);
        html.raw(&format!("<title>{title}: cable creepage</title>"));
        html.raw(&format!(
            "<style>\n{STYLE}@media screen and (prefers-color-scheme: dark) {{\n{}}}\n</style>",
            dark_style()
        ));
        html.raw("</head>\n<body>\n<main>");
        headline(&mut html, self);
        for (title, write) in SECTIONS {
            if title == HEAT && self.run.heat.is_none() {
                continue;
            }
            html.raw("<section>");
            html.element("h2", title);
            write(&mut html, self);
            html.raw("</section>");
        }
        html.raw("</main>\n</body>\n</html>");
        html.finish()
    }
}

/// Title and the most important numbers.
fn headline(html: &mut Html, report: &Report) {
    let run = &report.run;
    html.element("h1", &report.scene.title);
    let version = env!("CARGO_PKG_VERSION");
    html.paragraph(&format!(
        "Creepage of the cable in its duct under traffic, computed by creepage {version}."
    ));
    let Some(last) = run.passes.last() else { return };
    let passes = count(last.pass);
    let (force, what) = pressed(report, last);
    let place = what.trim_start_matches("force ");
    let newtons = |force| format!("{} N", rounded(force, 1));
    // What a force does, where that is not what one expects.
    let place = |force| format!("{place}{}", if force < 0.0 { ", tension" } else { "" });
    html.paragraph(&answer(report, last));
    html.raw("<div class=\"verdicts\">");
    let verdicts: Vec<String> = report.verdicts.iter().map(ToString::to_string).collect();
    html.list(&verdicts);
    html.raw("</div>");
    html.raw("<dl class=\"headlines\">");
    if let Some(saturation) = &run.saturation {
        let force = saturation.force_n;
        html.headline("Saturated force", &newtons(force), &place(force));
        let reached = count(saturation.passes_to_95_percent);
        let time = report.scene.traffic.years_after(saturation.passes_to_95_percent);
        let time = time.map_or_else(String::new, |years| format!("{}, ", after(years)));
        html.headline(
            "Passes to 95 % of it",
            &reached,
            &format!("{time}of {passes} computed"),
        );
    } else if let Some(heat) = &run.heat {
        let (force, place) = hardest(&heat.all_days);
        let note = format!("{place}, on all {} days", count(heat.all_days.day));
        html.headline("Largest force with heat", &newtons(force), &note);
    } else {
        let note = format!("{}, not levelled off after {passes} passes", place(force));
        html.headline("Force after the last pass", &newtons(force), &note);
    }
    let (upstream, downstream) = run.heat.as_ref().map_or(
        (last.upstream_displacement_m, last.downstream_displacement_m),
        |heat| {
            (
                heat.all_days.movement(CableEnd::Upstream),
                heat.all_days.movement(CableEnd::Downstream),
            )
        },
    );
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

/// The answer in a sentence.
fn answer(report: &Report, last: &PassRecord) -> String {
    let traffic = &report.scene.traffic;
    let passes = |pass: u64| {
        let time = traffic.years_after(pass).map(after);
        let words = if pass == 1 {
            "one pass".into()
        } else {
            format!("{} passes", count(pass))
        };
        time.map_or(words.clone(), |time| format!("{words} ({time})"))
    };
    if let Some(heat) = &report.run.heat {
        let (force, place) = hardest(&heat.all_days);
        return format!(
            "Heat and traffic press with up to {} N {place} in {}.",
            rounded(force, 1),
            passes(last.pass)
        );
    }
    let (force, what) = pressed(report, last);
    match &report.run.saturation {
        Some(saturation) => format!(
            "The {what} levels off at {} N. 95 % of that is reached after {}.",
            rounded(saturation.force_n, 1),
            passes(saturation.passes_to_95_percent)
        ),
        None => format!(
            "After {} the {what} is {} N; it has not levelled off.",
            passes(last.pass),
            rounded(force, 1)
        ),
    }
}

/// The force of days that is largest in size, and where it acts.
fn hardest(days: &DayExtremes) -> (f64, &'static str) {
    let forces = [
        (days.downstream_max_n, "on the downstream end"),
        (days.downstream_min_n, "on the downstream end, tension,"),
        (days.upstream_max_n, "on the upstream end"),
        (days.upstream_min_n, "on the upstream end, tension,"),
    ];
    let inside = (days.max_compression_n, "in the cable");
    let none = forces.iter().all(|(force, _)| *force == 0.0);
    let largest = forces.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    largest.filter(|_| !none).unwrap_or(inside)
}

/// The force that matters most after a pass, and where it acts.
fn pressed(report: &Report, last: &PassRecord) -> (f64, &'static str) {
    match pressed_end(&report.scene, last) {
        None => (last.max_compression_n, "largest compression in the cable"),
        Some(Place::Upstream) => (last.upstream_force_n, "force on the upstream end"),
        Some(_) => (last.downstream_force_n, "force on the downstream end"),
    }
}

fn warnings(html: &mut Html, report: &Report) {
    if report.warnings.is_empty() {
        html.paragraph("None.");
    }
    html.list(&report.warnings);
}

fn scene(html: &mut Html, report: &Report) {
    html.list(&words::scene(&report.scene));
    words::ground(html, &report.scene);
    if let Some(scaling) = words::scaling(&report.scene) {
        html.paragraph(&scaling);
    }
    words::vehicles(html, &report.scene);
}

fn limits(html: &mut Html, report: &Report) {
    let heat = if report.run.heat.is_some() {
        "A swing of temperature over the seasons"
    } else {
        "Heat (a loaded cable expands every day, and may press on its ends harder than creepage does; the scene has no [heat])"
    };
    html.paragraph(&format!(
        "{heat}, bends and changes of slope of the route, vehicles near the speed of the ground’s waves, and any change of the ground with \
         time."
    ));
    html.paragraph(
        "Method: K. Kashiro, K. Iwamura, T. Kamibayashi, T. Nagayama, H. Nishikubo, “Development of an Analysis Method for Power \
         Cable Creepage Phenomenon in the Duct”, Furukawa Review.",
    );
}
