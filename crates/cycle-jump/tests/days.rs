//! Days with few real passes against the simulation of every pass, on the same mesh.

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, PassOutcome, Passage, QuasiStatic,
    Restraint,
};
use cycle_jump::days::{DailyHeat, Day, Days, DaysRequest, Extremes, LockedLaw, evolve_days};
use cycle_jump::{Guide, JumpError, Jumps, Next};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, SurfaceLoad, Vehicle, Wheel};

use super::assert_near;

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
    coulomb: bool,
    days: u64,
    knots: u64,
    max_days: (u64, u64),
}

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
            coulomb: false,
            days: 3,
            knots: 24,
            max_days: (150, 1000),
        }
    }
}

impl Scene {
    fn live(&self, knots: u64, every_day: bool) -> Outcome<Days> {
        let angle = self.slope.atan();
        let limit = self.friction * WEIGHT * angle.cos();
        let shape_factor = 2e8 / limit;
        let laws = [FrictionLaw::ElasticPlastic { shape_factor }, FrictionLaw::Coulomb];
        let friction = Friction::new(laws[usize::from(self.coulomb)], limit)?;
        let clamps = self
            .clamps
            .iter()
            .map(|&(position, stiffness)| Restraint::new(position, stiffness));
        let cable = DuctedCable::new(self.length, STIFFNESS, friction)?
            .with_ends(self.ends.0, self.ends.1)?
            .with_restraints(clamps.collect())?
            .with_body_force(-WEIGHT * angle.sin())?;
        let mesh = Mesh::new(self.length, 0.3, 0.15)?;
        let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
        let (line, reach) = (DuctLine::new(1.2, 0.0)?, self.length + 16.0);
        let mut motions = Vec::new();
        for &(load, direction) in self.traffic {
            let load = SurfaceLoad::point(load * 9806.65)?;
            let wheel = Wheel { x: 0.0, y: 0.0, load };
            let truck = Vehicle::new("truck", vec![wheel], 11.1, direction)?;
            motions.push(DuctMotion::new(&ground, &truck, line, reach, 1e-6)?);
        }
        let law = measured_law(&motions, friction)?;
        let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
        let passages = passages(&solver, &motions)?;
        let swing = STIFFNESS * EXPANSION * self.kelvin;
        let profile = self.profile.iter().map(|&(time, share)| (time, share * swing));
        let heat = match self.profile {
            [] => DailyHeat::Cosine {
                lowest: 0.0,
                highest: swing,
            },
            _ => DailyHeat::Profile(profile.collect()),
        };
        let day = Day::new(self.per_day, motions.len(), heat, knots)?;
        let all: Vec<u64> = (1..=self.days).collect();
        let wanted: Vec<u64> = (1..=self.per_day).collect();
        let request = DaysRequest {
            passes: self.per_day * self.days,
            wanted: &wanted,
            wanted_days: &all,
            every_day,
            guide: Guide::Free,
            start: None,
        };
        let one_pass = |next: Next, state: &mut CableState| {
            solver.pass(&passages[next.phase], state).map_err(JumpError::from)
        };
        let jumps = Jumps::new(5e-3, 1.2, (0.01 * limit, 1e-6))?.with_start(3, 0.5)?;
        let jumps = jumps.with_max_passes(self.max_days.0, self.max_days.1);
        let days = evolve_days(&cable, &mesh, (&day, law), &jumps, &request, one_pass);
        Ok(days?)
    }
}

fn passages(solver: &QuasiStatic, motions: &[DuctMotion]) -> Result<Vec<Passage>, CableError> {
    motions
        .iter()
        .map(|motion| solver.passage(motion, 15.0))
        .collect()
}

/// The law of 25 m of cable.
fn measured_law(motions: &[DuctMotion], friction: Friction) -> Outcome<LockedLaw> {
    let mesh = Mesh::new(27.0, 0.3, 0.15)?;
    let q = friction.limit();
    let mut advances = [0.0; LockedLaw::SHARES.len()];
    for (advance, share) in advances.iter_mut().zip(LockedLaw::SHARES) {
        let cable = DuctedCable::new(27.0, STIFFNESS, friction)?.with_body_force(-share * q)?;
        let mut solver = QuasiStatic::new(cable, mesh)?;
        let nodes = mesh.nodes();
        let mut state = CableState::from_parts(&mesh, vec![0.0; nodes], vec![share * q; nodes])?;
        let passages = passages(&solver, motions)?;
        let mut before = 0.0;
        for _ in 0..2 {
            before = state.displacement()[nodes / 2];
            for passage in &passages {
                solver.pass(passage, &mut state)?;
            }
        }
        *advance = state.displacement()[nodes / 2] - before;
    }
    Ok(LockedLaw::new(advances, q))
}

