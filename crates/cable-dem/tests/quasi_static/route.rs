//! Ducts of several sections and with bends: an independent chain, closed forms, and what cutting a duct into pieces may not change.

use std::f64::consts::FRAC_PI_2;

use cable_dem::{
    CableState, DuctedCable, End, Mesh, PassOutcome, Passage, RestingCable, Restraint, Section, laid,
};

use super::heat::{extremes_of_days, thermal_force};
use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, cable, coulomb, reference_cable, reference_motion, sheathed,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const WEIGHT: f64 = 108.8;
const LIMIT: f64 = LIMITS[0];
const FRICTION: f64 = 0.25;
const LENGTH: f64 = 60.0;
const PASSES: [usize; 4] = [1, 10, 60, 200];

/// Straight and level.
fn straight(length: f64) -> Section {
    Section::new(length, LIMIT)
}

/// A quarter of a circle.
fn bend(radius: f64) -> Section {
    straight(radius * FRAC_PI_2).with_bend(FRICTION / radius)
}

/// A duct of 60 m with `middle` in its middle.
fn around(middle: Section) -> Vec<Section> {
    let rest = straight(0.5 * (LENGTH - middle.length));
    vec![rest, middle, rest]
}

fn slope(length: f64, tangent: f64) -> Section {
    let cosine = 1.0 / 1.0_f64.hypot(tangent);
    Section::new(length, LIMIT * cosine).with_body_force(-WEIGHT * tangent * cosine)
}

/// A clamp of 5 MN/m in the middle that slips at 200 N.
fn slipping_clamp() -> Restraint {
    Restraint {
        holds: Some(200.0),
        ..Restraint::new(30.0, 5e6)
    }
}

/// Forces on the fixed end \[N\], movements of the free one \[mm\] and forces on the clamp \[N\] after [`PASSES`], by an independent chain:
/// Newton's method with line search on the convex energy, spacing 0.05 m and step 0.025 m; its mesh is good to 0.3 %.
type Reference = (Vec<Section>, Vec<Restraint>, [[f64; 4]; 3]);

#[rustfmt::skip]
fn references() -> Vec<Reference> {
    let rough = Section::new(30.0, 0.35 * WEIGHT);
    vec![
        (vec![straight(60.0)], vec![],
            [[102.225, 288.77, 654.374, 1019.981], [0.01461, 0.25001, 1.6503, 3.63959], [0.0; 4]]),
        (around(bend(10.0)), vec![],
            [[102.225, 288.76, 654.636, 1031.283], [0.01461, 0.25001, 1.65027, 3.67269], [0.0; 4]]),
        (vec![slope(30.0, 0.03), straight(30.0)], vec![],
            [[102.223, 287.694, 626.729, 933.009], [0.01116, 0.21993, 1.48809, 3.14778], [0.0; 4]]),
        (vec![straight(30.0), rough], vec![],
            [[110.141, 298.274, 697.104, 1124.028], [0.01461, 0.25001, 1.63494, 3.77373], [0.0; 4]]),
        (vec![straight(60.0)], vec![slipping_clamp()],
            [[102.215, 278.067, 567.513, 846.076], [0.01461, 0.25001, 1.5157, 3.0096], [95.145, 198.241, 198.241, 198.241]]),
    ]
}

#[test]
fn forces_and_movements_of_routes_are_those_of_an_independent_chain() -> Outcome {
    for (sections, clamps, expected) in references() {
        let cable = reference_cable(LENGTH, sheathed(LIMIT))
            .with_sections(&sections)?
            .with_restraints(clamps)?;
        let mesh = Mesh::new(LENGTH, 0.1, 0.05)?;
        let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH)?;
        let mut run = Run::new(cable.clone(), mesh);
        let mut passed = 0;
        for (k, passes) in PASSES.into_iter().enumerate() {
            let outcome = run.passes(passes - passed, &passage);
            passed = passes;
            let [forces, movements, clamp] = expected;
            for (found, expected, allowed) in [
                (outcome.force.downstream, forces[k], 2e-3 * forces[3]),
                (
                    1e3 * outcome.upstream_displacement,
                    movements[k],
                    3e-3 * movements[3],
                ),
                (outcome.restraints.iter().sum(), clamp[k], 3e-3 * forces[3]),
            ] {
                assert!(
                    (found - expected).abs() <= allowed,
                    "{passes}: {found}, {expected}"
                );
            }
        }
        assert!(run.state.clamp_slips(&cable).iter().all(|slip| *slip > 1e-4));
    }
    Ok(())
}

