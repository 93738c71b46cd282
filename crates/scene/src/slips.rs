//! Numbers that were probably meant in another unit, and masses that stand for weights.
//!
//! A number without a unit is SI: `load = 20` is 20 N, the weight of two bricks, and `speed = 40` is 144 km/h. Both are
//! valid, so they are a warning and no error. So is `passes = 292.000`, which is 292.

use std::fmt;

use crate::document::{Content, Document, Node};
use crate::location::{Location, counted};
use crate::range::WEIGHT;
use crate::shown::four_digits;

/// A number that was probably meant in another unit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct UnitSlip {
    /// Where it stands.
    pub location: Location,
    /// The key, with its section.
    pub key: String,
    /// What it means, and what may have been meant.
    pub meaning: String,
}

impl fmt::Display for UnitSlip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            location,
            key,
            meaning,
        } = self;
        write!(f, "{location}: `{key}`{}: {meaning}", counted(key))
    }
}

/// Every one in `document`.
pub fn unit_slips(document: &Document) -> Vec<UnitSlip> {
    let mut slips = Vec::new();
    document.root.each_value("", &mut |key, node| {
        if let Some(meaning) = meaning(key, node, &document.written(&node.place)) {
            let (location, key) = (document.locate(&node.place), key.to_owned());
            slips.push(UnitSlip {
                location,
                key,
                meaning,
            });
        }
    });
    slips
}

fn meaning(key: &str, node: &Node, found: &str) -> Option<String> {
    // Lighter than any vehicle [N], faster than any truck [m/s], and a weight per length that may be a mass [N/m].
    const LIGHT: f64 = 1e3;
    const FAST: f64 = 130.0 / 3.6;
    const LIGHT_CABLE: f64 = 20.0;
    let key = key.rsplit('.').next()?;
    let value = match &node.content {
        Content::Number { value, .. } => *value,
        // A mass per length is a weight by definition only where g is.
        Content::Text(text) if key == "weight" && text.to_lowercase().replace("kgf", "").contains("kg") => {
            let weight = four_digits(WEIGHT.dimension?.parse(text).ok()?);
            return Some(format!(
                "{found} is a mass per length: times g it weighs {weight} N/m"
            ));
        }
        _ => return None,
    };
    let meant = match key {
        "load" if value > 0.0 && value < LIGHT => {
            format!("{value} N, less than 1 kN: did you mean \"{found} tf\" or \"{found} kN\"?")
        }
        "speed" if value > FAST => {
            let fast = 3.6 * value;
            format!("{value} m/s, {fast:.0} km/h: did you mean \"{found} km/h\"?")
        }
        "weight" if value < LIGHT_CABLE => format!("{value} N/m: did you mean \"{found} kg/m\"?"),
        "passes" if parts_thousands(found) => {
            let meant = found.replace('.', "");
            format!("{value} passes, since decimals follow a point: did you mean {meant}?")
        }
        _ => return None,
    };
    Some(format!("{found} without a unit is {meant}"))
}

/// Whether a point in a number may stand between thousands: three digits follow it.
fn parts_thousands(text: &str) -> bool {
    text.split_once('.')
        .is_some_and(|(_, digits)| digits.len() == 3 && digits.bytes().all(|b| b.is_ascii_digit()))
}
