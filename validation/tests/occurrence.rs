//! Does a cable creep: the table of the program against runs.

use creepage::occurrence;
use creepage_validation::occurrence::{Case, SHEAR};

/// A duct of 30 depths, 12 nodes a depth: shorter and coarser than what made the table.
#[test]
fn the_table_comes_out_of_runs() {
    for number in [0.1, 0.4, 0.8] {
        let wanted = occurrence::at(number);
        let case = Case::new(number, SHEAR[0]).expect("a case");
        let (locked, _) = case.saturated(30.0, 12.0).expect("saturated");
        assert!(
            (locked - wanted.locked_share).abs() < 0.02,
            "Q = {number}: {locked}, not {}",
            wanted.locked_share
        );
        let advance = case.advance(60.0, 12.0).expect("an advance");
        assert!(
            (advance - wanted.advance_share).abs() < 0.05,
            "Q = {number}: {advance}, not {}",
            wanted.advance_share
        );
    }
}

/// At Q that is no row: how good the reading between rows is.
#[test]
fn a_value_between_rows_comes_out_of_a_run() {
    let case = Case::new(1.2, SHEAR[0]).expect("a case");
    let (locked, _) = case.saturated(20.0, 12.0).expect("saturated");
    let wanted = occurrence::at(1.2).locked_share;
    assert!((locked - wanted).abs() < 0.02, "{locked}, not {wanted}");
}

/// Beyond Q = 3 a pass moves the middle of a long free cable no more, where one at Q = 0.2 moves it by two peaks. (Free ends still
/// work in a little.)
#[test]
fn above_three_no_pass_moves_the_middle() {
    for number in [3.5, 5.0] {
        let case = Case::new(number, SHEAR[0]).expect("a case");
        let advance = case.advance(40.0, 12.0).expect("an advance");
        assert!(advance.abs() < 0.02, "Q = {number}: {advance} peaks a pass");
    }
}
