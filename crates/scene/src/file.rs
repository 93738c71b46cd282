//! A scene file with its overrides, which knows where each value was written.

use std::fs::File;
use std::io::{Error, Read};
use std::path::{Path, PathBuf};

use crate::content::{Content, Node, entries_of};
use crate::error::{Result, SceneError, did_you_mean};
use crate::key::Form;
use crate::location::{Location, Source, SourceKind};
use crate::names::elsewhere;
use crate::scene::Scene;
use crate::stored::{Given, Stored};
use crate::units::{Dimension, Unit};
use crate::{histogram, overrides, preset, rules, unusual};

/// A scene file larger than this \[bytes\] is not a scene file.
const LARGEST_FILE: u64 = 16 << 20;
const SCENE: Form = Form::Table(Scene::KEYS);

/// The text of a scene and what was set on top of it.
///
/// A [`Scene`] is plain data; this is for who needs many scenes of one file, or the line of a key.
///
/// ```
/// use creepage_scene::SceneFile;
///
/// let text = std::fs::read_to_string("../../examples/scenes/full-scale-upper.toml")?;
/// let file = SceneFile::from_toml("upper.toml", &text)?;
/// let deeper = file.with(&["duct.depth=2 m"])?.scene()?;
/// assert_eq!((file.scene()?.duct.depth, deeper.duct.depth), (1.2, 2.0));
/// assert!(file.locate("duct.depth").unwrap().text().starts_with("depth = \"1.2 m\""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// Its values; its own place is the end of the file.
    root: Node,
}

impl SceneFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if the file cannot be read, is not TOML, or names a preset that is not known.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let name = path.as_ref().display().to_string();
        let bytes = match bytes_of(path.as_ref()) {
            Ok(bytes) => bytes,
            Err(why) => return Err(SceneError::Unreadable(name, why)),
        };
        let text = String::from_utf8_lossy(&bytes);
        let Err(error) = std::str::from_utf8(&bytes) else {
            return Self::from_toml(&name, &text);
        };
        let (source, start) = (Source::new(SourceKind::File, &name, &text), error.valid_up_to());
        Err(SceneError::Syntax {
            location: Location::new(&source, start..start),
            message: "found text that is not UTF-8: save the file as UTF-8".to_owned(),
        })
    }

    /// Takes `text` for the file; `name` stands for it in error messages.
    ///
    /// # Errors
    ///
    /// As for [`SceneFile::read`].
    pub fn from_toml(name: &str, text: &str) -> Result<Self> {
        let source = Source::new(SourceKind::File, name, text);
        let content = Content::Table(entries_of(&source)?);
        let mut root = Node::new(Location { source, bytes: None }, content);
        preset::expand(&mut root)?;
        Ok(Self { root })
    }

    /// The file with each `KEY=VALUE` of `overrides` set in turn.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if an override is not `KEY=VALUE`, or there is nothing at its key.
    pub fn with<T: AsRef<str>>(&self, overrides: &[T]) -> Result<Self> {
        let mut file = self.clone();
        for text in overrides {
            overrides::apply(&mut file.root, text.as_ref())?;
            preset::expand(&mut file.root)?;
        }
        Ok(file)
    }

    /// The text of the file, without what was set on top of it.
    pub fn text(&self) -> &str {
        &self.root.place.source.text
    }

    /// The scene.
    ///
    /// # Errors
    ///
    /// [`SceneError`] with the first thing that is wrong, and where.
    pub fn scene(&self) -> Result<Scene> {
        let read = || {
            let mut scene = Scene::read(&Given::new(String::new(), &self.root, SCENE))?;
            scene.resolve(self.root.place.file())?;
            rules::check(&scene).map(|()| scene)
        };
        read().map_err(|error| self.located(error))
    }

    /// Where the value of `key` stands, such as `vehicles.0.speed`, or else the section that would hold it.
    pub fn locate(&self, key: &str) -> Option<Location> {
        let (node, _) = self.find(key);
        (node.place != self.root.place).then(|| node.place.clone())
    }

    /// Warnings of numbers without a unit that someone may have meant in another one, each with its place.
    pub fn slips(&self) -> Vec<(Location, String)> {
        let slip = |(key, node): (String, &Node)| Some((node.place.clone(), unusual::slip(&key, node)?));
        self.root.values("").into_iter().filter_map(slip).collect()
    }

    /// Whether the file, an override or a preset gives `key` a value.
    pub fn names(&self, key: &str) -> bool {
        self.find(key).1
    }

    /// The table of axle loads that the scene reads too, if it names one.
    pub fn histogram(&self) -> Option<PathBuf> {
        let (node, true) = self.find("traffic.histogram") else {
            return None;
        };
        let text = node.content.get("file").unwrap_or(node).content.as_text();
        text.map(|text| histogram::beside(self.root.place.file(), text))
    }

    /// Every key that the file, its overrides or its presets give a value, in their order.
    pub fn typed(&self) -> Vec<Typed> {
        let typed = |(key, node): (String, &Node)| {
            let number = node.content.as_number();
            let text = node.content.as_text().map(str::to_owned);
            let text = text.or_else(|| number.map(|number| number.to_string()));
            Typed {
                key,
                text: text.unwrap_or_else(|| node.written()),
                is_number: number.is_some(),
                source: node.place.file().to_owned(),
            }
        };
        self.root.values("").into_iter().map(typed).collect()
    }

    /// The unit of the quantity that was typed at `key`; none for a bare number, and for what a preset gives.
    pub fn typed_unit(&self, key: &str, dimension: Dimension) -> Option<Unit> {
        let (node, is_value) = self.find(key);
        let is_typed = is_value && node.place.source.kind != SourceKind::Preset;
        dimension.unit_of(node.content.as_text().filter(|_| is_typed)?)
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    fn find(&self, key: &str) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.split('.') {
            match node.content.get(segment) {
                Some(inner) => node = inner,
                None => return (node, false),
            }
        }
        (node, true)
    }

    /// The error with the place of its key; if nothing stands there, with that of the section that lacks it.
    fn located(&self, mut error: SceneError) -> SceneError {
        if let SceneError::Wrong(wrong) = &mut error {
            let (section, key) = wrong.key.rsplit_once('.').unwrap_or(("", &wrong.key));
            let unknown = self.find(section).0.content.entry(key);
            let unknown = unknown.filter(|_| wrong.is_unknown);
            let place = || &self.find(&wrong.key).0.place;
            wrong.location = Some(unknown.map_or_else(place, |node| &node.key_place).clone());
            if wrong.is_unknown {
                let (other, words) = elsewhere(key);
                if !wrong.found.ends_with("?)") {
                    wrong.found += &did_you_mean(other);
                }
                wrong.allowed += words;
            }
        }
        error
    }
}

