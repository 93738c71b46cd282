//! How far beyond the ends of the duct a vehicle has to be followed.

use ground_field::DuctMotion;

use crate::CableError;
use crate::error::{checked, positive};
use crate::tuning::NEGLIGIBLE_TURN;

/// How far beyond the last turn of D_l, as a multiple of its distance, the parts of the duct no longer change the order in which they
/// lead: tails that are a sum of two powers, −a/ξᵐ + b/ξⁿ, have their steepest slope within 1.5 of the distance of their turn.
const SETTLED: f64 = 1.5;
/// Ratio of two neighbouring distances at which D_l is read.
const GROWTH: f64 = 1.01;
/// A vehicle is followed to this many depths from its wheels at least.
const NEAREST: f64 = 6.0;

/// How far \[m\] beyond the ends of a duct at `depth` \[m\] the origins of the vehicles with these `motions` have to be followed: 1.5 times
/// as far from their wheels as the outermost turn of D_l, and six depths at least.
///
/// Between two passes the ground is at rest, and what the duct does while a vehicle is farther out than its approach is taken in one
/// step. That is exact where D_l does not turn out there: friction does not depend on speed, and a node whose duct moves one way only
/// ends up the same whether it does so at once or little by little. On a half-space the outermost turn lies about 12 depths out at
/// ν = 0.4, and of the order 2/(1 − 2ν) depths in general. Over rock D_l turns again and again, each time by far less: turns by less than 1e-5 of the
/// peak do not count. To follow a vehicle farther than this changes nothing and costs little.
///
/// Turns are looked for inward from `farthest` \[m\] from the vehicles' origins, beyond which D_l counts as nothing. A hundred depths
/// are enough on a half-space, ten times their thickness on layers; the motions should reach that far.
///
/// # Errors
///
/// [`CableError::InvalidParameter`] unless `depth` is finite and positive and `farthest` is finite.
///
/// ```
/// use boussinesq::HalfSpace;
/// use cable_dem::approach;
/// use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
///
/// let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
/// let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
/// let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 150.0, 1e-8)?;
/// // Half as far again as the outermost turn, about twelve depths out.
/// let approach = approach(&[motion], 1.2, 120.0)?;
/// assert!((18.0..24.0).contains(&approach), "{approach}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn approach(motions: &[DuctMotion], depth: f64, farthest: f64) -> Result<f64, CableError> {
    let nearest = NEAREST * positive("depth", depth)?;
    checked("farthest", farthest, "finite", |_| true)?;
    Ok(motions
        .iter()
        .flat_map(|motion| [1.0, -1.0].map(|side| outermost(motion, side, nearest, farthest)))
        .fold(0.0, f64::max))
}

/// Where D_l has settled on one side of a vehicle; the walk is from `farthest` inward to `nearest` to its wheels.
fn outermost(motion: &DuctMotion, side: f64, nearest: f64, farthest: f64) -> f64 {
    let counts = NEGLIGIBLE_TURN * motion.peak_longitudinal();
    let start = motion.half_length();
    let mut distance = farthest - start;
    // D_l is nothing beyond; its range so far, and where it ends.
    let (mut low, mut high) = ((0.0, distance), (0.0, distance));
    while distance > nearest {
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
            return start + SETTLED * extreme.1;
        }
        distance /= GROWTH;
    }
    start + distance
}
