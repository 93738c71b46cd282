//! Motion of a straight duct at constant depth while a vehicle drives along it.

use crate::error::checked;
use crate::peaks;
use crate::{Displacement, GroundError, GroundField, RadialProfile, SurfaceLoad, Vehicle};

/// How far the ground is sampled at least, in the distance from a wheel to the duct.
const MIN_REACH: f64 = 8.0;
/// Largest share of the peak that the outer half of the sampled range may hold, should the peak not lie beyond it.
const FADED: f64 = 0.5;
/// The curvature of D_l is read over so many depths to either side.
const SECANT: f64 = 0.1;
/// √(max |D″| / max |D|) of D = ξ/(1 + ξ²)^{3/2}, which is D_l at depth 1 below a concentrated load on an incompressible half-space,
/// with D″ read over [`SECANT`] (2.2406 without).
const CONCENTRATED: f64 = 2.2145;
/// Radii beyond, each twice the last, at which a second rise is looked for: a thousand times the sampled range.
const OUTPOSTS: i32 = 10;
/// Extensions of the sampled range in search of the peak.
const MAX_EXTENSIONS: usize = 20;

/// Where the duct lies relative to the road and the wheel path.
///
/// ```
/// let line = ground_field::DuctLine::new(1.2, 0.5)?;
/// assert_eq!((line.depth(), line.lateral_offset()), (1.2, 0.5));
/// assert!(ground_field::DuctLine::new(0.0, 0.5).is_err());
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DuctLine {
    depth: f64,
    lateral_offset: f64,
}

impl DuctLine {
    /// A duct at `depth` \[m\] below the surface and `lateral_offset` \[m\] to the side of the vehicles' axis.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the depth is positive and both are finite.
    pub fn new(depth: f64, lateral_offset: f64) -> Result<Self, GroundError> {
        Ok(Self {
            depth: checked("depth", depth, "finite and positive", |v| v > 0.0)?,
            lateral_offset: checked("lateral_offset", lateral_offset, "finite", |_| true)?,
        })
    }

    /// Depth below the surface \[m\].
    pub fn depth(self) -> f64 {
        self.depth
    }

    /// Distance to the side of the vehicles' axis \[m\].
    pub fn lateral_offset(self) -> f64 {
        self.lateral_offset
    }
}

/// The displacement of a straight duct that moves with the ground, in the frame of the vehicle that drives along it.
///
/// With ξ = x − x_v from the vehicle's origin x_v, the displacement is a fixed shape: D_l(ξ) along the duct and D_v(ξ) downward,
/// superposed from the wheels at (x_w, y_w) with loads P_w, at horizontal distances r_w from the duct's point at offset y:
///
/// ```text
/// D_l(ξ) = Σ_w P_w u_r(r_w) (ξ − x_w)/r_w      D_v(ξ) = Σ_w P_w u_z(r_w)      r_w² = (ξ − x_w)² + (y − y_w)²
/// ```
///
/// with u_r and u_z the ground's displacement under a unit load at the duct's depth ([`GroundField`]). As the shape travels at the
/// velocity v, a point of the duct moves along it at (Kashiro et al., Furukawa Review, Equation (1))
///
/// ```text
/// V_l = ∂D_l(x − v t)/∂t = −v dD_l/dξ
/// ```
///
/// ξ is measured along x, whichever way the vehicle drives: for a reverse vehicle the duct ahead of it has ξ < 0. The speed enters V_l
/// alone: the load is static, so the vehicle must be much slower than the ground's shear waves.
///
/// An example stands on the front page of the crate.
#[derive(Debug, Clone)]
pub struct DuctMotion {
    profiles: Vec<RadialProfile>,
    wheels: Vec<WheelLine>,
    velocity: f64,
    reach: f64,
    samples: usize,
    peak_longitudinal: f64,
    peak_vertical: f64,
    length_scale: f64,
}

/// One wheel as the duct sees it.
#[derive(Debug, Clone, Copy)]
struct WheelLine {
    profile: usize,
    x: f64,
    side: f64,
    force: f64,
}

/// Displacement of the duct at one point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Point {
    longitudinal: f64,
    gradient: f64,
    vertical: f64,
}

