//! A commented scene to start from.
//!
//! The text is made from few answers and checked by reading it: what [`Template::to_toml`] returns is a valid scene.

use std::fmt::Write;

use crate::scene::{FrictionLaw, SceneError, quoted};
use crate::{Scene, presets};

/// Slope of the elastic part of friction \[N/m per m of cable\] behind the shape factor of a new scene: as in the scenes of
/// the full-scale experiment, an assumption.
const SLOPE: f64 = 1e8;
/// Shape factor \[1/m\] where there is no friction.
const FRICTIONLESS_SHAPE_FACTOR: f64 = 1e7;
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
        let mut file = File::default();
        file.remark("A cable in a duct under traffic. To compute: creepage run FILE");
        file.remark("A quantity is a text with its unit, or a bare number in SI. `creepage presets` lists the presets,");
        file.remark("with the source of every value; what stands beside a preset counts instead of it.");
        file.blank();
        file.set("title", &self.title, "");

        file.section("[duct]", "straight, at constant depth");
        file.set("length", &self.length, "from manhole to manhole");
        file.set("depth", &self.depth, "from the road surface to the cable");
        file.option(
            "lateral_offset = \"0.5 m\"",
            "from the vehicles' axis to the duct's; 0 if left out",
        );

        file.section("[ground]", "");
        if let TemplateGround::Pavement(preset) = &self.ground {
            file.set("preset", preset, &summary(preset));
        }
        file.option(
            "vertical_peak = \"120 um\"",
            "if you measured how far the duct goes down: scales the ground",
        );
        file.option(
            "rigid_base_depth = \"12 m\"",
            "bedrock; the ground goes down without end if left out",
        );
        if let TemplateGround::Modulus(modulus) = &self.ground {
            file.section(
                "[[ground.layers]]",
                "from the top; every layer but the last has a thickness",
            );
            file.set(
                "young_modulus",
                modulus,
                "that of small strains, several times that of settlements",
            );
            file.set("poisson_ratio", "0.4", "");
        }

        file.section("[cable]", "");
        file.set("preset", &self.cable, &summary(&self.cable));
        file.option("weight = \"108.8 N/m\"", "instead of the preset's");
        file.option("axial_stiffness = \"8.01e6 N\"", "EA, instead of the preset's");
        file.option(
            "normal_load_factor = 1.5",
            "normal force per metre = factor x weight; 1 if left out",
        );

        file.section("[friction]", "between cable and duct");
        file.set("dynamic_coefficient", &self.friction, "");
        if let Some(shape_factor) = shape_factor {
            let comment = "how steeply friction builds up before slip: assumed, as 1e8 N/m per metre";
            file.set("shape_factor", &format!("{shape_factor:.4e} 1/m"), comment);
        } else {
            file.set("law", "coulomb", "");
        }

        file.section("[ends]", "\"free\", \"fixed\" or { spring = \"3 MN/m\" }");
        file.end(
            "upstream",
            &self.upstream,
            "where forward vehicles come in, x = 0",
        );
        file.end("downstream", &self.downstream, "x = length");

        file.section("[[vehicles]]", "one section for each kind of vehicle");
        file.set("preset", &self.vehicle, &summary(&self.vehicle));
        file.set("speed", &self.speed, "");
        file.option("share = 0.5", "of the passes; equal shares if left out");
        file.option("direction = \"reverse\"", "\"forward\" if left out");

        file.section("[traffic]", "");
        file.set("passes", &self.passes, "of all vehicles together");
        file.text
    }
}

/// What a preset is; nothing where it is not known, which reading the scene will tell.
fn summary(name: &str) -> String {
    presets::all()
        .iter()
        .find(|preset| preset.name == name)
        .map_or_else(String::new, |preset| preset.summary.clone())
}

/// A commented TOML file in the making.
#[derive(Default)]
struct File {
    text: String,
}

impl File {
    fn blank(&mut self) {
        self.text.push('\n');
    }

    fn remark(&mut self, text: &str) {
        self.line(&format!("# {text}"), "");
    }

    fn section(&mut self, heading: &str, comment: &str) {
        self.blank();
        self.line(heading, comment);
    }

    fn set(&mut self, key: &str, value: &str, comment: &str) {
        self.line(&format!("{key} = {}", toml(value)), comment);
    }

    /// A key that is left out.
    fn option(&mut self, text: &str, comment: &str) {
        self.line(&format!("# {text}"), comment);
    }

    fn end(&mut self, key: &str, value: &str, comment: &str) {
        if matches!(value, "free" | "fixed") {
            self.set(key, value, comment);
        } else {
            self.line(&format!("{key} = {{ spring = {} }}", toml(value)), comment);
        }
    }

    fn line(&mut self, code: &str, comment: &str) {
        // Writing to a text does not fail.
        let _ = match comment {
            "" => writeln!(self.text, "{code}"),
            _ => writeln!(self.text, "{code:<COMMENTS$}# {comment}"),
        };
        if !comment.is_empty() && code.len() >= COMMENTS {
            // No blank was left before the comment.
            let at = self.text.len() - comment.len() - "# \n".len();
            self.text.insert(at, ' ');
        }
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
            let text = text.replace(&format!("# {option}"), option);
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
