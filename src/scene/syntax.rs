//! What was probably meant by a line that is not TOML.

/// A hint for `line` of a scene file: a decimal comma, or a quantity without quotes.
pub(super) fn hint(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let (key, value) = (key.trim(), value.split('#').next()?.trim());
    let number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
    if !number || value.contains(['"', '\'']) {
        return None;
    }
    if let Some(point) = with_point(value) {
        let quotes = if point.parse::<f64>().is_ok() { "" } else { "\"" };
        return Some(format!(
            "decimals are written with a point: {key} = {quotes}{point}{quotes}"
        ));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    unit.then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
}

/// A number written with commas, with or without a unit, as it is to be written here; `None` where there is no comma.
pub(super) fn with_point(text: &str) -> Option<String> {
    let digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_digit);
    let bytes = text.as_bytes();
    let commas: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i] == b',').collect();
    let between =
        |&at: &usize| digit(at.checked_sub(1).and_then(|i| bytes.get(i))) && digit(bytes.get(at + 1));
    if commas.is_empty() || !commas.iter().all(between) {
        return None;
    }
    // Two commas, or a comma before a point, part thousands.
    let thousands = commas.len() > 1 || text.contains('.');
    Some(text.replace(',', if thousands { "" } else { "." }))
}

#[cfg(test)]
mod tests {
    use super::{hint, with_point};

    #[test]
    fn commas_become_points_or_go() {
        assert_eq!(with_point("1,2 m").as_deref(), Some("1.2 m"));
        assert_eq!(with_point("-0,25").as_deref(), Some("-0.25"));
        assert_eq!(with_point("1,200,000 N").as_deref(), Some("1200000 N"));
        assert_eq!(with_point("1,200.5 N").as_deref(), Some("1200.5 N"));
        for text in ["1.2 m", ",", "1, 2", ",5", "5,", ""] {
            assert_eq!(with_point(text), None, "{text}");
        }
    }

    #[test]
    fn a_line_that_is_no_toml_gets_a_hint_where_one_is_known() {
        let cases = [
            ("depth = 1,2", "decimals are written with a point: depth = 1.2"),
            (
                "depth = 1,2 m # deep",
                "decimals are written with a point: depth = \"1.2 m\"",
            ),
            (
                "depth = 1.2 m",
                "a quantity with its unit stands in quotes: depth = \"1.2 m\"",
            ),
            (
                "tolerance = 5 %",
                "a quantity with its unit stands in quotes: tolerance = \"5 %\"",
            ),
        ];
        for (line, expected) in cases {
            assert_eq!(hint(line).as_deref(), Some(expected));
        }
        for line in ["depth = \"1.2 m", "depth", "law = coulomb", "passes = 200", ""] {
            assert_eq!(hint(line), None, "{line}");
        }
    }
}