/// Days with 24 passes and 20 K, by the same independent chain: largest and least force \[N\], largest and least movement \[mm\].
///
/// One of the sixteen is left out: on its first day that chain presses on the bend with the new temperature and the old displacements,
/// which gives 1940.47 N. Here it is the force at the step's end: [`warming_in_many_steps_is_warming_in_one`].
#[test]
fn days_on_routes_are_those_of_an_independent_chain() -> Outcome {
    for (sections, expected) in [
        (
            vec![straight(60.0)],
            [
                [Some(1630.09), Some(-1246.66), Some(0.0088), Some(-14.7663)],
                [Some(1619.63), Some(-1246.67), Some(-5.662), Some(-14.7663)],
            ],
        ),
        (
            around(bend(5.0)),
            [
                [None, Some(-1192.21), Some(0.0088), Some(-14.1744)],
                [Some(1683.4), Some(-1193.49), Some(-6.042), Some(-14.1839)],
            ],
        ),
    ] {
        let cable = reference_cable(LENGTH, sheathed(LIMIT)).with_sections(&sections)?;
        let seen = extremes_of_days(&cable, 0.1, 20.0, 24, 2)?;
        for (seen, expected) in seen.into_iter().zip(expected) {
            for (k, (seen, expected)) in seen.into_iter().zip(expected).enumerate() {
                let Some(expected) = expected else { continue };
                let scale = if k < 2 { 1683.4 } else { 14.7663 };
                assert!((seen - expected).abs() < 2e-3 * scale, "{seen}, {expected}");
            }
        }
    }
    Ok(())
}

/// The cable of [`reference_cable`] cooled until all of it slips towards its fixed end, a little at a time: the tension there \[N\].
fn pulled_through(sections: &[Section], spacing: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let length = sections.iter().map(|section| section.length).sum();
    let cable = reference_cable(length, coulomb(LIMIT)).with_sections(sections)?;
    let mesh = Mesh::new(length, spacing, spacing)?;
    let mut resting = RestingCable::new(&cable, &mesh)?;
    let mut state = laid(&cable, &mesh)?;
    for step in 1..=60 {
        resting.warm(&mut state, -500.0 * f64::from(step))?;
    }
    Ok(-state.end_forces(&cable)?.downstream)
}

/// The capstan with and without weight: T_in cosh μφ + sinh μφ √(T_in² + (wR)²), and T_in e^(μφ).
#[test]
fn a_cable_drawn_through_a_bend_is_a_capstan() -> Outcome {
    let (radius, lead) = (4.0, straight(20.0));
    let (pull, angle): (f64, f64) = (LIMIT * lead.length, FRICTION * FRAC_PI_2);
    let weight = WEIGHT * radius;
    let heavy = pull * angle.cosh() + angle.sinh() * pull.hypot(weight);
    let weightless = Section::new(radius * FRAC_PI_2, 1e-6).with_bend(FRICTION / radius);
    for (bend, expected) in [(bend(radius), heavy), (weightless, pull * angle.exp())] {
        let mut errors = Vec::new();
        for spacing in [0.2, 0.1, 0.05, 0.025] {
            errors.push((pulled_through(&[lead, bend], spacing)? / expected - 1.0).abs());
        }
        assert!(errors[3] < 1e-3, "{errors:?}");
        // Of first order: a fixed end bears no friction on its own half element, past which nothing slips.
        for pair in errors.windows(2) {
            assert!(pair[1] < 0.6 * pair[0], "{errors:?}");
        }
    }
    Ok(())
}

/// While the duct moves far the force changes much in a step, and with it the friction in a bend; where the cable comes to rest it presses on
/// the bend with the force that it has.
#[test]
fn a_cable_at_rest_in_a_bend_needs_no_more_friction_than_there_is() -> Outcome {
    let (length, friction, motion) = (12.0, sheathed(LIMIT), reference_motion().scaled(10.0)?);
    for spacing in [0.5, 0.25, 0.1] {
        let cable = cable(length, 100e6, friction, End::Spring(1e5), End::Spring(1e7))
            .with_sections(&[straight(length).with_bend(FRICTION / 2.0)])?;
        let mesh = Mesh::new(length, spacing, 0.5 * spacing)?;
        let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
        let mut run = Run::new(cable.clone(), mesh);
        for pass in 1..=3 {
            run.pass(&passage);
            let share = run.state.friction_share(&cable)?;
            assert!(share <= 1.0 + 1e-6, "{spacing} m, pass {pass}: {share}");
        }
    }
    Ok(())
}

/// A steep slope above its fixed end under a level duct, whose friction holds part of it: the cable slips on the whole slope and on a
/// length s of the level part, and the strains up to there add up to nothing.
#[test]
fn a_bar_on_two_slopes_hangs_on_the_level_part() -> Outcome {
    let (length, body) = (30.0, 1.3 * LIMIT);
    let sections = [straight(length).with_body_force(-body), straight(length)];
    let bar = cable(
        2.0 * length,
        AXIAL_STIFFNESS,
        coulomb(LIMIT),
        End::Fixed,
        End::Free,
    )
    .with_sections(&sections)?;
    let excess = body - LIMIT;
    // F₀ L − excess L²/2 = T²/(2 q), T = excess L − F₀ the tension at the border.
    let whole = excess * length;
    let half = LIMIT * length;
    let tension = (half * half + whole * half).sqrt() - half;
    let expected = whole - tension;
    let mut errors = Vec::new();
    for spacing in [0.4, 0.2, 0.1, 0.05] {
        let state = laid(&bar, &Mesh::new(2.0 * length, spacing, spacing)?)?;
        errors.push((state.end_forces(&bar)?.upstream / expected - 1.0).abs());
    }
    assert!(errors[3] < 1e-3, "{errors:?}");
    Ok(())
}

