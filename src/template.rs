//! A commented scene to start from.
//!
//! The text is made from a few answers and checked by reading it: [`Template::to_toml`] returns a valid scene.

use crate::scene::{FrictionLaw, SceneError, quoted};
use crate::{Scene, presets};

/// Slope of the elastic part of friction \[N/m per m of cable\] behind the shape factor of a new scene: as in the scenes of
/// the full-scale experiment, an assumption.
const SLOPE: f64 = 1e8;
/// Shape factor \[1/m\] where there is no friction.
const FRICTIONLESS_SHAPE_FACTOR: f64 = 1e7;
/// The text with places for the answers.
const TEXT: &str = include_str!("template.toml");
/// Column of the comments.
const COMMENTS: usize = 36;

/// What a new scene is made from: quantities with their units, as in a scene file, and names of presets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Template {
    /// Title.
    pub title: String,
    /// Length of the duct.
    pub length: String,
    /// Depth of the cable below the road.
    pub depth: String,
    /// What the ground is made of.
    pub ground: TemplateGround,
    /// Preset of the cable.
    pub cable: String,
    /// Dynamic friction coefficient.
    pub friction: String,
    /// The end where vehicles come in: `free`, `fixed` or a spring's stiffness.
    pub upstream: String,
    /// The other end.
    pub downstream: String,
    /// Preset of the vehicle.
    pub vehicle: String,
    /// Speed of the vehicle.
    pub speed: String,
    /// Number of passes.
    pub passes: String,
}

/// Ground of a new scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TemplateGround {
    /// One soil with this Young's modulus.
    Modulus(String),
    /// A preset of a pavement.
    Pavement(String),
}

impl Default for Template {
    fn default() -> Self {
        Self {
            title: "My duct".into(),
            length: "100 m".into(),
            depth: "1.2 m".into(),
            ground: TemplateGround::Modulus("300 MPa".into()),
            cable: "xlpe-800-single-core".into(),
            friction: "0.25".into(),
            upstream: "free".into(),
            downstream: "fixed".into(),
            vehicle: "t-25".into(),
            speed: "40 km/h".into(),
            passes: "300".into(),
        }
    }
}

impl Template {
    /// The scene as a commented file; `name` stands for the file in error messages.
    ///
    /// # Errors
    ///
    /// [`SceneError`] with the line of the new file that would be wrong.
    pub fn to_toml(&self, name: &str) -> Result<String, SceneError> {
        let scene = Scene::from_toml(name, &self.text(None))?;
        let limit = scene.friction_limit();
        let shape_factor = if limit > 0.0 {
            2.0 * SLOPE / limit
        } else {
            FRICTIONLESS_SHAPE_FACTOR
        };
        let text = self.text(Some(shape_factor));
        let scene = Scene::from_toml(name, &text)?;
        debug_assert!(matches!(scene.friction.law, FrictionLaw::ElasticPlastic { .. }));
        Ok(text)
    }

    /// The file with this shape factor, or with Coulomb's law where it is not known yet.
    fn text(&self, shape_factor: Option<f64>) -> String {
        let lines = TEXT.lines().filter_map(|line| self.line(line, shape_factor));
        lines.map(|line| line + "\n").collect()
    }

    /// A line of the file: `CONDITION| CODE @NAME  # COMMENT`, all but the code optional.
    fn line(&self, line: &str, shape_factor: Option<f64>) -> Option<String> {
        let line = match line.split_once('|') {
            Some((condition, line)) if self.holds(condition, shape_factor) => line.trim_start(),
            Some(_) => return None,
            None => line,
        };
        let (code, comment) = line.split_once("  # ").unwrap_or((line, ""));
        let (code, comment) = match code.split_once('@') {
            Some((before, name)) => {
                let value = self.value(name, shape_factor);
                let comment = comment.replace("@summary", summary(&value));
                (format!("{before}{}", literal(name, &value)), comment)
            }
            None => (code.to_owned(), comment.to_owned()),
        };
        Some(match comment.as_str() {
            "" => code,
            // At least one blank stands before the comment.
            _ => format!("{:<COMMENTS$}# {comment}", code + " "),
        })
    }

    fn holds(&self, condition: &str, shape_factor: Option<f64>) -> bool {
        match condition {
            "modulus" => matches!(self.ground, TemplateGround::Modulus(_)),
            "pavement" => matches!(self.ground, TemplateGround::Pavement(_)),
            "coulomb" => shape_factor.is_none(),
            _ => shape_factor.is_some(),
        }
    }

    /// The answer of this name in the text.
    fn value(&self, name: &str, shape_factor: Option<f64>) -> String {
        match name {
            "title" => &self.title,
            "length" => &self.length,
            "depth" => &self.depth,
            "modulus" | "pavement" => match &self.ground {
                TemplateGround::Modulus(text) | TemplateGround::Pavement(text) => text,
            },
            "cable" => &self.cable,
            "friction" => &self.friction,
            "upstream" => &self.upstream,
            "downstream" => &self.downstream,
            "vehicle" => &self.vehicle,
            "speed" => &self.speed,
            "passes" => &self.passes,
            _ => return format!("{:.4e} 1/m", shape_factor.unwrap_or_default()),
        }
        .clone()
    }
}

