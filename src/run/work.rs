//! What a run costs, in counts that do not depend on the machine, and the processor time that they take.

use std::ops::{Add, AddAssign, Div, Mul};

use cable_dem::Statistics;

use crate::plan::CableMethod;
use crate::scene::TrafficVehicle;

/// Time of a node's update, a window, a corner, a node's part in one jump, and in one pass that is listed within a jump, and of a step \[s\]
/// without inertia; of a node's update with it, and of an explicit one.
const SECONDS: Work = Work([5.2e-9, 1.1e-7, 1.5e-8, 1.2e-6, 3.5e-8, 7.5e-8]);
const DYNAMIC: Work = Work([6e-8, 0.0, 0.0, 1.4e-6, 4.5e-8, 0.0]);
const EXPLICIT: Work = Work([1e-9, 0.0, 0.0, 1.4e-6, 4.5e-8, 0.0]);
/// What they multiply by from one level to the next, where that is not measured; and the bounds of what is believed.
pub const GROWTH: Work = Work([4.6, 2.1, 4.6, 2.0, 2.0, 2.0]);
const BELIEVED: (f64, f64) = (0.8, 1.3);
/// Time of a point at which the motion of the duct is tabulated \[s\], for the vehicle and for each of its wheels.
const TABULATED: (f64, f64) = (3e-8, 7e-8);

/// Processor time in which the motion of the duct under each vehicle of a scene is tabulated at so many `points` \[s\].
pub fn tabulated(points: f64, vehicles: &[TrafficVehicle]) -> f64 {
    let of_vehicle = |of: &TrafficVehicle| TABULATED.0 + TABULATED.1 * of.vehicle.wheels().len() as f64;
    points * vehicles.iter().map(of_vehicle).sum::<f64>()
}

/// Counts of work: node updates, windows, corners, nodes times periods, nodes times passes within jumps, and steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work(pub [f64; 6]);

impl Work {
    /// Of so many simulated `periods` on a mesh of so many `nodes`, with so many passes listed within jumps.
    pub fn new(statistics: &Statistics, nodes: usize, periods: f64, listed: f64) -> Self {
        Self([
            statistics.node_updates as f64,
            statistics.windows as f64,
            statistics.corners as f64,
            nodes as f64 * periods,
            nodes as f64 * listed,
            statistics.steps as f64,
        ])
    }

    /// Node updates that take so much processor time \[s\].
    pub fn of_time(seconds: f64, method: CableMethod) -> Self {
        let mut work = Self::default();
        work.0[0] = seconds / Self::cost(method).0[0];
        work
    }

    /// Processor time \[s\].
    pub fn seconds(self, method: CableMethod) -> f64 {
        (self * Self::cost(method)).0.iter().sum()
    }

    fn cost(method: CableMethod) -> Self {
        match method {
            CableMethod::QuasiStatic => SECONDS,
            CableMethod::Dynamic => DYNAMIC,
            CableMethod::Explicit => EXPLICIT,
        }
    }

    /// On a mesh so many levels finer.
    pub fn refined(self, levels: usize) -> Self {
        (0..levels).fold(self, |work, _| work * GROWTH)
    }

    pub fn times(self, factor: f64) -> Self {
        Self(self.0.map(|count| factor * count))
    }

    /// What a run compares with the most that it refines for.
    pub fn updates(self) -> f64 {
        self.0[0] + self.0[2]
    }

    fn map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// Growth from `coarser` to this, as far as it is believed.
    pub fn growth(self, coarser: Self) -> Self {
        (self / coarser).map(GROWTH, |growth, usual| {
            if growth.is_finite() {
                growth.clamp(BELIEVED.0 * usual, BELIEVED.1 * usual)
            } else {
                usual
            }
        })
    }
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.map(other, |a, b| a + b)
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Work {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.map(other, |a, b| a * b)
    }
}

impl Div for Work {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.map(other, |a, b| a / b)
    }
}
