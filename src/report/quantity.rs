//! Quantities as an engineer says them: four digits, a prefix, groups of thousands.

use ground_field::Modulus;

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
pub fn quantity(value: f64, unit: &str) -> String {
    let size = value.abs();
    let (factor, prefix) = PREFIXES
        .into_iter()
        .find(|(factor, _)| size >= *factor)
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

/// A length in metres, for what stands beside other lengths: "0.05 m".
pub fn metres(metres: f64) -> String {
    format!("{} m", significant(metres))
}

/// Young's modulus in MPa, at the top and at the bottom where it varies: "3000 MPa", "100 to 250 MPa".
pub fn moduli(modulus: Modulus) -> String {
    let mega = |modulus: f64| significant(1e-6 * modulus);
    match modulus {
        Modulus::Uniform(modulus) => format!("{} MPa", mega(modulus)),
        Modulus::Linear { top, bottom } => format!("{} to {} MPa", mega(top), mega(bottom)),
    }
}

/// Stiffness of a spring or a clamp in kN/m: "3000 kN/m".
pub fn stiffness(stiffness: f64) -> String {
    format!("{} kN/m", significant(1e-3 * stiffness))
}

/// A number with its power of ten: "7.4·10⁶".
pub fn power_of_ten(value: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = format!("{value:.3e}");
    let (leading, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let leading = leading.trim_end_matches('0').trim_end_matches('.');
    let raised = |digit: char| digit.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    let exponent: String = exponent.chars().map(raised).collect();
    format!("{leading}·10{exponent}")
}

/// A length in the unit one would say it in: "0.9 m", "50 mm".
pub fn length(metres: f64) -> String {
    if metres.abs() < 0.1 {
        quantity(metres, "m")
    } else {
        format!("{} m", significant(metres))
    }
}

/// Four digits, without zeros at the end; very large and small numbers with an exponent.
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..9).contains(&magnitude) {
        return power_of_ten(value);
    }
    let text = format!("{value:.*}", (3 - magnitude).max(0) as usize);
    if text.contains('.') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
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
        assert_eq!([0.9, 1500.0, 0.05].map(length), ["0.9 m", "1500 m", "50 mm"]);
        assert_eq!(significant(7_352_941.0), "7352941");
        assert_eq!(significant(1e-7), "1·10⁻⁷");
        assert_eq!(significant(120.0), "120");
        assert_eq!(power_of_ten(7.4e6), "7.4·10⁶");
        assert_eq!(stiffness(3e6), "3000 kN/m");
        assert_eq!(metres(0.05), "0.05 m");
        assert_eq!(moduli(Modulus::Uniform(3e9)), "3000 MPa");
    }
}
