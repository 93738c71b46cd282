//! Motion of a straight duct at constant depth while a vehicle drives along it.
//!
//! The duct moves with the ground. In the vehicle's frame, ξ = x − x_v with x_v the vehicle's origin, the duct's
//! displacement is a fixed shape: D_l(ξ) along the duct, D_v(ξ) downward, superposed from the wheels. A wheel at (x_w, y_w)
//! contributes u_r · (ξ − x_w)/r to D_l, where r is the horizontal distance. As the shape travels, a point of the duct
//! moves along it at the velocity (Kashiro et al., Equation (1))
//!
//! V_l = ∂D_l(x − v t)/∂t = −v dD_l/dξ.

use crate::error::checked;
use crate::{GroundError, GroundField, RadialProfile, Vehicle};

/// Step of the scan for peaks, and how far beyond the wheels it goes, in the distance from a wheel to the duct.
const SCAN_STEP: f64 = 0.05;
const SCAN_REACH: f64 = 8.0;

/// Where the duct lies relative to the road and the wheel path.
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

/// The duct's displacement in a vehicle's frame; see the module's text for the equations.
///
/// ξ is measured along x, whichever way the vehicle drives: for a reverse vehicle the duct ahead of it has ξ < 0.
///
/// ```
/// use ground_field::{Displacement, DuctLine, DuctMotion, GroundError, GroundField, SurfaceLoad, Vehicle};
///
/// /// Incompressible soil of 300 MPa under a point load: u_r = c r z/R³, u_z = c (z²/R³ + 1/R), c = 3P/(4πE).
/// struct Clay;
///
/// impl GroundField for Clay {
///     fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
///         let distance = radius.hypot(depth);
///         let scale = 3.0 * load.force() / (4.0 * std::f64::consts::PI * 300e6);
///         Ok(Displacement {
///             radial: scale * radius * depth / distance.powi(3),
///             vertical: scale * (depth * depth / distance.powi(3) + 1.0 / distance),
///         })
///     }
/// }
///
/// let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
/// let motion = DuctMotion::new(&Clay, &truck, DuctLine::new(1.2, 0.0)?, 30.0, 1e-6)?;
/// // Ahead of the truck the duct is pushed forward, behind it backward; r z/R³ is largest at r = z/√2.
/// assert!(motion.longitudinal(1.0) > 0.0 && motion.longitudinal(-1.0) < 0.0);
/// let largest = motion.longitudinal(1.2 / 2.0_f64.sqrt());
/// assert!((motion.peak_longitudinal() / largest - 1.0).abs() < 1e-6);
/// # Ok::<(), GroundError>(())
/// ```
#[derive(Debug, Clone)]
pub struct DuctMotion {
    profiles: Vec<RadialProfile>,
    wheels: Vec<WheelLine>,
    velocity: f64,
    factor: f64,
    peak_longitudinal: f64,
    peak_vertical: f64,
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
    /// Motion of the duct on `line` under `vehicle`, for |ξ| up to `reach` \[m\], to `accuracy` as a share of the peak
    /// displacement under a wheel (see [`RadialProfile::sample`]).
    ///
    /// # Errors
    ///
    /// As for [`RadialProfile::sample`].
    pub fn new(
        field: &dyn GroundField,
        vehicle: &Vehicle,
        line: DuctLine,
        reach: f64,
        accuracy: f64,
    ) -> Result<Self, GroundError> {
        checked("reach", reach, "finite and positive", |v| v > 0.0)?;
        let sign = vehicle.direction().sign();
        // Reverse traffic is the mirror image of forward traffic: the wheels stay on their side of the duct.
        let placed = |x: f64, y: f64| (sign * x, y - line.lateral_offset);
        let farthest = vehicle
            .wheels()
            .iter()
            .map(|wheel| {
                let (x, side) = placed(wheel.x, wheel.y);
                (reach + x.abs()).hypot(side)
            })
            .fold(0.0, f64::max);

        let mut contact_radii: Vec<f64> = Vec::new();
        let mut wheels = Vec::new();
        for wheel in vehicle.wheels() {
            let contact_radius = wheel.load.contact_radius();
            let known = contact_radii.iter().position(|&other| other == contact_radius);
            let profile = known.unwrap_or_else(|| {
                contact_radii.push(contact_radius);
                contact_radii.len() - 1
            });
            let (x, side) = placed(wheel.x, wheel.y);
            wheels.push(WheelLine {
                profile,
                x,
                side,
                force: wheel.load.force(),
            });
        }
        let profiles = contact_radii
            .iter()
            .map(|&radius| RadialProfile::sample(field, radius, line.depth, farthest, accuracy))
            .collect::<Result<Vec<_>, _>>()?;

        let mut motion = Self {
            profiles,
            wheels,
            velocity: vehicle.velocity(),
            factor: 1.0,
            peak_longitudinal: 0.0,
            peak_vertical: 0.0,
        };
        motion.find_peaks(line.depth);
        Ok(motion)
    }

