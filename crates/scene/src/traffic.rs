//! `[[vehicles]]` and `[traffic]`: from their keys to who drives, how often and in which order, and back.

use cable_dem::Order;
use ground_field::{SurfaceLoad, Vehicle, Wheel};

use crate::data::{DAYS_PER_YEAR, Scene, Traffic, TrafficVehicle};
use crate::error::{Wrong, did_you_mean};
use crate::histogram;
use crate::key::listed;
use crate::keys::{SceneKeys, TrafficKeys, VEHICLES, VehicleKeys, WheelKeys};
use crate::nearest::nearest;
use crate::range::{PASSES, PER_DAY, shown};

/// Seed of a random order if the file gives none.
const DEFAULT_SEED: u64 = 1;
/// Speed of the axles of a histogram if the file gives none \[m/s\]: 40 km/h, as for the presets.
const AXLE_SPEED: f64 = 40.0 / 3.6;

/// Who drives, and how often; `name` is that of the scene's file.
pub fn traffic(name: &str, keys: &SceneKeys) -> Result<(Vec<TrafficVehicle>, Traffic), Box<Wrong>> {
    let traffic = &keys.traffic;
    let seed = traffic.seed.unwrap_or(DEFAULT_SEED);
    let wrong = |key: &str, found: &str, allowed: &str| Wrong::value(key, found, allowed);
    let (mut vehicles, order) = if let Some(histogram) = &traffic.histogram {
        if keys.ground.longitudinal_peak.is_some() {
            let found = "a histogram with `ground.longitudinal_peak`";
            let allowed = "`ground.vertical_peak`, which is that of the first row: one longitudinal peak for every load has no meaning";
            return Err(wrong("traffic.histogram", found, allowed));
        }
        let allowed = "order = \"random\", or none: the axles of a histogram come at random";
        if traffic.sequence.is_some() {
            return Err(wrong(
                "traffic.sequence",
                "a sequence of the axles of a histogram",
                allowed,
            ));
        }
        if traffic.order == Some(false) {
            return Err(wrong("traffic.order", "\"interleaved\"", allowed));
        }
        let vehicles = histogram::axles(name, histogram, traffic.speed.unwrap_or(AXLE_SPEED))?;
        (vehicles, Order::Random { seed })
    } else {
        let missing = || Wrong::missing("vehicles", VEHICLES);
        let listed = keys.vehicles.as_ref().ok_or_else(missing)?.iter().enumerate();
        let vehicles = listed
            .map(|(index, vehicle)| vehicle.vehicle(index))
            .collect::<Result<Vec<_>, _>>()?;
        let order = match &traffic.sequence {
            Some(names) => Order::Sequence(sequence(names, &vehicles)?),
            None if traffic.order == Some(true) => Order::Random { seed },
            None => Order::Interleaved,
        };
        (vehicles, order)
    };
    if let Order::Sequence(sequence) = &order {
        for (index, vehicle) in vehicles.iter_mut().enumerate() {
            vehicle.share = sequence.iter().filter(|&&i| i == index).count() as f64;
        }
    }
    normalise(&mut vehicles);
    let (passes, per_day) = (passes(traffic)?, traffic.per_day);
    Ok((
        vehicles,
        Traffic {
            passes,
            per_day,
            order,
        },
    ))
}

/// The indices of the vehicles of these names.
fn sequence(names: &[String], vehicles: &[TrafficVehicle]) -> Result<Vec<usize>, Box<Wrong>> {
    let known = || vehicles.iter().map(|traffic| traffic.vehicle.name());
    let index = |(place, name): (usize, &String)| {
        known().position(|known| known == name).ok_or_else(|| {
            let found = format!("\"{name}\"{}", did_you_mean(nearest(name, known())));
            Wrong::value(format!("traffic.sequence.{place}"), found, listed(known()))
        })
    };
    names.iter().enumerate().map(index).collect()
}

/// The passes: as they stand, or those of so many years, rounded to whole ones.
fn passes(traffic: &TrafficKeys) -> Result<u64, Box<Wrong>> {
    let missing = |key: &str, allowed: String| Wrong::missing(key, allowed);
    let Some(years) = traffic.years else {
        let allowed = format!("{}, or `years` with `per_day`", PASSES.allowed());
        return traffic.passes.ok_or_else(|| missing("traffic.passes", allowed));
    };
    let allowed = format!("vehicles a day beside `years`, {}", PER_DAY.allowed());
    let per_day = traffic
        .per_day
        .ok_or_else(|| missing("traffic.per_day", allowed))?;
    let passes = (years * DAYS_PER_YEAR * per_day).round();
    if PASSES.contains(passes) {
        return Ok(passes as u64);
    }
    let [years, per_day, passes] = [years, per_day, passes].map(shown);
    let found = format!("{years} years of {per_day} vehicles a day, {passes} passes");
    let allowed = format!("so many that there are {} passes", PASSES.words);
    Err(Wrong::value("traffic.years", found, allowed))
}

