//! The top of the page: the answer in words, verdicts, and the most important numbers.

use super::content::Report;
use super::ends;
use super::figure::MICRO;
use super::html::Html;
use super::measures::pressed_end;
use super::quantity::{count, significant};
use crate::answer::after;
use crate::design::Place;
use crate::scene::CableEnd;
use crate::scene::{End, Scene};
use crate::shown::{percent, words_if};
use crate::{Limited, PassRecord, Run, Saturation, Verdict};

/// Title and the most important numbers.
pub fn headline(html: &mut Html, report: &Report) {
    html.element("h1", &report.scene.title);
    html.paragraph(&format!(
        "Creepage of the cable in its duct under traffic, {}.{}",
        report.made(),
        words_if(report.warnings.is_empty(), " No warnings.")
    ));
    let Some(last) = report.run.passes.last() else {
        return;
    };
    html.raw("<div class=\"answer\">");
    html.paragraph(&answer(report, last));
    html.raw("</div>");
    html.verdicts(report.verdicts.iter().map(|verdict| {
        let kept = !verdict.is_exceeded() && verdict.levels_off_above.is_none();
        let shown = |value| report.shown.limited(verdict.quantity, value);
        (kept, verdict.shown_with(&report.shown.units, shown))
    }));
    if report.verdicts.len() > 1 {
        html.paragraph(&format!("Together: {}.", Verdict::summary(&report.verdicts)));
    }
    let is_of_clamp = |verdict: &Verdict| matches!(verdict.end, Place::Clamp(_));
    let has_clamps = !report.verdicts.is_empty() && !report.scene.restraints.is_empty();
    if has_clamps && !report.verdicts.iter().any(is_of_clamp) {
        html.paragraph("The clamps are not judged, as no limit names them (--limit-force clamp=FORCE).");
    }
    html.raw("<dl class=\"headlines\">");
    forces(html, report, last);
    let moved = CableEnd::ALL.map(|end| (movement(&report.run, last, end), end));
    let [(first, _), (second, _)] = moved;
    let (most, end) = moved[usize::from(second.abs() >= first.abs())];
    let note = format!("{} end, {}", end.name(), over(report, last.pass));
    html.headline("Movement of an end", &report.shown.movement(most), &note);
    let motion = &report.run.duct_motion;
    let [along, down] =
        [motion.peak_longitudinal_m, motion.peak_vertical_m].map(|peak| significant(MICRO * peak) + " µm");
    let down = format!("along its axis; {down} down");
    html.headline("Peak motion of the duct", &along, &down);
    let error = percent(report.run.error_estimate.relative);
    let note = "of the forces, from the computation alone";
    html.headline("Estimated error", &error, note);
    clamps(html, report);
    html.raw("</dl>");
}

/// The clamp that is pressed hardest: a card as wide as the page, as the others fill their rows.
fn clamps(html: &mut Html, report: &Report) {
    let Report { run, shown, .. } = report;
    let force = |position: f64| run.largest(Place::Clamp(position), Limited::Force);
    let clamps = run.restraints.iter().map(|clamp| clamp.position_m);
    if let Some(hardest) = clamps.max_by(|a, b| force(*a).total_cmp(&force(*b))) {
        let when = if run.heat.is_some() {
            "during a pass or in heat"
        } else {
            DURING
        };
        let note = format!("at {}, {when}", shown.length(hardest));
        html.headline("Largest force on a clamp", &shown.force(force(hardest)), &note);
    }
}

/// The three cards about forces.
fn forces(html: &mut Html, report: &Report, last: &PassRecord) {
    let Report { run, shown, .. } = report;
    let (largest, place, when) = hardest(run);
    let traffic = |html: &mut Html| {
        let years = report.scene.traffic.years_after(last.pass);
        let note = years.map_or("their rate is not known".into(), |years| {
            format!("in {}", after(years))
        });
        html.headline("Passes computed", &count(last.pass), &note);
    };
    let note = format!("{}, {when}{}", on(place), tension(largest));
    if let Some(heat) = &run.heat {
        html.headline("Largest force with heat", &shown.force(largest), &note);
        let day = heat.last_whole(&run.days, last.pass);
        let swing = day.map_or(0.0, |day| day.largest_range().0);
        let within = "on an end within the last whole day";
        html.headline("Swing of the force", &shown.force(swing), within);
        return traffic(html);
    }
    if let Some(saturation) = &run.saturation {
        let place = levelled(&report.scene, saturation);
        let later = words_if(saturation.is_beyond(&run.passes), BEYOND);
        let note = format!("{}, {AFTER}{later}{}", on(place), tension(saturation.force_n));
        html.headline("Saturated force", &shown.force(saturation.force_n), &note);
        let reached = saturation.passes_to_95_percent;
        let time = report.scene.traffic.years_after(reached);
        let time = time.map_or_else(String::new, |years| format!("{}; ", after(years)));
        let note = format!("{time}{} computed", count(last.pass));
        html.headline("Passes to 95 % of it", &count(reached), &note);
    } else {
        let (force, place) = pressed(&report.scene, last);
        let note = format!("{}{}; it {}", on(place), tension(force), not_level(run));
        html.headline("Force after the last pass", &shown.force(force), &note);
        traffic(html);
    }
    html.headline("Largest force of all passes", &shown.force(largest), &note);
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
    let moved = format!("{} {}", by_turns(report), moved(report, last));
    if report.run.heat.is_some() {
        let (force, place, _) = hardest(&report.run);
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
        return format!("{now}; it {}.{moved}", not_level(&report.run));
    };
    let level = shown.force(saturation.force_n);
    let reached = passes(saturation.passes_to_95_percent);
    let that = if report.run.random.is_some() {
        "the mean"
    } else {
        "that"
    };
    if saturation.passes_to_95_percent > last.pass {
        return format!(
            "{now}. It levels off at {level}; 95 % of {that} takes {reached}, more than were computed.{moved}"
        );
    }
    format!(
        "The {} levels off at {level}. 95 % of {that} is reached after {reached}.{moved}",
        force_of(levelled(scene, saturation))
    )
}

