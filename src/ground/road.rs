//! How far out on the road a vehicle is followed.
//!
//! Between two passes the ground is at rest. What the duct does while a vehicle is farther out than its `approach` is taken
//! in one step, from rest to the first position and from the last position to rest. That is exact where D_l does not
//! turn out there: friction does not depend on speed, and a node whose duct only moves one way ends up the same whether it
//! does so at once or little by little. So a vehicle has to be followed to the outermost turn of D_l, and no farther: ten
//! depths on a half-space with ν = 0.4, 2/(1 − 2ν) depths in general. Over rock D_l turns again and again, each time by far
//! less; turns that do not count are left out.

use ground_field::DuctMotion;

use crate::scene::Scene;

/// Turns of D_l by less than this share of its peak do not count.
const NEGLIGIBLE_TURN: f64 = 1e-5;
/// The road is looked at so many distances from wheel to duct away from the wheels, and so many times as far as the layers go
/// down.
const FARTHEST_DISTANCES: f64 = 100.0;
const FARTHEST_THICKNESSES: f64 = 10.0;
/// But no farther than this \[m\].
const FARTHEST: f64 = 3000.0;
/// Ratio of two neighbouring distances at which it is looked at.
const GROWTH: f64 = 1.01;
/// A vehicle is followed so much farther than to the turn: beyond, the parts of the duct no longer change the order in which they
/// lead, as tails that are a sum of two powers have their steepest slope within 1.5 of the distance of their turn.
const MARGIN: f64 = 1.5;
/// A vehicle is followed to so many depths from its wheels at least.
const NEAREST: f64 = 6.0;

/// How far the road is looked at \[m\], measured from a vehicle's origin.
pub fn farthest(scene: &Scene) -> f64 {
    let wheels = || scene.vehicles.iter().flat_map(|traffic| traffic.vehicle.wheels());
    let ahead = wheels().map(|wheel| wheel.x.abs()).fold(0.0, f64::max);
    let aside = wheels()
        .map(|wheel| wheel.y.abs() + scene.duct.lateral_offset.abs())
        .fold(0.0, f64::max);
    let thickness: f64 = scene
        .ground
        .profile
        .layers()
        .iter()
        .map(ground_field::SoilLayer::thickness)
        .sum();
    let far = (FARTHEST_DISTANCES * scene.duct.depth.hypot(aside)).max(FARTHEST_THICKNESSES * thickness);
    ahead + far.min(FARTHEST)
}

/// How far from a vehicle's origin its motion of the duct has to be known \[m\].
pub fn reach(scene: &Scene) -> f64 {
    scene.duct.length + scene.solver.approach.unwrap_or(0.0).max(farthest(scene))
}

/// How far beyond the duct's ends vehicles are followed \[m\]: as the scene says, or to the outermost turn of D_l.
pub fn approach(scene: &Scene, motions: &[DuctMotion]) -> f64 {
    scene
        .solver
        .approach
        .unwrap_or_else(|| outermost_turn(scene, motions))
}

/// Distance from the vehicles' origins beyond which D_l of none of them turns by more than counts \[m\].
pub fn outermost_turn(scene: &Scene, motions: &[DuctMotion]) -> f64 {
    motions
        .iter()
        .flat_map(|motion| [1.0, -1.0].map(|side| outermost(motion, scene, side)))
        .fold(0.0, f64::max)
}

/// The outermost turn on one side of a vehicle, looked for from far away inward.
fn outermost(motion: &DuctMotion, scene: &Scene, side: f64) -> f64 {
    let counts = NEGLIGIBLE_TURN * motion.peak_longitudinal();
    let start = motion.half_length();
    let mut distance = farthest(scene) - start;
    // D_l is nothing beyond; its range so far, and where it ends.
    let (mut low, mut high) = ((0.0, distance), (0.0, distance));
    while distance > NEAREST * scene.duct.depth {
        let value = motion.longitudinal(side * (start + distance));
        if value < low.0 {
            low = (value, distance);
        }
        if value > high.0 {
            high = (value, distance);
        }
        // On the way in from nothing D_l has gone one way; it turned where it was farthest from nothing.
        let (extreme, turned) = if high.0 > -low.0 {
            (high, high.0 - value)
        } else {
            (low, value - low.0)
        };
        if turned > counts {
            return start + MARGIN * extreme.1;
        }
        distance /= GROWTH;
    }
    start + distance
}
