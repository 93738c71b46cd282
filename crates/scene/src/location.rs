//! Where something is written, and how to show it.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::shown::shortened;

/// Longest piece of a line that is shown \[characters\].
const LONGEST_EXCERPT: usize = 120;
/// Longest name of a file, or text of an override, that is shown \[characters\].
const LONGEST_NAME: usize = 300;

/// A text and what it is called.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Source {
    pub name: String,
    pub text: String,
    pub kind: SourceKind,
}

impl Source {
    pub fn new(kind: SourceKind, name: &str, text: &str) -> Arc<Self> {
        let [name, text] = [name, text].map(str::to_owned);
        Arc::new(Self { name, text, kind })
    }
}

#[derive(Debug, Default, PartialEq, Eq)]
pub enum SourceKind {
    File,
    Preset,
    #[default]
    Override,
}

/// A place in a scene file, a preset or an override.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Location {
    pub(crate) source: Arc<Source>,
    /// `None` for the end of the text, where what it lacks would be added.
    pub(crate) bytes: Option<Range<usize>>,
}

impl Location {
    /// Any range is fine: what lies outside the text is cut off.
    pub(crate) fn new(source: &Arc<Source>, bytes: Range<usize>) -> Self {
        let (source, bytes) = (source.clone(), Some(bytes));
        Self { source, bytes }
    }

    /// The file, `preset NAME` for a preset, or `--set KEY=VALUE` for an override.
    pub fn file(&self) -> &str {
        &self.source.name
    }

    /// Line number from 1, in a file.
    pub fn line(&self) -> Option<usize> {
        let above = &self.source.text[..self.beginning()];
        (self.source.kind == SourceKind::File).then(|| 1 + above.matches('\n').count())
    }

    /// The line.
    pub fn text(&self) -> &str {
        let line = self.source.text[self.beginning()..].lines().next();
        line.unwrap_or_default().trim_end_matches('\r')
    }

    /// The first byte of its line.
    fn beginning(&self) -> usize {
        let before = &self.source.text[..self.start()];
        before.rfind('\n').map_or(0, |end| end + 1)
    }

    /// Its first byte in the text.
    fn start(&self) -> usize {
        let text = &self.source.text;
        let start = self.bytes.as_ref().map(|bytes| bytes.start.min(text.len()));
        let mut places = (0..=start.unwrap_or(text.trim_end().len())).rev();
        places.find(|&at| text.is_char_boundary(at)).unwrap_or(0)
    }

    /// The line with its number and the faulty part underlined; it begins with a line break.
    pub fn excerpt(&self) -> String {
        let (text, begin) = (self.text(), self.beginning());
        let Some(bytes) = self.bytes.as_ref().filter(|_| !text.trim().is_empty()) else {
            return String::new();
        };
        // At least one character is marked, or the end of the line.
        let start = (self.start() - begin).min(text.len());
        let first = text[start..].chars().next().map_or(0, char::len_utf8);
        let end = bytes.end.saturating_sub(begin).max(start + first);
        // Of a very long line the part around the mark is shown.
        let before = text[..start].chars().count();
        let skipped = before.saturating_sub(LONGEST_EXCERPT * 3 / 4);
        let (mut shown, mut marks) = (String::new(), String::new());
        for (at, c) in text.char_indices().skip(skipped).take(LONGEST_EXCERPT) {
            shown.push(if c.is_control() { ' ' } else { c });
            let mark = if (start..end).contains(&at) { "^" } else { " " };
            // Chinese, Japanese and Korean characters take two columns of a terminal.
            let wide = matches!(c, '\u{1100}'..='\u{115f}' | '\u{2e80}'..='\u{d7a3}' | '\u{f900}'..='\u{ff60}' | '\u{ffe0}'..='\u{ffe6}');
            marks += &mark.repeat(1 + usize::from(wide));
        }
        if start == text.len() {
            marks.push('^');
        }
        if text.chars().count() > skipped + LONGEST_EXCERPT {
            shown.push('…');
        }
        let number = self.line().map_or_else(String::new, |line| line.to_string());
        let (margin, marks) = (" ".repeat(number.len()), marks.trim_end());
        format!("\n{margin} |\n{number} | {shown}\n{margin} | {marks}")
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // An override stands here as it was written.
        f.write_str(&shortened(self.file(), LONGEST_NAME))?;
        self.line().map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

/// What stands behind a key with numbers from 0, counted from 1 as people do: ` (vehicle 1, wheel 2)` behind `vehicles.0.wheels.1.load`;
/// nothing behind other keys.
pub(crate) fn counted(key: &str) -> String {
    let names = [
        ("layers", "layer"),
        ("restraints", "clamp"),
        ("vehicles", "vehicle"),
        ("wheels", "wheel"),
    ];
    let parts: Vec<&str> = key.split('.').collect();
    let item = |pair: &[&str]| {
        let (_, name) = names.iter().find(|(list, _)| *list == pair[0])?;
        let number = pair[1].parse::<usize>().ok()?.checked_add(1)?;
        Some(format!("{name} {number}"))
    };
    let items: Vec<String> = parts.windows(2).filter_map(item).collect();
    if items.is_empty() {
        String::new()
    } else {
        format!(" ({})", items.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(text: &str, bytes: Range<usize>) -> Location {
        Location::new(&Source::new(SourceKind::File, "f", text), bytes)
    }

    #[test]
    fn the_marks_stand_below_the_faulty_part() {
        let text = "a = 1\r\n\tb = { 名 = \"x\" } # c\r\n";
        let start = text.find('"').unwrap();
        let location = place(text, start..start + 3);
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
                place(text, start..end).excerpt();
            }
        }
        assert_eq!(place("", 0..0).line(), Some(1));
    }

    #[test]
    fn a_long_line_is_cut() {
        let text = format!("{}!{}", "x".repeat(5000), "y".repeat(5000));
        let excerpt = place(&text, 5000..5001).excerpt();
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