impl DuctMotion {
    /// Motion of the duct on `line` under `vehicle`, for |ξ| up to `reach` \[m\] at least, to `accuracy` as a share of the peak
    /// displacement under a wheel (see [`RadialProfile::sample`]).
    ///
    /// The ground is sampled as far as the peaks need it, which over a stiff slab may lie many depths from the wheels.
    ///
    /// # Errors
    ///
    /// As for [`RadialProfile::sample`]; [`GroundError::Unsupported`] for a field that does not fade with distance.
    pub fn new(
        field: &dyn GroundField,
        vehicle: &Vehicle,
        line: DuctLine,
        reach: f64,
        accuracy: f64,
    ) -> Result<Self, GroundError> {
        checked("reach", reach, "finite and positive", |v| v > 0.0)?;
        let (wheels, contact_radii) = seen_from(line, vehicle);
        let distance = |wheel: &WheelLine| line.depth.hypot(wheel.side);
        let mut motion = Self {
            profiles: Vec::new(),
            reach: reach.max(MIN_REACH * wheels.iter().map(distance).fold(0.0, f64::max)),
            wheels,
            velocity: vehicle.velocity(),
            samples: 0,
            peak_longitudinal: 0.0,
            peak_vertical: 0.0,
            length_scale: line.depth,
        };
        for _ in 0..=MAX_EXTENSIONS {
            let radius = |wheel: &WheelLine| (motion.reach + wheel.x.abs()).hypot(wheel.side);
            let farthest = motion.wheels.iter().map(radius).fold(0.0, f64::max);
            motion.profiles = contact_radii
                .iter()
                .map(|&radius| RadialProfile::sample(field, radius, line.depth, farthest, accuracy))
                .collect::<Result<_, _>>()?;
            motion.samples += motion.profiles.iter().map(RadialProfile::samples).sum::<usize>();
            if !motion.find_peaks() {
                motion.reach *= 2.0;
            } else if let Some(radius) = motion.rise_beyond(field, contact_radii[0], line.depth, farthest)? {
                motion.reach = 2.0 * radius;
            } else {
                motion.length_scale = motion.smooth_over(line.depth);
                return Ok(motion);
            }
        }
        Err(GroundError::Unsupported {
            model: "motion of the duct",
            limit: "its displacement does not fade with the distance from the load",
        })
    }

    /// The same motion with all displacements multiplied by `factor`: a softer or stiffer ground of the same shape.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the factor, and the peaks it makes, are finite.
    pub fn scaled(mut self, factor: f64) -> Result<Self, GroundError> {
        for wheel in &mut self.wheels {
            wheel.force *= factor;
        }
        self.peak_longitudinal *= factor.abs();
        self.peak_vertical *= factor.abs();
        let forces = self.wheels.iter().map(|wheel| wheel.force.abs());
        let size = forces.sum::<f64>() + self.peak_longitudinal + self.peak_vertical;
        let allowed = "finite, and so the displacements it makes";
        checked("factor", factor, allowed, |_| size.is_finite())?;
        Ok(self)
    }

    /// Largest |ξ| \[m\] up to which the motion has the accuracy asked; at least the `reach` asked.
    ///
    /// Farther from every wheel the motion is zero: what computes with a motion is to keep within its reach.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// D_l(ξ), positive toward growing x \[m\].
    pub fn longitudinal(&self, xi: f64) -> f64 {
        self.point(xi).longitudinal
    }

    /// D_v(ξ), positive downward \[m\].
    pub fn vertical(&self, xi: f64) -> f64 {
        self.point(xi).vertical
    }

    /// dD_l/dξ, the strain of the duct.
    pub fn longitudinal_gradient(&self, xi: f64) -> f64 {
        self.point(xi).gradient
    }

    /// V_l(ξ) = −v dD_l/dξ, positive toward growing x \[m/s\] (Kashiro et al., Equation (1)).
    pub fn longitudinal_velocity(&self, xi: f64) -> f64 {
        -self.velocity * self.longitudinal_gradient(xi)
    }

    /// Largest |D_l| along the duct \[m\].
    pub fn peak_longitudinal(&self) -> f64 {
        self.peak_longitudinal
    }

    /// Largest |D_v| along the duct \[m\].
    pub fn peak_vertical(&self) -> f64 {
        self.peak_vertical
    }

