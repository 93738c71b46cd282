//! Ranges of values, and how to say what is allowed.

use super::Dimension;

/// A range of values.
#[derive(Clone, Copy)]
pub(super) struct Range {
    /// In words, after "a length".
    words: &'static str,
    pub holds: fn(f64) -> bool,
}

pub(super) const ANY: Range = Range {
    words: "of any sign",
    holds: |_| true,
};
pub(super) const POSITIVE: Range = Range {
    words: "greater than 0",
    holds: |v| v > 0.0,
};
pub(super) const NOT_NEGATIVE: Range = Range {
    words: "of at least 0",
    holds: |v| v >= 0.0,
};
pub(super) const POISSON: Range = Range {
    words: "from 0 to 0.5",
    holds: |v| (0.0..=0.5).contains(&v),
};
pub(super) const COEFFICIENT: Range = Range {
    words: "from 0 to 10",
    holds: |v| (0.0..=10.0).contains(&v),
};
pub(super) const TOLERANCE: Range = Range {
    words: "greater than 0 and at most 0.5",
    holds: |v| v > 0.0 && v <= 0.5,
};

/// What is allowed where a quantity belongs.
pub(super) fn allowed_quantity(dimension: Dimension, range: Range, example: &str) -> String {
    let units: Vec<&str> = dimension.units().collect();
    format!(
        "{} {}, such as {example} (units: {})",
        dimension.noun(),
        range.words,
        units.join(", ")
    )
}

/// What is allowed where a dimensionless number belongs.
pub(super) fn allowed_number(range: Range) -> String {
    format!("a number {}, without quotes or unit", range.words)
}

/// A value of ours in a message, such as the end of a range.
pub(super) fn shown(value: f64) -> String {
    if (1e-6..1e9).contains(&value.abs()) || value == 0.0 {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}
