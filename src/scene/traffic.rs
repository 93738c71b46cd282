//! `[[vehicles]]` and `[traffic]`: who drives, how often, in which order.

use std::cmp::Ordering;

use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};

use super::data::{DAYS_PER_YEAR, Order, PeakScaling, Traffic, TrafficVehicle};
use super::error::SceneError;
use super::histogram;
use super::range::{
    CONTACT_RADIUS, LANE, LOAD, PASSES, PER_DAY, SHARE, SPEED, WHEEL_LOAD, WHEEL_X, WHEEL_Y, YEARS,
    allowed_whole, shown,
};
use super::table::Table;
use super::value::Value;

const DIRECTIONS: &[(&str, Direction)] = &[("forward", Direction::Forward), ("reverse", Direction::Reverse)];
/// Seed of a random order where the file gives none.
const DEFAULT_SEED: u64 = 1;

/// Speed of the axles of a histogram where the file gives none \[m/s\]: 40 km/h, as for the presets.
const AXLE_SPEED: f64 = 40.0 / 3.6;

/// Who drives, and how often; `name` is that of the scene's file.
pub fn traffic(
    name: &str,
    root: &Table,
    scaling: Option<PeakScaling>,
) -> Result<(Vec<TrafficVehicle>, Traffic), SceneError> {
    let table = root.table("traffic")?;
    let (mut vehicles, order) = if let Some(value) = histogram(root, &table)? {
        if let Some(PeakScaling::Longitudinal(_)) = scaling {
            let allowed = "`ground.vertical_peak`, which is that of the first row: one longitudinal peak for every load has no meaning";
            return Err(value.inconsistent("a histogram with `ground.longitudinal_peak`", allowed));
        }
        let speed = table.optional_quantity("speed", SPEED)?.unwrap_or(AXLE_SPEED);
        (histogram::axles(name, &value, speed)?, random_order(&table)?)
    } else {
        let vehicles = listed(root)?;
        let order = order(&table, &vehicles)?;
        (vehicles, order)
    };
    if let Order::Sequence(sequence) = &order {
        for (index, vehicle) in vehicles.iter_mut().enumerate() {
            vehicle.share = sequence.iter().filter(|&&i| i == index).count() as f64;
        }
    }
    normalise(&mut vehicles);
    let traffic = Traffic {
        passes: passes(&table)?,
        per_day: table.optional_quantity("per_day", PER_DAY)?,
        order,
    };
    Ok((vehicles, traffic))
}

/// The table of axles in place of `[[vehicles]]`; of two that were set at different times the later one stands.
fn histogram<'d>(root: &Table<'d>, table: &Table<'d>) -> Result<Option<Value<'d>>, SceneError> {
    let Some(value) = table.optional("histogram") else {
        let allowed = "no `speed`: every vehicle has its own";
        table.refuse("speed", "histogram", allowed)?;
        return Ok(None);
    };
    let Some(vehicles) = root.optional("vehicles") else {
        return Ok(Some(value));
    };
    match table.order(&value, &vehicles) {
        Ordering::Greater => Ok(Some(value)),
        Ordering::Less => Ok(None),
        Ordering::Equal => {
            Err(value.inconsistent("both `traffic.histogram` and [[vehicles]]", "only one of the two"))
        }
    }
}

/// Axles of a histogram come at random.
fn random_order(table: &Table) -> Result<Order, SceneError> {
    let [order, sequence] = table.alternatives("order", "sequence")?;
    let allowed = "order = \"random\", or none: the axles of a histogram come at random";
    if let Some(sequence) = sequence {
        return Err(sequence.inconsistent("a sequence of the axles of a histogram", allowed));
    }
    if let Some(order) = order {
        order.word_of(&[("random", ())], allowed)?;
    }
    Ok(Order::Random { seed: seed(table)? })
}

fn seed(table: &Table) -> Result<u64, SceneError> {
    let seed = table.optional("seed");
    seed.map_or(Ok(DEFAULT_SEED), |seed| seed.integer(0..=u64::MAX))
}

/// The vehicles that the file lists.
fn listed(root: &Table) -> Result<Vec<TrafficVehicle>, SceneError> {
    let allowed = "one [[vehicles]] or more, or traffic.histogram";
    let items = root.required("vehicles", allowed)?.some_items(allowed)?;
    let vehicle = |(index, item)| {
        let table = Table::new(item)?;
        let name = name(&table, index)?;
        Ok(TrafficVehicle {
            vehicle: vehicle(&table, name)?,
            share: table.optional_quantity("share", SHARE)?.unwrap_or(1.0),
            lateral_offset: table.optional_quantity("lateral_offset", LANE)?.unwrap_or(0.0),
        })
    };
    items.into_iter().enumerate().map(vehicle).collect()
}

