//! The calibration's stability map on a coarser grid: an identified b is right, and what cannot be identified is said to be so.

use creepage_validation::stability::calibration::{Cell, Draw, Outcome, Table, draws, map};

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn an_identified_shape_factor_is_never_wrong() {
    let table = Table::new(3.0).unwrap();
    let grid = map(&table, 4, 3, 20).unwrap();
    assert_eq!(draws(&grid, Draw::Wrong), 0);
    assert_eq!(draws(&grid, Draw::Failed), 0);
    // Intervals of 95 % miss one truth of twenty; three standard deviations of the binomial count more are chance.
    let identified: usize = grid.cells.iter().map(Cell::identified).sum();
    let expected = 0.05 * identified as f64;
    let missed = draws(&grid, Draw::Missed) as f64;
    assert!(
        missed <= expected + 3.0 * (0.95 * expected).sqrt(),
        "{missed} of {identified} intervals miss the truth"
    );
    // The map has both regions: soft contact with little noise, and stiff contact with much.
    assert_eq!(grid.cells[0].outcome(), Outcome::Identified);
    assert_eq!(
        grid.cells[grid.cells.len() - 1].outcome(),
        Outcome::NotIdentifiable
    );
}
