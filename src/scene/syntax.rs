//! Why a text is not TOML: what its parser says, with a hint for a quantity without quotes, a decimal comma, a range of values and a bracket
//! that is still open.

use std::ops::Range;

use super::location::line_start;

pub struct Fault {
    pub span: Range<usize>,
    pub message: String,
}

/// Why the parser gave up on `text`, and where.
pub fn fault(text: &str, error: &toml::de::Error) -> Fault {
    let mut span = error.span().unwrap_or_else(|| deepest_line(text));
    span.start = span.start.min(text.trim_end().len());
    let start = line_start(text, span.start);
    let message = match open_before(&text[..span.start]).filter(|&(_, at)| at < start) {
        Some((mark, at)) => {
            let line = 1 + text[..at].matches('\n').count();
            format!("{}; the `{mark}` of line {line} is open here", error.message())
        }
        None => hint(text[start..].lines().next().unwrap_or_default())
            .unwrap_or_else(|| error.message().to_owned()),
    };
    Fault { span, message }
}

/// The parser does not say where keys are nested too deep.
fn deepest_line(text: &str) -> Range<usize> {
    let points = |&line: &&str| line.matches('.').count();
    let deepest = text.lines().max_by_key(points).unwrap_or_default();
    let start = text.find(deepest).unwrap_or_default();
    start..start
}

/// The innermost bracket, or the quotes of a text of several lines, that `text` leaves open, and where it begins.
fn open_before(text: &str) -> Option<(&str, usize)> {
    let mut open = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find(['#', '"', '\'', '[', '{', ']', '}']) {
        let start = at + found;
        let rest = &text[start..];
        at = start
            + match rest.as_bytes()[0] {
                b'#' => rest.find('\n').unwrap_or(rest.len()),
                b'"' | b'\'' => {
                    let mark = if rest.starts_with("\"\"\"") || rest.starts_with("'''") {
                        3
                    } else {
                        1
                    };
                    let (quotes, content) = rest.split_at(mark);
                    match content_length(content, quotes) {
                        Some(length) => length + 2 * mark,
                        None => return Some((quotes, start)),
                    }
                }
                b'[' | b'{' => {
                    open.push(start);
                    1
                }
                _ => {
                    open.pop();
                    1
                }
            };
    }
    open.last().map(|&start| (&text[start..=start], start))
}

/// Length of the text in front of its closing quotes, if any.
fn content_length(content: &str, quotes: &str) -> Option<usize> {
    let escaped = |end: usize| content[..end].bytes().rev().take_while(|&b| b == b'\\').count() % 2 == 1;
    let mut ends = content.match_indices(quotes).map(|(end, _)| end);
    ends.find(|&end| quotes.starts_with('\'') || !escaped(end))
}

/// A hint for a line whose value is a range, a number with commas, or a number with its unit.
fn hint(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let (key, value) = (key.trim(), value.split('#').next()?.trim());
    if !value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-'))
        || value.contains(['"', '\''])
    {
        return None;
    }
    if value.contains("..") || value.contains(':') {
        return Some("a key has one value; `creepage sweep --vary KEY=A:B:STEP` computes a range".to_owned());
    }
    let quoted = |value: &str| match value.parse::<f64>() {
        Ok(_) => value.to_owned(),
        Err(_) => format!("\"{value}\""),
    };
    if let Some(point) = with_point(value) {
        let how = if point.contains('.') {
            "decimals are written with a point"
        } else {
            "numbers have no thousands separators"
        };
        let or = without_thousands(value).map_or_else(String::new, |whole| {
            format!(", or {} if the comma separates thousands", quoted(&whole))
        });
        return Some(format!("{how}: {key} = {}{or}", quoted(&point)));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    (unit && value.parse::<f64>().is_err())
        .then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
}

/// A number written with commas, with or without a unit, as it is to be written here; `None` where there is no comma.
pub fn with_point(text: &str) -> Option<String> {
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

/// A number whose only comma may also part thousands, `3,000 MPa`, without it.
pub fn without_thousands(text: &str) -> Option<String> {
    let (before, after) = text.split_once(',')?;
    let digits = after.bytes().take_while(u8::is_ascii_digit).count();
    let first = before.trim().trim_start_matches(['+', '-']);
    let groups = (1..=3).contains(&first.len()) && !first.starts_with('0') && digits == 3;
    (groups && !after.contains([',', '.'])).then(|| format!("{before}{after}"))
}

#[cfg(test)]
mod tests {
    use super::{open_before, with_point, without_thousands};

    #[test]
    fn only_a_comma_before_three_digits_may_part_thousands() {
        assert_eq!(without_thousands("3,000 MPa").as_deref(), Some("3000 MPa"));
        assert_eq!(without_thousands("-12,500").as_deref(), Some("-12500"));
        for text in [
            "3,00 m",
            "0,300 m",
            "3,0000 m",
            "1234,500 m",
            "3,000.5 m",
            "1,000,000",
            "3",
        ] {
            assert_eq!(without_thousands(text), None, "{text}");
        }
    }

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
    fn what_is_open_is_found_behind_texts_and_comments() {
        for (text, open) in [
            ("[a]\nb = [1, { c = \"]\" }] # [\n[[d]]\n", None),
            ("a = '''\n[\n'''\nb = \"[\\\"[\"\nc = 'C:\\'\n", None),
            ("a = 1\nb = [ { x = 1 },\n[c]\n", Some(("[", 10))),
            ("a = [1, 2]\nb = { c = [", Some(("[", 21))),
            ("a = '''\nb = 2\n[c]\n", Some(("'''", 4))),
        ] {
            assert_eq!(open_before(text), open, "{text}");
        }
    }
}
