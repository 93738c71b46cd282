//! Days with few real passes against the simulation of every pass, on the same mesh.

use boussinesq::HalfSpace;
use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic, Restraint};
use cycle_jump::days::{DailyHeat, Day, DayRecord, Days, DaysRequest, LockedLaw, live};
use cycle_jump::{JumpError, Next};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, SurfaceLoad, Vehicle, Wheel};

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

const EXPANSION: f64 = 17e-6;
const STIFFNESS: f64 = 8.01e6;
const WEIGHT: f64 = 108.8;

/// A cable under traffic and heat.
struct Scene {
    name: &'static str,
    length: f64,
    ends: (End, End),
    clamps: &'static [(f64, f64)],
    /// tan θ.
    slope: f64,
    /// Load \[tf\] and direction of each vehicle of a period.
    traffic: &'static [(f64, Direction)],
    per_day: u64,
    kelvin: f64,
    /// Times and shares of the swing, for a profile.
    profile: &'static [(f64, f64)],
    friction: f64,
    days: u64,
}

const SPRING: fn(f64) -> End = End::Spring;

impl Default for Scene {
    fn default() -> Self {
        Self {
            name: "",
            length: 60.0,
            ends: (End::Free, End::Fixed),
            clamps: &[],
            slope: 0.0,
            traffic: &[(20.0, Direction::Forward)],
            per_day: 480,
            kelvin: 20.0,
            profile: &[],
            friction: 0.25,
            days: 3,
        }
    }
}

impl Scene {
    fn live(&self, knots: u64, every_day: bool) -> Outcome<Days> {
        let angle = self.slope.atan();
        let limit = self.friction * WEIGHT * angle.cos();
        let law = FrictionLaw::ElasticPlastic {
            shape_factor: 2e8 / limit,
        };
        let friction = Friction::new(law, limit)?;
        let clamps = self
            .clamps
            .iter()
            .map(|&(position, stiffness)| Restraint { position, stiffness });
        let cable = DuctedCable::new(self.length, STIFFNESS, friction)?
            .with_ends(self.ends.0, self.ends.1)?
            .with_restraints(clamps.collect())?
            .with_body_force(-WEIGHT * angle.sin())?;
        let mesh = Mesh::new(self.length, 0.3, 0.15)?;
        let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
        let motions: Vec<DuctMotion> = self
            .traffic
            .iter()
            .map(|&(load, direction)| -> Outcome<DuctMotion> {
                let wheel = Wheel {
                    x: 0.0,
                    y: 0.0,
                    load: SurfaceLoad::point(load * 9806.65)?,
                };
                let truck = Vehicle::new("truck", vec![wheel], 11.1, direction)?;
                Ok(DuctMotion::new(
                    &ground,
                    &truck,
                    DuctLine::new(1.2, 0.0)?,
                    self.length + 16.0,
                    1e-6,
                )?)
            })
            .collect::<Outcome<_>>()?;
        let law = measured_law(&motions, friction)?;
        let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
        let passages: Vec<Passage> = motions
            .iter()
            .map(|motion| solver.passage(motion, 15.0))
            .collect::<Result<_, _>>()?;
        let swing = STIFFNESS * EXPANSION * self.kelvin;
        let heat = if self.profile.is_empty() {
            DailyHeat::Cosine {
                lowest: 0.0,
                highest: swing,
            }
        } else {
            DailyHeat::Profile(
                self.profile
                    .iter()
                    .map(|&(time, share)| (time, share * swing))
                    .collect(),
            )
        };
        let day = Day {
            passes: self.per_day,
            period: motions.len(),
            heat,
            knots,
        };
        let all: Vec<u64> = (1..=self.days).collect();
        let wanted: Vec<u64> = (1..=self.per_day).collect();
        let request = DaysRequest {
            passes: self.per_day * self.days,
            wanted: &wanted,
            wanted_days: &all,
            tolerance: 5e-3,
            least: (0.01 * limit, 1e-6),
            every_day,
        };
        let one_pass = |next: Next, state: &mut CableState| {
            solver.pass(&passages[next.phase], state).map_err(JumpError::from)
        };
        Ok(live(&cable, &mesh, &day, law, &request, one_pass)?)
    }
}

