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
    /// Its share of all passes.
    pub share: f64,
}

impl Lane<'_> {
    /// Places of the wheels of its heaviest vehicle, and half their widths \[m\].
    pub fn wheels(&self) -> Vec<(f64, f64)> {
        let weight = |traffic: &TrafficVehicle| traffic.weight();
        let heaviest = self
            .vehicles
            .iter()
            .max_by(|a, b| weight(a).total_cmp(&weight(b)));
        let wheels = heaviest.iter().flat_map(|traffic| {
            let wheels = traffic.wheels().into_iter();
            wheels.map(|wheel| (wheel.y + traffic.lateral_offset, wheel.contact_radius))
        });
        wheels.collect()
    }

    /// What drives there, in words.
    pub fn name(&self) -> String {
        match &self.vehicles[..] {
            [] => String::new(),
            [traffic] => traffic.name.clone(),
            [first, others @ ..] => format!("{} and {} more", first.name, others.len()),
        }
    }
}

/// Middle between a vehicle's outer wheels.
pub fn middle(traffic: &TrafficVehicle) -> f64 {
    let sides = || traffic.wheels().into_iter().map(|wheel| wheel.y);
    let (right, left) = (
        sides().fold(f64::INFINITY, f64::min),
        sides().fold(f64::NEG_INFINITY, f64::max),
    );
    0.5 * (right + left) + traffic.lateral_offset
}

/// The lanes of a scene, in the order of their first vehicles.
pub fn lanes(scene: &Scene) -> Vec<Lane<'_>> {
    let mut lanes: Vec<Lane> = Vec::new();
    for (traffic, share) in scene.vehicles.iter().zip(scene.shares()) {
        let (middle, direction) = (middle(traffic), traffic.direction);
        let same = |lane: &&mut Lane| lane.direction == direction && (lane.middle - middle).abs() < SAME;
        match lanes.iter_mut().find(same) {
            Some(lane) => {
                lane.vehicles.push(traffic);
                lane.share += share;
            }
            None => lanes.push(Lane {
                middle,
                direction,
                vehicles: vec![traffic],
                share,
            }),
        }
    }
    lanes
}
