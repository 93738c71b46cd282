//! Random scenes over the whole allowed range of every key: what `examples/whole_range` does with ten thousand, with few quick ones.

#[path = "../examples/whole_range/judged.rs"]
#[allow(dead_code, reason = "the example names outcomes in its table")]
mod judged;
#[path = "../examples/whole_range/scenes.rs"]
pub mod scenes;

use judged::{Outcome, judged};

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