/// Passes over a duct, and warm days between.
fn outcomes(bar: &DuctedCable) -> Result<Vec<(PassOutcome, CableState)>, Box<dyn std::error::Error>> {
    let mesh = Mesh::new(LENGTH, 0.3, 0.15)?;
    let passage = Passage::new(bar, &mesh, &reference_motion(), APPROACH)?;
    let mut resting = RestingCable::new(bar, &mesh)?;
    let mut run = Run::new(bar.clone(), mesh);
    let mut all = Vec::new();
    for kelvin in [0.0, 12.0, 3.0] {
        resting.warm(&mut run.state, thermal_force(kelvin))?;
        all.push((run.pass(&passage), run.state.clone()));
    }
    Ok(all)
}

/// Cut into equal sections, with a very wide bend, or with a clamp that never slips instead of one that cannot.
#[test]
fn what_changes_nothing_gives_the_bits_of_the_whole() -> Outcome {
    let bar = cable(
        LENGTH,
        AXIAL_STIFFNESS,
        sheathed(LIMIT),
        End::Spring(1e6),
        End::Fixed,
    );
    let whole = outcomes(&bar)?;
    for sections in [&[straight(LENGTH)][..], &[straight(0.1 * LENGTH); 10]] {
        assert_eq!(outcomes(&bar.clone().with_sections(sections)?)?, whole);
    }
    let wide = straight(LENGTH).with_bend(FRICTION / 1e9);
    for ((bent, _), (straight, _)) in outcomes(&bar.clone().with_sections(&[wide])?)?.iter().zip(&whole) {
        for (a, b) in [
            (bent.force.downstream, straight.force.downstream),
            (bent.force.upstream, straight.force.upstream),
            (bent.peak.downstream, straight.peak.downstream),
        ] {
            assert!((a - b).abs() <= 1e-9 * b.abs(), "{a} N, {b} N");
        }
    }

    let clamped = |holds| {
        let clamp = Restraint {
            holds,
            ..Restraint::new(21.37, 3e6)
        };
        outcomes(&bar.clone().with_restraints(vec![clamp])?)
    };
    for ((one, before), (other, after)) in clamped(None)?.iter().zip(clamped(Some(1e6))?) {
        assert_eq!(*one, other);
        assert_eq!(
            (before.displacement(), before.friction()),
            (after.displacement(), after.friction())
        );
    }
    Ok(())
}

/// However fast the cable is warmed between two passes: the force that presses on a bend is that of the step's end.
#[test]
fn warming_in_many_steps_is_warming_in_one() -> Outcome {
    let bar = reference_cable(LENGTH, sheathed(LIMIT)).with_sections(&around(bend(5.0)))?;
    let mesh = Mesh::new(LENGTH, 0.1, 0.05)?;
    let mut resting = RestingCable::new(&bar, &mesh)?;
    let forces = [1, 16].map(|steps| {
        let mut state = CableState::at_rest(&mesh);
        for step in 1..=steps {
            let kelvin = 20.0 * f64::from(step) / f64::from(steps);
            resting.warm(&mut state, thermal_force(kelvin))?;
        }
        state.end_forces(&bar).map(|force| force.downstream)
    });
    let [at_once, in_steps] = [forces[0].clone()?, forces[1].clone()?];
    assert!(
        (at_once - in_steps).abs() < 1e-5 * at_once,
        "{at_once} N, {in_steps} N"
    );
    Ok(())
}

/// A cable that slips all along pulls with its friction and what its clamp holds.
#[test]
fn a_clamp_that_slips_at_once_adds_what_it_holds() -> Outcome {
    let bar = reference_cable(10.0, coulomb(LIMIT));
    let mesh = Mesh::new(10.0, 0.1, 0.1)?;
    let mut tensions = Vec::new();
    for clamps in [
        vec![],
        vec![Restraint {
            holds: Some(150.0),
            ..Restraint::new(4.03, 1e7)
        }],
    ] {
        let bar = bar.clone().with_restraints(clamps)?;
        let mut state = laid(&bar, &mesh)?;
        RestingCable::new(&bar, &mesh)?.warm(&mut state, -20_000.0)?;
        tensions.push(-state.end_forces(&bar)?.downstream);
        let slipped = state.clamp_slips(&bar).first().unwrap_or(&0.0)
            + state.restraint_forces(&bar)?.iter().sum::<f64>() / 1e7;
        let here = state.displacement()[40] + 0.3 * (state.displacement()[41] - state.displacement()[40]);
        assert!(
            tensions.len() == 1 || (slipped - here).abs() < 1e-12,
            "{slipped} m, {here} m"
        );
    }
    assert!((tensions[1] - tensions[0] - 150.0).abs() < 1e-6, "{tensions:?}");
    Ok(())
}
