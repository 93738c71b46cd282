//! A commented scene to start from.

use crate::Scene;
use crate::scene::{SceneError, quoted};

/// Slope of the elastic part of friction \[N/m per m of cable\] behind the shape factor of a new scene: as in the scenes of
/// the full-scale experiment, an assumption.
const SLOPE: f64 = 1e8;
const TEXT: &str = include_str!("template.toml");
/// Column of the comments.
const COMMENTS: usize = 36;

/// A commented scene with these values at its keys, such as `("duct.length", "250 m")`; the shape factor suits friction and cable. A value at
/// `ground.preset` takes the place of the one soil. `name` stands for the file in error messages.
///
/// # Errors
///
/// [`SceneError`] with the line of the new file that would be wrong.
///
/// ```
/// let text = creepage::template("my-duct.toml", &[("duct.length", "250 m"), ("ends.downstream", "3 MN/m")])?;
/// assert!(text.contains("length = \"250 m\" ") && text.contains("downstream = { spring = \"3 MN/m\" }"));
/// # Ok::<(), creepage::SceneError>(())
/// ```
pub fn template(name: &str, values: &[(&str, &str)]) -> Result<String, SceneError> {
    let mut text = TEXT.to_owned();
    for (key, value) in values {
        if *key == "ground.preset" {
            let (before, layers) = text.split_once("\n[[ground.layers]]").unwrap_or((&text, ""));
            let after = layers.split_once("\n[cable]").map_or("", |(_, after)| after);
            let before = before.replace("\n[ground]\n", "\n[ground]\npreset = \n");
            text = format!("{before}\n[cable]{after}");
        }
        set(&mut text, key, &toml(key, value));
    }
    let limit = Scene::from_toml(name, &text)?.friction_limit();
    if limit > 0.0 {
        let shape_factor = format!("\"{:.4e} 1/m\"", 2.0 * SLOPE / limit);
        set(&mut text, "friction.shape_factor", &shape_factor);
    }
    Scene::from_toml(name, &text)?;
    Ok(text)
}

/// Replaces the value in the line of a key; the comment behind it keeps its column.
fn set(text: &mut String, key: &str, value: &str) {
    let (section, key) = key.rsplit_once('.').unwrap_or(("", key));
    let section = text.find(&format!("[{section}]")).unwrap_or(0);
    let key = format!("\n{key} = ");
    let Some(start) = text[section..].find(&key).map(|at| section + at + 1) else {
        return;
    };
    let end = start + text[start..].find('\n').unwrap_or(text.len() - start);
    let comment = text[start..end].split_once("  # ").map(|(_, comment)| comment);
    let line = format!("{}{value}", key.trim_start());
    let line = match comment {
        Some(comment) => format!("{:<COMMENTS$}# {comment}", line + " "),
        None => line,
    };
    text.replace_range(start..end, &line);
}

/// A value as TOML: a number as it is, an end that is neither free nor fixed as a spring, everything else in quotes.
fn toml(key: &str, value: &str) -> String {
    let value = value.trim();
    let number = value.starts_with(|c: char| c.is_ascii_digit() || c == '-')
        && value.ends_with(|c: char| c.is_ascii_digit())
        && value.parse::<f64>().is_ok();
    let literal = if number && key != "title" {
        value.to_owned()
    } else {
        quoted(value)
    };
    match value {
        value if !key.starts_with("ends.") || ["free", "fixed"].contains(&value) => literal,
        _ => format!("{{ spring = {literal} }}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{End, FrictionLaw};

    #[test]
    fn the_default_is_a_valid_scene_with_its_values() {
        let text = template("new.toml", &[]).expect("a valid scene");
        assert_eq!(text, TEXT);
        let scene = Scene::from_toml("new.toml", &text).expect("a valid scene");
        assert_eq!((scene.duct.length, scene.duct.depth), (100.0, 1.2));
        assert_eq!(
            (scene.ends.upstream, scene.ends.downstream),
            (End::Free, End::Fixed)
        );
        let FrictionLaw::ElasticPlastic { shape_factor } = scene.friction.law() else {
            panic!("elastic-plastic")
        };
        // q·b/2 = 1e8 N/m².
        assert!((0.25 * 108.8 * shape_factor / 2.0 / 1e8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_commented_out_is_valid_too() {
        let options = TEXT
            .lines()
            .filter_map(|line| line.strip_prefix("# "))
            .filter(|line| line.contains(" = "));
        let mut count = 0;
        for option in options {
            // A section that is commented out comes with its keys, but for those that exclude each other.
            let heat = TEXT
                .split_once("# [heat]")
                .map_or("", |(_, heat)| heat)
                .contains(option);
            let text = if heat {
                let (before, section) = TEXT.split_once("# [heat]").expect("a section");
                let with_rate = before.replace("# per_day = ", "per_day = ");
                format!("{with_rate}[heat]{}", section.replace("\n# ", "\n"))
            } else {
                TEXT.replace(&format!("# {option}"), option)
            };
            Scene::from_toml("new.toml", &text).unwrap_or_else(|error| panic!("{error}"));
            count += 1;
        }
        assert!(count >= 8, "{count}");
    }

    #[test]
    fn every_value_reaches_the_scene_and_bad_ones_are_refused_with_their_line() {
        let text = template(
            "x",
            &[
                ("title", "a \"b\" \\ c\n長"),
                ("duct.length", "0.2 km"),
                ("ground.preset", "n5-cbr3"),
                ("friction.dynamic_coefficient", "0"),
                ("ends.upstream", "3 MN/m"),
                ("vehicles.preset", "t-14"),
                ("vehicles.speed", "5"),
                ("traffic.passes", "7"),
            ],
        );
        let scene = Scene::from_toml("x", &text.expect("a valid scene")).expect("valid");
        assert_eq!(scene.title, "a \"b\" \\ c\n長");
        assert_eq!((scene.duct.length, scene.traffic.passes), (200.0, 7));
        assert_eq!(scene.ends.upstream, End::Spring(3e6));
        assert_eq!(scene.ground.layers.len(), 4);
        assert_eq!(scene.vehicles[0].speed, 5.0);
        for (key, value, named) in [
            ("duct.depth", "1.2 kN", "`duct.depth`"),
            ("cable.preset", "rope", "`cable.preset`"),
            ("traffic.passes", "many", "`traffic.passes`"),
            (
                "friction.dynamic_coefficient",
                "nan",
                "`friction.dynamic_coefficient`",
            ),
            ("ends.upstream", "loose", "`ends.upstream.spring`"),
        ] {
            let message = template("new.toml", &[(key, value)])
                .expect_err("a bad value")
                .to_string();
            assert!(
                message.starts_with("new.toml, line ") && message.contains(named),
                "{message}"
            );
        }
    }
}
