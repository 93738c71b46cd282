//! One varied key: the values that it takes.

use super::distribution::drawn;
use super::error::SweepError;
use super::numbers::{number, numbers, unit};
use creepage_scene::Unit;

/// Maximum number of values of a range.
const MAX_VALUES: f64 = 1e6;
/// Digits kept of A + i·STEP: the decimals that were written, without the binary dust of their sum.
const DIGITS: usize = 12;

/// A key and the values it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The scene's key.
    pub key: String,
    /// Its values, as they would stand after `--set KEY=`, or [distributions](super::Distribution)
    /// to draw from.
    pub values: Vec<String>,
}

/// What was found, and what is allowed in its place.
type Refusal = (String, String);

impl Axis {
    /// Reads `KEY=A:B:STEP`, `KEY=V1,V2,…`, or `KEY=` with a
    /// [distribution](super::Distribution::parse). Numbers may have a unit: `0.6m:2m:0.2m`.
    ///
    /// # Errors
    ///
    /// [`SweepError::Invalid`] with what is allowed.
    pub fn parse(text: &str) -> Result<Self, SweepError> {
        Self::read(text).map_err(|(found, allowed)| SweepError::Invalid {
            argument: format!("--vary {text}: "),
            found,
            allowed,
        })
    }

    fn read(text: &str) -> Result<Self, Refusal> {
        let (key, written) = text.split_once('=').unwrap_or_default();
        let (key, written) = (key.trim(), written.trim());
        if key.is_empty() || written.is_empty() {
            let allowed = "KEY=A:B:STEP, KEY=V1,V2,… or KEY=normal(MEAN, SD), with a key such as duct.depth";
            return Err(("no key or no value".into(), allowed.into()));
        }
        let refused = |allowed: &str| (written.to_owned(), allowed.to_owned());
        let values = if let Some(distribution) = drawn(key, written) {
            distribution.map_err(refused)?;
            vec![written.to_owned()]
        } else if let Some(range) = range(written) {
            range.map_err(refused)?
        } else {
            list(written)?
        };
        let key = key.to_owned();
        Ok(Self { key, values })
    }

    /// The unit of all its values, if they have one.
    pub(super) fn unit(&self) -> Option<Unit> {
        let of = |value: &String| match drawn(&self.key, value) {
            Some(distribution) => unit(&distribution.ok()?.quantile(0.5).1),
            None => unit(value),
        };
        let mut units = self.values.iter().filter(|value| !value.is_empty()).map(of);
        let first = units.next()?;
        first.filter(|_| units.all(|unit| unit == first))
    }
}

/// The parts of a list; commas inside brackets and quotes part nothing.
fn split(text: &str) -> Vec<&str> {
    let (mut depth, mut quote) = (0_usize, None);
    let parts = text.split(|c| {
        match (quote, c) {
            (Some(open), _) => quote = Some(open).filter(|&open| c != open),
            (None, '"' | '\'') => quote = Some(c),
            (None, '{' | '[' | '(') => depth += 1,
            (None, '}' | ']' | ')') => depth = depth.saturating_sub(1),
            _ => return c == ',' && depth == 0,
        }
        false
    });
    parts.map(str::trim).collect()
}

/// The values of V1,V2,….
fn list(text: &str) -> Result<Vec<String>, Refusal> {
    let list = split(text);
    let units: Vec<&str> = list.iter().filter_map(|value| Some(number(value)?.1)).collect();
    let last = units.last().copied().unwrap_or_default();
    if list.contains(&"") {
        return Err(("an empty value".into(), "values between commas".into()));
    }
    if let ([first, second], Some(one)) = (&list[..], decimal_comma(text)) {
        let space = if last.is_empty() { " " } else { "" };
        return Err((
            format!("{first} and {second}, or {one}?"),
            format!("`{first}{last},{space}{second}` for two values, `{one}` for one"),
        ));
    }
    if let [one] = list[..]
        && let Some((first, last)) = one.split_once("..").or_else(|| one.split_once('-'))
        && let (Some(_), Some(_), None) = (number(first), number(last), number(one))
    {
        let range = format!("A:B:STEP for a range, such as {first}:{last}:STEP");
        return Err((one.to_owned(), range));
    }
    if units.contains(&"") && units.iter().any(|unit| !unit.is_empty()) {
        let allowed = format!("the unit at every value, such as {}{last}", list[0]);
        return Err(("values with a unit and without one".into(), allowed));
    }
    Ok(list.into_iter().map(str::to_owned).collect())
}

/// Two values that may be one with a decimal comma, as it would be written with a point: `1,5m`,
/// `0,25`, `1,05`.
fn decimal_comma(text: &str) -> Option<String> {
    let (whole, rest) = text.split_once(',')?;
    let unsigned = whole.strip_prefix(['+', '-']).unwrap_or(whole);
    let (digits, unit) = rest.split_at(rest.bytes().take_while(u8::is_ascii_digit).count());
    let is_count = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if !is_count(unsigned) || !is_count(digits) || number(rest)?.1 != unit.trim() {
        return None;
    }
    let like_one = !unit.is_empty() || unsigned == "0" || (digits.len() > 1 && digits.starts_with('0'));
    like_one.then(|| format!("{whole}.{rest}"))
}

