//! Clamps and their limits.

use creepage::design::{Design, best};
use creepage::{Limited, Place};

use crate::scenes::run;

use super::grid::{WARM, check_none, designed, held, reached, scene};

#[test]
fn a_clamp_has_limits_of_its_own() {
    let scene = scene(&[]);
    let clamp = Place::Clamp(13.0);
    let free = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let end = (Place::Downstream, Limited::Force, 0.7 * free);
    // The softest clamp that is good enough for the end.
    let soft = designed(&scene, &[clamp], &[end]).answer.expect("a clamp");
    let force = soft.value(clamp, Limited::Force);
    assert_eq!(soft.clamps[0].force_n, force);
    // With less than that on it there is none; with more there is a range, whose ends are the two limits.
    check_none(&scene, &[clamp], &[end, (clamp, Limited::Force, 0.6 * force)]);
    let both = designed(&scene, &[clamp], &[end, (clamp, Limited::Force, 1.2 * force)]);
    let (from, to) = both.range_n_per_m.expect("a range");
    let to = to.expect("an upper end");
    assert!(from < to && both.binding.len() == 2, "{:?}", both.binding);
    let stiffer = held(&scene, &[(clamp, 1.05 * to)]);
    assert!(reached(&stiffer, clamp, Limited::Force) > 1.2 * force);
    // Where it may move little it has to be stiff.
    let half = 0.5 * soft.value(clamp, Limited::Movement);
    let moved = (clamp, Limited::Movement, half);
    let stiff = designed(&scene, &[clamp], &[moved]).answer.expect("a clamp");
    assert!(stiff.stiffness_n_per_m > soft.stiffness_n_per_m);
    let stiff = held(&scene, &[(clamp, stiff.stiffness_n_per_m.expect("a clamp"))]);
    assert!(reached(&stiff, clamp, Limited::Movement) <= moved.2);
}

#[test]
fn of_several_clamps_the_softest_is_the_best() {
    let scene = scene(&[]);
    let free = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let end = [(Place::Downstream, Limited::Force, 0.6 * free)];
    let designs = [5.0, 11.0, 14.0].map(|position| designed(&scene, &[Place::Clamp(position)], &end));
    let found = best(&designs).expect("one");
    let stiffness = |design: &Design| design.answer.as_ref().and_then(|answer| answer.stiffness_n_per_m);
    let all: Vec<f64> = designs.iter().filter_map(stiffness).collect();
    assert!(all.len() > 1, "{all:?}");
    assert_eq!(stiffness(found), all.into_iter().reduce(f64::min));
}

#[test]
fn clamps_are_followed_through_jumps_and_days() {
    let clamp = [
        "restraints=[{ position = 11, stiffness = 3e5 }, { position = 4, stiffness = 2e5 }]",
        "traffic.passes=60",
    ];
    let of = |more: &[&str]| run(&scene(&[&clamp, more].concat()));
    // Every pass, and few with jumps between them.
    let [every, few] = ["quasi-static", "pass-law"].map(|method| of(&[&format!("solver.method={method}")]));
    assert!(few.cost.simulated_passes < 60);
    let mut compared = 0;
    for (one, other) in every.restraints.iter().zip(&few.restraints) {
        assert_eq!(one.after_passes_n.len(), every.passes.len());
        assert_eq!(other.after_passes_n.last(), Some(&other.force_n));
        let forces = other.after_passes_n.iter().zip(&other.during_passes_n);
        for (pass, (after, during)) in few.passes.iter().zip(forces) {
            // Nor is it less during a pass.
            assert!(during.abs() >= after.abs(), "pass {}", pass.pass);
            let same = every.passes.iter().position(|every| every.pass == pass.pass);
            let Some(same) = same else { continue };
            for apart in [
                one.after_passes_n[same] - after,
                one.during_passes_n[same] - during,
            ] {
                assert!(
                    apart.abs() < 0.02 * one.force_n.abs(),
                    "pass {}: {apart}",
                    pass.pass
                );
            }
            compared += 1;
        }
    }
    assert!(compared > 20);
    // Heat pushes and draws: the day's range holds what every pass leaves, and more.
    let warm = run(&scene(&[&WARM[..], &clamp[..1]].concat()));
    let all = &warm.heat.as_ref().expect("heat").all_days;
    assert_eq!(all.restraints.len(), 2);
    for (clamp, range) in warm.restraints.iter().zip(&all.restraints) {
        for force in &clamp.after_passes_n {
            assert!((range.min_n..=range.max_n).contains(force), "{force} {range:?}");
        }
        let days = warm.days.iter().map(|day| day.restraints.len());
        assert!(days.min() == Some(2));
    }
    let place = Place::Clamp(11.0);
    let at_rest = all.restraints[0].max_n.abs().max(all.restraints[0].min_n.abs());
    let passes = warm.passes.iter().zip(&warm.restraints[0].during_passes_n);
    let simulated = passes.filter(|(pass, _)| !pass.interpolated);
    let largest = simulated.fold(at_rest, |most, (_, force)| most.max(force.abs()));
    assert!(largest > at_rest);
    assert_eq!(warm.largest(place, Limited::Force), largest);
    assert_eq!(warm.largest(place, Limited::Movement), largest / 3e5);
}
