//! Numbers and tables for a reader, as the terminal and the report show them.

use crate::PassRecord;

/// Leading digits of the passes in a shortened table.
const STEPS: [u64; 3] = [1, 2, 5];
/// Rows of a table that is read at a glance.
const ROWS: usize = 16;

/// `value` with so many decimals, and no minus before zeros.
pub fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        _ => text,
    }
}

/// An error as a percentage.
pub fn share(error: f64) -> String {
    if error > 0.0 && error < 5e-5 {
        "< 0.01 %".into()
    } else {
        format!("{:.2} %", 100.0 * error)
    }
}

/// A time in words of its size.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => "< 1 ms".into(),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.0} h", s / 3600.0),
    }
}

/// The first passes, then about evenly growing numbers, and the last.
pub fn selected(passes: &[PassRecord]) -> Vec<&PassRecord> {
    if passes.len() <= ROWS {
        return passes.iter().collect();
    }
    let last = passes.len() - 1;
    passes
        .iter()
        .enumerate()
        .filter(|(index, record)| {
            let leading = record.pass / 10_u64.pow(record.pass.ilog10());
            let round = record.pass.is_multiple_of(10_u64.pow(record.pass.ilog10()));
            *index == last || (round && STEPS.contains(&leading))
        })
        .map(|(_, record)| record)
        .collect()
}

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

/// A quantity to four digits with the prefix that suits its size: "8.01 MN".
#[cfg(feature = "plot")]
pub fn quantity(value: f64, unit: &str) -> String {
    let size = value.abs();
    let (factor, prefix) = PREFIXES
        .into_iter()
        .find(|(factor, _)| size >= *factor)
        .unwrap_or((1.0, ""));
    format!("{} {prefix}{unit}", significant(value / factor))
}

/// A whole number in groups of three digits, which do not break: "5 840 000".
#[cfg(feature = "plot")]
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    if digits.len() <= 4 {
        return digits;
    }
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push('\u{a0}');
        }
        grouped.push(digit);
    }
    grouped
}

/// A length in the unit one would say it in: "0.9 m", "50 mm".
#[cfg(feature = "plot")]
pub fn length(metres: f64) -> String {
    if metres.abs() < 0.1 {
        quantity(metres, "m")
    } else {
        format!("{} m", significant(metres))
    }
}

/// Four digits, without zeros at the end; very large and small numbers with an exponent.
#[cfg(feature = "plot")]
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..9).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let text = format!("{value:.*}", (3 - magnitude).max(0) as usize);
    match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text,
    }
}

#[cfg(all(test, feature = "plot"))]
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
        assert_eq!([0.9, 1500.0, 0.05].map(length), ["0.9 m", "1500 m", "50 mm"]);
        assert_eq!(significant(7_352_941.0), "7352941");
        assert_eq!(significant(1e-7), "1.000e-7");
        assert_eq!(significant(120.0), "120");
    }
}
