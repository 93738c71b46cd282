//! Bytes as text.

use encoding_rs::{Encoding, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::error::{Result, TableError};

/// Japanese characters one after the other that two letters of Latin-1 hardly ever look like.
const JAPANESE: usize = 2;

/// The text: by its byte order mark, in the `encoding` that was named, or in the one that it looks
/// like; signs of full width as those of ASCII.
pub fn decoded(file: &str, bytes: &[u8], encoding: Option<&'static Encoding>) -> Result<String> {
    // The mark at the beginning goes before what was named, and is taken away.
    let (text, _, malformed) = encoding.unwrap_or_else(|| recognised(bytes)).decode(bytes);
    let printed =
        |c: char| !c.is_control() || matches!(c, '\t' | '\n' | '\r' | '\u{c}' | '\u{1a}' | '\u{85}');
    let narrow = |c: char| match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        '\u{3000}' => ' ',
        c => c,
    };
    if malformed || !text.chars().all(printed) {
        let named = encoding.map_or_else(String::new, |encoding| format!(" in {}", encoding.name()));
        let found = format!("bytes that are no text{named}");
        let allowed = "a table as text (UTF-8, UTF-16, Latin-1, Shift_JIS; `encoding` chooses) or an Excel workbook (.xlsx)";
        return Err(TableError::line(file, 0, found, allowed));
    }
    Ok(text.chars().map(narrow).collect())
}

fn recognised(bytes: &[u8]) -> &'static Encoding {
    let places = |place: usize| bytes.iter().skip(place).step_by(2);
    let zeros = |place: usize| places(place).filter(|&&byte| byte == 0).count();
    // Digits and separators have a byte of zeros in UTF-16.
    let many = bytes.len() / 4;
    match (zeros(0), zeros(1)) {
        (0, odd) if odd > many => UTF_16LE,
        (even, 0) if even > many => UTF_16BE,
        _ if std::str::from_utf8(bytes).is_ok() => UTF_8,
        _ if is_japanese(bytes) => SHIFT_JIS,
        // Latin-1, and what Windows puts where that has control characters.
        _ => WINDOWS_1252,
    }
}

fn is_japanese(bytes: &[u8]) -> bool {
    let (text, _, malformed) = SHIFT_JIS.decode(bytes);
    let of_two_bytes = |c: char| matches!(c, '\u{3040}'..='\u{30ff}' | '\u{4e00}'..='\u{9fff}');
    let mut runs = text.split(|c| !of_two_bytes(c));
    !malformed && runs.any(|run| run.chars().count() >= JAPANESE)
}
