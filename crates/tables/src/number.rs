//! Numbers as spreadsheets and data loggers write them.

/// What instruments and spreadsheets write if there is no value, in small letters, between bars.
const NO_VALUES: &str = "nan|na|n/a|n.a.|null|none|nil|-|--|---|?|inf|+inf|-inf|infinity|-infinity|overflow|ovld|ovl|ol|\
                         overload|overrange|err|error|bad|invalid|fault|no data|nodata|missing|n.v.|k.a.|k. a.|keine angabe|\
                         #value!|#wert!|#div/0!|#num!|#zahl!|#ref!|#bezug!|#n/a|#nv|#name?|#null!|#####|1.#qnan|1.#ind|\
                         -1.#ind|1.#inf|-1.#inf|欠測";

/// Whether the text of a cell stands for no value, as `NaN` and `#N/A` do.
pub fn is_no_value(text: &str) -> bool {
    let text = text.to_lowercase();
    NO_VALUES.split('|').any(|word| word == text)
}

/// The number at the beginning of `text`, where this sign stands before the decimals: its digits as
/// a program writes them, and what follows, a unit or nothing. `None` if there is none, or it is not finite.
pub fn number(text: &str, decimal: char) -> Option<(String, &str)> {
    let text = text.trim_start_matches('\'');
    let part = |c: char| c.is_ascii_digit() || "+-−.,'’eE".contains(c) || c.is_whitespace();
    let end = text.find(|c: char| !part(c)).unwrap_or(text.len());
    let written = match text[..end].rsplit_once(char::is_whitespace) {
        // As in 1/K.
        Some((digits, "1")) if text[end..].starts_with('/') => digits,
        _ => &text[..end],
    };
    let written = written.trim_end_matches(|c: char| !c.is_ascii_digit() && !".,".contains(c));
    let digits = plain(written, decimal)?;
    let is_finite = digits.parse().is_ok_and(f64::is_finite);
    is_finite.then(|| (digits, text[written.len()..].trim()))
}

/// The digits without the one sign between groups of three, the first of which begins with no zero.
fn plain(digits: &str, decimal: char) -> Option<String> {
    let digits = digits.replace('−', "-");
    let (whole, decimals) = digits.split_at(digits.find(decimal).unwrap_or(digits.len()));
    let is_mark = |c: char| ".,'’".contains(c) || (c.is_whitespace() && c != '\t');
    let is_three = |group: &str| group.len() == 3 && group.bytes().all(|byte| byte.is_ascii_digit());
    let is_grouped = |mark: char| {
        let mut groups = whole.trim_start_matches(['+', '-']).split(mark);
        let first = groups.next().unwrap_or("");
        (1..=3).contains(&first.len()) && !first.starts_with('0') && groups.all(is_three)
    };
    let is_number = whole.chars().find(|&c| is_mark(c)).is_none_or(is_grouped);
    is_number.then(|| whole.replace(is_mark, "") + &decimals.replacen(decimal, ".", 1))
}

/// The cell read with a decimal point and with a decimal comma: where they differ, it may be either.
pub fn by_either_sign(cell: &str) -> [Option<f64>; 2] {
    ['.', ','].map(|decimal| number(cell, decimal)?.0.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_in_every_notation() {
        let (point, comma) = ('.', ',');
        for (text, decimal, value, unit) in [
            ("94.1", point, 94.1, ""),
            ("94,1", comma, 94.1, ""),
            ("−94,1", comma, -94.1, ""),
            ("1.234,5", comma, 1234.5, ""),
            ("1,234.5", point, 1234.5, ""),
            ("1'234.5", point, 1234.5, ""),
            ("1 234,5", comma, 1234.5, ""),
            ("1\u{202f}234,5", comma, 1234.5, ""),
            ("9.41e1", point, 94.1, ""),
            ("9,41E+01", comma, 94.1, ""),
            ("94,1 N", comma, 94.1, "N"),
            ("0.0941kN", point, 0.0941, "kN"),
            ("1,2e-6 1/K", comma, 1.2e-6, "1/K"),
            ("5.", point, 5.0, ""),
            (".5", point, 0.5, ""),
        ] {
            let found = number(text, decimal).map(|(digits, unit)| (digits.parse(), unit));
            assert_eq!(found, Some((Ok(value), unit)), "{text}");
        }
        for text in [
            "", "N", "1,23.4", "12,3456", "1.2.3", "--1", "1e999", "1 2", "1234,567",
        ] {
            assert!(number(text, point).is_none(), "{text}");
        }
    }

    #[test]
    fn a_cell_tells_the_decimal_sign_or_is_doubtful() {
        let says = |cell: &str| match by_either_sign(cell) {
            [Some(_), None] => "point",
            [None, Some(_)] => "comma",
            [Some(point), Some(comma)] if point != comma => "doubtful",
            _ => "silent",
        };
        let (point, comma) = ("point", "comma");
        for (cell, expected) in [
            ("94.1", point),
            ("1,234.5", point),
            ("1,234,567", point),
            ("0.200", point),
            ("1234.567", point),
            ("1.200e3", point),
            ("94,1", comma),
            ("1.234,5", comma),
            ("1.234.567", comma),
            ("-0,113 kN", comma),
            ("1,113", "doubtful"),
            ("1.200 m", "doubtful"),
            ("-1.200", "doubtful"),
            ("12", "silent"),
            ("a.b", "silent"),
        ] {
            assert_eq!(says(cell), expected, "{cell}");
        }
    }
}
