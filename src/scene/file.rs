//! A scene file with its overrides, which knows where each value was written.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::data::{Order, Scene};
use super::document::{Content, Document, Node};
use super::error::SceneError;
use super::location::Location;
use super::range::shown;
use super::slips::{self, UnitSlip};
use super::{histogram, overrides, preset, read};

/// A scene file larger than this \[bytes\] is not a scene file.
const LARGEST_FILE: u64 = 16 << 20;
/// How far a share, or a factor beside itself, may be from what it has to be.
const ROUNDING: f64 = 1e-9;

/// The text of a scene and what was set on top of it.
///
/// A [`Scene`] is plain data; this is for who needs many scenes of one file, or the line of a key.
///
/// ```
/// use creepage::scene::SceneFile;
///
/// let text = std::fs::read_to_string("examples/scenes/full-scale-upper.toml")?;
/// let file = SceneFile::from_toml("upper.toml", &text)?;
/// let deeper = file.with(&["duct.depth=2 m"])?.scene()?;
/// assert_eq!((file.scene()?.duct.depth, deeper.duct.depth), (1.2, 2.0));
/// assert!(file.locate("duct.depth").unwrap().text.starts_with("depth = \"1.2 m\""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SceneFile {
    name: String,
    pub(super) document: Document,
}

impl SceneFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where the file cannot be read, is not TOML, or names a preset that is not known.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|open| open.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
        match read {
            Err(_) if path.is_dir() => {
                let what = "this is a folder; a scene is a file, such as my-duct.toml";
                let source = std::io::Error::new(std::io::ErrorKind::IsADirectory, what);
                return Err(SceneError::Unreadable(file, source));
            }
            Err(source) => return Err(SceneError::Unreadable(file, source)),
            Ok(length) if length as u64 > LARGEST_FILE => {
                return Err(SceneError::TooLarge(file, LARGEST_FILE));
            }
            Ok(_) => {}
        }
        let text = String::from_utf8(bytes).map_err(|e| SceneError::not_utf8(&file, &e))?;
        Self::from_toml(&file, &text)
    }

    /// Takes `text` for the file; `name` stands for it in error messages.
    ///
    /// # Errors
    ///
    /// As for [`SceneFile::read`].
    pub fn from_toml(name: &str, text: &str) -> Result<Self, SceneError> {
        let mut document = Document::parse(name, text)?;
        preset::expand(&mut document)?;
        Ok(Self {
            name: name.to_owned(),
            document,
        })
    }

    /// The file with each `KEY=VALUE` of `overrides` set in turn.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where an override is not `KEY=VALUE`, or there is nothing at its key.
    pub fn with<T: AsRef<str>>(&self, overrides: &[T]) -> Result<Self, SceneError> {
        let mut file = self.clone();
        for text in overrides {
            overrides::apply(&mut file.document, text.as_ref())?;
            preset::expand(&mut file.document)?;
        }
        Ok(file)
    }

    /// The text of the file, without what was set on top of it.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// The scene.
    ///
    /// # Errors
    ///
    /// [`SceneError`] with the first thing that is wrong, and where.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        read::scene(&self.name, &self.document)
    }

    /// Where the value of `key` stands, such as `vehicles.0.speed`, or else the section that would hold it.
    pub fn locate(&self, key: &str) -> Option<Location> {
        let mut found = None;
        let mut node = &self.document.root;
        for segment in key.split('.') {
            let Some(inner) = child(node, segment) else {
                break;
            };
            node = inner;
            found = Some(&node.place);
        }
        found.map(|place| self.document.locate(place))
    }

    /// Whether the file or an override gives `key` a value.
    #[cfg(feature = "sweep")]
    pub(crate) fn names(&self, key: &str) -> bool {
        let root = Some(&self.document.root);
        key.split('.')
            .fold(root, |node, segment| child(node?, segment))
            .is_some()
    }

    /// Numbers without a unit that someone may have meant in another one.
    pub fn unit_slips(&self) -> Vec<UnitSlip> {
        slips::unit_slips(&self.document)
    }

    /// All texts of the file with their keys.
    #[cfg(feature = "sweep")]
    pub(crate) fn texts(&self) -> Vec<(String, String)> {
        let mut texts = Vec::new();
        self.document.root.texts(String::new(), &mut texts);
        texts
    }

    /// The table of axle loads that the scene reads too, if it names one.
    pub fn histogram(&self) -> Option<PathBuf> {
        histogram::path(&self.name, &self.document)
    }

    /// All keys and values of the file and its overrides, without comments: two files with the same text make the same scenes, where what
    /// they name is the same.
    #[cfg(feature = "sweep")]
    pub(crate) fn values(&self) -> String {
        format!("{:?}", self.document.root)
    }
}

impl Scene {
    /// Reads the scene file at `path`. For overrides on top of it there is [`SceneFile::with`].
    ///
    /// # Errors
    ///
    /// [`SceneError`] with the first thing that is wrong, and where.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        SceneFile::read(path)?.scene()
    }

    /// Reads a scene from TOML `text`; `name` stands for the file in error messages.
    ///
    /// # Errors
    ///
    /// As for [`Scene::from_file`].
    pub fn from_toml(name: &str, text: &str) -> Result<Self, SceneError> {
        SceneFile::from_toml(name, text)?.scene()
    }

    /// Checks everything that reading a scene file checks. What computes with a scene does so first.
    ///
    /// ```
    /// use creepage::Scene;
    ///
    /// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    /// scene.validate()?;
    /// scene.duct.depth = -1.0;
    /// let error = scene.validate().unwrap_err().to_string();
    /// assert!(error.starts_with("`duct.depth`: out of range: found \"-1.0 m\"; allowed: a length greater than 0, from 1 cm to 1 km"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SceneError::Wrong`] with the first key whose value is out of its range or contradicts another one.
    pub fn validate(&self) -> Result<(), SceneError> {
        if let Order::Sequence(sequence) = &self.traffic.order {
            let count = self.vehicles.len();
            if let Some(index) = sequence.iter().find(|&&index| index >= count) {
                let allowed = format!("a vehicle's index, less than {count}");
                return Err(SceneError::value("traffic.sequence", index.to_string(), allowed));
            }
        }
        // A scene is valid if a file can hold it.
        let read = SceneFile::from_toml("scene", &self.to_toml()).and_then(|file| file.scene());
        let read = read.map_err(SceneError::without_location)?;
        let (factor, follows) = (self.cable.normal_load_factor, read.cable.normal_load_factor);
        // Written so that NaN fails.
        let same = (factor - follows).abs() <= ROUNDING * follows;
        if !same {
            let allowed = format!(
                "{}, which follows from the arrangement and the diameters",
                shown(follows)
            );
            return Err(SceneError::value(
                "cable.normal_load_factor",
                shown(factor),
                allowed,
            ));
        }
        for (index, (one, other)) in self.vehicles.iter().zip(&read.vehicles).enumerate() {
            if (one.share - other.share).abs() > ROUNDING {
                let allowed = format!(
                    "{}, with which all shares sum to 1 and suit a sequence",
                    shown(other.share)
                );
                let key = format!("vehicles.{index}.share");
                return Err(SceneError::value(key, shown(one.share), allowed));
            }
        }
        Ok(())
    }
}

pub(super) fn child<'n>(node: &'n Node, segment: &str) -> Option<&'n Node> {
    match &node.content {
        Content::Table(entries) => Some(&entries.iter().find(|entry| entry.key == segment)?.value),
        Content::Array(items) => items.get(segment.parse::<usize>().ok()?),
        _ => None,
    }
}
