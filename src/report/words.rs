//! The scene in words.

use ground_field::{Base, Direction, Modulus};

use super::content::Report;
use super::html::Html;
use super::lanes::middle;
use super::quantity::{Shown, count, power_of_ten, quantity, significant};
use crate::Scene;
use crate::answer::after;
use crate::ground::load_ratio;
use crate::scene::{Arrangement, End, FrictionLaw, Order, PeakScaling, TrafficVehicle};

/// Vehicles that differ by their load alone have one row where there are more than this.
const MOST_ROWS: usize = 12;
/// Kilometres an hour of a metre a second.
const KILOMETRES_PER_HOUR: f64 = 3.6;

/// What lies where and what holds it, a point for each part.
pub fn scene(report: &Report) -> Vec<String> {
    let Report { scene, shown, .. } = report;
    let (duct, ends) = (&scene.duct, &scene.ends);
    let (long, deep) = (shown.length(duct.length), shown.length(duct.depth));
    let ends = format!(
        "Ends: upstream (x = 0) {}, downstream (x = {long}) {}.",
        end(ends.upstream, shown),
        end(ends.downstream, shown)
    );
    let mut points = vec![
        format!(
            "Duct: {long} long, {deep} from the road surface to the cable{}.",
            slope(report)
        ),
        cable(report),
        friction(report),
        ends,
    ];
    points.extend(route(report));
    points.extend(scene.restraints.iter().map(|clamp| {
        let (stiff, place) = (shown.stiffness(clamp.stiffness), shown.length(clamp.position));
        let holds = clamp
            .holds
            .map(|holds| format!(", which slips above {}", shown.force(holds)));
        format!("Clamp of {stiff} at {place}{}.", holds.unwrap_or_default())
    }));
    points.push(traffic(scene));
    points
}

/// Which way the duct slopes, and what draws the cable down it.
fn slope(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let slope = scene.duct.slope;
    if slope == 0.0 {
        return String::new();
    }
    let way = if slope > 0.0 { "rises" } else { "falls" };
    format!(
        "; it {way} with x by {} %, and {} of the cable’s weight draw it down",
        significant(100.0 * slope.abs()),
        shown.weight(scene.body_force().abs())
    )
}

/// The sections of the duct, and what its bends do.
fn route(report: &Report) -> Vec<String> {
    let Report {
        scene, shown, run, ..
    } = report;
    let largest = run
        .passes
        .iter()
        .map(|pass| pass.max_compression_n.abs())
        .fold(0.0, f64::max);
    let mut begin = 0.0;
    let sections = scene.route.iter().map(|section| {
        let end = begin + section.length.unwrap_or(0.0);
        let (from, to) = (shown.length(begin), shown.length(end));
        begin = end;
        let way = if section.slope > 0.0 { "rises" } else { "falls" };
        let slope = match section.slope {
            0.0 => "level".to_owned(),
            slope => format!("{way} by {} %", significant(100.0 * slope.abs())),
        };
        let bend = section.bend_radius.map_or_else(String::new, |radius| {
            let effect = if largest > scene.cable.weight * radius {
                "the cable’s force presses it sideways with more than its weight, so that the bend anchors it"
            } else {
                "the cable’s force presses it sideways with less than its weight, which adds a few per cent"
            };
            format!(", bend of {} radius: {effect}", shown.length(radius))
        });
        let friction = section
            .dynamic_coefficient
            .map(|friction| format!(", friction {}", significant(friction)));
        format!(
            "Section from {from} to {to}: {slope}{bend}{}.",
            friction.unwrap_or_default()
        )
    });
    sections.collect()
}

fn cable(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let cable = &scene.cable;
    let pressed = match scene.normal_load_factor() {
        1.0 => "it lies on the duct with its own weight".to_owned(),
        factor => format!(
            "it presses on {} with {} times its weight",
            under(scene),
            significant(factor)
        ),
    };
    let (weight, stiffness) = (shown.weight(cable.weight), shown.load(cable.axial_stiffness));
    format!(
        "Cable: {weight} heavy, axial stiffness EA {stiffness}; {pressed}{}.",
        beside(report)
    )
}