    /// The same motion with all displacements multiplied by `factor`: a softer or stiffer ground of the same shape.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.factor *= factor;
        self.peak_longitudinal *= factor.abs();
        self.peak_vertical *= factor.abs();
        self
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

    /// D_l at the equally spaced points `first`, `first + spacing`, … \[m\].
    pub fn sample_longitudinal(&self, first: f64, spacing: f64, count: usize) -> Vec<f64> {
        (0..count)
            .map(|k| self.longitudinal(first + spacing * k as f64))
            .collect()
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

    /// How many radii the ground model was asked for.
    pub fn samples(&self) -> usize {
        self.profiles.iter().map(RadialProfile::samples).sum()
    }

    fn point(&self, xi: f64) -> Point {
        let mut sum = Point::default();
        for wheel in &self.wheels {
            let ahead = xi - wheel.x;
            let radius = ahead.hypot(wheel.side);
            let at = self.profiles[wheel.profile].at(radius);
            // d(ahead · u_r/r)/dξ; the slope of u_r/r vanishes on the axis.
            let bend = if radius > 0.0 {
                at.ratio_slope * ahead * ahead / radius
            } else {
                0.0
            };
            let force = wheel.force * self.factor;
            sum.longitudinal += force * at.ratio * ahead;
            sum.gradient += force * (at.ratio + bend);
            sum.vertical += force * at.vertical;
        }
        sum
    }

    /// Scans once all that lies around the wheels for both peaks, then closes in on each.
    fn find_peaks(&mut self, depth: f64) {
        let mut positions: Vec<f64> = self.wheels.iter().map(|wheel| wheel.x).collect();
        positions.sort_by(f64::total_cmp);
        // The field under one wheel has the width of its distance: the nearest wheel's is the narrowest, the farthest one's the widest.
        let distances = self.wheels.iter().map(|wheel| depth.hypot(wheel.side));
        let (nearest, farthest) = distances.fold((f64::INFINITY, 0.0_f64), |(low, high), distance| {
            (low.min(distance), high.max(distance))
        });
        let step = SCAN_STEP * nearest;
        let (mut longitudinal, mut vertical) = ((0.0, 0.0_f64), (0.0, 0.0_f64));
        let mut xi = f64::NEG_INFINITY;
        for x in positions {
            xi = xi.max(x - SCAN_REACH * farthest);
            while xi <= x + SCAN_REACH * farthest {
                let point = self.point(xi);
                if point.longitudinal.abs() > longitudinal.1 {
                    longitudinal = (xi, point.longitudinal.abs());
                }
                if point.vertical.abs() > vertical.1 {
                    vertical = (xi, point.vertical.abs());
                }
                xi += step;
            }
        }
        self.peak_longitudinal = largest_near(longitudinal.0, step, |xi| self.point(xi).longitudinal.abs());
        self.peak_vertical = largest_near(vertical.0, step, |xi| self.point(xi).vertical.abs());
    }
}

/// Maximum of a smooth single bump within `step` of `around`, by golden section.
fn largest_near(around: f64, step: f64, value: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (around - step, around + step);
    // The bracket shrinks to 1e-8 of a step, where the bump is flat to rounding.
    for _ in 0..40 {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if value(left) > value(right) {
            high = right;
        } else {
            low = left;
        }
    }
    value(0.5 * (low + high)).max(value(around))
}