/// Makes the shares sum to 1, whatever their size. Shares that do so but for rounding are kept to the last digit.
fn normalise(vehicles: &mut [TrafficVehicle]) {
    let sum: f64 = vehicles.iter().map(|v| v.share).sum();
    if (sum - 1.0).abs() <= f64::EPSILON * vehicles.len() as f64 {
        return;
    }
    let largest = vehicles.iter().fold(0.0, |largest: f64, v| largest.max(v.share));
    let sum: f64 = vehicles.iter().map(|v| v.share / largest).sum();
    for vehicle in vehicles {
        vehicle.share = vehicle.share / largest / sum;
    }
}

/// The load of a vehicle that is one concentrated load on its axis.
pub fn concentrated(vehicle: &Vehicle) -> Option<f64> {
    let at_axis = |wheel: &Wheel| (wheel.x, wheel.y, wheel.load.contact_radius()) == (0.0, 0.0, 0.0);
    match vehicle.wheels() {
        [wheel] if at_axis(wheel) => Some(wheel.load.force()),
        _ => None,
    }
}

impl VehicleKeys {
    /// The vehicle with these keys, the `index`-th of the list.
    fn vehicle(&self, index: usize) -> Result<TrafficVehicle, Box<Wrong>> {
        let wrong = |found: String, allowed: &str| Wrong::value(format!("vehicles.{index}"), found, allowed);
        let rejected = |error: ground_field::GroundError| wrong(error.to_string(), "another vehicle");
        let wheels = match (self.load, &self.wheels) {
            (Some(load), _) => vec![WheelKeys {
                load,
                ..WheelKeys::default()
            }],
            (None, Some(wheels)) => wheels.clone(),
            (None, None) => {
                let allowed = "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]";
                return Err(wrong("neither `load` nor `wheels`".into(), allowed));
            }
        };
        let wheel = |wheel: &WheelKeys| {
            let load = SurfaceLoad::new(wheel.load, wheel.contact_radius).map_err(rejected)?;
            Ok(Wheel {
                x: wheel.x,
                y: wheel.y,
                load,
            })
        };
        let wheels = wheels.iter().map(wheel).collect::<Result<_, Box<Wrong>>>()?;
        let name = self
            .name
            .clone()
            .unwrap_or_else(|| format!("vehicle {}", index + 1));
        Ok(TrafficVehicle {
            vehicle: Vehicle::new(name, wheels, self.speed, self.direction).map_err(rejected)?,
            share: self.share.unwrap_or(1.0),
            lateral_offset: self.lateral_offset,
        })
    }

    /// The keys of a vehicle; in a sequence it has no share.
    pub fn of(traffic: &TrafficVehicle, in_sequence: bool) -> Self {
        let vehicle = &traffic.vehicle;
        let wheel = |wheel: &Wheel| WheelKeys {
            x: wheel.x,
            y: wheel.y,
            load: wheel.load.force(),
            contact_radius: wheel.load.contact_radius(),
        };
        let wheels: Vec<WheelKeys> = vehicle.wheels().iter().map(wheel).collect();
        let load = concentrated(vehicle);
        Self {
            name: Some(vehicle.name().to_owned()),
            speed: vehicle.speed(),
            load,
            wheels: load.is_none().then_some(wheels),
            lateral_offset: traffic.lateral_offset,
            direction: vehicle.direction(),
            share: (!in_sequence).then_some(traffic.share),
        }
    }
}

impl TrafficKeys {
    /// The keys of the traffic of a scene.
    pub fn of(scene: &Scene) -> Self {
        let traffic = &scene.traffic;
        let mut keys = Self {
            passes: Some(traffic.passes),
            per_day: traffic.per_day,
            ..Self::default()
        };
        match &traffic.order {
            Order::Interleaved => {}
            Order::Random { seed } => (keys.order, keys.seed) = (Some(true), Some(*seed)),
            Order::Sequence(sequence) => {
                let name = |&index: &usize| Some(scene.vehicles.get(index)?.vehicle.name().to_owned());
                keys.sequence = Some(sequence.iter().filter_map(name).collect());
            }
        }
        keys
    }
}
