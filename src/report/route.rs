//! The duct along the road: its length, ends, clamps, slope and traffic.

use ground_field::Direction;

use super::content::Report;
use super::figure::{WIDTH, ticks};
use super::quantity::{Shown, significant};
use crate::Scene;
use crate::figure::{Anchor, Drawing, Ink};
use crate::scene::End;
use crate::shown::words_if;

/// Where the duct begins and ends \[px\].
const LEFT: f64 = 44.0;
const RIGHT: f64 = 396.0;
/// The title's height, and where the directions of traffic stand \[px\].
const TITLE: f64 = 36.0;
const TRAFFIC: f64 = 50.0;
/// Where the road, the duct below it and the axis of lengths are drawn \[px\].
const ROAD: f64 = 72.0;
const DEEP: f64 = ROAD + 44.0;
const AXIS: f64 = DEEP + 34.0;
/// Half the duct's height \[px\].
const DUCT: f64 = 6.0;
/// Clamps that are listed at most.
const MOST: usize = 8;

/// The drawing, and its caption.
pub fn route(report: &Report) -> (String, String) {
    let Report { scene, shown, .. } = report;
    let clamps = clamps(report);
    let words = AXIS + 44.0;
    let height = words + Drawing::LINE * (2.0 + clamps.len() as f64) + 4.0;

    let mut drawing = Drawing::new("Along the duct", (WIDTH, height));
    drawing.title("Along the duct", (0.5 * WIDTH, 0.5 * TITLE));
    traffic(&mut drawing, scene);
    let level = |y: f64| [(LEFT, y), (RIGHT, y)];
    let [road, below] = [level(ROAD), level(AXIS - 6.0)];
    drawing.area(&[road[0], road[1], below[1], below[0]], Ink::Grey, 0.15);
    drawing.line(&road, Ink::Dark, 2.0);
    for wall in [DEEP - DUCT, DEEP + DUCT] {
        drawing.line(&level(wall), Ink::Grey, 1.0);
    }
    drawing.line(&level(DEEP), Ink::Series(0), 3.0);
    end(&mut drawing, scene.ends.upstream, (LEFT, DEEP), -1.0);
    end(&mut drawing, scene.ends.downstream, (RIGHT, DEEP), 1.0);
    draw_clamps(&mut drawing, scene);

    drawing.line(&level(AXIS), Ink::Dark, 1.2);
    let unit = shown.units.length;
    let length = unit.of_si(scene.duct.length);
    for (place, label) in ticks(length) {
        let x = LEFT + (RIGHT - LEFT) * place / length;
        drawing.line(&[(x, AXIS), (x, AXIS + 5.0)], Ink::Dark, 1.2);
        drawing.text(&label, (x, AXIS + 15.0), Anchor::Middle);
    }
    drawing.text(unit.symbol(), (RIGHT + 32.0, AXIS + 15.0), Anchor::Middle);
    for (name, end, x, anchor) in [
        ("upstream end", scene.ends.upstream, 12.0, Anchor::Start),
        ("downstream end", scene.ends.downstream, WIDTH - 12.0, Anchor::End),
    ] {
        drawing.text(name, (x, words), anchor);
        drawing.text(&held(end, shown), (x, words + Drawing::LINE), anchor);
    }
    for (k, clamp) in clamps.iter().enumerate() {
        let y = words + Drawing::LINE * (k as f64 + 2.3);
        drawing.text(clamp, (12.0, y), Anchor::Start);
    }
    (drawing.to_svg(), caption(report))
}

fn caption(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let slope = scene.duct.slope;
    let way = if slope > 0.0 { "rises" } else { "falls" };
    let slope = if slope == 0.0 {
        "The duct is level.".to_owned()
    } else {
        let percent = significant(100.0 * slope.abs());
        format!("The duct {way} by {percent} % toward growing x, which is not drawn.")
    };
    format!(
        "The cable in its duct from the side, {} deep. The length is to scale, the depth is not. {slope}",
        shown.length(scene.duct.depth)
    )
}

