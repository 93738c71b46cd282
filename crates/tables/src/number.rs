//! Numbers as spreadsheets and data loggers write them.

use crate::options::Decimal;

/// What instruments and spreadsheets write if there is no value, in small letters, between bars.
const NO_VALUES: &str = "nan|na|n/a|n.a.|null|none|nil|-|--|---|?|inf|+inf|-inf|infinity|-infinity|overflow|ovld|ovl|ol|\
                         overload|overrange|err|error|bad|invalid|fault|no data|nodata|missing|n.v.|k.a.|k. a.|keine angabe|\
                         #value!|#wert!|#div/0!|#num!|#zahl!|#ref!|#bezug!|#n/a|#nv|#name?|#null!|#####|1.#qnan|1.#ind|\
                         -1.#ind|1.#inf|-1.#inf|欠測";

/// Whether the cell says that there is no value.
pub fn is_no_value(text: &str) -> bool {
    let text = text.to_lowercase();
    NO_VALUES.split('|').any(|word| word == text)
}

/// Whether the cell is a bare number in some notation.
pub fn is_number(text: &str) -> bool {
    let of = |decimal| number(text, decimal).is_some_and(|number| number.unit.is_empty());
    of(Decimal::Point) || of(Decimal::Comma)
}

/// A finite number, its digits as a program reads them, and the unit that follows it.
#[derive(Debug, PartialEq)]
pub struct Number<'c> {
    pub value: f64,
    pub digits: String,
    pub unit: &'c str,
}

/// The number in `text`.
pub fn number(text: &str, decimal: Decimal) -> Option<Number<'_>> {
    let text = text.trim_start_matches('\'');
    let written = written(text);
    let digits = plain(written, decimal)?;
    let value: f64 = digits.parse().ok()?;
    let unit = text[written.len()..].trim();
    value.is_finite().then_some(Number { value, digits, unit })
}

/// The digits and signs at the beginning of a text.
fn written(text: &str) -> &str {
    let part = |c: char| c.is_ascii_digit() || "+-−.,'’eE".contains(c) || c.is_whitespace();
    let end = text.find(|c: char| !part(c)).unwrap_or(text.len());
    let digits = match text[..end].rsplit_once(char::is_whitespace) {
        // As in 1/K.
        Some((digits, "1")) if text[end..].starts_with('/') => digits,
        _ => &text[..end],
    };
    digits.trim_end_matches(|c: char| !c.is_ascii_digit() && !".,".contains(c))
}

/// The digits as a program reads them, without signs between groups of three.
fn plain(digits: &str, decimal: Decimal) -> Option<String> {
    let (point, group) = match decimal {
        Decimal::Point => ('.', ','),
        Decimal::Comma => (',', '.'),
    };
    let digits = digits.replace('−', "-");
    let (whole, fraction) = match digits.split_once(point) {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (&*digits, None),
    };
    let is_group = |c: char| c == group || c == '\'' || c == '’' || (c.is_whitespace() && c != '\t');
    let mut parts = whole.split(is_group);
    let mut plain = parts.next()?.to_owned();
    let first = plain.trim_start_matches(['+', '-']).len();
    for part in parts {
        // The last group may carry an exponent.
        let three = part.bytes().take_while(u8::is_ascii_digit).count() == 3;
        if !three || !(1..=3).contains(&first) {
            return None;
        }
        plain += part;
    }
    if let Some(fraction) = fraction {
        plain.push('.');
        plain += fraction;
    }
    Some(plain)
}

/// What a cell says of the decimal sign of its column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Nothing: it is no number, or has no such sign.
    Silent,
    Certain(Decimal),
    /// One sign before three digits: decimals or thousands.
    Doubtful,
}

/// What `cell` says.
pub fn sign(cell: &str) -> Sign {
    let cell = cell.trim_start_matches('\'');
    if !cell.starts_with(|c: char| c.is_ascii_digit() || "+-−.,".contains(c)) {
        return Sign::Silent;
    }
    let digits = written(cell);
    let (commas, points) = (digits.matches(',').count(), digits.matches('.').count());
    let single = |sign: char, decimal, other| {
        let (whole, rest) = digits.split_once(sign).unwrap_or((digits, ""));
        let whole = whole.trim_start_matches(['+', '-', '−']);
        if rest.contains(sign) {
            // Thousands only.
            return Sign::Certain(other);
        }
        let three = rest.len() == 3 && rest.bytes().all(|byte| byte.is_ascii_digit());
        let may_be_thousands = three && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
        if may_be_thousands {
            Sign::Doubtful
        } else {
            Sign::Certain(decimal)
        }
    };
    match (commas, points) {
        (0, 0) => Sign::Silent,
        (_, 0) => single(',', Decimal::Comma, Decimal::Point),
        (0, _) => single('.', Decimal::Point, Decimal::Comma),
        _ if digits.rfind(',') > digits.rfind('.') => Sign::Certain(Decimal::Comma),
        _ => Sign::Certain(Decimal::Point),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_in_every_notation() {
        let (point, comma) = (Decimal::Point, Decimal::Comma);
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
            let found = number(text, decimal).map(|number| (number.value, number.unit));
            assert_eq!(found, Some((value, unit)), "{text}");
        }
        for text in [
            "", "N", "1,23.4", "12,3456", "1.2.3", "--1", "1e999", "1 2", "1234,567",
        ] {
            assert!(number(text, point).is_none(), "{text}");
        }
    }

    #[test]
    fn a_cell_tells_the_decimal_sign_or_is_doubtful() {
        let (point, comma) = (Sign::Certain(Decimal::Point), Sign::Certain(Decimal::Comma));
        for (cell, says) in [
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
            ("1,113", Sign::Doubtful),
            ("1.200 m", Sign::Doubtful),
            ("-1.200", Sign::Doubtful),
            ("12", Sign::Silent),
            ("a.b", Sign::Silent),
        ] {
            assert_eq!(sign(cell), says, "{cell}");
        }
    }
}
