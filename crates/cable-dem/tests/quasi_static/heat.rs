//! Heat: closed forms of bars that grow and shrink against friction, and days of traffic against an independent program.

use std::f64::consts::PI;

use cable_dem::{CableError, CableState, DuctedCable, End, Friction, Mesh, Passage, RestingCable};
use ground_field::Direction;
use proptest::prelude::*;

use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, assert_near, cable, coulomb, largest, largest_difference,
    reference_motion, sheathed, unjudged_passage,
};
use super::shared::mirrored;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Thermal expansion of copper \[1/K\].
const EXPANSION: f64 = 17e-6;
const LIMIT: f64 = LIMITS[0];

/// Θ of a cable that is warmer by `kelvin` \[N\].
pub fn thermal_force(kelvin: f64) -> f64 {
    AXIAL_STIFFNESS * EXPANSION * kelvin
}

/// A cable as laid, brought to one temperature after the other.
struct Heated {
    cable: DuctedCable,
    resting: RestingCable,
    state: CableState,
}

impl Heated {
    fn new(length: f64, friction: Friction, ends: (End, End), spacing: f64) -> Result<Self, CableError> {
        let cable = cable(length, AXIAL_STIFFNESS, friction, ends.0, ends.1);
        Self::of(cable, spacing)
    }

    fn of(cable: DuctedCable, spacing: f64) -> Result<Self, CableError> {
        let mesh = Mesh::new(cable.length(), spacing, spacing)?;
        Ok(Self {
            resting: RestingCable::new(&cable, &mesh)?,
            state: cable_dem::laid(&cable, &mesh)?,
            cable,
        })
    }

    /// Brings it to `kelvin`; the movement of its first node and the largest force along it.
    fn to(&mut self, kelvin: f64) -> Result<(f64, f64), CableError> {
        self.resting.warm(&mut self.state, thermal_force(kelvin))?;
        let force = self.state.element_forces(&self.cable)?;
        let largest = force.fold(f64::NEG_INFINITY, f64::max);
        Ok((self.state.displacement()[0], largest))
    }
}

/// Each end of a long bar slides over Θ/q, where friction takes up the force; a short one slides whole.
#[test]
fn free_bars_move_at_their_ends() -> Outcome {
    let free = (End::Free, End::Free);
    let mut bar = Heated::new(160.0, coulomb(LIMIT), free, 0.05)?;
    let force = thermal_force(10.0);
    let moved = force * force / (2.0 * LIMIT * AXIAL_STIFFNESS);
    assert_near(1e3 * moved, 4.2553, 1e-3, "mm");
    let (end, inside) = bar.to(10.0)?;
    assert_near(inside, force, 1e-9 * force, "N");
    assert_near(end, -moved, 1e-5 * moved, "m");
    // Friction has to turn over on the way back (Masing): half of the movement stays.
    assert_near(bar.to(0.0)?.0, -0.5 * moved, 5e-6 * moved, "m");

    let (length, kelvin) = (60.0, 30.0);
    let (end, inside) = Heated::new(length, coulomb(LIMIT), free, 0.1)?.to(kelvin)?;
    let moved = 0.5 * EXPANSION * kelvin * length - LIMIT * length * length / (8.0 * AXIAL_STIFFNESS);
    assert_near(end, -moved, 1e-5 * moved, "m");
    // The middle node has no side to slip to.
    let force = 0.5 * LIMIT * (length - 0.1);
    assert_near(inside, force, 1e-9 * force, "N");
    Ok(())
}

/// Between two fixed ends nothing moves, and the whole cable shows the force of its heat, also under a vehicle that moves nothing.
#[test]
fn nothing_moves_between_fixed_ends() -> Outcome {
    for friction in [coulomb(LIMIT), sheathed(LIMIT)] {
        let mut bar = Heated::new(60.0, friction, (End::Fixed, End::Fixed), 0.1)?;
        let (_, inside) = bar.to(20.0)?;
        assert_near(inside, 2723.4, 2.7234e-3, "N");
        assert!(bar.state.displacement().iter().all(|u| u.abs() < 1e-15));
        let mesh = Mesh::new(60.0, 0.1, 0.1)?;
        let still = Passage::from_shape(&bar.cable, &mesh, Direction::Forward, |_| 0.0, APPROACH)?;
        let mut run = Run::new(bar.cable.clone(), mesh);
        run.state = bar.state;
        let mut seen = 0;
        run.watch(&still, |_, state| {
            let ends = state.end_forces(&bar.cable).expect("a cable as long as its mesh");
            for force in [ends.upstream, ends.downstream] {
                assert_near(force, inside, 1e-9 * inside, "N");
            }
            seen += 1;
        });
        assert!(seen > 0);
    }
    Ok(())
}