    /// Velocity of the vehicle along x \[m/s\], with its direction's sign.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Half the length \[m\] of duct that the wheels themselves stand over, measured from the vehicle's origin.
    pub fn half_length(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.x.abs()).fold(0.0, f64::max)
    }

    /// Length over which D_l changes \[m\]: √(max |D_l| / max |D_l″|), multiplied so that it is the depth of a duct right below a
    /// concentrated load on an incompressible half-space, and that depth at least.
    ///
    /// Beside the lane, under a stiff slab or a wide wheel the duct moves more smoothly than its depth says.
    pub fn length_scale(&self) -> f64 {
        self.length_scale
    }

    /// How many radii the ground model was asked for.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// What each wheel does to the duct at ξ.
    fn parts(&self, xi: f64) -> impl Iterator<Item = Point> {
        self.wheels.iter().map(move |wheel| {
            let ahead = xi - wheel.x;
            let radius = ahead.hypot(wheel.side);
            let at = self.profiles[wheel.profile].at(radius);
            // d(ahead · u_r/r)/dξ; the slope of u_r/r vanishes on the axis.
            let bend = if radius > 0.0 {
                at.ratio_slope * ahead * ahead / radius
            } else {
                0.0
            };
            Point {
                longitudinal: wheel.force * at.ratio * ahead,
                gradient: wheel.force * (at.ratio + bend),
                vertical: wheel.force * at.vertical,
            }
        })
    }

    fn point(&self, xi: f64) -> Point {
        self.parts(xi).fold(Point::default(), |sum, part| Point {
            longitudinal: sum.longitudinal + part.longitudinal,
            gradient: sum.gradient + part.gradient,
            vertical: sum.vertical + part.vertical,
        })
    }

    /// Finds both peaks, and whether the field has faded toward the end of what was sampled, so that none lies beyond.
    fn find_peaks(&mut self) -> bool {
        let positions = self.positions();
        let points: Vec<Point> = positions.iter().map(|&xi| self.point(xi)).collect();
        let largest = |of: fn(Point) -> f64| {
            let value = |xi| of(self.point(xi)).abs();
            peaks::largest(&positions, |k| of(points[k]).abs(), value)
        };
        let along = largest(|point| point.longitudinal);
        let down = largest(|point| point.vertical);
        (self.peak_longitudinal, self.peak_vertical) = (along, down);
        let outer = |xi: f64| {
            self.wheels
                .iter()
                .all(|wheel| (xi - wheel.x).abs() >= 0.5 * self.reach)
        };
        // Of the wheels' sizes, which cannot cancel.
        let faded = |xi: f64| {
            let size = |of: fn(Point) -> f64| self.parts(xi).map(|part| of(part).abs()).sum::<f64>();
            size(|part| part.longitudinal) <= FADED * along && size(|part| part.vertical) <= FADED * down
        };
        positions.into_iter().filter(|&xi| outer(xi)).all(faded)
    }

    /// [`DuctMotion::length_scale`] of a duct at `depth`.
    fn smooth_over(&self, depth: f64) -> f64 {
        let apart = SECANT * depth;
        let bend = |xi: f64| {
            let across = self.longitudinal_gradient(xi + apart) - self.longitudinal_gradient(xi - apart);
            across.abs() / (2.0 * apart)
        };
        let sharpest = self.positions().into_iter().map(bend).fold(0.0, f64::max);
        // Not a number where nothing moves.
        depth.max(CONCENTRATED * (self.peak_longitudinal / sharpest).sqrt())
    }

    /// A radius beyond `farthest` where the wheels together might still move the duct more than a share of the peaks: a stiff slab's own
    /// peak lies far outside that of the soil around a shallow duct. A field that does not answer there is taken at its word within.
    fn rise_beyond(
        &mut self,
        field: &dyn GroundField,
        contact_radius: f64,
        depth: f64,
        farthest: f64,
    ) -> Result<Option<f64>, GroundError> {
        let force = self.wheels.iter().map(|wheel| wheel.force).sum();
        let load = SurfaceLoad::new(force, contact_radius)?;
        let radii: Vec<f64> = (1..=OUTPOSTS).map(|k| farthest * 2_f64.powi(k)).collect();
        let values = field.displacements(load, &radii, depth).unwrap_or_default();
        self.samples += radii.len();
        let high = |value: &Displacement| {
            value.radial.abs() > FADED * self.peak_longitudinal
                || value.vertical.abs() > FADED * self.peak_vertical
        };
        let risen = values.iter().zip(&radii).rev().find(|(value, _)| high(value));
        Ok(risen.map(|(_, &radius)| radius))
    }

    /// Positions ξ, ascending, that resolve what each wheel does: its profile's cells are as wide as the field is smooth.
    fn positions(&self) -> Vec<f64> {
        let mut positions = Vec::new();
        for wheel in &self.wheels {
            for radius in self.profiles[wheel.profile].places() {
                // The width of a feature in ξ is that in r or more: both the place itself and the one of equal distance.
                let leg = (radius * radius - wheel.side * wheel.side).max(0.0).sqrt();
                positions.extend([radius, leg, -radius, -leg].map(|ahead| wheel.x + ahead));
            }
        }
        positions.retain(|xi| xi.abs() <= self.reach);
        positions.sort_by(f64::total_cmp);
        positions.dedup();
        positions
    }
}

/// The wheels of `vehicle` as the duct sees them, and the distinct radii of their contact.
fn seen_from(line: DuctLine, vehicle: &Vehicle) -> (Vec<WheelLine>, Vec<f64>) {
    // Reverse traffic is the mirror image of forward traffic: the wheels stay on their side of the duct.
    let sign = vehicle.direction().sign();
    let mut contact_radii: Vec<f64> = Vec::new();
    let wheels = vehicle.wheels().iter().map(|wheel| {
        let contact_radius = wheel.load.contact_radius();
        let known = contact_radii.iter().position(|&other| other == contact_radius);
        let profile = known.unwrap_or_else(|| {
            contact_radii.push(contact_radius);
            contact_radii.len() - 1
        });
        WheelLine {
            profile,
            x: sign * wheel.x,
            side: wheel.y - line.lateral_offset,
            force: wheel.load.force(),
        }
    });
    (wheels.collect(), contact_radii)
}
