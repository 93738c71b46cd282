//! Numbers, texts and tables for a reader, as the terminal and the report show them.

/// Rows of a table that is read at a glance.
pub const ROWS: usize = 16;

/// Words that are said only if something holds.
pub fn words_if(holds: bool, words: &str) -> &str {
    if holds { words } else { "" }
}

/// `value` with this number of decimals, and no minus before zeros.
pub fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        _ => text,
    }
}

/// A number without zeros at the end of its decimals.
pub fn without_zeros(number: &str) -> &str {
    let decimals = number.contains('.');
    let short = number.trim_end_matches('0').trim_end_matches('.');
    if decimals { short } else { number }
}

/// A node spacing or a vehicle step: three decimals, and two digits of one that is smaller.
pub fn spacing(length: f64) -> String {
    let is_small = length > 0.0 && length < 0.01;
    let decimals = if is_small {
        1.0 - length.log10().floor()
    } else {
        3.0
    };
    rounded(length, decimals as usize)
}

/// An estimated share as a percentage.
pub fn percent(share: f64) -> String {
    match share {
        share if share > 0.0 && share < 5e-5 => "< 0.01 %".into(),
        share => format!("{:.2} %", 100.0 * share),
    }
}

/// A given share as the percentage that was meant.
pub fn exact_percent(share: f64) -> String {
    format!("{} %", exact(100.0 * share))
}

/// A given number in another unit as it was meant, without the binary digits of the product.
pub fn exact(number: f64) -> String {
    format!("{}", (1e12 * number).round() / 1e12)
}

/// A time in words of its size.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => "< 1 ms".into(),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.0} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_spacing_is_shown_as_nothing() {
        let shown = [
            (12.3456, "12.346"),
            (0.05, "0.050"),
            (0.0081, "0.0081"),
            (0.00032, "0.00032"),
            (0.0, "0.000"),
        ];
        for (length, text) in shown {
            assert_eq!(spacing(length), text);
        }
    }

    #[test]
    fn percentages_show_what_is_known() {
        let estimates = [(0.0, "0.00 %"), (1e-6, "< 0.01 %"), (0.0123456, "1.23 %")];
        for (share, text) in estimates {
            assert_eq!(percent(share), text);
        }
        let given = [
            (1e-6, "0.0001 %"),
            (0.01, "1 %"),
            (0.07, "7 %"),
            (0.335, "33.5 %"),
        ];
        for (share, text) in given {
            assert_eq!(exact_percent(share), text);
        }
    }
}
