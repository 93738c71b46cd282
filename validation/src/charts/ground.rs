//! Chart 1: what the motion of the duct costs, by model of the ground, knob and accuracy.
//!
//! A wheel of 20 tf on a disc of 0.15 m radius, a duct 1.2 m deep. A profile is what a run needs: the model made, the motion
//! sampled, D_l evaluated at 301 points to 15 m on either side. Its error is the largest difference from the exact D_l as a share
//! of the largest |D_l|. Exact is the closed form on homogeneous ground and elsewhere an independent quadrature
//! ([`crate::ground_reference`]), with which the crate `burmister` at 1e-11 has to agree to 1e-10, or no chart is drawn.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use ground_field::{
    Base, Direction, Displacement, DuctLine, DuctMotion, GroundError, GroundField, Soil, SoilLayer,
    SoilProfile, SurfaceLoad, Vehicle, Wheel,
};
use layered_fem::LayeredFem;

use crate::Failure;
use crate::ground_reference;
use crate::precision::{Figure, Point};

const DEPTH: f64 = 1.2;
const REACH: f64 = 15.0;
const FORCE: f64 = 196_133.0;
const CONTACT_RADIUS: f64 = 0.15;
/// Each time is the median of this many, or of fewer where one takes long.
const TIMINGS: usize = 15;
/// Seconds after which no further timing is made.
const PATIENCE: f64 = 0.3;

/// A method with its knob: from an accuracy to a motion and a count of what it took.
struct Method {
    name: &'static str,
    /// What is counted.
    unit: &'static str,
    knobs: &'static [f64],
    run: fn(&SoilProfile, f64) -> Answer,
}

/// A motion and what it took, or why not.
type Answer = Result<(DuctMotion, usize), GroundError>;

