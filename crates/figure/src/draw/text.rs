//! How much room a text takes. An SVG is laid out by the program that shows it, so widths are estimates on the safe side.

use crate::error::FigureError;

/// Size of letters \[px\].
pub const TEXT: f64 = 14.0;
/// Width of a letter as a share of the font's size: wide, so that estimates err on the safe side.
const LETTER: f64 = 0.6;

/// Estimated width of a text \[px\].
pub fn text_width(text: &str, size: f64) -> f64 {
    let letter = |letter| if is_wide(letter) { 1.0 } else { LETTER };
    size * text.chars().map(letter).sum::<f64>()
}

/// Letters as wide as high: CJK and full-width forms.
fn is_wide(letter: char) -> bool {
    matches!(letter, '\u{2e80}'..='\u{9fff}' | '\u{ac00}'..='\u{d7a3}' | '\u{f900}'..='\u{faff}' | '\u{ff00}'..='\u{ff60}')
}

/// An error where `text` needs more than its room \[px\].
pub fn check_room(text: &str, needed: f64, room: f64) -> Result<(), FigureError> {
    if needed <= room {
        return Ok(());
    }
    Err(FigureError::NoRoom {
        text: text.to_owned(),
        needed,
        room,
    })
}
