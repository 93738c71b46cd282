//! Bytes as text.

use encoding_rs::{Encoding as Table, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use super::options::Encoding;

/// Bytes by which UTF-16 without a mark is recognised.
const SAMPLE: usize = 512;

/// The text: by its byte order mark, in the `encoding` that was named, or in the one that it looks like. `None` where it is none.
pub fn decoded(bytes: &[u8], encoding: Option<Encoding>) -> Option<String> {
    // The mark at the beginning goes before what was named, and is taken away.
    let table = encoding.map_or_else(|| recognised(bytes), |named| named.0);
    let (text, _, malformed) = table.decode(bytes);
    let printed =
        |c: char| !c.is_control() || matches!(c, '\t' | '\n' | '\r' | '\u{c}' | '\u{1a}' | '\u{85}');
    (!malformed && text.chars().all(printed)).then(|| text.into_owned())
}

fn recognised(bytes: &[u8]) -> &'static Table {
    let sample = &bytes[..bytes.len().min(SAMPLE) & !1];
    let zeros = |place: usize| {
        sample
            .iter()
            .skip(place)
            .step_by(2)
            .filter(|&&byte| byte == 0)
            .count()
    };
    // Digits and separators have a byte of zeros in UTF-16.
    let many = sample.len() / 4;
    match (zeros(0), zeros(1)) {
        (0, odd) if odd > many => UTF_16LE,
        (even, 0) if even > many => UTF_16BE,
        _ if std::str::from_utf8(bytes).is_ok() => UTF_8,
        // Latin-1, and what Windows puts where that has control characters.
        _ => WINDOWS_1252,
    }
}
