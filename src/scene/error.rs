//! What can be wrong with a scene, and where.

use std::fmt;
use std::ops::Range;
use std::string::FromUtf8Error;

use ground_field::GroundError;

/// Longest piece of a line that is shown \[characters\].
const LONGEST_EXCERPT: usize = 120;

/// What is wrong with a scene. The message ends with the faulty line, marked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        source: std::io::Error,
    },
    /// The file is far larger than any scene.
    #[error("{file}: found {found} bytes; allowed: a scene file of at most {allowed} bytes")]
    TooLarge {
        /// The file.
        file: String,
        /// Its size \[bytes\].
        found: u64,
        /// Largest size allowed \[bytes\].
        allowed: u64,
    },
    /// The file is not UTF-8 text.
    #[error("{location}: found text that is not UTF-8; allowed: UTF-8, with or without byte order mark{}", .location.excerpt())]
    NotUtf8 {
        /// Where.
        location: Box<Location>,
    },
    /// The file is not TOML.
    #[error("{location}: not valid TOML: {message}{}", .location.excerpt())]
    Syntax {
        /// Where.
        location: Box<Location>,
        /// What is wrong.
        message: String,
    },
    /// An override is not `KEY=VALUE`, or there is nothing at its key.
    #[error("{location}: `{key}`: found {found}; allowed: {allowed}{}", .location.excerpt())]
    Override {
        /// Where.
        location: Box<Location>,
        /// The key that it meant to set.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A key that is not known.
    #[error("{location}: found unknown key `{key}`{}; allowed: {allowed}{}", did_you_mean(.suggestion.as_deref()), .location.excerpt())]
    UnknownKey {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// The known keys.
        allowed: String,
        /// The nearest known key.
        suggestion: Option<String>,
    },
    /// A required key is not there.
    #[error("{location}: key `{key}` is missing; allowed: {allowed}{}", .location.excerpt())]
    MissingKey {
        /// The section that lacks it.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What is allowed.
        allowed: String,
    },
    /// A value of the wrong kind, such as a text where a list belongs.
    #[error("{location}: `{key}`: found {found}; allowed: {allowed}{}", .location.excerpt())]
    WrongType {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A number in quotes without a unit.
    #[error("{location}: `{key}`: missing unit: found {found}; allowed: {allowed}{}", .location.excerpt())]
    MissingUnit {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A unit that is not known.
    #[error("{location}: `{key}`: unknown unit `{unit}`: found {found}{}; allowed: {allowed}{}", did_you_mean(*.suggestion), .location.excerpt())]
    UnknownUnit {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// The unit as written.
        unit: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
        /// The nearest unit that is allowed.
        suggestion: Option<&'static str>,
    },
    /// A unit of another dimension.
    #[error("{location}: `{key}`: wrong dimension: found {found}, {dimension}; allowed: {allowed}{}", .location.excerpt())]
    WrongDimension {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// The dimension that was found, in words.
        dimension: &'static str,
        /// What is allowed.
        allowed: String,
    },
    /// A value outside its range, or not a finite number.
    #[error("{location}: `{key}`: out of range: found {found}; allowed: {allowed}{}", .location.excerpt())]
    OutOfRange {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A word that is not one of the allowed ones.
    #[error("{location}: `{key}`: found {found}{}; allowed: {allowed}{}", did_you_mean(.suggestion.as_deref()), .location.excerpt())]
    UnknownWord {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// The allowed words.
        allowed: String,
        /// The nearest of them.
        suggestion: Option<String>,
    },
    /// A value that contradicts another one.
    #[error("{location}: `{key}`: found {found}; allowed: {allowed}{}", .location.excerpt())]
    Inconsistent {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// The ground or a vehicle cannot be built from these values.
    #[error("{location}: `{key}`: {source}{}", .location.excerpt())]
    Rejected {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// Why.
        source: GroundError,
    },
}

fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |word| format!("; did you mean `{word}`?"))
}

/// A place in a scene file or in an override.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Location {
    /// The file, or `--set KEY=VALUE` for an override.
    pub file: String,
    /// Line number from 1; `None` in an override.
    pub line: Option<usize>,
    /// The line.
    pub text: String,
    /// The faulty part of the line \[bytes\]; empty where there is nothing to mark.
    pub marked: Range<usize>,
}

impl Location {
    /// The place of the bytes `span` in `text`. Every span is fine: what lies outside the text is cut off.
    #[expect(
        clippy::unnecessary_box_returns,
        reason = "errors hold it boxed, to stay small"
    )]
    pub(super) fn new(file: &str, text: &str, span: Range<usize>, numbered: bool) -> Box<Self> {
        let bytes = text.as_bytes();
        let start = span.start.min(bytes.len());
        let line_start = bytes[..start]
            .iter()
            .rposition(|&b| b == b'\n')
            .map_or(0, |i| i + 1);
        let line_end = bytes[start..]
            .iter()
            .position(|&b| b == b'\n')
            .map_or(bytes.len(), |i| start + i);
        let line = text
            .get(line_start..line_end)
            .unwrap_or_default()
            .trim_end_matches('\r');
        let start = (start - line_start).min(line.len());
        let end = span.end.saturating_sub(line_start).clamp(start, line.len());
        let number = 1 + text.get(..line_start).unwrap_or_default().matches('\n').count();
        Box::new(Self {
            file: file.to_owned(),
            line: numbered.then_some(number),
            text: line.to_owned(),
            marked: start..end,
        })
    }

    /// The line with its number and the faulty part underlined; it begins with a line break.
    pub(super) fn excerpt(&self) -> String {
        if self.text.trim().is_empty() {
            return String::new();
        }
        let mut shown = String::new();
        let mut marks = String::new();
        let before = self
            .text
            .get(..self.marked.start)
            .unwrap_or_default()
            .chars()
            .count();
        // A very long line is shown from shortly before the mark.
        let skipped = before.saturating_sub(LONGEST_EXCERPT / 2);
        for (count, (offset, c)) in self.text.char_indices().skip(skipped).enumerate() {
            if count == LONGEST_EXCERPT {
                shown.push('…');
                break;
            }
            let mark = if self.marked.contains(&offset) { '^' } else { ' ' };
            shown.push(match c {
                '\t' => ' ',
                c if c.is_control() => '\u{fffd}',
                c => c,
            });
            marks.extend(std::iter::repeat_n(mark, columns(c)));
        }
        let number = self.line.map_or_else(String::new, |line| line.to_string());
        let margin = " ".repeat(number.len());
        let marks = marks.trim_end();
        let last = if marks.is_empty() {
            String::new()
        } else {
            format!("\n{margin} | {marks}")
        };
        format!("\n{margin} |\n{number} | {shown}{last}")
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        self.line.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

/// Columns a character takes on a terminal: Chinese, Japanese and Korean characters take two.
fn columns(c: char) -> usize {
    match c {
        '\u{1100}'..='\u{115f}'
        | '\u{2e80}'..='\u{a4cf}'
        | '\u{ac00}'..='\u{d7a3}'
        | '\u{f900}'..='\u{faff}'
        | '\u{fe30}'..='\u{fe6f}'
        | '\u{ff00}'..='\u{ff60}'
        | '\u{ffe0}'..='\u{ffe6}' => 2,
        _ => 1,
    }
}

/// The error for a file whose bytes are not UTF-8.
pub(super) fn not_utf8(file: &str, error: &FromUtf8Error) -> SceneError {
    let valid = error.utf8_error().valid_up_to();
    let text = String::from_utf8_lossy(error.as_bytes());
    SceneError::NotUtf8 {
        location: Location::new(file, &text, valid..valid, true),
    }
}

impl SceneError {
    /// Where the scene is wrong; `None` if its file cannot be read at all.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Unreadable { .. } | Self::TooLarge { .. } => None,
            Self::NotUtf8 { location }
            | Self::Syntax { location, .. }
            | Self::Override { location, .. }
            | Self::UnknownKey { location, .. }
            | Self::MissingKey { location, .. }
            | Self::WrongType { location, .. }
            | Self::MissingUnit { location, .. }
            | Self::UnknownUnit { location, .. }
            | Self::WrongDimension { location, .. }
            | Self::OutOfRange { location, .. }
            | Self::UnknownWord { location, .. }
            | Self::Inconsistent { location, .. }
            | Self::Rejected { location, .. } => Some(location),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Location;

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
}
