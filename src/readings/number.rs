//! Numbers as spreadsheets and data loggers write them.

use super::options::Decimal;

/// What instruments and spreadsheets write where there is no number.
const NO_NUMBERS: &[&str] = &[
    "nan",
    "na",
    "n/a",
    "#n/a",
    "#nv",
    "null",
    "none",
    "-",
    "--",
    "---",
    "?",
    "inf",
    "+inf",
    "-inf",
    "infinity",
    "-infinity",
    "overflow",
    "ol",
    "err",
    "error",
    "#value!",
    "#wert!",
    "#div/0!",
    "#num!",
    "#zahl!",
    "#ref!",
    "#bezug!",
];

/// Whether the cell says that there is no number.
pub fn is_unusable(text: &str) -> bool {
    NO_NUMBERS.iter().any(|none| text.eq_ignore_ascii_case(none))
}

/// The finite number, and the unit that follows it.
pub fn number(text: &str, decimal: Decimal) -> Option<(f64, &str)> {
    let text = text.trim_start_matches('\'');
    let part = |c: char| c.is_ascii_digit() || "+-−.,'’eE".contains(c) || c.is_whitespace();
    let end = text.find(|c: char| !part(c)).unwrap_or(text.len());
    let digits = text[..end].trim_end_matches(|c: char| !c.is_ascii_digit() && !".,".contains(c));
    let value: f64 = plain(digits, decimal)?.parse().ok()?;
    value.is_finite().then(|| (value, text[digits.len()..].trim()))
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

/// What the cells say of the decimal sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    Certain(Decimal),
    /// Commas before three digits: decimals or thousands.
    Doubtful,
}

/// The decimal sign by what the cells show; a point where nothing speaks against it.
pub fn decimal_sign<'c>(cells: impl Iterator<Item = &'c str>) -> Sign {
    let mut doubtful = false;
    for cell in cells.filter(|cell| cell.starts_with(|c: char| c.is_ascii_digit() || "+-−.,'".contains(c)))
    {
        let count = |sign: char| cell.matches(sign).count();
        let after = |sign: char| {
            let rest = cell.rsplit(sign).next().unwrap_or("");
            rest.bytes().take_while(u8::is_ascii_digit).count()
        };
        match (count(','), count('.')) {
            (0, _) => {}
            (1, 0) if after(',') != 3 || cell.starts_with("0,") || cell.starts_with("-0,") => {
                return Sign::Certain(Decimal::Comma);
            }
            (1, 0) => doubtful = true,
            (1, _) if cell.rfind(',') > cell.rfind('.') => return Sign::Certain(Decimal::Comma),
            _ => return Sign::Certain(Decimal::Point),
        }
    }
    if doubtful {
        Sign::Doubtful
    } else {
        Sign::Certain(Decimal::Point)
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
            ("5.", point, 5.0, ""),
            (".5", point, 0.5, ""),
        ] {
            assert_eq!(number(text, decimal), Some((value, unit)), "{text}");
        }
        for text in [
            "", "N", "1,23.4", "12,3456", "1.2.3", "--1", "1e999", "1 2", "1234,567",
        ] {
            assert!(number(text, point).is_none(), "{text}");
        }
    }

    #[test]
    fn one_clear_cell_tells_the_decimal_sign() {
        let of = |cells: &[&'static str]| decimal_sign(cells.iter().copied());
        assert_eq!(of(&["1", "94.1"]), Sign::Certain(Decimal::Point));
        assert_eq!(of(&["1,234", "94,1"]), Sign::Certain(Decimal::Comma));
        assert_eq!(of(&["1.234,5"]), Sign::Certain(Decimal::Comma));
        assert_eq!(of(&["1,234.5", "1,234"]), Sign::Certain(Decimal::Point));
        assert_eq!(of(&["0,113"]), Sign::Certain(Decimal::Comma));
        assert_eq!(of(&["1,113", "2,450"]), Sign::Doubtful);
    }
}