/// The law of 25 m of cable.
fn measured_law(motions: &[DuctMotion], friction: Friction) -> Outcome<LockedLaw> {
    let mesh = Mesh::new(27.0, 0.3, 0.15)?;
    let q = friction.limit();
    let mut advances = Vec::new();
    for share in LockedLaw::SHARES {
        let cable = DuctedCable::new(27.0, STIFFNESS, friction)?.with_body_force(-share * q)?;
        let mut solver = QuasiStatic::new(cable, mesh)?;
        let nodes = mesh.nodes();
        let mut state = CableState::from_parts(&mesh, vec![0.0; nodes], vec![share * q; nodes])?;
        let passages: Vec<Passage> = motions
            .iter()
            .map(|motion| solver.passage(motion, 15.0))
            .collect::<Result<_, _>>()?;
        let mut before = 0.0;
        for _ in 0..2 {
            before = state.displacement()[nodes / 2];
            for passage in &passages {
                solver.pass(passage, &mut state)?;
            }
        }
        advances.push(state.displacement()[nodes / 2] - before);
    }
    println!("{advances:.2?}");
    Ok(LockedLaw::new(&advances, q))
}

/// Largest error of a force and a movement on any day, and where.
fn error(right: &[DayRecord], found: &[DayRecord]) -> (f64, f64, u64) {
    right
        .iter()
        .zip(found)
        .fold((0.0, 0.0, 0), |worst: (f64, f64, u64), (right, found)| {
            assert_eq!(right.day, found.day);
            let (force, movement) = right.extremes.difference(&found.extremes, (1.0, 1e-6));
            (
                worst.0.max(force),
                worst.1.max(movement),
                if force > worst.0 { right.day } else { worst.2 },
            )
        })
}

#[test]
#[ignore = "explores"]
fn explore() -> Outcome {
    use Direction::{Forward, Reverse};
    let sharp: &'static [(f64, f64)] = &[(0.0, 0.0), (0.25, 1.0)];
    let scenes = [
        Scene {
            name: "L300",
            length: 300.0,
            per_day: 800,
            days: 6,
            ..Scene::default()
        },
        Scene {
            name: "L300 sp",
            length: 300.0,
            per_day: 800,
            days: 4,
            kelvin: 40.0,
            slope: 0.03,
            ends: (SPRING(1e6), SPRING(1e5)),
            ..Scene::default()
        },
        Scene {
            name: "A30 6",
            length: 30.0,
            per_day: 800,
            days: 20,
            ends: (End::Free, End::Free),
            slope: 0.03,
            ..Scene::default()
        },
        Scene {
            name: "S60",
            ..Scene::default()
        },
        Scene {
            name: "S60ff",
            ends: (End::Free, End::Free),
            slope: 0.03,
            ..Scene::default()
        },
        Scene {
            name: "A30",
            length: 30.0,
            per_day: 800,
            ..Scene::default()
        },
        Scene {
            name: "A30ff",
            length: 30.0,
            per_day: 800,
            ends: (End::Free, End::Free),
            slope: 0.03,
            ..Scene::default()
        },
        Scene {
            name: "S60sp",
            ends: (SPRING(1e6), SPRING(1e5)),
            ..Scene::default()
        },
        Scene {
            name: "S60tw",
            traffic: &[(20.0, Forward), (12.0, Reverse)],
            clamps: &[(45.0, 1e6)],
            ..Scene::default()
        },
        Scene {
            name: "R192ff",
            length: 100.0,
            per_day: 192,
            ends: (End::Free, End::Free),
            slope: 0.03,
            kelvin: 40.0,
            ..Scene::default()
        },
        Scene {
            name: "S60 sharp",
            profile: sharp,
            ..Scene::default()
        },
        Scene {
            name: "A30ff sharp",
            length: 30.0,
            per_day: 800,
            ends: (End::Free, End::Free),
            slope: 0.03,
            profile: sharp,
            ..Scene::default()
        },
        Scene {
            name: "shk",
            friction: 0.9,
            traffic: &[(12.0, Forward)],
            ..Scene::default()
        },
    ];
    for scene in scenes {
        let begin = std::time::Instant::now();
        let right = scene.live(scene.per_day, true)?;
        println!(
            "{}: {} passes {:.1?}, drift {:.4}",
            scene.name,
            right.simulated,
            begin.elapsed(),
            1e3 * right.drift
        );
        for knots in [24, 48, 96] {
            let begin = std::time::Instant::now();
            let found = scene.live(knots, false)?;
            for (r, f) in right.days.iter().zip(&found.days) {
                let d = r.extremes.difference(&f.extremes, (1.0, 1e-6));
                print!(" {:.2}/{:.2}", 100.0 * d.0, 100.0 * d.1);
            }
            let (force, movement, day) = error(&right.days, &found.days);
            let passes =
                right
                    .records
                    .iter()
                    .zip(&found.records)
                    .fold((0.0_f64, 0), |worst, (right, found)| {
                        let apart = (right.outcome.force.downstream - found.outcome.force.downstream).abs();
                        let apart =
                            apart.max((right.outcome.force.upstream - found.outcome.force.upstream).abs());
                        if apart > worst.0 {
                            (apart, right.pass)
                        } else {
                            worst
                        }
                    });
            println!(
                "  K {knots}: force {:.2} % (day {day}), movement {:.2} %; passes of day 1: {:.2} % at {}; {} passes, {} sweeps, {} corrected, {:.1?}",
                100.0 * force,
                100.0 * movement,
                100.0 * passes.0 / right.extremes.largest_force(),
                passes.1,
                found.simulated,
                found.sweeps,
                found.corrected,
                begin.elapsed()
            );
            let e = [
                right.days.last().unwrap().extremes,
                found.days.last().unwrap().extremes,
            ];
            for e in e {
                println!(
                    "     {:.1?} {:.1?} C {:.1} T {:.1} {:.3?} {:.3?}",
                    (e.most.upstream, e.most.downstream),
                    (e.least.upstream, e.least.downstream),
                    e.compression,
                    e.tension,
                    e.forward.map(|u| 1e3 * u),
                    e.backward.map(|u| 1e3 * u)
                );
            }
        }
    }
    Ok(())
}

