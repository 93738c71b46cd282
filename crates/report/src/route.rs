//! The duct along the road: its length, ends, clamps, slopes and bends.

use super::chart::{WIDTH, ticks};
use super::content::Report;
use crate::words::{held_by, significant};
use creepage_plan::shown::words_if;
use creepage_scene::{CableEnd, End};
use plain_figure::{Anchor, Drawing, Ink};

/// Where the duct begins and ends \[px\].
const LEFT: f64 = 44.0;
const RIGHT: f64 = 396.0;
/// The title's height, and where the road, the duct below it and the axis of lengths are drawn \[px\].
const TITLE: f64 = 36.0;
const ROAD: f64 = 46.0;
const DEEP: f64 = ROAD + 44.0;
const AXIS: f64 = DEEP + 34.0;
/// Half the duct's height \[px\].
const DUCT: f64 = 6.0;
/// Clamps that are numbered at most, and the least distance of their numbers \[px\].
const MAX_NUMBERED: usize = 8;
const APART: f64 = 14.0;

/// The drawing, and its caption.
pub fn route(report: &Report) -> (String, String) {
    let Report { scene, reader, .. } = report;
    let words = AXIS + 44.0;
    let mut drawing = Drawing::new("Along the duct", (WIDTH, words + 2.0 * Drawing::LINE));
    drawing.title("Along the duct", (0.5 * WIDTH, 0.5 * TITLE));
    let level = |y: f64| [(LEFT, y), (RIGHT, y)];
    let [road, below] = [level(ROAD), level(AXIS - 6.0)];
    drawing.area(&[road[0], road[1], below[1], below[0]], Ink::Grey, 0.15);
    drawing.line(&road, Ink::Dark, 2.0);
    for wall in [DEEP - DUCT, DEEP + DUCT] {
        drawing.line(&level(wall), Ink::Grey, 1.0);
    }
    drawing.line(&level(DEEP), Ink::Series(0), 3.0);
    for (cable_end, x, out, edge, anchor) in [
        (CableEnd::Upstream, LEFT, -1.0, 12.0, Anchor::Start),
        (CableEnd::Downstream, RIGHT, 1.0, WIDTH - 12.0, Anchor::End),
    ] {
        let held = cable_end.held_in(scene);
        end(&mut drawing, held, (x, DEEP), out);
        drawing.text(&format!("{} end", cable_end.name()), (edge, words), anchor);
        drawing.text(&held_by(held, reader), (edge, words + Drawing::LINE), anchor);
    }
    clamps(&mut drawing, report);
    sections(&mut drawing, report);
    drawing.line(&level(AXIS), Ink::Dark, 1.2);
    let unit = reader.units.length;
    for (place, label) in ticks(unit.of_si(scene.duct.length)) {
        let x = at(report, place / unit.of_si(1.0));
        drawing.line(&[(x, AXIS), (x, AXIS + 5.0)], Ink::Dark, 1.2);
        drawing.text(&label, (x, AXIS + 15.0), Anchor::Middle);
    }
    drawing.text(unit.symbol(), (RIGHT + 32.0, AXIS + 15.0), Anchor::Middle);
    let sections = words_if(
        !scene.route.is_empty(),
        " Below the road the sections of the route: how they slope, and the radii R of their bends.",
    );
    let caption = format!(
        "The cable in its duct from the side, {} deep. The length is to scale; depth and slope are not.{sections}",
        reader.length(scene.duct.depth)
    );
    (drawing.to_svg(), caption)
}

/// Where a place along the duct \[m\] is drawn \[px\].
fn at(report: &Report, place: f64) -> f64 {
    LEFT + (RIGHT - LEFT) * place / report.scene.duct.length
}

/// What holds an end; `out` is the direction out of the duct.
fn end(drawing: &mut Drawing, end: End, (x, y): (f64, f64), out: f64) {
    let wall = match end {
        End::Fixed => x,
        End::Spring(_) => {
            let coil = (0..).zip([0.0, -6.0, 6.0, -6.0, 6.0, -6.0, 0.0]);
            let turn = |(k, side)| (x + out * 4.0 * f64::from(k), y + side);
            let spring: Vec<(f64, f64)> = coil.map(turn).collect();
            drawing.line(&spring, Ink::Series(1), 1.6);
            x + out * 24.0
        }
        End::Free => return drawing.line(&[(x, y), (x + out * 14.0, y)], Ink::Series(0), 3.0),
    };
    drawing.line(&[(wall, y - 14.0), (wall, y + 14.0)], Ink::Dark, 2.0);
    for low in [-12.0, -6.0, 0.0, 6.0, 12.0] {
        let stroke = [(wall, y + low), (wall + out * 6.0, y + low + 6.0)];
        drawing.line(&stroke, Ink::Dark, 0.8);
    }
}

/// Borders between sections, with their slopes and the radii of their bends.
fn sections(drawing: &mut Drawing, report: &Report) {
    let mut begin = 0.0;
    for section in &report.scene.route {
        let end = begin + section.length.unwrap_or(0.0);
        let (from, to) = (at(report, begin), at(report, end));
        if begin > 0.0 {
            drawing.line(&[(from, ROAD), (from, AXIS - 6.0)], Ink::Grey, 0.8);
        }
        let slope = (section.slope != 0.0).then(|| format!("{} %", significant(100.0 * section.slope)));
        let bend = section
            .bend_radius
            .map(|radius| format!("R {}", report.reader.length(radius)));
        let words: Vec<String> = slope.into_iter().chain(bend).collect();
        if to - from > 40.0 {
            let below = (0.5 * (from + to), DEEP + 20.0);
            drawing.text(&words.join(", "), below, Anchor::Middle);
        }
        begin = end;
    }
}

/// Clamps on the cable, with the numbers that they have in words if there are several.
fn clamps(drawing: &mut Drawing, report: &Report) {
    let clamps = &report.scene.restraints;
    let mut numbered = f64::NEG_INFINITY;
    for (k, clamp) in (1..).zip(clamps) {
        let x = at(report, clamp.position);
        for side in [-1.0, 1.0] {
            let [near, far] = [3.0, 11.0].map(|away| DEEP + side * away);
            let jaw = [(x - 4.0, far), (x + 4.0, far), (x + 2.0, near), (x - 2.0, near)];
            drawing.area(&jaw, Ink::Series(1), 1.0);
        }
        if clamps.len() > 1 && k <= MAX_NUMBERED && (x - numbered).abs() > APART {
            numbered = x;
            drawing.text(&k.to_string(), (x, DEEP - 20.0), Anchor::Middle);
        }
    }
}