/// What a preset is; empty where it is not known, which is an error when the scene is read.
fn summary(name: &str) -> &'static str {
    let preset = presets::all().iter().find(|preset| preset.name == name);
    preset.map_or("", |preset| &preset.summary)
}

/// The value as it stands behind a key: an end that is neither free nor fixed is a spring.
fn literal(name: &str, value: &str) -> String {
    match (name, value) {
        (_, "free" | "fixed") => toml(value),
        ("upstream" | "downstream", _) => format!("{{ spring = {} }}", toml(value)),
        _ => toml(value),
    }
}

/// A value as TOML: a number as it is, everything else in quotes.
fn toml(value: &str) -> String {
    let value = value.trim();
    let number = value.starts_with(|c: char| c.is_ascii_digit() || c == '-')
        && value.ends_with(|c: char| c.is_ascii_digit())
        && value.parse::<f64>().is_ok();
    if number {
        return value.to_owned();
    }
    quoted(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::End;

    #[test]
    fn the_default_is_a_valid_scene_with_its_values() {
        let text = Template::default().to_toml("new.toml").expect("a valid scene");
        let scene = Scene::from_toml("new.toml", &text).expect("a valid scene");
        assert_eq!((scene.duct.length, scene.duct.depth), (100.0, 1.2));
        assert_eq!(
            (scene.ends.upstream, scene.ends.downstream),
            (End::Free, End::Fixed)
        );
        assert_eq!(scene.vehicles[0].vehicle.weight(), 250e3);
        let FrictionLaw::ElasticPlastic { shape_factor } = scene.friction.law else {
            panic!("elastic-plastic")
        };
        // q·b/2 = 1e8 N/m².
        assert!((0.25 * 108.8 * shape_factor / 2.0 / 1e8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_commented_out_is_valid_too() {
        let text = Template::default().to_toml("new.toml").expect("a valid scene");
        let options = text
            .lines()
            .filter_map(|line| line.strip_prefix("# "))
            .filter(|line| line.contains(" = "));
        let mut count = 0;
        for option in options {
            // A section that is commented out comes with its keys, but for those that exclude each other.
            let heat = text
                .split_once("# [heat]")
                .map_or("", |(_, heat)| heat)
                .contains(option);
            let text = if heat {
                let (before, section) = text.split_once("# [heat]").expect("a section");
                let with_rate = before.replace("# per_day = ", "per_day = ");
                format!("{with_rate}[heat]{}", section.replace("\n# ", "\n"))
            } else {
                text.replace(&format!("# {option}"), option)
            };
            Scene::from_toml("new.toml", &text).unwrap_or_else(|error| panic!("{error}"));
            count += 1;
        }
        assert!(count >= 8, "{count}");
    }

    #[test]
    fn every_answer_reaches_the_scene_and_bad_ones_are_refused_with_their_line() {
        let answers = Template {
            title: "a \"b\" \\ c\n長".into(),
            length: "0.2 km".into(),
            ground: TemplateGround::Pavement("n5-cbr3".into()),
            friction: "0".into(),
            upstream: "3 MN/m".into(),
            vehicle: "t-14".into(),
            speed: "5".into(),
            passes: "7".into(),
            ..Template::default()
        };
        let scene = Scene::from_toml("x", &answers.to_toml("x").expect("a valid scene")).expect("valid");
        assert_eq!(scene.title, answers.title);
        assert_eq!((scene.duct.length, scene.traffic.passes), (200.0, 7));
        assert_eq!(scene.ends.upstream, End::Spring(3e6));
        assert_eq!(scene.ground.profile.layers().len(), 3);
        assert_eq!(scene.vehicles[0].vehicle.speed(), 5.0);

        for (bad, key) in [
            (
                Template {
                    depth: "1.2 kN".into(),
                    ..Template::default()
                },
                "`duct.depth`",
            ),
            (
                Template {
                    cable: "rope".into(),
                    ..Template::default()
                },
                "`cable.preset`",
            ),
            (
                Template {
                    passes: "many".into(),
                    ..Template::default()
                },
                "`traffic.passes`",
            ),
            (
                Template {
                    friction: "nan".into(),
                    ..Template::default()
                },
                "`friction.dynamic_coefficient`",
            ),
            (
                Template {
                    upstream: "loose".into(),
                    ..Template::default()
                },
                "`ends.upstream.spring`",
            ),
        ] {
            let message = bad.to_toml("new.toml").expect_err("a bad answer").to_string();
            assert!(
                message.starts_with("new.toml, line ") && message.contains(key),
                "{message}"
            );
        }
    }
}
