//! Random scenes over the whole allowed range of every key: few quick ones of the ten thousand.

use creepage::Scene;
use creepage_validation::whole_range::judged::{Outcome, judged};
use creepage_validation::whole_range::scenes;

/// Scenes that take less than a second each.
const QUICK: [u64; 24] = [
    1, 2, 5, 11, 19, 20, 21, 23, 27, 30, 35, 36, 38, 42, 45, 47, 49, 54, 56, 57, 58, 60, 6, 51,
];

#[test]
fn answers_over_the_whole_range_of_every_key_can_be_true() {
    for number in QUICK {
        let (outcome, stated) = judged(&scenes::scene(number));
        assert_eq!(outcome, Outcome::Right, "scene {number}");
        assert!(
            stated.is_some_and(|stated| stated <= 0.5),
            "scene {number}: {stated:?}"
        );
    }
}

/// So heavy a cable hardly slips: on coarse meshes only its end on a spring moves, and nothing shows the 330 N that the sharpest bend leaves in it.
#[test]
fn slip_that_only_fine_meshes_show_is_not_missed() {
    let mut scene = Scene::from_toml("scene", &scenes::scene(9180)).expect("a valid scene");
    (scene.duct.length, scene.traffic.passes) = (5.0, 1);
    // So slow that inertia does not count.
    for traffic in &mut scene.vehicles {
        traffic.speed = 1.0;
    }
    let run = creepage::run(&scene).expect("an answer");
    scene.solver.tolerance = 0.01;
    let finer = creepage::run(&scene).expect("an answer");
    let forces = [&run, &finer].map(|run| run.passes[0].max_compression_n);
    let stated = run.error_estimate.relative;
    assert!(
        (forces[0] - forces[1]).abs() <= stated * forces[1],
        "{forces:?}, {stated}"
    );
}
