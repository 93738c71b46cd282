//! The top of the page: the answer in words, verdicts, and the most important numbers.

use super::content::Report;
use super::figure::MICRO;
use super::html::Html;
use super::measures::pressed_end;
use super::quantity::count;
use crate::answer::{CableEnd, after};
use crate::design::Place;
use crate::scene::{End, Scene};
use crate::shown::percent;
use crate::{Limited, PassRecord, Run, Saturation, Verdict};

/// Title and the most important numbers.
pub fn headline(html: &mut Html, report: &Report) {
    html.element("h1", &report.scene.title);
    html.paragraph(&format!(
        "Creepage of the cable in its duct under traffic, {}.{}",
        report.made(),
        if report.warnings.is_empty() {
            " No warnings."
        } else {
            ""
        }
    ));
    let Some(last) = report.run.passes.last() else {
        return;
    };
    html.raw("<div class=\"answer\">");
    html.paragraph(&answer(report, last));
    html.raw("</div>");
    html.verdicts(report.verdicts.iter().map(|verdict| {
        let later = later(report, verdict);
        let kept = verdict.reached_after.is_none() && later.is_empty();
        (kept, verdict.shown(&report.shown.units) + &later)
    }));
    html.raw("<dl class=\"headlines\">");
    forces(html, report, last);
    let moved = CableEnd::ALL.map(|end| (movement(&report.run, last, end), end));
    let [(first, _), (second, _)] = moved;
    let (most, end) = moved[usize::from(second.abs() >= first.abs())];
    let note = format!("{} end, {}", end.name(), over(report, last.pass));
    html.headline("Movement of an end", &report.shown.movement(most), &note);
    let motion = &report.run.duct_motion;
    let along = format!("{:.2} µm", MICRO * motion.peak_longitudinal_m);
    let down = format!("along its axis; {:.1} µm down", MICRO * motion.peak_vertical_m);
    html.headline("Peak motion of the duct", &along, &down);
    let error = percent(report.run.error_estimate.relative);
    let note = "of the forces, from the computation alone";
    html.headline("Estimated error", &error, note);
    html.raw("</dl>");
}

/// The three cards about forces.
fn forces(html: &mut Html, report: &Report, last: &PassRecord) {
    let Report { run, shown, .. } = report;
    let (largest, place) = hardest(run);
    let traffic = |html: &mut Html| {
        let years = report.scene.traffic.years_after(last.pass);
        let note = years.map_or("their rate is not known".into(), |years| {
            format!("in {}", after(years))
        });
        html.headline("Passes computed", &count(last.pass), &note);
    };
    let note = format!("{}{}, during all passes", on(place), tension(largest));
    if run.heat.is_some() {
        html.headline("Largest force with heat", &shown.force(largest), &note);
        let swing = run.days.last().map_or(0.0, |day| day.largest_range().0);
        html.headline(
            "Swing of the force",
            &shown.force(swing),
            "on an end within the last day",
        );
        return traffic(html);
    }
    if let Some(saturation) = &run.saturation {
        let place = levelled(&report.scene, saturation);
        let note = format!("{}{}", on(place), tension(saturation.force_n));
        html.headline("Saturated force", &shown.force(saturation.force_n), &note);
        let reached = saturation.passes_to_95_percent;
        let time = report.scene.traffic.years_after(reached);
        let time = time.map_or_else(String::new, |years| format!("{}; ", after(years)));
        let note = format!("{time}{} computed", count(last.pass));
        html.headline("Passes to 95 % of it", &count(reached), &note);
    } else {
        let (force, place) = pressed(&report.scene, last);
        let note = format!("{}{}, not levelled off", on(place), tension(force));
        html.headline("Force after the last pass", &shown.force(force), &note);
        traffic(html);
    }
    html.headline("Largest force computed", &shown.force(largest), &note);
}

/// The answer in sentences.
fn answer(report: &Report, last: &PassRecord) -> String {
    let Report { scene, shown, .. } = report;
    let passes = |pass: u64| {
        let words = if pass == 1 {
            "one pass".into()
        } else {
            format!("{} passes", count(pass))
        };
        let time = scene.traffic.years_after(pass).map(after);
        time.map_or(words.clone(), |time| format!("{words} ({time})"))
    };
    let moved = format!(" {}", moved(report, last));
    if report.run.heat.is_some() {
        let (force, place) = hardest(&report.run);
        return format!(
            "In {} heat and traffic load {} with up to {}{}.{moved}",
            passes(last.pass),
            the(place),
            shown.force(force),
            tension(force)
        );
    }
    let (force, place) = pressed(scene, last);
    let now = format!(
        "After {} the {} is {}{}",
        passes(last.pass),
        force_of(place),
        shown.force(force),
        tension(force)
    );
    let Some(saturation) = &report.run.saturation else {
        return format!("{now}; it has not levelled off.{moved}");
    };
    let level = shown.force(saturation.force_n);
    let reached = passes(saturation.passes_to_95_percent);
    if saturation.passes_to_95_percent > last.pass {
        return format!(
            "{now}. It levels off at {level}; 95 % of that takes {reached}, more than were computed.{moved}"
        );
    }
    format!(
        "The {} levels off at {level}. 95 % of that is reached after {reached}.{moved}",
        force_of(levelled(scene, saturation))
    )
}

