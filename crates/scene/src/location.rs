//! Where something is written, and how to show it.

use std::fmt;
use std::ops::Range;

use crate::shown::shortened;

/// Longest piece of a line that is shown \[characters\].
const LONGEST_EXCERPT: usize = 120;
/// Longest name of a file, or text of an override, that is shown \[characters\].
const LONGEST_NAME: usize = 300;

/// A place in a scene file or in an override.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Location {
    /// The file, or `--set KEY=VALUE` for an override.
    pub file: String,
    /// Line number from 1; `None` in an override.
    pub line: Option<usize>,
    /// The line.
    pub text: String,
    /// The faulty part of the line \[bytes\].
    pub marked: Range<usize>,
}

impl Location {
    /// The place of the bytes `span` in `text`. Every span is fine: what lies outside the text is cut off.
    pub(crate) fn new(file: &str, text: &str, span: Range<usize>, numbered: bool) -> Self {
        let mut places = (0..=span.start.min(text.len())).rev();
        let start = places.find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        let begin = text[..start].rfind('\n').map_or(0, |end| end + 1);
        let line = text[begin..].lines().next().unwrap_or_default();
        let line = line.trim_end_matches('\r');
        let start = (start - begin).min(line.len());
        // At least one character is marked, or the end of the line.
        let first = line[start..].chars().next().map_or(0, char::len_utf8);
        let end = span.end.saturating_sub(begin).clamp(start + first, line.len());
        Self {
            file: file.to_owned(),
            line: numbered.then(|| 1 + text[..begin].matches('\n').count()),
            text: line.to_owned(),
            marked: start..end,
        }
    }

    /// The line with its number and the faulty part underlined; it begins with a line break.
    pub fn excerpt(&self) -> String {
        if self.text.trim().is_empty() {
            return String::new();
        }
        // Of a very long line the part around the mark is shown.
        let before = self.text[..self.marked.start].chars().count();
        let skipped = before.saturating_sub(LONGEST_EXCERPT * 3 / 4);
        let (mut shown, mut marks) = (String::new(), String::new());
        for (at, c) in self.text.char_indices().skip(skipped).take(LONGEST_EXCERPT) {
            shown.push(if c.is_control() { ' ' } else { c });
            let mark = if self.marked.contains(&at) { "^" } else { " " };
            // Chinese, Japanese and Korean characters take two columns of a terminal.
            let wide = matches!(c, '\u{1100}'..='\u{115f}' | '\u{2e80}'..='\u{d7a3}' | '\u{f900}'..='\u{ff60}' | '\u{ffe0}'..='\u{ffe6}');
            marks += &mark.repeat(1 + usize::from(wide));
        }
        if self.marked.start == self.text.len() {
            marks.push('^');
        }
        if self.text.chars().count() > skipped + LONGEST_EXCERPT {
            shown.push('…');
        }
        let number = self.line.map_or_else(String::new, |line| line.to_string());
        let (margin, marks) = (" ".repeat(number.len()), marks.trim_end());
        format!("\n{margin} |\n{number} | {shown}\n{margin} | {marks}")
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // An override stands here as it was written.
        f.write_str(&shortened(&self.file, LONGEST_NAME))?;
        self.line.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

/// What stands behind a key with numbers from 0, counted from 1 as people do: ` (vehicle 1, wheel 2)` behind `vehicles.0.wheels.1.load`;
/// nothing behind other keys.
pub(crate) fn counted(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    let item = |pair: &[&str]| {
        let names = [
            ("layers", "layer"),
            ("restraints", "clamp"),
            ("vehicles", "vehicle"),
            ("wheels", "wheel"),
        ];
        let (_, name) = names.into_iter().find(|(list, _)| *list == pair[0])?;
        let number = pair[1].parse::<usize>().ok()?.checked_add(1)?;
        Some(format!("{name} {number}"))
    };
    let items: Vec<String> = parts.windows(2).filter_map(item).collect();
    match &items[..] {
        [] => String::new(),
        items => format!(" ({})", items.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{Location, counted};

    #[test]
    fn the_marks_stand_below_the_faulty_part() {
        let text = "a = 1\r\n\tb = { 名 = \"x\" } # c\r\n";
        let start = text.find('"').unwrap();
        let location = Location::new("f", text, start..start + 3, true);
        assert_eq!(location.to_string(), "f, line 2");
        assert_eq!(
            location.excerpt(),
            "\n  |\n2 |  b = { 名 = \"x\" } # c\n  |             ^^^"
        );
    }

    #[test]
    fn any_span_has_a_location() {
        let text = "長さ = 1\nb";
        for start in 0..text.len() + 3 {
            for end in 0..text.len() + 3 {
                Location::new("f", text, start..end, true).excerpt();
            }
        }
        assert_eq!(Location::new("f", "", 0..0, true).line, Some(1));
    }

    #[test]
    fn a_long_line_is_cut() {
        let text = format!("{}!{}", "x".repeat(5000), "y".repeat(5000));
        let excerpt = Location::new("f", &text, 5000..5001, true).excerpt();
        assert!(excerpt.len() < 300 && excerpt.contains("xx!yy"));
    }

    #[test]
    fn items_are_counted_from_one() {
        for (key, words) in [
            ("vehicles.0.wheels.1.load", " (vehicle 1, wheel 2)"),
            ("ground.layers.2.thickness", " (layer 3)"),
            ("restraints.0", " (clamp 1)"),
            ("vehicles", ""),
            ("vehicles.name", ""),
            ("vehicles.18446744073709551615", ""),
        ] {
            assert_eq!(counted(key), words, "{key}");
        }
    }
}
