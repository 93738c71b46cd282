//! How much traffic: passes, or years with vehicles a day.

use creepage::{Scene, SceneError};

use super::{FULL, assert_override_refused, read, read_with};

#[test]
fn years_are_whole_passes_of_an_average_year() {
    let passes = |set: &[&str]| -> Result<u64, SceneError> { Ok(read_with(set)?.traffic.passes) };
    assert_eq!(
        passes(&["traffic.years=20", "traffic.per_day=800"]).unwrap(),
        5_844_000
    );
    // 365.25 · 0.1 = 36.525, rounded.
    assert_eq!(passes(&["traffic.years=1", "traffic.per_day=0.1"]).unwrap(), 37);
    // What was set later counts, and a rate beside passes changes none.
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
    assert_eq!(Scene::from_toml("bad.toml", &years.to_toml()).unwrap(), years);
    let without = read_with(&["traffic.per_day="]).unwrap();
    assert_eq!(
        (without.traffic.per_day, without.traffic.years_after(9)),
        (None, None)
    );
}

#[test]
fn amounts_of_traffic_that_have_no_meaning_are_refused() {
    for bad in ["years=0", "years=-1", "years=nan", "years=1e7"] {
        assert_override_refused(&[&format!("traffic.{bad}")], &["`traffic.years`"]);
    }
    for bad in [
        "per_day=0",
        "per_day=-800",
        "per_day=nan",
        "per_day=1e10",
        "per_day=\"800 1/h\"",
    ] {
        assert_override_refused(&[&format!("traffic.{bad}")], &["`traffic.per_day`"]);
    }
    for (years, per_day, found) in [("1e-9", "1", "0 passes"), ("1e6", "1e9", "3.6525e17 passes")] {
        let set = [
            &*format!("traffic.years={years}"),
            &*format!("traffic.per_day={per_day}"),
        ];
        assert_override_refused(
            &set,
            &["`traffic.years`", found, "from 1 to 1000000000000 passes"],
        );
    }
}
