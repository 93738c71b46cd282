//! How much traffic: passes, or years with vehicles a day.

use creepage::SceneError;

use super::{FULL, assert_override_refused, read, read_with};

#[test]
fn years_are_whole_passes_of_an_average_year() {
    let passes = |set: &[&str]| -> Result<u64, SceneError> { Ok(read_with(set)?.traffic.passes) };
    let years = ["traffic.years=20", "traffic.per_day=800"];
    assert_eq!(passes(&years).unwrap(), 5_844_000);
    // 365.25 · 0.1 = 36.525, rounded.
    assert_eq!(passes(&["traffic.years=1", "traffic.per_day=0.1"]).unwrap(), 37);
    // What was set later counts, and a rate with passes changes none.
    assert_eq!(passes(&["traffic.years=20", "traffic.passes=7"]).unwrap(), 7);
    assert_eq!(passes(&["traffic.per_day=3"]).unwrap(), 60);
}

#[test]
fn a_rate_gives_passes_a_time_and_is_written_back() {
    let scene = read(FULL).unwrap();
    assert_eq!(scene.traffic.per_day, Some(800.0));
    assert_eq!(scene.traffic.years_after(292_200), Some(1.0));
    let years = read(&FULL.replace("passes = 60", "years = 0.5")).unwrap();
    assert_eq!(years.traffic.passes, 146_100);
    assert_eq!(read(&years.to_toml()).unwrap(), years);
    let without = read_with(&["traffic.per_day="]).unwrap().traffic;
    assert_eq!((without.per_day, without.years_after(9)), (None, None));
}

#[test]
fn amounts_of_traffic_that_have_no_meaning_are_refused() {
    let rates = ["0", "-800", "nan", "1e10", "\"800 1/h\""].map(|bad| ("per_day", bad));
    let years = ["0", "-1", "nan", "1e7"].map(|bad| ("years", bad));
    for (key, bad) in rates.into_iter().chain(years) {
        assert_override_refused(&[&format!("traffic.{key}={bad}")], &format!("traffic.{key}"));
    }
    // No passes, and more than can be counted.
    for (per_day, years) in [("1", "1e-9"), ("1e9", "1e6")] {
        let [per_day, years] = [
            format!("traffic.per_day={per_day}"),
            format!("traffic.years={years}"),
        ];
        assert_override_refused(&[&per_day, &years], "traffic.years");
    }
}
