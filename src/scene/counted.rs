//! Items of lists, counted from 1 as people do.

/// Lists of a scene, and what one item of each is called.
const ITEMS: [(&str, &str); 4] = [
    ("layers", "layer"),
    ("restraints", "clamp"),
    ("vehicles", "vehicle"),
    ("wheels", "wheel"),
];

/// What stands behind a key with numbers from 0, ` (vehicle 1, wheel 2)` behind `vehicles.0.wheels.1.load`; nothing behind other keys.
pub fn counted(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    let items = parts.windows(2).filter_map(|pair| {
        let (_, item) = ITEMS.iter().find(|(list, _)| *list == pair[0])?;
        let index: usize = pair[1].parse().ok()?;
        Some(format!("{item} {}", index.checked_add(1)?))
    });
    match items.collect::<Vec<_>>().join(", ") {
        items if items.is_empty() => items,
        items => format!(" ({items})"),
    }
}

/// The same in a message that begins with its key in backticks.
pub fn with_count(message: &str) -> String {
    let key = message.strip_prefix('`').and_then(|rest| rest.split_once('`'));
    key.map_or_else(
        || message.to_owned(),
        |(key, rest)| format!("`{key}`{}{rest}", counted(key)),
    )
}

#[cfg(test)]
mod tests {
    use super::{counted, with_count};

    #[test]
    fn items_are_counted_from_one() {
        for (key, words) in [
            ("vehicles.0.wheels.1.load", " (vehicle 1, wheel 2)"),
            ("ground.layers.2.thickness", " (layer 3)"),
            ("restraints.0", " (clamp 1)"),
            ("duct.depth", ""),
            ("vehicles", ""),
            ("vehicles.name", ""),
            ("vehicles.18446744073709551615", ""),
        ] {
            assert_eq!(counted(key), words, "{key}");
        }
        assert_eq!(
            with_count("`vehicles.0` weighs 600 t"),
            "`vehicles.0` (vehicle 1) weighs 600 t"
        );
        assert_eq!(with_count("no key"), "no key");
    }
}
