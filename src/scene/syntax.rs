//! What is wrong with a file that is not TOML: where, and what was probably meant.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys;
use super::location::line_start;
use super::openings::openings;

pub struct Fault {
    pub span: Range<usize>,
    pub message: String,
}

/// Why the parser gave up on `text`, and where that was written.
pub fn fault(text: &str, error: &toml::de::Error) -> Fault {
    let openings = openings(text);
    // The parser does not say where keys are nested too deep.
    let (span, too_deep) = (error.span(), openings.too_deep);
    let Some(span) = span.filter(|_| too_deep.is_none() || !error.message().contains("recurs")) else {
        let start = too_deep.unwrap_or_default();
        let message = "keys or brackets inside each other, deeper than in any scene".into();
        return Fault {
            span: start..start,
            message,
        };
    };
    if let Some(opening) = openings.unclosed
        && line_start(text, opening.start) < line_start(text, span.start)
    {
        let message = format!("`{}` is not closed", &text[opening.clone()]);
        return Fault {
            span: opening,
            message,
        };
    }
    let start = line_start(text, span.start);
    let line = text[start..].lines().next().unwrap_or_default();
    let message = if error.message() == "duplicate key"
        && let Some(first) = first_line(text, &span)
    {
        let listed = text
            .lines()
            .nth(first - 1)
            .is_some_and(|line| line.trim().starts_with("[["));
        let another = match line.trim() {
            header if listed && header.ends_with(']') => {
                format!("; another item of the list is written [{header}]")
            }
            _ => String::new(),
        };
        format!("duplicate key, which stands on line {first} already{another}")
    } else if text.trim_start().starts_with('{') {
        "this is JSON; a scene has lines such as length = \"30 m\"".to_owned()
    } else if is_table(text) {
        "this is a table; a scene has lines such as length = \"30 m\"".to_owned()
    } else {
        hint(line).unwrap_or_else(|| in_plain_words(error.message()).to_owned())
    };
    Fault { span, message }
}

/// What the parser says, in the words of those who do not know it.
fn in_plain_words(message: &str) -> &str {
    const WORDS: [(&str, &str); 13] = [
        (
            "string values must be quoted",
            "behind `=` stands a number, or a text in quotes",
        ),
        (
            "unexpected key or value",
            "nothing but a comment, which begins with `#`, stands behind a value",
        ),
        (
            "key with no value",
            "a line has a key, `=` and a value, such as length = \"30 m\"",
        ),
        ("unquoted keys cannot be empty", "the key before `=` is missing"),
        (
            "invalid unquoted key",
            "a key has only the letters a to z, digits, `_` and `-`",
        ),
        ("extra `=`", "there is one `=` too many"),
        (
            "unclosed table",
            "the closing bracket is missing: a section is written [duct]",
        ),
        (
            "unclosed array table",
            "a closing bracket is missing: an item of a list is written [[vehicles]]",
        ),
        (
            "missing escaped value",
            "in double quotes `\\` has a meaning of its own: write `/`, or single quotes",
        ),
        ("invalid mantissa", "a digit stands before a decimal point: 0.5"),
        ("invalid fraction", "a digit stands behind a decimal point: 5.0"),
        (
            "unexpected leading zero",
            "a number does not begin with a zero that counts nothing",
        ),
        ("invalid float", "this is no number"),
    ];
    let known = WORDS.iter().find(|(begins, _)| message.starts_with(begins));
    known.map_or(message, |(_, words)| words)
}

/// The line on which the key at `second` stands for the first time.
fn first_line(text: &str, second: &Range<usize>) -> Option<usize> {
    let start = line_start(text, second.start);
    let name = |line: &str| {
        let header = line.split('#').next().unwrap_or_default();
        header.trim().trim_matches(['[', ']']).trim().to_owned()
    };
    let wanted = text[start..].lines().next().map(name);
    let same = |line: &str| line.trim_start().starts_with('[') && Some(name(line)) == wanted;
    let first = if text[start..second.start].trim_start().starts_with('[') {
        text[..start].lines().position(same)?
    } else {
        text[..first_key(text, second)?].matches('\n').count()
    };
    Some(1 + first)
}

/// Where the key at `second` stands for the first time: the last one of its name before it, behind the same beginning of a line.
fn first_key(text: &str, second: &Range<usize>) -> Option<usize> {
    fn collect(table: &DeTable, keys: &mut Vec<(String, usize)>) {
        for (key, value) in table {
            keys.push((key.get_ref().clone().into_owned(), key.span().start));
            inside(value, keys);
        }
    }
    fn inside(value: &Spanned<DeValue>, keys: &mut Vec<(String, usize)>) {
        match value.get_ref() {
            DeValue::Table(table) => collect(table, keys),
            DeValue::Array(items) => items.iter().for_each(|item| inside(item, keys)),
            _ => {}
        }
    }
    let mut keys = Vec::new();
    collect(DeTable::parse_recoverable(text).0.get_ref(), &mut keys);
    let name = text.get(second.clone())?.trim_matches(['"', '\'']);
    let before = |at: usize| text[line_start(text, at)..at].trim();
    keys.into_iter()
        .filter(|(key, start)| key == name && *start < second.start)
        .map(|(_, start)| start)
        .filter(|&start| {
            line_start(text, start) == line_start(text, second.start) || before(start) == before(second.start)
        })
        .max()
}