/// A key and what stands there, as it was typed or as a preset has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Typed {
    /// The key with the numbers of list items: `vehicles.0.speed`.
    pub key: String,
    /// What stands there, a text without quotes.
    pub text: String,
    /// Whether it is a number without quotes.
    pub is_number: bool,
    /// The file, the override or the preset that gives it.
    pub source: String,
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Error> {
    if path.is_dir() {
        let found = "this is a folder; a scene is a file, such as my-duct.toml";
        return Err(Error::other(found));
    }
    let mut bytes = Vec::new();
    let size = File::open(path)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
    if size as u64 <= LARGEST_FILE {
        return Ok(bytes);
    }
    let allowed = format!("found more than {LARGEST_FILE} bytes; allowed: a scene file of at most so many");
    Err(Error::other(allowed))
}

impl Scene {
    /// Reads the scene file at `path`. For overrides on top of it there is [`SceneFile::with`].
    ///
    /// # Errors
    ///
    /// [`SceneError`] with the first thing that is wrong, and where.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        SceneFile::read(path)?.scene()
    }

    /// Reads a scene from TOML `text`; `name` stands for the file in error messages.
    ///
    /// # Errors
    ///
    /// As for [`Scene::from_file`].
    pub fn from_toml(name: &str, text: &str) -> Result<Self> {
        SceneFile::from_toml(name, text)?.scene()
    }

    /// Checks everything that reading a scene file checks. What computes with a scene does so first.
    ///
    /// # Errors
    ///
    /// [`SceneError::Wrong`] with the first key whose value is out of its range or contradicts another one.
    pub fn validate(&self) -> Result<()> {
        Self::read(&Given::new(String::new(), &self.node(), SCENE))?;
        rules::check(self)
    }

    /// The scene as a TOML file, all quantities in SI: [`Scene::from_toml`] reads the same scene from it.
    pub fn to_toml(&self) -> String {
        // Tables, lists, numbers and texts: there is nothing among them that TOML cannot write.
        toml::to_string(&self.node().content).unwrap_or_default()
    }

    /// The tree of the file that it would be.
    pub(crate) fn node(&self) -> Node {
        self.write(SCENE).into()
    }
}
