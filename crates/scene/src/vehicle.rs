//! `[[vehicles]]`: who drives above the duct.

use ground_field::{Direction, GroundError, SurfaceLoad, Vehicle};

use crate::content::Content;
use crate::error::Result;
use crate::key::Form;
use crate::key::Form::{List, Name, Number, Table, Words};
use crate::range::{CONTACT_RADIUS, LANE, LOAD, SHARE, SPEED, WHEEL_LOAD, WHEEL_X, WHEEL_Y};
use crate::section::keys;
use crate::stored::{Given, Stored};

keys! {
    /// A vehicle and how often it drives, in SI. It has a load or wheels.
    pub struct TrafficVehicle {
        preset "A vehicle by its name; other keys override its values.";
        /// Name of the vehicle.
        name: String = Name("a name in quotes that no other vehicle has"), "\"vehicle 1\", \"vehicle 2\", …";
        /// Speed of the vehicle.
        speed: f64 = Number(SPEED);
        /// One concentrated load.
        load: Option<f64> = Number(LOAD), "`wheels` instead";
        /// Wheels of the vehicle.
        wheels: Vec<Wheel> = List(&[Table(Wheel::KEYS)], 1, WHEELS), "`load` instead";
        /// Its lane: how far its axis lies to the left of the first lane's, seen along forward traffic.
        lateral_offset: f64 = Number(LANE), "0 m";
        /// Forward is toward growing x.
        direction: Direction = DIRECTION, "\"forward\"";
        /// Its share of the passes, relative to those of the others.
        share: f64 = Number(SHARE), "equal shares" => 1.0;
    }
}

const WHEELS: &str = "a list of wheels, such as [ { x = \"0 m\", y = \"0.9 m\", load = \"50 kN\" } ]";

keys! {
    /// A wheel of a vehicle, in SI.
    #[derive(Copy, Default)]
    pub struct Wheel {
        /// Where the wheel is ahead of the vehicle's origin, along the road.
        x: f64 = Number(WHEEL_X), "0 m";
        /// Where it is to the left of the vehicle's axis, seen along forward traffic.
        y: f64 = Number(WHEEL_Y), "0 m";
        /// Load of the wheel.
        load: f64 = Number(WHEEL_LOAD);
        /// Radius of the disc that it loads.
        contact_radius: f64 = Number(CONTACT_RADIUS), "0 m, a point";
    }
}

const DIRECTIONS: &[(&str, Direction)] = &[("forward", Direction::Forward), ("reverse", Direction::Reverse)];
const DIRECTION: Form = Words(&["forward", "reverse"], "; forward is toward the downstream end");

impl Stored for Direction {
    fn read(given: &Given) -> Result<Self> {
        given.word(DIRECTIONS, given.form.allowed())
    }

    fn write(&self, _: Form) -> Content {
        Content::Text(self.to_string())
    }
}

impl TrafficVehicle {
    /// A vehicle that is one concentrated `load` \[N\] at its origin, driving forward at `speed` \[m/s\].
    pub fn point(name: &str, load: f64, speed: f64) -> Self {
        Self {
            name: name.to_owned(),
            speed,
            load: Some(load),
            wheels: Vec::new(),
            lateral_offset: 0.0,
            direction: Direction::Forward,
            share: 1.0,
        }
    }

    /// Its wheels; a concentrated load is one at its origin.
    pub fn wheels(&self) -> Vec<Wheel> {
        let Some(load) = self.load else {
            return self.wheels.clone();
        };
        vec![Wheel {
            load,
            ..Wheel::default()
        }]
    }

    /// Total load \[N\].
    pub fn weight(&self) -> f64 {
        self.wheels().iter().map(|wheel| wheel.load).sum()
    }

    /// The vehicle as the ground feels it.
    ///
    /// # Errors
    ///
    /// [`GroundError`] if a valid scene has none: no wheels, or a number out of its range.
    pub fn vehicle(&self) -> Result<Vehicle, GroundError> {
        let mut wheels = Vec::new();
        for wheel in self.wheels() {
            let load = SurfaceLoad::new(wheel.load, wheel.contact_radius)?;
            let (x, y) = (wheel.x, wheel.y);
            wheels.push(ground_field::Wheel { x, y, load });
        }
        Vehicle::new(&*self.name, wheels, self.speed, self.direction)
    }
}