/// Largest error of a force, as a share of the largest that day, and of a movement, as a share of its range, on any day.
fn error(right: &[(u64, Extremes)], found: &[(u64, Extremes)]) -> (f64, f64) {
    assert_eq!(right.len(), found.len());
    let days = right.iter().zip(found);
    days.fold((0.0, 0.0), |worst: (f64, f64), (right, found)| {
        assert_eq!(right.0, found.0);
        let (force, movement) = right.1.difference(&found.1, (1.0, 1e-6));
        (worst.0.max(force), worst.1.max(movement))
    })
}

const FREE: (End, End) = (End::Free, End::Free);
const SHARP: &[(f64, f64)] = &[(0.0, 0.0), (0.25, 1.0)];

/// Short and long, free and held, one way and two, near shakedown, with sharp corners of the temperature.
fn scenes() -> Vec<Scene> {
    use Direction::{Forward, Reverse};
    let of = |name, change: fn(&mut Scene)| {
        let mut scene = Scene {
            name,
            ..Scene::default()
        };
        change(&mut scene);
        scene
    };
    vec![
        of("60 m", |_| {}),
        of("30 m, 800 a day, free on a slope", |scene| {
            (scene.length, scene.per_day, scene.ends, scene.slope) = (30.0, 800, FREE, 0.03);
        }),
        of("60 m, near shakedown", |scene| {
            (scene.friction, scene.traffic) = (0.9, &[(12.0, Forward)]);
        }),
        of("30 m, sharp corners, free on a slope", |scene| {
            (scene.length, scene.per_day, scene.ends, scene.slope) = (30.0, 800, FREE, 0.03);
            (scene.profile, scene.knots) = (SHARP, 48);
        }),
        of("36 m, heavy traffic and little heat, free on a slope", |scene| {
            (scene.length, scene.per_day, scene.kelvin) = (36.0, 240, 0.5);
            (scene.traffic, scene.ends, scene.slope) = (&[(200.0, Forward)], FREE, 0.03);
        }),
        of("30 m, two ways, springs, days that repeat", |scene| {
            scene.traffic = &[(87.0, Forward), (87.0, Reverse), (87.0, Forward)];
            (scene.length, scene.per_day, scene.kelvin) = (30.0, 399, 63.0);
            (scene.ends, scene.days) = ((End::Spring(1e6), End::Spring(1e5)), 6);
        }),
        of("60 m, two ways, a clamp", |scene| {
            (scene.traffic, scene.clamps) = (&[(20.0, Forward), (12.0, Reverse)], &[(45.0, 1e6)]);
        }),
    ]
}

/// Forces and ends of every day within 1.5 %.
fn agrees(scene: &Scene) -> Outcome {
    let right = scene.live(scene.per_day, true)?;
    assert_eq!(right.simulated, scene.per_day * scene.days);
    let found = scene.live(scene.knots, false)?;
    let (force, movement) = error(&right.days, &found.days);
    let (force, movement) = (100.0 * force, 100.0 * movement);
    let of = format!("{} of {} passes", found.simulated, right.simulated);
    let name = scene.name;
    println!("{name}: force {force:.2} %, movement {movement:.2} % with {of}");
    assert!(force < 1.5 && movement < 1.5, "{name}");
    // Few passes were simulated, all that were asked for are known, the last one exactly as often as the first.
    assert!(found.simulated < right.simulated / 3);
    assert_eq!(found.records.len(), right.records.len());
    let largest = right.extremes.largest_force();
    for (right, found) in right.records.iter().zip(&found.records) {
        assert_eq!(right.pass, found.pass);
        let apart = (right.outcome.max_compression - found.outcome.max_compression).abs() / largest;
        assert!(apart < 0.03, "{}: pass {}: {apart}", scene.name, right.pass);
    }
    Ok(())
}

#[test]
fn days_with_few_real_passes_are_those_of_every_pass() -> Outcome {
    scenes().iter().try_for_each(agrees)
}

