//! `[[vehicles]]` and `[traffic]`: who drives, how often, in which order.

use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};

use super::range::{CONTACT_RADIUS, LOAD, OFFSET, PASSES, SHARE, SPEED, allowed_whole};
use super::table::Table;
use super::value::Value;
use super::{Dimension, Order, PeakScaling, SceneError, Traffic, TrafficVehicle, keys};

const DIRECTIONS: &[(&str, Direction)] = &[("forward", Direction::Forward), ("reverse", Direction::Reverse)];
const LOAD_EXAMPLE: &str = "\"20 tf\"";
/// Seed of a random order where the file gives none.
const DEFAULT_SEED: u64 = 1;

pub(super) fn traffic(
    root: &Table,
    scaling: Option<PeakScaling>,
) -> Result<(Vec<TrafficVehicle>, Traffic), SceneError> {
    let allowed = "one [[vehicles]] or more";
    let items = root.required("vehicles", allowed)?.some_items(allowed)?;
    let mut vehicles: Vec<TrafficVehicle> = Vec::with_capacity(items.len());
    for (index, item) in items.iter().enumerate() {
        let table = item.table(keys::VEHICLE)?;
        let name = name(&table, index, &vehicles)?;
        let vehicle = vehicle(&table, name)?;
        if let Some(allowed) = unscalable(&vehicle, index, scaling) {
            return Err(table.inconsistent("a vehicle without load", allowed));
        }
        let share = table.optional_number("share", SHARE)?.unwrap_or(1.0);
        vehicles.push(TrafficVehicle { vehicle, share });
    }
    let table = root.table("traffic", keys::TRAFFIC)?;
    let passes = table
        .required("passes", &allowed_whole(&PASSES))?
        .integer(PASSES)?;
    let order = order(&table, &vehicles)?;
    if let Order::Sequence(sequence) = &order {
        for (index, vehicle) in vehicles.iter_mut().enumerate() {
            vehicle.share = sequence.iter().filter(|&&i| i == index).count() as f64;
        }
    }
    normalise(&mut vehicles);
    Ok((vehicles, Traffic { passes, order }))
}

/// Makes the shares sum to 1, whatever their size.
fn normalise(vehicles: &mut [TrafficVehicle]) {
    let largest = vehicles.iter().fold(0.0, |largest: f64, v| largest.max(v.share));
    let sum: f64 = vehicles.iter().map(|v| v.share / largest).sum();
    for vehicle in vehicles {
        vehicle.share = vehicle.share / largest / sum;
    }
}

fn name(table: &Table, index: usize, others: &[TrafficVehicle]) -> Result<String, SceneError> {
    let allowed = "a name in quotes that no other vehicle has";
    let taken = |name: &str| others.iter().any(|other| other.vehicle.name() == name);
    if let Some(value) = table.optional("name") {
        let name = value.text(allowed)?;
        if name.trim().is_empty() || taken(&name) {
            return Err(value.inconsistent(value.written(), allowed));
        }
        return Ok(name);
    }
    let name = format!("vehicle {}", index + 1);
    if taken(&name) {
        return Err(table.inconsistent(format!("no name, where \"{name}\" is taken"), allowed));
    }
    Ok(name)
}

fn vehicle(table: &Table, name: String) -> Result<Vehicle, SceneError> {
    let wheels = match table.alternatives("load", "wheels")? {
        [Some(load), _] => {
            let force = load.quantity(Dimension::Force, LOAD, LOAD_EXAMPLE)?;
            vec![Wheel {
                x: 0.0,
                y: 0.0,
                load: SurfaceLoad::point(force).map_err(|e| table.rejected(e))?,
            }]
        }
        [None, Some(list)] => list
            .some_items("a list of wheels, such as [ { x = \"0 m\", y = \"0.9 m\", load = \"50 kN\" } ]")?
            .iter()
            .map(wheel)
            .collect::<Result<_, _>>()?,
        [None, None] => {
            return Err(table.inconsistent(
                "neither `load` nor `wheels`",
                "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]",
            ));
        }
    };
    let speed = table.quantity("speed", Dimension::Speed, SPEED, "\"40 km/h\"")?;
    let direction = table.word("direction", DIRECTIONS, Direction::Forward)?;
    Vehicle::new(name, wheels, speed, direction).map_err(|e| table.rejected(e))
}

fn wheel(item: &Value) -> Result<Wheel, SceneError> {
    let table = item.table(keys::WHEEL)?;
    let length = |key, range, example| -> Result<f64, SceneError> {
        Ok(table
            .optional_quantity(key, Dimension::Length, range, example)?
            .unwrap_or(0.0))
    };
    let force = table.quantity("load", Dimension::Force, LOAD, "\"50 kN\"")?;
    let contact_radius = length("contact_radius", CONTACT_RADIUS, "\"0.15 m\"")?;
    Ok(Wheel {
        x: length("x", OFFSET, "\"-4 m\"")?,
        y: length("y", OFFSET, "\"0.9 m\"")?,
        load: SurfaceLoad::new(force, contact_radius).map_err(|e| table.rejected(e))?,
    })
}

/// What is allowed instead of a vehicle that moves nothing where its displacements are to be scaled.
pub(super) fn unscalable(vehicle: &Vehicle, index: usize, scaling: Option<PeakScaling>) -> Option<String> {
    let key = match scaling? {
        PeakScaling::Longitudinal(_) => "ground.longitudinal_peak",
        PeakScaling::Vertical(_) if index == 0 => "ground.vertical_peak",
        PeakScaling::Vertical(_) => return None,
    };
    (vehicle.weight() == 0.0).then(|| format!("a load greater than 0, which `{key}` can scale"))
}

fn order(table: &Table, vehicles: &[TrafficVehicle]) -> Result<Order, SceneError> {
    let [order, sequence] = table.alternatives("order", "sequence")?;
    let random = match order {
        Some(order) => order.word(&[("interleaved", false), ("random", true)])?,
        None => false,
    };
    if random {
        let seed = table
            .optional("seed")
            .map_or(Ok(DEFAULT_SEED), |seed| seed.integer(0..=u64::MAX))?;
        return Ok(Order::Random { seed });
    }
    if let Some(seed) = table.optional("seed") {
        seed.integer(0..=u64::MAX)?;
    }
    let choice = if sequence.is_some() { "sequence" } else { "order" };
    table.refuse("seed", choice, "`seed` only with order = \"random\"")?;
    match sequence {
        Some(list) => list
            .some_items("a list of the vehicles' names, such as [\"truck\", \"van\"]")?
            .iter()
            .map(|item| {
                let names: Vec<_> = vehicles
                    .iter()
                    .enumerate()
                    .map(|(index, v)| (v.vehicle.name(), index))
                    .collect();
                item.word(&names)
            })
            .collect::<Result<_, _>>()
            .map(Order::Sequence),
        None => Ok(Order::Interleaved),
    }
}