/// How far both ends have moved.
fn moved(report: &Report, last: &PassRecord) -> String {
    let ends = &report.scene.ends;
    let (moves, when) = if report.run.heat.is_some() {
        ("moves by up to", "Over all days")
    } else {
        ("has moved", "After the last pass computed")
    };
    let of = |(end, held): (CableEnd, End)| {
        let free = if held == End::Free { "free " } else { "" };
        let moved = report.shown.movement(movement(&report.run, last, end).abs());
        (held != End::Fixed).then(|| format!("the {free}{} end {moves} {moved}", end.name()))
    };
    let both = [
        (CableEnd::Upstream, ends.upstream),
        (CableEnd::Downstream, ends.downstream),
    ];
    let moved: Vec<String> = both.into_iter().filter_map(of).collect();
    if moved.is_empty() {
        return "Both ends are fixed.".to_owned();
    }
    format!("{when} {}.", moved.join(" and "))
}

/// Displacement after the last pass; of a heated cable the farthest of all days \[m\].
fn movement(run: &Run, last: &PassRecord, end: CableEnd) -> f64 {
    match (&run.heat, end) {
        (Some(heat), _) => heat.all_days.movement(end),
        (None, CableEnd::Upstream) => last.upstream_displacement_m,
        (None, CableEnd::Downstream) => last.downstream_displacement_m,
    }
}

/// Where a force acts: on an end, or within the cable.
type At = Option<CableEnd>;

/// The force that is largest in size on an end, after passes and during them and in all heat, or in the cable where no end is held.
fn hardest(run: &Run) -> (f64, At) {
    let of_passes = run.passes.iter().flat_map(|record| {
        [
            (record.downstream_force_n, CableEnd::Downstream),
            (record.downstream_peak_n, CableEnd::Downstream),
            (record.upstream_force_n, CableEnd::Upstream),
            (record.upstream_peak_n, CableEnd::Upstream),
        ]
    });
    let days = run.heat.iter().map(|heat| &heat.all_days);
    let of_days = days.clone().flat_map(|days| {
        [
            (days.downstream_max_n, CableEnd::Downstream),
            (days.downstream_min_n, CableEnd::Downstream),
            (days.upstream_max_n, CableEnd::Upstream),
            (days.upstream_min_n, CableEnd::Upstream),
        ]
    });
    let largest = of_passes
        .chain(of_days)
        .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    if let Some((force, end)) = largest.filter(|(force, _)| *force != 0.0) {
        return (force, Some(end));
    }
    let inside = run.passes.iter().map(|record| record.max_compression_n);
    let inside = inside.chain(days.map(|days| days.max_compression_n));
    (inside.fold(0.0, f64::max), None)
}

/// The force that matters most after a pass.
fn pressed(scene: &Scene, last: &PassRecord) -> (f64, At) {
    match pressed_end(scene, last) {
        None => (last.max_compression_n, None),
        Some(Place::Upstream) => (last.upstream_force_n, Some(CableEnd::Upstream)),
        Some(_) => (last.downstream_force_n, Some(CableEnd::Downstream)),
    }
}

/// Where the force acts that levels off.
fn levelled(scene: &Scene, saturation: &Saturation) -> At {
    match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => None,
        _ if saturation.upstream_force_n.abs() > saturation.downstream_force_n.abs() => {
            Some(CableEnd::Upstream)
        }
        _ => Some(CableEnd::Downstream),
    }
}

/// What a limit that is kept so far comes to later.
fn later(report: &Report, verdict: &Verdict) -> String {
    let Some(saturation) = &report.run.saturation else {
        return String::new();
    };
    let level = match verdict.end {
        Place::Upstream => saturation.upstream_force_n,
        Place::Downstream => saturation.downstream_force_n,
        Place::Clamp(_) => return String::new(),
    };
    let exceeds = verdict.quantity == Limited::Force && level.abs() > verdict.limit;
    if verdict.reached_after.is_some() || !exceeds {
        return String::new();
    }
    format!(
        " in these passes; more of them exceed it, as the force levels off at {}",
        report.shown.force(level)
    )
}

fn force_of(place: At) -> String {
    place.map_or("largest compression in the cable".into(), |end| {
        format!("force on the {} end", end.name())
    })
}

fn on(place: At) -> String {
    place.map_or("in the cable".into(), |end| format!("on the {} end", end.name()))
}

fn the(place: At) -> String {
    place.map_or("the cable".into(), |end| format!("the {} end", end.name()))
}

/// What a force does, where that is not what one expects.
fn tension(force: f64) -> &'static str {
    if force < 0.0 { ", tension" } else { "" }
}

/// The passes that were computed.
fn over(report: &Report, passes: u64) -> String {
    let when = if report.run.heat.is_some() { "in" } else { "after" };
    let plural = if passes == 1 { "" } else { "es" };
    format!("{when} {} pass{plural}", count(passes))
}