/// The values of A:B:STEP, both ends included, or what is allowed; `None` for what does not begin
/// so.
fn range(text: &str) -> Option<Result<Vec<String>, &'static str>> {
    let parts: Vec<&str> = text.split(':').collect();
    number(parts[0]).filter(|_| parts.len() > 1)?;
    if parts.len() == 2 {
        return Some(Err("A:B:STEP, which needs a step, such as 1:2:0.5"));
    }
    let Some(([first, last, step], unit)) = numbers(&parts) else {
        return Some(Err("A:B:STEP, three numbers in one unit"));
    };
    let steps = (last - first) / step;
    let is_bare = |part: &&str| number(part).is_some_and(|(_, unit)| unit.is_empty());
    let counts = parts.iter().map(is_bare).eq([false, false, true]);
    if !(0.0..=MAX_VALUES).contains(&steps) || counts || (steps < 1.0 - 1e-9 && first != last) {
        return Some(Err(
            "A:B:STEP with a STEP that leads from A to B, a distance in their unit and no number of values, to a million values at most",
        ));
    }
    let value = |i: u64| {
        let value = first + i as f64 * step;
        let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
        // Next to the steps themselves, zero is zero.
        let is_zero = rounded.abs() < 1e-9 * step.abs();
        let value = if is_zero { 0.0 } else { rounded };
        format!("{value} {unit}").trim_end().to_owned()
    };
    // The end counts where rounding alone keeps a step from it.
    let count = (steps * (1.0 + 1e-12) + 1e-9).floor() as u64;
    Some(Ok((0..=count).map(value).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn listed(text: &str) -> Vec<String> {
        Axis::parse(text).expect("an axis").values
    }

    #[test]
    fn ranges_hold_both_ends_as_they_would_be_written() {
        assert_eq!(listed("a=0.1:0.5:0.1"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(listed("a = 1:2:0.4"), ["1", "1.4", "1.8"]);
        assert_eq!(listed("a=-0.2:0.2:0.1"), ["-0.2", "-0.1", "0", "0.1", "0.2"]);
        assert_eq!(listed("a=2m:1m:-0.5m"), ["2 m", "1.5 m", "1 m"]);
        assert_eq!(listed("a=1:3:1 MN/m"), ["1 MN/m", "2 MN/m", "3 MN/m"]);
        assert_eq!(
            listed("a=1e6 N:2e6 N:5e5 N"),
            ["1000000 N", "1500000 N", "2000000 N"]
        );
        assert_eq!(listed("a=5:5:1"), ["5"]);
        assert_eq!(listed("a=0:0.3:0.1").len(), 4);
        assert_eq!(listed("a=0:1:0.001").len(), 1001);
    }

    #[test]
    fn lists_keep_what_stands_in_brackets_together() {
        assert_eq!(listed("a=1,2, 3"), ["1", "2", "3"]);
        assert_eq!(
            listed("ends.downstream={ spring = \"3 MN/m\", x = 1 },fixed"),
            ["{ spring = \"3 MN/m\", x = 1 }", "fixed"]
        );
        assert_eq!(listed("title=\"a,b\",c"), ["\"a,b\"", "c"]);
        assert_eq!(listed("v=t-25"), ["t-25"]);
    }

    #[test]
    fn what_is_no_axis_is_refused() {
        #[rustfmt::skip]
        let no_axes = [
            "a", "=1", "a=", "a=1,,2", "a=1:2:0", "a=1:2:-1", "a=1m:2km:1m", "a=0:1:1e-9", "a=0:8000000:1",
            "a=1:10000001:1.2.3", "a=1:2:3:4", "a=1:x:2", "a=normal(1)", "a=normal(1, 0)", "a=normal(1, -1)",
            "a=normal(1, nan)", "a=lognormal(-1, 1)", "a=lognormal(1, 1 m)", "a=uniform(2, 1)", "a=triangle(1, 2)",
            "a=uniform(1 m, 2 N)", "a=0.1-0.5", "a=0.1..0.5", "duct.depth=1m:2m",
        ];
        // What may be a decimal comma, or a unit at the last value alone.
        let may_be_two = ["a=1,5m", "a=1,5 m", "a=0,25", "a=-0,3", "a=1,05", "a=0.5,1,2m"];
        for text in no_axes.into_iter().chain(may_be_two) {
            assert!(Axis::parse(text).is_err(), "{text}");
        }
        let message = |text: &str| Axis::parse(text).expect_err(text).to_string();
        assert!(message("duct.depth=1,5m").contains("1 and 5m, or 1.5m?"));
    }

    #[test]
    fn lists_of_whole_numbers_of_numbers_with_points_and_of_words_have_one_meaning() {
        for (text, values) in [
            ("a=1e-5", &["1e-5"][..]),
            ("traffic.passes=10,100", &["10", "100"]),
            ("a=0, 1", &["0", "1"]),
            ("a=0, 25", &["0", "25"]),
            ("a=0,0.5", &["0", "0.5"]),
            ("a=1,5e3", &["1", "5e3"]),
            ("a=1m,5m", &["1m", "5m"]),
            ("a=0.2,0.3", &["0.2", "0.3"]),
            ("ends.downstream=fixed,free", &["fixed", "free"]),
        ] {
            assert_eq!(listed(text), values, "{text}");
        }
    }
}