#[test]
#[ignore = "explores"]
fn years() -> Outcome {
    let scenes = [
        Scene {
            name: "L300",
            length: 300.0,
            per_day: 800,
            days: 7305,
            ..Scene::default()
        },
        Scene {
            name: "L300 up",
            length: 300.0,
            per_day: 800,
            days: 7305,
            slope: 0.03,
            ..Scene::default()
        },
        Scene {
            name: "L300ff",
            length: 300.0,
            per_day: 800,
            days: 7305,
            slope: 0.03,
            ends: (End::Free, End::Free),
            ..Scene::default()
        },
        Scene {
            name: "H2c",
            length: 300.0,
            per_day: 48,
            kelvin: 25.0,
            days: 7305,
            ..Scene::default()
        },
        Scene {
            name: "A30",
            length: 30.0,
            per_day: 800,
            days: 7305,
            ..Scene::default()
        },
        Scene {
            name: "A30ff",
            length: 30.0,
            per_day: 800,
            ends: (End::Free, End::Free),
            slope: 0.03,
            days: 7305,
            ..Scene::default()
        },
    ];
    for scene in scenes {
        for knots in [24, 48] {
            let begin = std::time::Instant::now();
            let found = scene.live(knots, false)?;
            let e = found.extremes;
            println!(
                "{} K {knots}: {} passes, {} sweeps, {} corrected, periodic {:?}, drift {:.3} mm, {:.1?}",
                scene.name,
                found.simulated,
                found.sweeps,
                found.corrected,
                found.periodic_from,
                1e3 * found.drift,
                begin.elapsed()
            );
            let d = found.days.last().unwrap().extremes;
            for e in [e, d] {
                println!(
                    "     {:.1?} {:.1?} C {:.1} T {:.1} {:.3?} {:.3?}",
                    (e.most.upstream, e.most.downstream),
                    (e.least.upstream, e.least.downstream),
                    e.compression,
                    e.tension,
                    e.forward.map(|u| 1e3 * u),
                    e.backward.map(|u| 1e3 * u)
                );
            }
        }
    }
    Ok(())
}
