//! Numbers without a unit that were meant in another one than SI, `load = 20` in tonnes or `speed = 40` in km/h, decimals that may be
//! thousands, `passes = 292.000`, and masses that stand for weights.

use crate::content::{Content, Node};
use crate::range::WEIGHT;
use crate::shown::four_digits;
use crate::unusual::of;

/// The warning for what stands at `key`.
pub fn slip(key: &str, node: &Node) -> Option<String> {
    let words = words(key.rsplit('.').next()?, &node.content, &node.written)?;
    Some(of(key, &format!(": {words}")))
}

fn words(key: &str, content: &Content, found: &str) -> Option<String> {
    // Lighter than any vehicle [N], faster than any truck [m/s], and a weight per length that may be a mass [N/m].
    const LIGHT: f64 = 1e3;
    const FAST: f64 = 130.0 / 3.6;
    const LIGHT_CABLE: f64 = 20.0;
    if let (Some(text), "weight") = (content.as_text(), key) {
        let is_mass = text.to_lowercase().replace("kgf", "").contains("kg");
        let weight = four_digits(WEIGHT.dimension?.parse(text).ok()?);
        return is_mass.then(|| format!("{found} is a mass per length: times g it weighs {weight} N/m"));
    }
    let value = content.as_number()?;
    let is_thousands = |(_, digits): (&str, &str)| digits.len() == 3 && digits.parse::<u16>().is_ok();
    let (value, meant) = match key {
        "load" if value > 0.0 && value < LIGHT => (
            format!("{value} N, less than 1 kN"),
            format!("\"{found} tf\" or \"{found} kN\""),
        ),
        "speed" if value > FAST => (
            format!("{value} m/s, {:.0} km/h", 3.6 * value),
            format!("\"{found} km/h\""),
        ),
        "weight" if value < LIGHT_CABLE => (format!("{value} N/m"), format!("\"{found} kg/m\"")),
        "passes" if found.split_once('.').is_some_and(is_thousands) => (
            format!("{value} passes, since decimals follow a point"),
            found.replace('.', ""),
        ),
        _ => return None,
    };
    Some(format!(
        "{found} without a unit is {value}: did you mean {meant}?"
    ))
}
