//! Numbers and tables for a reader, as the terminal and the report show them.

/// `value` with `decimals` decimals, and no minus before zeros.
pub fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        _ => text,
    }
}

/// An error as a percentage.
pub fn share(error: f64) -> String {
    if error > 0.0 && error < 5e-5 {
        "< 0.01 %".into()
    } else {
        format!("{:.2} %", 100.0 * error)
    }
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
