//! Passes as days and years, where the vehicles a day are known.

use creepage_plan::shown::{without_zeros, words_if};
use creepage_scene::{DAYS_PER_YEAR, Traffic};

/// Days of a month, on average.
const MONTH: f64 = DAYS_PER_YEAR / 12.0;
/// Powers of ten of years that have rows of their own; whoever computes more knows why.
const POWERS: std::ops::Range<i32> = 0..4;

/// Times that a reader looks for \[days\], with their names.
fn times() -> impl Iterator<Item = (f64, String)> {
    let years = POWERS.flat_map(|power| [1.0, 2.0, 5.0].map(|leading| leading * 10_f64.powi(power)));
    let named = |years: f64| format!("{years} year{}", words_if(years != 1.0, "s"));
    let years = years.map(move |years| (years * DAYS_PER_YEAR, named(years)));
    let short = [(1.0, "1 day"), (MONTH, "1 month")].map(|(days, name)| (days, name.to_owned()));
    short.into_iter().chain(years)
}

/// The passes with which the first day, month and year and round numbers of years end, ascending;
/// none where nothing is known of time.
pub fn calendar(traffic: &Traffic) -> Vec<(u64, String)> {
    let Some(per_day) = traffic.per_day else {
        return Vec::new();
    };
    let at = times().map(|(days, name)| ((days * per_day).round() as u64, name));
    let comes = |(pass, _): &(u64, _)| (1..=traffic.passes).contains(pass);
    at.filter(comes).collect()
}

/// A time \[years\] in words, to three digits.
pub fn after(years: f64) -> String {
    let days = years * DAYS_PER_YEAR;
    // Passes are whole: a month of 100 a day is 3044 of them.
    if let Some((_, name)) = times().find(|(time, _)| (days / time - 1.0).abs() < 1e-3) {
        return name;
    }
    let (number, unit) = match days {
        d if d < 1.0 / 24.0 => (1440.0 * d, "min"),
        d if d < 1.0 => (24.0 * d, "h"),
        d if d < DAYS_PER_YEAR => (d, "days"),
        _ => (years, "years"),
    };
    let decimals = (2 - number.max(1e-9).log10().floor() as i32).max(0) as usize;
    format!("{} {unit}", without_zeros(&format!("{number:.decimals$}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_months_and_years_have_their_passes() {
        let scene =
            creepage_scene::Scene::from_file("../../examples/scenes/full-scale-upper.toml").expect("a scene");
        let traffic = |passes, per_day| Traffic {
            passes,
            per_day,
            ..scene.traffic.clone()
        };
        let names = |traffic: &Traffic| -> Vec<(u64, String)> { calendar(traffic) };
        assert_eq!(names(&traffic(1000, None)), []);
        let twenty = names(&traffic(5_844_000, Some(800.0)));
        let expected = [
            (800, "1 day"),
            (24_350, "1 month"),
            (292_200, "1 year"),
            (584_400, "2 years"),
            (1_461_000, "5 years"),
            (2_922_000, "10 years"),
            (5_844_000, "20 years"),
        ];
        assert_eq!(twenty, expected.map(|(pass, name)| (pass, name.to_owned())));
        // One vehicle in ten days: the first day has none.
        assert_eq!(names(&traffic(40, Some(0.1)))[0], (3, "1 month".to_owned()));
    }

    #[test]
    fn times_are_said_in_the_unit_of_their_size() {
        for (days, words) in [
            (1.0 / 800.0, "1.8 min"),
            (0.5, "12 h"),
            (1.0, "1 day"),
            (3044.0 / 100.0, "1 month"),
            (100.0, "100 days"),
            (12.34, "12.3 days"),
            (3.0 * DAYS_PER_YEAR, "3 years"),
            (20.0 * DAYS_PER_YEAR, "20 years"),
        ] {
            assert_eq!(after(days / DAYS_PER_YEAR), words);
        }
    }
}
