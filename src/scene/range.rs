//! Ranges of values, and how to say what is allowed.

use std::ops::RangeInclusive;

use super::Dimension;

/// A range of values.
#[derive(Clone, Copy)]
pub(super) struct Range {
    /// In words, after "a length".
    words: &'static str,
    holds: fn(f64) -> bool,
}

pub(super) const ANY: Range = Range {
    words: "of any sign",
    holds: |_| true,
};
pub(super) const POSITIVE: Range = Range {
    words: "greater than 0",
    holds: |v| v > 0.0,
};
// The limits of what the models can mean, far outside what is built: beyond them numbers lose their digits, or a run its
// end.
macro_rules! range {
    ($(#[$doc:meta])* $name:ident, $low:expr, $high:expr, $words:expr) => {
        $(#[$doc])*
        pub(super) const $name: Range = Range {
            words: $words,
            holds: |v| ($low..=$high).contains(&v),
        };
    };
}
range!(DUCT_LENGTH, 0.1, 1e5, "greater than 0, from 0.1 m to 100 km");
range!(DEPTH, 0.01, 1e3, "greater than 0, from 1 cm to 1 km");
range!(OFFSET, -1e3, 1e3, "of any sign, at most 1 km");
range!(THICKNESS, 1e-6, 1e4, "greater than 0, from 1 um to 10 km");
range!(CONTACT_RADIUS, 0.0, 100.0, "of at least 0 and at most 100 m");
range!(PEAK, 1e-12, 1.0, "greater than 0, from 1e-6 um to 1 m");
range!(MODULUS, 1e3, 1e13, "greater than 0, from 1 kPa to 10000 GPa");
range!(WEIGHT, 1e-3, 1e6, "greater than 0, from 1e-3 N/m to 1 MN/m");
range!(AXIAL_STIFFNESS, 1.0, 1e15, "greater than 0, from 1 N to 1e15 N");
range!(SHAPE_FACTOR, 1.0, 1e18, "greater than 0, from 1 to 1e18 1/m");
range!(STIFFNESS, 1e-9, 1e18, "greater than 0, from 1e-9 to 1e18 N/m");
range!(LOAD_FACTOR, 1e-6, 1e6, "greater than 0, from 1e-6 to 1e6");
range!(LOAD, 0.0, 1e9, "of at least 0 and at most 1000 MN");
range!(SPEED, 1e-3, 1e3, "greater than 0, from 1 mm/s to 1 km/s");
range!(APPROACH, 0.1, 1e5, "greater than 0, from 0.1 m to 100 km");
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

range!(SHARE, 1e-12, 1e12, "greater than 0, from 1e-12 to 1e12");
/// Numbers of passes that can be computed, by the pass law at the latest.
pub(super) const PASSES: RangeInclusive<u64> = 1..=pass_law::MOST_PASSES;
/// Most nodes and most steps of a vehicle over the duct; where the scene gives no step there are two to a node.
const MOST_NODES: f64 = 5e6;
const MOST_STEPS: f64 = 1e7;

/// A range whose ends follow from the rest of the scene, with its words.
pub(super) type Follows = (RangeInclusive<f64>, String);

/// Node spacings \[m\] in a duct of this length.
pub(super) fn node_spacings(length: f64) -> Follows {
    let words = format!(
        "at most half the duct's length, {} m, and at least its five-millionth part",
        shown(length / 2.0)
    );
    (length / MOST_NODES..=length / 2.0, words)
}

/// Steps of a vehicle \[m\] over a duct of this length.
pub(super) fn vehicle_steps(length: f64) -> Follows {
    let words = format!(
        "at most the duct's length, {} m, and at least its ten-millionth part",
        shown(length)
    );
    (length / MOST_STEPS..=length, words)
}

/// Positions of clamps \[m\] in a duct of this length.
pub(super) fn positions(length: f64) -> Follows {
    let words = format!("a position in the duct, from 0 m to {} m", shown(length));
    (0.0..=length, words)
}

impl Range {
    /// Whether a number lies within.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite() && (self.holds)(value)
    }

    /// The range of a quantity in words.
    pub fn of(self, dimension: Dimension) -> String {
        format!("{} {}", dimension.noun(), self.words)
    }

    /// The range of a number in words.
    pub fn of_number(self) -> String {
        format!("a number {}", self.words)
    }
}

/// What is allowed where a quantity belongs.
pub(super) fn allowed_quantity(dimension: Dimension, range: Range, example: &str) -> String {
    let units: Vec<&str> = dimension.units().collect();
    format!(
        "{}, such as {example} (units: {})",
        range.of(dimension),
        units.join(", ")
    )
}

/// What is allowed where a dimensionless number belongs.
pub(super) fn allowed_number(range: Range) -> String {
    format!("{}, without quotes or unit", range.of_number())
}

/// What is allowed where a whole number belongs.
pub(super) fn allowed_whole(range: &RangeInclusive<u64>) -> String {
    match (range.start(), range.end()) {
        (least, &u64::MAX) => format!("a whole number of at least {least}, without quotes"),
        (least, most) => format!("a whole number from {least} to {most}, without quotes"),
    }
}

/// A value of ours in a message, such as the end of a range.
pub(super) fn shown(value: f64) -> String {
    if (1e-6..1e9).contains(&value.abs()) || value == 0.0 {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}