/// Whether the text begins like a table of readings or of ducts: cells between commas, semicolons or tabs, and no key.
fn is_table(text: &str) -> bool {
    let mut lines = text
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let like_a_row = |line: &str| line.contains([',', ';', '\t']) && !line.contains(['=', '[', '"', ':']);
    lines.next().is_some_and(like_a_row)
}

/// A hint for `line` of a scene file: a comment of another language, a section without brackets, a decimal comma, a text or a quantity
/// without quotes, typographic quotes, a colon or nothing in place of `=`.
fn hint(line: &str) -> Option<String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    if let Some(mark) = ["//", "/*", ";", "%", "--", "!"]
        .iter()
        .find(|mark| line.trim().starts_with(**mark))
    {
        return Some(format!("a comment begins with `#`, not with `{mark}`"));
    }
    let Some((key, value)) = line.split_once('=') else {
        let line = line.split('#').next()?.trim();
        if keys::holds(keys::of(""), line) {
            return Some(format!("a section stands in brackets: [{line}]"));
        }
        let (key, value) = line.split_once([':', '→']).or_else(|| line.split_once(' '))?;
        let (key, value) = (key.trim(), value.trim());
        let is_value = line.contains([':', '→'])
            || value.starts_with(['"', '\'', '{', '['])
            || value.parse::<f64>().is_ok();
        return (!key.is_empty() && !value.is_empty() && key.chars().all(plain) && is_value)
            .then(|| both_sides(key, value));
    };
    let (key, value) = (key.trim(), value.split('#').next()?.trim());
    if let Some(key) = key.strip_suffix(':') {
        return Some(both_sides(key.trim_end(), value));
    }
    if value.is_empty() {
        return Some(format!("the value is missing: {key} = …"));
    }
    let is_own_line = key.chars().all(plain) && !value.contains(['[', '{', '}', ']']);
    if let Some(value) = value.strip_suffix([',', ';']).filter(|_| is_own_line) {
        return Some(format!("nothing stands at the end of a line: {key} = {value}"));
    }
    if value.contains(SMART_QUOTES) {
        let straight = value.replace(SMART_QUOTES, "\"");
        return Some(format!("“ and ” are not TOML's quotes: {key} = {straight}"));
    }
    for quote in ['"', '\''] {
        let which = if value.starts_with(quote) {
            "closing"
        } else {
            "opening"
        };
        if value.matches(quote).count() == 1 && (value.starts_with(quote) || value.ends_with(quote)) {
            let value = value.trim_matches(quote);
            return Some(format!(
                "the {which} quote is missing: {key} = {quote}{value}{quote}"
            ));
        }
    }
    let number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
    if value.contains(['"', '\'']) {
        return None;
    }
    if !number {
        let is_text = value.starts_with(char::is_alphabetic)
            && value
                .chars()
                .all(|c| c.is_alphanumeric() || " _-.,()/".contains(c));
        return is_text.then(|| format!("a text stands in quotes: {key} = \"{value}\""));
    }
    if value.contains("..") {
        return Some("a key has one value; `creepage sweep --vary KEY=A:B:STEP` computes a range".to_owned());
    }
    if let Some(point) = with_point(value) {
        let quotes = if point.parse::<f64>().is_ok() { "" } else { "\"" };
        let how = if point.contains('.') {
            "decimals are written with a point"
        } else {
            "nothing parts thousands"
        };
        let or = without_thousands(value).map_or_else(String::new, |whole| {
            format!(", or {quotes}{whole}{quotes} if the comma parts thousands")
        });
        return Some(format!("{how}: {key} = {quotes}{point}{quotes}{or}"));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    unit.then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
}

fn both_sides(key: &str, value: &str) -> String {
    format!("a key and its value stand on both sides of `=`: {key} = {value}")
}

/// Quotes of word processors and mail.
const SMART_QUOTES: [char; 5] = ['“', '”', '„', '‘', '’'];

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
    use super::{hint, with_point, without_thousands};

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
            (
                "length = “250 m”",
                "“ and ” are not TOML's quotes: length = \"250 m\"",
            ),
            (
                "length: \"250 m\"",
                "a key and its value stand on both sides of `=`: length = \"250 m\"",
            ),
            (
                "depth = \"1.2 m",
                "the closing quote is missing: depth = \"1.2 m\"",
            ),
            ("law = coulomb", "a text stands in quotes: law = \"coulomb\""),
            ("passes = 5,844,000", "nothing parts thousands: passes = 5844000"),
            (
                "depth 1.2 # m",
                "a key and its value stand on both sides of `=`: depth = 1.2",
            ),
            (
                "friction # of the cable",
                "a section stands in brackets: [friction]",
            ),
            ("// depth = 1", "a comment begins with `#`, not with `//`"),
        ];
        for (line, expected) in cases {
            assert_eq!(hint(line).as_deref(), Some(expected));
        }
        for line in ["depth", "see: ", "a b: c", "a b", "passes = 200", ""] {
            assert_eq!(hint(line), None, "{line}");
        }
    }
}
