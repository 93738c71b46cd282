//! Bare numbers that were probably meant in another unit.
//!
//! A number without a unit is SI: `load = 20` is 20 N, the weight of two bricks, and `speed = 40` is 144 km/h. Both are
//! valid, so they are a warning and no error. So is `passes = 292.000`, which is 292.

use std::fmt;

use super::counted::counted;
use super::document::{Content, Document, Node};
use super::keys::joined;
use super::location::Location;

/// Loads below this \[N\] are lighter than any vehicle.
const LIGHT: f64 = 1e3;
/// Speeds above this \[m/s\] are faster than any truck: 130 km/h.
const FAST: f64 = 130.0 / 3.6;
/// Weights per length below this \[N/m\] may be in kg/m.
const LIGHT_CABLE: f64 = 20.0;

/// A bare number that was probably meant in another unit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct UnitSlip {
    /// Where it stands.
    pub location: Location,
    /// The key, with its section.
    pub key: String,
    /// The number as written.
    pub found: String,
    /// What it means, and what may have been meant.
    pub meaning: String,
}

impl fmt::Display for UnitSlip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: `{}`{}: {} without a unit is {}",
            self.location,
            self.key,
            counted(&self.key),
            self.found,
            self.meaning
        )
    }
}

/// Every one in `document`.
pub fn unit_slips(document: &Document) -> Vec<UnitSlip> {
    let mut slips = Vec::new();
    let mut judge = |path: String, node: &Node| {
        let (Content::Number { value, .. }, Some(key)) = (&node.content, path.rsplit('.').next()) else {
            return;
        };
        let found = document.written(&node.place);
        let meaning = match key {
            "load" if *value > 0.0 && *value < LIGHT => {
                format!("{value} N, less than 1 kN: did you mean \"{found} tf\" or \"{found} kN\"?")
            }
            "speed" if *value > FAST => {
                let fast = 3.6 * value;
                format!("{value} m/s, {fast:.0} km/h: did you mean \"{found} km/h\"?")
            }
            "weight" if *value < LIGHT_CABLE => {
                format!("{value} N/m: did you mean \"{found} kgf/m\"?")
            }
            "passes" if parts_thousands(&found) => {
                let meant = found.replace('.', "");
                format!("{value} passes, since decimals follow a point: did you mean {meant}?")
            }
            _ => return,
        };
        slips.push(UnitSlip {
            location: document.locate(&node.place),
            key: path,
            found,
            meaning,
        });
    };
    each_value(&document.root, "", &mut judge);
    slips
}

/// Whether a point in a number may stand between thousands: three digits follow it.
fn parts_thousands(text: &str) -> bool {
    text.split_once('.')
        .is_some_and(|(_, digits)| digits.len() == 3 && digits.bytes().all(|b| b.is_ascii_digit()))
}

/// Calls `visit` with every value that is no table and no list, and its key.
fn each_value(node: &Node, path: &str, visit: &mut impl FnMut(String, &Node)) {
    match &node.content {
        Content::Table(entries) => {
            for entry in entries {
                each_value(&entry.value, &joined(path, &entry.key), visit);
            }
        }
        Content::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                each_value(item, &joined(path, &index.to_string()), visit);
            }
        }
        _ => visit(path.to_owned(), node),
    }
}