const CLOSED: &[f64] = &[1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const TRANSFORM: &[f64] = &[0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
const ELEMENTS: &[f64] = &[0.1, 0.01, 5e-3, 3e-3, 1e-3, 3e-4, 1e-4];

const METHODS: [Method; 3] = [
    Method {
        name: "boussinesq",
        unit: "evaluations",
        knobs: CLOSED,
        run: |profile, accuracy| {
            // On layers: the base's soil alone, what a hand calculation would take.
            let soil = match profile.base() {
                Base::HalfSpace(soil) => soil,
                Base::Rigid => {
                    return Err(GroundError::Unsupported {
                        model: "boussinesq",
                        limit: "rock",
                    });
                }
            };
            let motion = motion(&HalfSpace::new(soil), accuracy)?;
            let count = motion.samples();
            Ok((motion, count))
        },
    },
    Method {
        name: "burmister",
        unit: "wavenumbers",
        knobs: TRANSFORM,
        run: |profile, accuracy| {
            // The transform ten times as accurate as the curve through it, as in a run.
            let field = Counted {
                ground: LayeredHalfSpace::new(profile)?.with_accuracy(0.1 * accuracy)?,
                wavenumbers: AtomicUsize::new(0),
            };
            let motion = motion(&field, accuracy)?;
            Ok((motion, field.wavenumbers.into_inner()))
        },
    },
    Method {
        name: "fem",
        unit: "unknowns",
        knobs: ELEMENTS,
        run: |profile, accuracy| {
            let ground = LayeredFem::new(profile, accuracy)?;
            let motion = motion(&ground, accuracy)?;
            Ok((motion, ground.unknowns()))
        },
    },
];

fn motion(field: &dyn GroundField, accuracy: f64) -> Result<DuctMotion, GroundError> {
    let wheel = Wheel {
        x: 0.0,
        y: 0.0,
        load: load()?,
    };
    let vehicle = Vehicle::new("wheel", vec![wheel], 11.0, Direction::Forward)?;
    DuctMotion::new(field, &vehicle, DuctLine::new(DEPTH, 0.0)?, REACH, accuracy)
}

fn load() -> Result<SurfaceLoad, GroundError> {
    SurfaceLoad::new(FORCE, CONTACT_RADIUS)
}

fn positions() -> Vec<f64> {
    (-150..=150).map(|k| 0.1 * f64::from(k)).collect()
}

/// The layered half-space, counting the wavenumbers it solves.
struct Counted {
    ground: LayeredHalfSpace,
    wavenumbers: AtomicUsize,
}

impl GroundField for Counted {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        Ok(self.displacements(load, &[radius], depth)?[0])
    }

    fn displacements(
        &self,
        load: SurfaceLoad,
        radii: &[f64],
        depth: f64,
    ) -> Result<Vec<Displacement>, GroundError> {
        let (values, statistics) = self.ground.displacements_with_statistics(load, radii, depth)?;
        self.wavenumbers
            .fetch_add(statistics.wavenumbers, Ordering::Relaxed);
        Ok(values)
    }
}

/// The four grounds: name and layers as (thickness m, modulus MPa, Poisson's ratio), the last without thickness.
fn grounds() -> Result<Vec<(&'static str, SoilProfile)>, GroundError> {
    let ground = |layers: &[(f64, f64, f64)], base: (f64, f64)| {
        let layers = layers
            .iter()
            .map(|&(thickness, modulus, ratio)| {
                SoilLayer::uniform(thickness, Soil::new(modulus * 1e6, ratio)?)
            })
            .collect::<Result<_, _>>()?;
        SoilProfile::new(layers, Base::HalfSpace(Soil::new(base.0 * 1e6, base.1)?))
    };
    Ok(vec![
        ("homogeneous, 800 MPa", ground(&[], (800.0, 0.4))?),
        // Kashiro et al., Furukawa Review, Table 1.
        (
            "Table 1 of the paper",
            ground(&[(0.05, 4000.0, 0.35), (0.05, 800.0, 0.35)], (800.0, 0.4))?,
        ),
        // Thicknesses of traffic class N6 on a subgrade of CBR 6; moduli: initial values of UFC 3-260-03 for asphalt, stabilised
        // base, unstabilised base and subgrade.
        (
            "N6 pavement on CBR 6",
            ground(
                &[
                    (0.10, 2411.0, 0.35),
                    (0.09, 6890.0, 0.20),
                    (0.25, 207.0, 0.35),
                    (0.25, 207.0, 0.35),
                ],
                (103.0, 0.4),
            )?,
        ),
        // Assumed: 0.2 m of peat-like soil, its underside 0.1 m above the duct.
        (
            "soft band above the duct",
            ground(&[(0.9, 200.0, 0.3), (0.2, 5.0, 0.45)], (200.0, 0.3))?,
        ),
    ])
}

/// Exact D_l at the positions.
fn exact(name: &str, profile: &SoilProfile) -> Result<Vec<f64>, Failure> {
    let radii: Vec<f64> = positions().iter().map(|xi| xi.abs()).collect();
    let signed = |values: Vec<Displacement>| -> Vec<f64> {
        let pairs = positions().into_iter().zip(values);
        pairs.map(|(xi, value)| xi.signum() * value.radial).collect()
    };
    let reference = signed(ground_reference::displacements(profile, load()?, &radii, DEPTH));
    let own = match profile.homogeneous() {
        Some(soil) => HalfSpace::new(soil).displacements(load()?, &radii, DEPTH)?,
        None => LayeredHalfSpace::new(profile)?
            .with_accuracy(1e-11)?
            .displacements(load()?, &radii, DEPTH)?,
    };
    let gap = error(&signed(own), &reference);
    if gap <= 1e-10 {
        Ok(reference)
    } else {
        Err(format!("{name}: two exact answers differ by {gap:.1e} of the peak").into())
    }
}

/// Largest difference as a share of the largest exact value; infinite for what is not a number.
fn error(values: &[f64], exact: &[f64]) -> f64 {
    let peak = exact.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    let gaps = values
        .iter()
        .zip(exact)
        .map(|(value, exact)| (value - exact).abs());
    gaps.fold(0.0, |worst: f64, gap| {
        if gap.is_nan() {
            f64::INFINITY
        } else {
            worst.max(gap / peak)
        }
    })
}

/// The profile's error, cost and count; `None` if the method refuses.
fn measure(method: &Method, profile: &SoilProfile, knob: f64, exact: &[f64]) -> Option<(f64, f64, usize)> {
    let positions = positions();
    let mut times = Vec::new();
    let begin = Instant::now();
    loop {
        let start = Instant::now();
        let (motion, count) = (method.run)(profile, knob).ok()?;
        let values: Vec<f64> = positions.iter().map(|&xi| motion.longitudinal(xi)).collect();
        times.push(start.elapsed().as_secs_f64());
        if times.len() >= TIMINGS || begin.elapsed().as_secs_f64() > PATIENCE {
            times.sort_by(f64::total_cmp);
            return Some((error(&values, exact), times[times.len() / 2], count));
        }
    }
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let grounds = grounds()?;
    let mut points = Vec::new();
    let mut table =
        String::from("ground,method,accuracy_asked,error_share_of_peak,seconds,count,count_unit,outcome\n");
    for (ground, (name, profile)) in grounds.iter().enumerate() {
        let exact = exact(name, profile)?;
        for (number, method) in METHODS.iter().enumerate() {
            for &knob in method.knobs {
                let row = format!("\"{name}\",\"{}\",{knob:e}", method.name);
                let Some((error, seconds, count)) = measure(method, profile, knob, &exact) else {
                    writeln!(table, "{row},,,,{},refused", method.unit)?;
                    continue;
                };
                writeln!(
                    table,
                    "{row},{error:.3e},{seconds:.3e},{count},{},answered",
                    method.unit
                )?;
                points.push(Point {
                    panel: ground,
                    series: number,
                    knob,
                    error,
                    seconds,
                    count: Some(count.max(1) as f64),
                });
            }
        }
    }
    crate::table::write(&out.join("ground.csv"), &table)?;

    let panels: Vec<(String, f64)> = grounds
        .iter()
        .map(|(name, _)| ((*name).to_owned(), 0.0))
        .collect();
    let errors = ("error of D_l, share of its peak", (1e-13, 10.0));
    let seconds = Figure {
        title: "Motion of the duct: error against time, by model of the ground",
        cost: ("time for one profile, s", (1e-5, 20.0)),
        error: errors,
    };
    let names = METHODS.map(|method| method.name.to_owned());
    let svg = seconds.draw(&panels, &names, &points, |point| Some(point.seconds))?;
    std::fs::write(out.join("ground.svg"), svg)?;
    let count = Figure {
        title: "Motion of the duct: error against work, each model in its own unit",
        cost: ("work for one profile", (0.5, 1e6)),
        error: errors,
    };
    let names = METHODS.map(|method| format!("{} ({})", method.name, method.unit));
    let svg = count.draw(&panels, &names, &points, |point| point.count)?;
    std::fs::write(out.join("ground-count.svg"), svg)?;
    // An answered accuracy is kept, or the chart's own claim is wrong.
    for point in &points {
        let (method, ground) = (METHODS[point.series].name, grounds[point.panel].0);
        let promised = method != "boussinesq" || point.panel == 0;
        if promised && point.error > PROMISE * point.knob {
            return Err(format!(
                "{method} on {ground}: {:.1e} where {:.1e} was asked",
                point.error, point.knob
            )
            .into());
        }
    }
    Ok(())
}

/// The field keeps its accuracy and so does the curve through it; the two add up.
const PROMISE: f64 = 2.0;
