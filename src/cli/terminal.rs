//! Text for a terminal, in which nothing that came from a file or an argument can give the terminal orders.
//!
//! Control characters and those that turn the direction of writing are shown as U+FFFD. Tables and JSON documents are data and do not
//! pass here: JSON escapes such characters, and a table keeps them.

use std::error::Error;
use std::fmt::Display;
use std::io::{self, StderrLock, StdoutLock, Write};

use crate::error::with_causes;
use crate::scene::shortened;

/// What stands for a character that is not shown.
const REPLACEMENT: &str = "\u{fffd}";
/// Longest message \[characters\].
const LONGEST_MESSAGE: usize = 1800;
/// Of a message that is too long, what is kept of its end: the allowed values and the line at fault.
const KEPT_END: usize = 700;
/// Longest text of the user's within a line \[characters\].
const LONGEST_TEXT: usize = 200;
/// Width of a table that a terminal shows without breaking its lines, and of a name that is not broken \[characters\].
const TERMINAL_WIDTH: usize = 80;
const SHORT_NAME: usize = 13;

pub fn out() -> Shown<StdoutLock<'static>> {
    Shown(io::stdout().lock())
}

pub fn err() -> Shown<StderrLock<'static>> {
    Shown(io::stderr().lock())
}

/// Prints a warning on standard error; if that is closed, nobody reads it.
pub fn warn(warning: impl Display) {
    let _ = writeln!(err(), "warning: {}", cut(&warning.to_string()));
}

pub fn warn_all(warnings: &[String]) {
    warnings.iter().for_each(warn);
}

/// Prints an error with its causes on standard error.
pub fn fail(error: &dyn Error) {
    let _ = writeln!(err(), "error: {}", cut(&with_causes(error)));
}

/// A text of the user's as one line of bounded length.
pub fn line(text: &str) -> String {
    let line = text.replace(['\n', '\r'], REPLACEMENT);
    shortened(&line, LONGEST_TEXT)
}

/// Writes rows of as many cells below their names, columns as wide as they have to be: numbers to the right, words to the left. Where that is
/// wider than a terminal, long names are broken at blanks.
pub fn table(out: &mut impl Write, names: &[String], rows: &[Vec<String>]) -> io::Result<()> {
    let width = |text: &String| text.chars().count();
    let plain = |cell: &String| sentence(&cell.replace('\u{ad}', ""));
    let names: Vec<String> = names.iter().map(plain).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(plain).collect()).collect();
    let cells = |column: usize| rows.iter().map(move |row| &row[column]);
    let widest = |column: usize| cells(column).map(width).max().unwrap_or_default();
    let whole: usize = (0..names.len())
        .map(|column| widest(column).max(width(&names[column])) + 2)
        .sum();
    let heading = |(column, name): (usize, &String)| match whole {
        _ if whole <= TERMINAL_WIDTH + 2 => vec![name.clone()],
        _ => broken(name, SHORT_NAME.max(widest(column))),
    };
    let mut headings: Vec<Vec<String>> = names.iter().enumerate().map(heading).collect();
    // Names stand just above their columns.
    let height = headings.iter().map(Vec::len).max().unwrap_or_default();
    for heading in &mut headings {
        heading.splice(0..0, vec![String::new(); height - heading.len()]);
    }
    let line = |line: usize| headings.iter().map(|heading| heading[line].clone()).collect();
    let names: Vec<Vec<String>> = (0..height).map(line).collect();
    let begins = |c: char| c.is_ascii_digit() || "-+<>–".contains(c);
    let is_number = |cell: &String| cell.trim_start().starts_with(begins);
    for row in names.iter().chain(&rows) {
        let cell = |(column, cell): (usize, &String)| {
            let heading = headings[column].iter().map(width).max();
            let width = heading.unwrap_or_default().max(widest(column));
            if cells(column).any(is_number) {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            }
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        writeln!(out, "{}", cells.join("  ").trim_end())?;
    }
    Ok(())
}

/// A text in lines of at most `width` characters, if its words allow that.
fn broken(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.extend([" ", word]);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A sentence of this program's, which may repeat a text of the user's, as one line of bounded length.
pub fn sentence(text: &str) -> String {
    cut(&text.replace(['\n', '\r'], REPLACEMENT))
}

/// A message of bounded length: its beginning and its end.
pub fn cut(message: &str) -> String {
    let count = message.chars().count();
    if count <= LONGEST_MESSAGE {
        return message.to_owned();
    }
    let begin = shortened(message, LONGEST_MESSAGE - KEPT_END);
    let end: String = message.chars().skip(count - KEPT_END).collect();
    format!("{begin} …{end}")
}

/// Whether a terminal may take the character for an order.
pub fn is_hidden(c: char) -> bool {
    let turns_direction =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns_direction || matches!(c, '\u{2028}' | '\u{2029}')
}

/// Writes text with hidden characters replaced, line breaks excepted.
pub struct Shown<W>(W);

impl<W: Write> Write for Shown<W> {
    /// Takes whole pieces of text, as `write!` hands them over.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let is_hidden = |c: char| c != '\n' && is_hidden(c);
        let text = String::from_utf8_lossy(bytes).replace(is_hidden, REPLACEMENT);
        self.0.write_all(text.as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        let mut out = Shown(Vec::new());
        write!(out, "{text}").expect("memory");
        String::from_utf8(out.0).expect("UTF-8")
    }

    #[test]
    fn nothing_that_orders_a_terminal_passes() {
        let hidden = (0..0x11_0000)
            .filter_map(char::from_u32)
            .filter(|&c| is_hidden(c));
        let hidden: Vec<char> = hidden.collect();
        for c in [
            '\x1b', '\x07', '\r', '\t', '\x7f', '\u{9b}', '\u{202e}', '\u{2066}',
        ] {
            assert!(hidden.contains(&c), "{c:?}");
        }
        for c in hidden {
            let expected = if c == '\n' {
                "a\nb".to_owned()
            } else {
                "a\u{fffd}b".to_owned()
            };
            assert_eq!(shown(&format!("a{c}b")), expected, "{c:?}");
        }
        for text in ["名 = ξ µm → 5 %\n", "", "plain"] {
            assert_eq!(shown(text), text);
        }
    }

    #[test]
    fn long_messages_keep_both_ends() {
        let message = format!("where: found {}; allowed: less", "é".repeat(1_000_000));
        let cut = cut(&message);
        assert!(
            cut.chars().count() < 2000 && cut.starts_with("where: found é"),
            "{cut}"
        );
        assert!(
            cut.contains("… (1000028 characters) …") && cut.ends_with("; allowed: less"),
            "{cut}"
        );
        assert_eq!(super::cut("short"), "short");
        assert_eq!(line("a\nb"), "a\u{fffd}b");
        assert_eq!(
            line(&"x".repeat(201)),
            format!("{}… (201 characters)", "x".repeat(200))
        );
    }
}