/// Twenty years cost a few days.
#[test]
fn days_repeat_in_the_end_but_for_a_drift() -> Outcome {
    let mut scene = scenes().swap_remove(1);
    // Every pass of the first four days: they repeat from the second on.
    scene.days = 4;
    let right = scene.live(scene.per_day, true)?;
    let place = |day: &(u64, Extremes)| day.1.displacement[0][1];
    scene.days = 7305;
    let years = scene.live(scene.knots, false)?;
    let last = &years.days[years.days.len() - 1];
    assert!(years.simulated < 400 && years.periodic_from.is_some_and(|day| day < 40));
    let drift = place(&right.days[3]) - place(&right.days[2]);
    assert_near(years.drift, drift, 5e-3 * drift.abs());
    // Forces stay those of the fourth day, and the ends are as far as the drift has brought them.
    let (force, _) = right.days[3].1.difference(&last.1, (1.0, 1.0));
    assert!(force < 0.015, "{force}");
    let expected = place(&right.days[3]) + years.drift * 7301.0;
    assert_near(place(last), expected, 1e-3 * expected.abs());
    assert_near(years.extremes.displacement[0][1], place(last), 1e-9);
    Ok(())
}

/// Without traffic a cable does what the closed forms say, day after day.
#[test]
fn without_traffic_only_heat_moves_the_cable() -> Outcome {
    let scene = Scene {
        length: 160.0,
        traffic: &[(0.0, Direction::Forward)],
        ends: FREE,
        kelvin: 10.0,
        days: 50,
        coulomb: true,
        ..Scene::default()
    };
    let lived = scene.live(24, false)?;
    let force = STIFFNESS * EXPANSION * 10.0;
    let moved = force * force / (2.0 * 0.25 * WEIGHT * STIFFNESS);
    for (day, extremes) in &lived.days {
        assert_near(extremes.compression, force, 1e-2 * force);
        let [least, most] = extremes.displacement[1];
        assert_near(most, moved, 1e-2 * moved);
        let stays = if *day == 1 { 0.0 } else { 0.5 * moved };
        assert_near(least, stays, 1e-2 * moved);
    }
    Ok(())
}

#[test]
fn days_that_take_too_long_are_given_up() {
    let scene = Scene {
        length: 300.0,
        days: 400,
        max_days: (0, 5),
        ..Scene::default()
    };
    // 300 m do not settle in five days.
    let error = scene.live(24, false).expect_err("too many days").to_string();
    assert!(error.contains("still differ from day to day"), "{error}");
}

#[test]
fn what_is_no_day_is_refused() -> Outcome {
    let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * WEIGHT)?;
    let mesh = Mesh::new(6.0, 0.3, 0.15)?;
    let cable = DuctedCable::new(6.0, STIFFNESS, friction)?;
    let jumps = Jumps::new(5e-3, 1.2, (1.0, 1e-6))?;
    let noon = || DailyHeat::Cosine {
        lowest: 0.0,
        highest: 1.0,
    };
    let is_refused = |error: JumpError| matches!(error, JumpError::InvalidParameter { .. });
    for bad in [
        Day::new(1, 2, noon(), 2),
        Day::new(10, 0, noon(), 2),
        Day::new(10, 2, noon(), 0),
        Day::new(10, 2, DailyHeat::Profile(Vec::new()), 2),
    ] {
        assert!(bad.is_err_and(is_refused));
    }
    let day = Day::new(10, 2, noon(), 2)?;
    let days = |passes: u64, wanted: &[u64]| {
        let request = DaysRequest {
            passes,
            wanted,
            wanted_days: &[1, 2],
            every_day: false,
            guide: Guide::Free,
            start: None,
        };
        let law = LockedLaw::new([0.0; LockedLaw::SHARES.len()], friction.limit());
        // No vehicle moves this cable.
        let pass =
            |_: Next, state: &mut CableState| PassOutcome::at_rest(&cable, state).map_err(JumpError::from);
        evolve_days(&cable, &mesh, (&day, law), &jumps, &request, pass)
    };
    assert!(days(20, &[20]).is_ok());
    assert!(days(0, &[20]).is_err_and(is_refused));
    // What does not come is not known.
    let records = days(20, &[0, 21, 20])?.records;
    assert!(records.iter().map(|record| record.pass).eq([20]));
    Ok(())
}
