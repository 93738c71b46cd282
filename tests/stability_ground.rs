//! The ground's stability maps on coarser grids: with its guards on, no model is wrong anywhere, and the maps can tell.
//!
//! What is mapped stands in `examples/stability/burmister.rs` and `fem.rs`, the independent answers in
//! `examples/shared/ground_reference.rs`.

#![allow(dead_code, reason = "the figures of the maps are drawn by the example")]

#[path = "../examples/stability/burmister.rs"]
mod burmister_map;
#[path = "../examples/stability/fem.rs"]
mod fem;
#[path = "../examples/shared/ground_map.rs"]
mod ground_map;
#[path = "../examples/shared/ground_reference.rs"]
mod ground_reference;

use ground_map::{Grid, Outcome};

/// Every cell of the crate is right, or refused with a typed error; at most `refused` of them are.
fn never_wrong(grid: &Grid, refused: usize) {
    assert_eq!(grid.never_wrong(), Ok(()));
    assert!(
        grid.count(0, Outcome::Refused) <= refused,
        "{} refused",
        grid.count(0, Outcome::Refused)
    );
    assert!(grid.count(0, Outcome::Right) > 0);
}

#[test]
fn burmister_is_right_everywhere_and_transfer_matrices_are_not() {
    let grid = burmister_map::map(7, 8).unwrap();
    never_wrong(&grid, 0);
    // The judge sees what it is there for: lost digits, and overflow.
    assert!(grid.count(1, Outcome::Wrong) > 5 && grid.count(1, Outcome::Failed) > 5);
    assert!(grid.count(1, Outcome::Right) > 20);
}

// cargo test --release --test stability_ground -- --ignored
#[test]
#[ignore = "45 grounds by finite elements"]
fn elements_are_never_wrong_as_poissons_ratio_goes_to_a_half() {
    let grid = fem::incompressible(5).unwrap();
    // Rounding is refused where a very stiff layer is nearly incompressible: contrast of 1e4 from ν = 0.4999.
    never_wrong(&grid, 4);
    assert!(grid.count(1, Outcome::Wrong) > 20, "the locking element locks");
}

// cargo test --release --test stability_ground -- --ignored
#[test]
#[ignore = "25 grounds by finite elements"]
fn elements_are_never_wrong_over_thickness_and_contrast() {
    let grid = fem::layered(5, 5).unwrap();
    never_wrong(&grid, 0);
    assert!(
        grid.count(1, Outcome::Right) > 5,
        "{}",
        grid.count(1, Outcome::Right)
    );
}

/// A corner of both maps that is quick enough for every run of the tests.
#[test]
fn elements_are_never_wrong_on_the_coarsest_grid() {
    let grid = fem::layered(2, 2).unwrap();
    never_wrong(&grid, 0);
}