/// The shares of both directions.
fn traffic(drawing: &mut Drawing, scene: &Scene) {
    let words = |direction: Direction| {
        let shares = scene.vehicles.iter().zip(scene.shares());
        let same = shares.filter(|(vehicle, _)| vehicle.direction == direction);
        let share: f64 = same.map(|(_, share)| share).sum();
        Some(format!("{direction}, {} %", significant(100.0 * share))).filter(|_| share > 0.0)
    };
    if let Some(words) = words(Direction::Forward) {
        drawing.text(&format!("→ {words}"), (LEFT, TRAFFIC), Anchor::Start);
    }
    if let Some(words) = words(Direction::Reverse) {
        drawing.text(&format!("{words} ←"), (RIGHT, TRAFFIC), Anchor::End);
    }
}

/// What holds an end; `out` is the direction out of the duct.
fn end(drawing: &mut Drawing, end: End, (x, y): (f64, f64), out: f64) {
    let wall = |drawing: &mut Drawing, x: f64| {
        drawing.line(&[(x, y - 14.0), (x, y + 14.0)], Ink::Dark, 2.0);
        for k in -2..=2 {
            let low = y + 6.0 * f64::from(k);
            drawing.line(&[(x, low), (x + out * 6.0, low + 6.0)], Ink::Dark, 0.8);
        }
    };
    match end {
        End::Fixed => wall(drawing, x),
        End::Spring(_) => {
            let coil = |k: u32| {
                let side = match k {
                    0 | 6 => 0.0,
                    k if k.is_multiple_of(2) => 6.0,
                    _ => -6.0,
                };
                (x + out * 4.0 * f64::from(k), y + side)
            };
            let spring: Vec<(f64, f64)> = (0..=6).map(coil).collect();
            drawing.line(&spring, Ink::Series(1), 1.6);
            wall(drawing, x + out * 24.0);
        }
        End::Free => drawing.line(&[(x, y), (x + out * 14.0, y)], Ink::Series(0), 3.0),
    }
}

fn held(end: End, shown: &Shown) -> String {
    match end {
        End::Free => "free".to_owned(),
        End::Fixed => "fixed".to_owned(),
        End::Spring(spring) => format!("spring of {}", shown.stiffness(spring)),
    }
}

/// Clamps on the cable, numbered if there are several.
fn draw_clamps(drawing: &mut Drawing, scene: &Scene) {
    for (k, clamp) in scene.restraints.iter().enumerate() {
        let (x, y) = (LEFT + (RIGHT - LEFT) * clamp.position / scene.duct.length, DEEP);
        for side in [-1.0, 1.0] {
            let [near, far] = [3.0, 11.0].map(|away| y + side * away);
            let jaw = [(x - 4.0, far), (x + 4.0, far), (x + 2.0, near), (x - 2.0, near)];
            drawing.area(&jaw, Ink::Series(1), 1.0);
        }
        if k < MOST && scene.restraints.len() > 1 {
            drawing.text(&(k + 1).to_string(), (x, y - 20.0), Anchor::Middle);
        }
    }
}

/// What the clamps are.
fn clamps(report: &Report) -> Vec<String> {
    let Report { scene, shown, .. } = report;
    let clamps = &scene.restraints;
    let name = |(k, clamp): (usize, &crate::scene::Restraint)| {
        let number = format!("{}: ", k + 1);
        let number = words_if(clamps.len() > 1, &number);
        let (stiff, place) = (shown.stiffness(clamp.stiffness), shown.length(clamp.position));
        format!("{number}clamp of {stiff} at {place}")
    };
    let mut names: Vec<String> = clamps.iter().take(MOST).enumerate().map(name).collect();
    if clamps.len() > MOST {
        names.push(format!("and {} more clamps", clamps.len() - MOST));
    }
    names
}
