//! Numbers with units, as they are varied.

pub(super) use creepage_scene::leading_number as number;
use creepage_scene::{Dimension, Unit};

/// What a dimension makes of a text, quotes around it apart; no unit belongs to two dimensions.
fn of_dimensions<T>(text: &str, read: impl Fn(Dimension, &str) -> Option<T>) -> Option<T> {
    let text = text.trim().trim_matches(['"', '\'']);
    Dimension::ALL.iter().find_map(|dimension| read(*dimension, text))
}

/// The SI value of a number with or without a unit; `None` for any other text.
pub fn si(text: &str) -> Option<f64> {
    let value = of_dimensions(text, |dimension, text| dimension.parse_argument(text).ok());
    value.filter(|value| value.is_finite())
}

/// The unit of a number with a unit.
pub fn unit(text: &str) -> Option<Unit> {
    of_dimensions(text, Dimension::unit_of)
}

/// Numbers and the one unit that all of them have, or all but none.
pub fn numbers<const N: usize>(texts: &[&str]) -> Option<([f64; N], String)> {
    let read: Option<Vec<(f64, &str)>> = texts.iter().map(|text| number(text)).collect();
    let (values, units): (Vec<f64>, Vec<&str>) = read?.into_iter().unzip();
    let unit = units.iter().find(|unit| !unit.is_empty());
    let unit = unit.copied().unwrap_or_default();
    let is_one = units.iter().all(|own| own.is_empty() || *own == unit);
    Some((values.try_into().ok().filter(|_| is_one)?, unit.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_on_like_a_number_is_no_number() {
        assert_eq!(number("1.2.3"), None);
        assert_eq!(number("1 2"), None);
        assert_eq!(number("1.2m"), Some((1.2, "m")));
    }

    #[test]
    fn values_with_units_become_si() {
        assert_eq!(si("2 m"), Some(2.0));
        assert_eq!(si("\"3 MN/m\""), Some(3e6));
        assert_eq!(si("0.25"), Some(0.25));
        for text in ["t-25", "fixed", "{ spring = 3 }", "nan", ""] {
            assert_eq!(si(text), None, "{text}");
        }
    }
}
