//! Vehicles by where they drive.

use ground_field::Direction;

use crate::Scene;
use crate::scene::TrafficVehicle;

/// Axes nearer to each other than this are one lane \[m\].
const SAME: f64 = 5e-4;

/// Vehicles that drive in one line and one direction. Places are to the left of the line from which the scene measures them \[m\], seen
/// toward growing x.
#[derive(Debug)]
pub struct Lane<'s> {
    /// Middle between the outer wheels.
    pub middle: f64,
    pub direction: Direction,
    /// In the scene's order.
    pub vehicles: Vec<&'s TrafficVehicle>,
}

impl Lane<'_> {
    /// The share of all passes.
    pub fn share(&self) -> f64 {
        self.vehicles.iter().map(|traffic| traffic.share).sum()
    }

    /// Places of the wheels of its heaviest vehicle, and half their widths \[m\].
    pub fn wheels(&self) -> Vec<(f64, f64)> {
        let weight = |traffic: &TrafficVehicle| traffic.vehicle.weight();
        let heaviest = self
            .vehicles
            .iter()
            .max_by(|a, b| weight(a).total_cmp(&weight(b)));
        let wheels = heaviest.iter().flat_map(|traffic| {
            let wheels = traffic.vehicle.wheels().iter();
            wheels.map(|wheel| (wheel.y + traffic.lateral_offset, wheel.load.contact_radius()))
        });
        wheels.collect()
    }

    /// What drives there, in words.
    pub fn name(&self) -> String {
        match &self.vehicles[..] {
            [] => String::new(),
            [traffic] => traffic.vehicle.name().to_owned(),
            [first, others @ ..] => format!("{} and {} more", first.vehicle.name(), others.len()),
        }
    }
}

/// Middle between a vehicle's outer wheels.
pub fn middle(traffic: &TrafficVehicle) -> f64 {
    let sides = || traffic.vehicle.wheels().iter().map(|wheel| wheel.y);
    let (right, left) = (
        sides().fold(f64::INFINITY, f64::min),
        sides().fold(f64::NEG_INFINITY, f64::max),
    );
    0.5 * (right + left) + traffic.lateral_offset
}

/// The lanes of a scene, in the order of their first vehicles.
pub fn lanes(scene: &Scene) -> Vec<Lane<'_>> {
    let mut lanes: Vec<Lane> = Vec::new();
    for traffic in &scene.vehicles {
        let (middle, direction) = (middle(traffic), traffic.vehicle.direction());
        let same = |lane: &&mut Lane| lane.direction == direction && (lane.middle - middle).abs() < SAME;
        match lanes.iter_mut().find(same) {
            Some(lane) => lane.vehicles.push(traffic),
            None => lanes.push(Lane {
                middle,
                direction,
                vehicles: vec![traffic],
            }),
        }
    }
    lanes
}
