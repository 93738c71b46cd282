//! Vehicles: wheels that travel together.

use std::fmt;

use crate::error::checked;
use crate::{GroundError, SurfaceLoad};

/// One wheel of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wheel {
    /// Position ahead of the vehicle's origin, positive in its direction of travel \[m\].
    pub x: f64,
    /// Position to the side of the wheel path's axis \[m\].
    pub y: f64,
    /// What the wheel puts on the road.
    pub load: SurfaceLoad,
}

/// Which way a vehicle drives along the duct.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// Toward growing x.
    #[default]
    Forward,
    /// Toward falling x.
    Reverse,
}

impl Direction {
    /// +1 for forward, −1 for reverse.
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Reverse => -1.0,
        }
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Forward => "forward",
            Self::Reverse => "reverse",
        })
    }
}

/// A vehicle: wheels in fixed places relative to each other, a speed and a direction.
///
/// ```
/// use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};
///
/// let load = SurfaceLoad::new(50e3, 0.15)?;
/// let axle = vec![Wheel { x: 0.0, y: -0.9, load }, Wheel { x: 0.0, y: 0.9, load }];
/// let trailer = Vehicle::new("trailer", axle, 11.1, Direction::Reverse)?;
/// assert_eq!((trailer.weight(), trailer.velocity()), (100e3, -11.1));
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle {
    name: String,
    wheels: Vec<Wheel>,
    speed: f64,
    direction: Direction,
}

impl Vehicle {
    /// A vehicle with `wheels`, driving at `speed` \[m/s\].
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless there is a wheel, the speed is positive and all positions are finite.
    pub fn new(
        name: impl Into<String>,
        wheels: Vec<Wheel>,
        speed: f64,
        direction: Direction,
    ) -> Result<Self, GroundError> {
        checked("wheels", wheels.len() as f64, "at least one", |v| v > 0.0)?;
        for wheel in &wheels {
            checked("wheel x", wheel.x, "finite", |_| true)?;
            checked("wheel y", wheel.y, "finite", |_| true)?;
        }
        checked("speed", speed, "finite and positive", |v| v > 0.0)?;
        Ok(Self {
            name: name.into(),
            wheels,
            speed,
            direction,
        })
    }

    /// A vehicle that is one concentrated `load` \[N\] at its origin, driving forward at `speed` \[m/s\].
    ///
    /// # Errors
    ///
    /// As for [`Vehicle::new`] and [`SurfaceLoad::new`].
    pub fn point(name: impl Into<String>, load: f64, speed: f64) -> Result<Self, GroundError> {
        let wheel = Wheel {
            x: 0.0,
            y: 0.0,
            load: SurfaceLoad::point(load)?,
        };
        Self::new(name, vec![wheel], speed, Direction::Forward)
    }

    /// The same vehicle, driving in `direction`.
    #[must_use]
    pub fn driving(mut self, direction: Direction) -> Self {
        self.direction = direction;
        self
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Wheels, in the vehicle's own frame.
    pub fn wheels(&self) -> &[Wheel] {
        &self.wheels
    }

    /// Speed \[m/s\], positive.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Direction of travel.
    pub fn direction(&self) -> Direction {
        self.direction
    }

    /// Velocity along x \[m/s\]: the speed with the direction's sign.
    pub fn velocity(&self) -> f64 {
        self.direction.sign() * self.speed
    }

    /// Total load \[N\].
    pub fn weight(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.load.force()).sum()
    }
}