/// A bar that slides whole on a slope creeps down by (p/q) L (αΔT − (q − p) L/EA) … in every cycle.
#[test]
fn a_free_bar_walks_down_a_slope() -> Outcome {
    let length = 40.0;
    for (body_force, kelvin) in [(3.0, 30.0), (8.0, 20.0), (-8.0, 40.0)] {
        let free = cable(length, AXIAL_STIFFNESS, coulomb(LIMIT), End::Free, End::Free);
        let mut bar = Heated::of(free.with_body_force(body_force)?, 0.05)?;
        let mut ends = Vec::new();
        for _ in 0..6 {
            bar.to(kelvin)?;
            ends.push(bar.to(0.0)?.0);
        }
        let p: f64 = body_force.abs();
        let step = p / LIMIT * length * (EXPANSION * kelvin - (LIMIT - p) * length / AXIAL_STIFFNESS);
        let walked = step.max(0.0).copysign(body_force);
        assert_near(
            ends[5] - ends[4],
            walked,
            0.02 * walked.abs(),
            (body_force, kelvin),
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// One step or many: only the turns of the temperature count.
    #[test]
    fn the_number_of_steps_does_not_matter(
        length in 5.0_f64..80.0,
        sheath in prop::bool::ANY,
        spring in 3.0_f64..8.0,
        kelvin in (1.0_f64..60.0, -20.0_f64..60.0),
    ) {
        let friction = if sheath { sheathed(LIMIT) } else { coulomb(LIMIT) };
        // Against a fixed end no node turns back while the temperature goes one way.
        let ends = (End::Spring(10_f64.powf(spring)), End::Fixed);
        let make = || Heated::new(length, friction, ends, length / 100.0);
        let (mut one, mut many) = (make()?, make()?);
        let mut before = 0.0;
        for kelvin in [kelvin.0, kelvin.1] {
            one.to(kelvin)?;
            for step in 1..=7 {
                many.to(before + (kelvin - before) * f64::from(step) / 7.0)?;
            }
            before = kelvin;
            let moved = largest(one.state.displacement().iter().copied()).max(1e-6);
            let apart = largest_difference(one.state.displacement(), many.state.displacement());
            prop_assert!(apart < 1e-7 * moved, "{apart} of {moved}");
        }
    }

    /// In the mirror ends and slope change places, and a cable that is warm pushes as hard.
    #[test]
    fn heat_in_the_mirror_mirrors_the_answer(
        length in 5.0_f64..40.0,
        spring in 3.0_f64..8.0,
        body_force in -10.0_f64..10.0,
        kelvin in -30.0_f64..60.0,
    ) {
        let held = cable(length, AXIAL_STIFFNESS, sheathed(LIMIT), End::Spring(10_f64.powf(spring)), End::Free)
            .with_body_force(body_force)?;
        let mesh = Mesh::for_depth(length, 1.2, 6.0)?;
        let motion = reference_motion();
        let shape = |xi: f64| motion.longitudinal(xi);
        let after = |cable: &DuctedCable, direction| -> Result<CableState, CableError> {
            let passage = Passage::from_shape(cable, &mesh, direction, shape, APPROACH)?;
            let mut run = Run::new(cable.clone(), mesh);
            let mut resting = RestingCable::new(cable, &mesh)?;
            for part in [0.3, 1.0, 0.5] {
                resting.warm(&mut run.state, thermal_force(part * kelvin))?;
                run.pass(&passage);
            }
            Ok(run.state)
        };
        let mirrored = mirrored(&held)?;
        let (one, other) = (after(&held, Direction::Forward)?, after(&mirrored, Direction::Reverse)?);
        let ends = (one.end_forces(&held)?, other.end_forces(&mirrored)?);
        let apart = one.displacement().iter().rev().zip(other.displacement()).map(|(a, b)| (a + b).abs());
        let moved = largest(one.displacement().iter().copied()).max(1e-6);
        // Each of some hundred steps is exact to 1e-9 of the friction limit.
        prop_assert!(apart.fold(0.0, f64::max) < 1e-7 * moved);
        prop_assert!((ends.0.upstream - ends.1.downstream).abs() < 1e-7 * LIMIT * length);
    }
}

/// Upstream and downstream end, length \[m\], K, passes a day, days; and on the first and the last of them the downstream force at most and at
/// least \[N\] and the upstream end at most, at least and at the day's end \[mm\].
type Day = ((End, End), f64, f64, usize, usize, [[f64; 5]; 2]);

const JOINT: (End, End) = (End::Free, End::Fixed);
const SPRUNG: (End, End) = (End::Spring(1e6), End::Spring(1e6));

#[rustfmt::skip]
const DAYS: [Day; 5] = [
    (JOINT, 30.0, 20.0, 24, 6, [[814.1, -815.2, 0.009, -8.899, -1.396], [814.1, -815.2, -1.324, -8.899, -1.396]]),
    (JOINT, 30.0, 40.0, 24, 6, [[814.1, -815.2, 0.003, -19.055, -1.436], [814.1, -815.2, -1.378, -19.055, -1.436]]),
    (JOINT, 100.0, 20.0, 48, 4, [[2612.5, -460.3, 0.025, -18.250, -9.586], [2275.2, -535.7, -9.786, -19.001, -10.030]]),
    ((End::Free, End::Free), 100.0, 20.0, 48, 4, [[0.0, 0.0, 0.025, -13.310, -3.237], [0.0, 0.0, 0.166, -9.908, 0.166]]),
    (SPRUNG, 30.0, 20.0, 24, 4, [[1768.5, 0.4, 0.008, -1.671, 0.008], [1787.7, 188.7, 0.040, -1.653, 0.013]]),
];

/// An independent full-chain program: passes evenly over the day, the cable brought to the day's temperature, a cosine, before each.
#[test]
fn days_of_traffic_are_those_of_an_independent_program() -> Outcome {
    for (ends, length, kelvin, passes, days, expected) in DAYS {
        let spacing = if length < 50.0 { 0.1 } else { 0.2 };
        let bar = cable(length, AXIAL_STIFFNESS, sheathed(LIMIT), ends.0, ends.1);
        let seen = extremes_of_days(&bar, spacing, kelvin, passes, days)?;
        for (day, expected) in [(1, expected[0]), (days, expected[1])] {
            let force = expected[0].abs().max(expected[1].abs()).max(1.0);
            let range = expected[2] - expected[3];
            for (k, (seen, expected)) in seen[day - 1].into_iter().zip(expected).enumerate() {
                let scale = if k < 2 { force } else { range };
                let name = format!("{length} m, {kelvin} K, day {day}");
                let apart = 100.0 * (seen - expected).abs() / scale;
                println!("{name}: {seen:.3} {expected} ({apart:.2} %)");
                assert_near(seen, expected, 0.005 * scale, name);
            }
        }
    }
    Ok(())
}

/// Largest and least force on the downstream end \[N\], largest and least movement of the upstream one and the last of it \[mm\] of each
/// day with so many `passes`, between which the cable is warmed by up to `kelvin` at noon.
pub fn extremes_of_days(
    bar: &DuctedCable,
    spacing: f64,
    kelvin: f64,
    passes: usize,
    days: usize,
) -> Result<Vec<[f64; 5]>, CableError> {
    let mesh = Mesh::new(bar.length(), spacing, 0.5 * spacing)?;
    let passage = unjudged_passage(bar, &mesh, &reference_motion());
    let mut run = Run::new(bar.clone(), mesh);
    let mut resting = RestingCable::new(bar, &mesh)?;
    let mut all = Vec::new();
    for _ in 0..days {
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut seen = [high, low, high, low, 0.0];
        let mut see = |state: &CableState| -> Result<(), CableError> {
            let force = state.end_forces(bar)?.downstream;
            let end = 1e3 * state.displacement()[0];
            let [most, least, farthest, nearest, _] = seen;
            seen = [
                most.max(force),
                least.min(force),
                farthest.max(end),
                nearest.min(end),
                end,
            ];
            Ok(())
        };
        for pass in 0..passes {
            if 2 * pass == passes {
                resting.warm(&mut run.state, thermal_force(kelvin))?;
                see(&run.state)?;
            }
            let time = (pass as f64 + 0.5) / passes as f64;
            let warmed = 0.5 * kelvin * (1.0 - (2.0 * PI * time).cos());
            resting.warm(&mut run.state, thermal_force(warmed))?;
            see(&run.state)?;
            run.pass(&passage);
            see(&run.state)?;
        }
        resting.warm(&mut run.state, 0.0)?;
        see(&run.state)?;
        all.push(seen);
    }
    Ok(all)
}
