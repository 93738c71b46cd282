//! Numbers as a reader takes them in: four digits, groups of thousands, powers of ten.

use creepage_scene::four_digits;

/// SI prefixes and what they stand for, the largest first.
const PREFIXES: [(f64, &str); 7] = [
    (1e9, "G"),
    (1e6, "M"),
    (1e3, "k"),
    (1.0, ""),
    (1e-3, "m"),
    (1e-6, "µ"),
    (1e-9, "n"),
];
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Four digits or all before the point, without zeros at the end; very large and small numbers with an exponent.
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(1e-4..1e9).contains(&value.abs()) {
        return power_of_ten(value);
    }
    let decimals = (3.0 - value.abs().log10().floor()).max(0.0) as usize;
    let rounded: f64 = format!("{value:.decimals$}").parse().unwrap_or(value);
    rounded.to_string()
}

/// A number with its power of ten: "7.4·10⁶".
pub fn power_of_ten(value: f64) -> String {
    let text = format!("{:e}", four_digits(value));
    let (leading, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised = |digit: char| digit.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    let exponent: String = exponent.chars().map(raised).collect();
    format!("{leading}·10{exponent}")
}

/// A quantity to four digits with the prefix that suits its size: "8.01 MN".
pub fn quantity(value: f64, unit: &str) -> String {
    let mut prefixes = PREFIXES.into_iter();
    let (factor, prefix) = prefixes
        .find(|(factor, _)| value.abs() >= *factor)
        .unwrap_or((1.0, ""));
    format!("{} {prefix}{unit}", significant(value / factor))
}

/// A whole number in groups of three digits, which do not break: "5 840 000".
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if digits.len() > 4 && index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push('\u{a0}');
        }
        grouped.push(digit);
    }
    grouped
}

/// "one pass", "5 840 000 passes".
pub fn passes(number: u64) -> String {
    match number {
        1 => "one pass".to_owned(),
        number => format!("{} passes", count(number)),
    }
}

/// The least and the largest of some values; infinite without any.
pub fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let wider = |[least, most]: [f64; 2], value: f64| [least.min(value), most.max(value)];
    values.into_iter().fold(none, wider)
}

/// The largest of …, 0.5, 1, 2, 5, 10, … that is not above `number`, which is positive.
pub fn round_below(number: f64) -> f64 {
    // The cube root of a thousand comes out a little below ten.
    let number = number * (1.0 + 1e-9);
    let power = 10_f64.powf(number.log10().floor());
    let step = [5.0, 2.0].into_iter().find(|step| number / power >= *step);
    step.unwrap_or(1.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_have_four_digits_and_a_prefix() {
        for (value, unit, expected) in [
            (8.01e6, "N", "8.01 MN"),
            (0.05, "m", "50 mm"),
            (-35.7e-6, "m", "-35.7 µm"),
            (0.0, "N", "0 N"),
            (108.8, "N/m", "108.8 N/m"),
            (999.99, "N", "1000 N"),
            (7_352_941.0, "1/m", "7.353 M1/m"),
        ] {
            assert_eq!(quantity(value, unit), expected);
        }
        assert_eq!(
            [7, 2000, 5_840_000].map(count),
            ["7", "2000", "5\u{a0}840\u{a0}000"]
        );
        assert_eq!(significant(7_352_941.0), "7352941");
        assert_eq!(significant(1e-7), "1·10⁻⁷");
        assert_eq!(significant(120.0), "120");
        assert_eq!(power_of_ten(7.4e6), "7.4·10⁶");
    }
}
