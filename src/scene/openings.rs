//! Where a bracket or a text of several lines was opened that is never closed, and where keys go too deep.
//!
//! A parser reports both where it gives up, lines later or not at all. This scan knows only quotes, comments and brackets; it
//! is asked after the parser has failed.

use std::ops::Range;

/// No key of a scene is deeper, list and table brackets included.
const DEEPEST: usize = 16;

#[derive(Debug, Default, PartialEq)]
pub struct Openings {
    /// The quotes or the bracket that are not closed.
    pub unclosed: Option<Range<usize>>,
    /// The first place that is deeper than any scene.
    pub too_deep: Option<usize>,
}

/// Scans `text` up to where the parser gave up; what is closed after that is closed.
pub fn openings(text: &str) -> Openings {
    let bytes = text.as_bytes();
    let mut found = Openings::default();
    // Brackets that are open, and the points in the key that is being read.
    let mut open: Vec<usize> = Vec::new();
    let mut points = 0;
    let mut at = 0;
    while at < bytes.len() {
        let start = at;
        at += 1;
        match bytes[start] {
            b'#' => at = line_end(bytes, start),
            quote @ (b'"' | b'\'') => {
                let triple = bytes[start..].starts_with(&[quote; 3]);
                match closed(bytes, start, triple) {
                    Some(end) => at = end,
                    None if triple => {
                        found.unclosed = Some(start..start + 3);
                        return found;
                    }
                    // Whatever brackets follow in this line may belong to the text.
                    None => return found,
                }
            }
            b'[' | b'{' => open.push(start),
            close @ (b']' | b'}') => {
                let fits = |&at: &usize| matches!((bytes[at], close), (b'[', b']') | (b'{', b'}'));
                match open.pop() {
                    Some(last) if !fits(&last) => {
                        found.unclosed = Some(last..last + 1);
                        return found;
                    }
                    _ => {}
                }
            }
            b'.' => points += 1,
            b'=' | b',' => points = 0,
            b'\n' => {
                points = 0;
                // A heading ends with its line: no value begins one.
                if open.first().is_some_and(|&at| begins_a_line(text, at)) {
                    open.clear();
                }
            }
            _ => {}
        }
        if open.len() + points > DEEPEST {
            found.too_deep.get_or_insert(start);
        }
    }
    let first = open.first().filter(|&&at| !begins_a_line(text, at));
    found.unclosed = first.map(|&start| start..start + 1);
    found
}

fn begins_a_line(text: &str, at: usize) -> bool {
    let before = text[..at].trim_end_matches([' ', '\t']);
    before.is_empty() || before.ends_with('\n')
}

fn line_end(bytes: &[u8], start: usize) -> usize {
    let length = bytes[start..].iter().position(|&b| b == b'\n');
    length.map_or(bytes.len(), |length| start + length)
}

/// The end of the text in quotes that begins at `start`; `None` where it has none.
fn closed(bytes: &[u8], start: usize, triple: bool) -> Option<usize> {
    let quote = bytes[start];
    let marks = if triple { 3 } else { 1 };
    let mut at = start + marks;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if quote == b'"' => at += 1,
            b'\n' if !triple => return None,
            b if b == quote && bytes[at..].iter().take(marks).filter(|&&b| b == quote).count() == marks => {
                return Some(at + marks);
            }
            _ => {}
        }
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{Openings, openings};

    #[track_caller]
    fn unclosed(text: &str) -> Option<usize> {
        openings(text).unclosed.map(|range| range.start)
    }

    #[test]
    fn what_is_closed_is_not_reported() {
        for text in [
            "",
            "[a]\nb = [1, { c = \"]\" }] # [\n[[d]]\n",
            "a = '''\n[\n'''\nb = \"\"\"\"quoted\\\"\"\"\"",
            "a = \"[\\\"[\"\nb = 'C:\\'\n",
            // The parser reports a heading without its end, at its line.
            "[duct\nlength = 1\n",
            "[[duct\n",
        ] {
            assert_eq!(openings(text), Openings::default(), "{text}");
        }
    }

    #[test]
    fn the_opening_is_found() {
        assert_eq!(unclosed("a = 1\nb = [ { x = 1 },\n[c]\nd = 2\n"), Some(10));
        assert_eq!(unclosed("a = { b = [1, 2 }\nc = 3"), Some(10));
        assert_eq!(unclosed("a = '''\nb = 2\n[c]\n"), Some(4));
        assert_eq!(unclosed("a = \"\"\"b\nc = 2\n"), Some(4));
        // A text without its end hides what is open.
        assert_eq!(unclosed("a = [\n \"b ],\nc = 2\n"), None);
    }

    #[test]
    fn deep_keys_and_brackets_are_found() {
        let deep = |text: &str| openings(text).too_deep;
        assert_eq!(deep(&format!("a = 1\nb{} = 2\n", ".b".repeat(20))), Some(39));
        assert_eq!(deep(&format!("a = {}\n", "[".repeat(100))), Some(20));
        assert_eq!(deep("a = 1.5\nb = [1.0, 2.0, 3.0]\nc.d.e = 3\n"), None);
    }
}
