//! Jumps and days against the simulation of every pass.

mod days;
mod jumps;

#[track_caller]
fn assert_near(found: f64, expected: f64, allowed: f64) {
    let off = (found - expected).abs();
    assert!(off <= allowed, "{found}, not {expected} within {allowed}");
}