/// What the cable lies on.
fn under(scene: &Scene) -> &'static str {
    match scene.cable.arrangement {
        Arrangement::TrefoilUpper => "the two lower cables",
        _ => "the duct",
    }
}

/// The other cables in the duct.
fn beside(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let place = match scene.cable.arrangement {
        Arrangement::TrefoilUpper => "the upper one of three cables in trefoil",
        Arrangement::TrefoilLower => "a lower one of three cables in trefoil",
        Arrangement::CradledOuter => "an outer one of three cables side by side",
        Arrangement::CradledMiddle => "the middle one of three cables side by side",
        Arrangement::Single => return String::new(),
    };
    let [inner, own] =
        [scene.duct.inner_diameter, scene.cable.diameter].map(|d| shown.length(d.unwrap_or_default()));
    format!(", as {place}, {own} thick in a duct of {inner}")
}

/// What computing several cables together would change.
fn together(scene: &Scene) -> &'static str {
    match scene.cable.arrangement {
        Arrangement::Single => "",
        Arrangement::TrefoilUpper | Arrangement::TrefoilLower => {
            " The cables are computed one by one. Computed together, the lower ones also carry the upper one’s friction, which lowers their \
             force (from 707 to 592 N in a computation of the full-scale experiment): wedging alone does not explain the 900 N measured there."
        }
        _ => " The cables are computed one by one, without friction between them.",
    }
}

fn friction(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let law = match scene.friction.law() {
        FrictionLaw::Coulomb => "Coulomb's law".to_owned(),
        FrictionLaw::ElasticPlastic { shape_factor: b } => {
            format!("elastic-plastic law, shape factor {} 1/m", power_of_ten(b))
        }
        FrictionLaw::Sigmoid { shape_factor: b } => {
            format!("sigmoid law, shape factor {} 1/m", power_of_ten(b))
        }
        _ => "a law of its own".to_owned(),
    };
    format!(
        "Friction: dynamic coefficient {}, so at most {}; {law}.{}",
        significant(scene.friction.dynamic_coefficient),
        shown.weight(scene.friction_limit()),
        together(scene)
    )
}

fn end(end: End, shown: &Shown) -> String {
    match end {
        End::Free => "free".into(),
        End::Fixed => "fixed".into(),
        End::Spring(spring) => format!("on a spring of {}", shown.stiffness(spring)),
    }
}

fn traffic(scene: &Scene) -> String {
    let passes = match scene.traffic.passes {
        1 => "one pass".to_owned(),
        passes => format!("{} passes", count(passes)),
    };
    let rate = scene
        .traffic
        .per_day
        .zip(scene.traffic.years_after(scene.traffic.passes));
    let rate = rate.map(|(per_day, years)| format!(" in {}, {} a day,", after(years), significant(per_day)));
    let passes = passes + &rate.unwrap_or_default();
    let vehicles = scene.vehicles.len();
    let order = match scene.order() {
        _ if vehicles == 1 => return format!("Traffic: {passes} of one vehicle."),
        Order::Interleaved => "mixed evenly by their shares",
        Order::Random { .. } => "at random by their shares",
        Order::Sequence(_) => "in a given sequence, over and over",
    };
    format!("Traffic: {passes} of {vehicles} kinds of vehicles, {order}.")
}