/// The passes: as they stand, or those of so many years, rounded to whole ones.
fn passes(table: &Table) -> Result<u64, SceneError> {
    let [passes, years] = table.alternatives("passes", "years")?;
    let Some(value) = years else {
        let allowed = format!("{}, or `years` with `per_day`", allowed_whole(&PASSES));
        return passes
            .map_or_else(|| table.required("passes", &allowed), Ok)?
            .integer(PASSES);
    };
    let years = value.quantity(YEARS)?;
    let allowed = format!("vehicles a day beside `years`, {}", PER_DAY.allowed());
    let per_day = table.required("per_day", &allowed)?.quantity(PER_DAY)?;
    let passes = (years * DAYS_PER_YEAR * per_day).round();
    if !(*PASSES.start() as f64..=*PASSES.end() as f64).contains(&passes) {
        let found = format!(
            "{} years of {} vehicles a day, {} passes",
            shown(years),
            shown(per_day),
            shown(passes)
        );
        let allowed = format!(
            "so many that there are from {} to {} passes",
            PASSES.start(),
            PASSES.end()
        );
        return Err(value.inconsistent(found, allowed));
    }
    Ok(passes as u64)
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

fn name(table: &Table, index: usize) -> Result<String, SceneError> {
    let name = table.optional("name");
    name.map_or_else(
        || Ok(format!("vehicle {}", index + 1)),
        |name| name.text("a name in quotes that no other vehicle has"),
    )
}

fn vehicle(table: &Table, name: String) -> Result<Vehicle, SceneError> {
    let wheels = match table.alternatives("load", "wheels")? {
        [Some(load), _] => {
            let force = load.quantity(LOAD)?;
            vec![Wheel {
                x: 0.0,
                y: 0.0,
                load: SurfaceLoad::point(force).map_err(|e| table.rejected(e))?,
            }]
        }
        [None, Some(list)] => list
            .some_items("a list of wheels, such as [ { x = \"0 m\", y = \"0.9 m\", load = \"50 kN\" } ]")?
            .into_iter()
            .map(wheel)
            .collect::<Result<_, _>>()?,
        [None, None] => {
            return Err(table.value.inconsistent(
                "neither `load` nor `wheels`",
                "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]",
            ));
        }
    };
    let speed = table.quantity("speed", SPEED)?;
    let allowed = "\"forward\", toward the downstream end, or \"reverse\"";
    let direction = table
        .optional("direction")
        .map_or(Ok(Direction::Forward), |value| value.word_of(DIRECTIONS, allowed))?;
    Vehicle::new(name, wheels, speed, direction).map_err(|e| table.rejected(e))
}

fn wheel(item: Value) -> Result<Wheel, SceneError> {
    let table = Table::new(item)?;
    let or_zero = |key, quantity| {
        table
            .optional_quantity(key, quantity)
            .map(Option::unwrap_or_default)
    };
    let force = table.quantity("load", WHEEL_LOAD)?;
    let contact_radius = or_zero("contact_radius", CONTACT_RADIUS)?;
    Ok(Wheel {
        x: or_zero("x", WHEEL_X)?,
        y: or_zero("y", WHEEL_Y)?,
        load: SurfaceLoad::new(force, contact_radius).map_err(|e| table.rejected(e))?,
    })
}

fn order(table: &Table, vehicles: &[TrafficVehicle]) -> Result<Order, SceneError> {
    let [order, sequence] = table.alternatives("order", "sequence")?;
    let random = match order {
        Some(order) => order.word(&[("interleaved", false), ("random", true)])?,
        None => false,
    };
    if random {
        return Ok(Order::Random { seed: seed(table)? });
    }
    if let Some(seed) = table.optional("seed") {
        seed.integer(0..=u64::MAX)?;
    }
    let choice = if sequence.is_some() { "sequence" } else { "order" };
    table.refuse("seed", choice, "`seed` only with order = \"random\"")?;
    let Some(list) = sequence else {
        return Ok(Order::Interleaved);
    };
    let names: Vec<(&str, usize)> = vehicles.iter().map(|v| v.vehicle.name()).zip(0..).collect();
    let items = list.some_items("a list of the vehicles' names, such as [\"truck\", \"van\"]")?;
    let sequence = items
        .iter()
        .map(|item| item.word(&names))
        .collect::<Result<_, _>>()?;
    Ok(Order::Sequence(sequence))
}