/// Why there is no force that levels off.
fn not_level(run: &Run) -> &'static str {
    run.range.map_or("has not levelled off", |_| "was larger before")
}

/// What vehicles that differ leave by turns, once nothing changes any more.
fn by_turns(report: &Report) -> String {
    let shown = &report.shown;
    let each = report.run.by_turns().into_iter().map(|(end, least, most)| {
        let (end, least, most) = (end.name(), shown.force_number(least), shown.force(most));
        format!("the {end} end shows {least} to {most}")
    });
    let each: Vec<String> = each.collect();
    if each.is_empty() {
        return String::new();
    }
    let how = if report.run.random.is_some() {
        "in nine passes of ten"
    } else {
        "after passes by turns"
    };
    format!(" In the end {} {how}, as vehicles differ.", each.join(" and "))
}

/// How far both ends have moved.
fn moved(report: &Report, last: &PassRecord) -> String {
    let (moves, when) = if report.run.heat.is_some() {
        ("moves by up to", "Over all days")
    } else {
        ("has moved", "After the last pass computed")
    };
    let of = |end: CableEnd| {
        let held = end.held_in(&report.scene);
        let free = if held == End::Free { "free " } else { "" };
        let moved = report
            .shown
            .movement(movement(&report.run, last, end).abs())
            .replace("> ", "more than ");
        (held != End::Fixed).then(|| format!("the {free}{} end {moves} {moved}", end.name()))
    };
    let moved: Vec<String> = CableEnd::ALL.into_iter().filter_map(of).collect();
    if moved.is_empty() {
        return "Both ends are fixed.".to_owned();
    }
    let is_out = |end| movement(&report.run, last, end).abs() > report.shown.most;
    let leaves = words_if(
        CableEnd::ALL.into_iter().any(is_out),
        "; the cable leaves the duct",
    );
    format!("{when} {}{leaves}.", moved.join(" and "))
}

/// Displacement after the last pass; of a heated cable the farthest of all days \[m\].
fn movement(run: &Run, last: &PassRecord, end: CableEnd) -> f64 {
    let heat = run.heat.as_ref();
    heat.map_or(ends::of_pass(last, end)[1], |heat| heat.all_days.movement(end))
}

/// Where a force acts: on an end, or within the cable.
type At = Option<CableEnd>;

/// When a force acts.
const AFTER: &str = "after a pass";
const BEYOND: &str = " beyond those computed";
const DURING: &str = "during a pass";
const IN_HEAT: &str = "in the heat of a day";

/// The force that is largest in size on an end, after passes and during them and in all heat, or in the cable where no end is held; and when.
fn hardest(run: &Run) -> (f64, At, &'static str) {
    let of_passes = run.passes.iter().flat_map(|record| {
        let forces = [
            (record.downstream_peak_n, CableEnd::Downstream, DURING),
            (record.upstream_peak_n, CableEnd::Upstream, DURING),
            (record.downstream_least_n, CableEnd::Downstream, DURING),
            (record.upstream_least_n, CableEnd::Upstream, DURING),
            (record.downstream_force_n, CableEnd::Downstream, AFTER),
            (record.upstream_force_n, CableEnd::Upstream, AFTER),
        ];
        forces.map(|(force, end, when)| (force + run.scatter(end, record).copysign(force), end, when))
    });
    let days = run.heat.iter().map(|heat| &heat.all_days);
    let of_days = days.clone().flat_map(|days| {
        [
            (days.downstream_max_n, CableEnd::Downstream, IN_HEAT),
            (days.downstream_min_n, CableEnd::Downstream, IN_HEAT),
            (days.upstream_max_n, CableEnd::Upstream, IN_HEAT),
            (days.upstream_min_n, CableEnd::Upstream, IN_HEAT),
        ]
    });
    let largest = of_passes
        .chain(of_days)
        .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    if let Some((force, end, when)) = largest.filter(|(force, ..)| *force != 0.0) {
        return (force, Some(end), when);
    }
    let inside = run
        .passes
        .iter()
        .map(|record| (record.max_compression_n, None, AFTER));
    let inside = inside.chain(days.map(|days| (days.max_compression_n, None, IN_HEAT)));
    let nothing = (0.0, None, AFTER);
    inside.fold(nothing, |most, one| if one.0 > most.0 { one } else { most })
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