/// The layers of the ground from the surface down.
pub fn ground(html: &mut Html, report: &Report) {
    let Report { scene, shown, .. } = report;
    let Ok(profile) = scene.ground.profile() else {
        return;
    };
    let row = |depth: String, modulus: String, ratio: f64| vec![depth, modulus, significant(ratio)];
    let mut rows = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let bottom = top + layer.thickness();
        let modulus = shown.moduli(layer.modulus());
        let depth = shown.depths(top, bottom);
        rows.push(row(depth, modulus, layer.poisson_ratio()));
        top = bottom;
    }
    let below = format!("below {}", shown.depth(top));
    rows.push(match profile.base() {
        Base::HalfSpace(soil) => {
            let depth = if top == 0.0 { "everywhere".into() } else { below };
            row(
                depth,
                shown.moduli(Modulus::Uniform(soil.young_modulus())),
                soil.poisson_ratio(),
            )
        }
        Base::Rigid => vec![below, "rock that does not move".into(), "–".into()],
    });
    html.table(
        1,
        &["ground at depth", "Young’s modulus", "Poisson’s ratio"],
        rows,
    );
}

/// How the ground was scaled to a measurement, if it was.
pub fn scaling(scene: &Scene) -> Option<String> {
    Some(match scene.ground.scaling()? {
        PeakScaling::Longitudinal(peak) => format!(
            "The motion of the duct is scaled so that each vehicle moves it by {} along its axis at most.",
            quantity(peak, "m")
        ),
        PeakScaling::Vertical(peak) => format!(
            "The motion of the duct is scaled to a measured deflection: {} down under the first vehicle.",
            quantity(peak, "m")
        ),
    })
}

/// The vehicles, and where they drive.
pub fn vehicles(html: &mut Html, report: &Report) {
    let Report { scene, shown, .. } = report;
    let first = &scene.vehicles[0];
    let alike = |other: &TrafficVehicle| load_ratio(other, first).is_some();
    let many = scene.vehicles.len() > MOST_ROWS && scene.vehicles.iter().all(alike);
    let rows = scene.vehicles.iter().zip(scene.shares()).map(|(vehicle, share)| {
        let speed = significant(KILOMETRES_PER_HOUR * vehicle.speed);
        let direction = match vehicle.direction {
            Direction::Forward => "forward",
            Direction::Reverse => "reverse",
        };
        vec![
            vehicle.name.clone(),
            format!("{speed} km/h {direction}, {}", lane(report, vehicle)),
            load(vehicle, shown),
            format!("{} %", significant(100.0 * share)),
        ]
    });
    let head = ["vehicle", "drives", "load", "share"];
    if many {
        let mut row = rows.take(1).next().unwrap_or_default();
        row[0] = format!("{} classes of axles", scene.vehicles.len());
        row[2] = loads(report);
        "100 %".clone_into(&mut row[3]);
        html.table(3, &head, [row]);
    } else {
        html.table(3, &head, rows);
    }
}

/// The range of the vehicles' loads and their mean.
fn loads(report: &Report) -> String {
    let Report { scene, shown, .. } = report;
    let weights = || scene.vehicles.iter().map(TrafficVehicle::weight);
    let (least, most) = (
        weights().fold(f64::INFINITY, f64::min),
        weights().fold(0.0, f64::max),
    );
    let shared = weights().zip(scene.shares());
    let mean: f64 = shared.map(|(weight, share)| share * weight).sum();
    let [least, most, mean] = [least, most, mean].map(|load| shown.load(load));
    format!("{least} to {most}, in the mean {mean}")
}

/// Where a vehicle drives beside the duct, seen toward growing x.
fn lane(report: &Report, traffic: &TrafficVehicle) -> String {
    let left = middle(traffic) - report.scene.duct.lateral_offset;
    if left.abs() < 5e-4 {
        return "right above the duct".into();
    }
    let side = if left > 0.0 { "left" } else { "right" };
    format!("{} {side} of the duct", report.shown.length(left.abs()))
}

fn load(vehicle: &TrafficVehicle, shown: &Shown) -> String {
    let whole = shown.load(vehicle.weight());
    match &vehicle.wheels()[..] {
        [wheel] if wheel.contact_radius == 0.0 => format!("{whole}, concentrated"),
        [_] => format!("{whole}, one wheel"),
        wheels => format!("{whole} on {} wheels", wheels.len()),
    }
}
