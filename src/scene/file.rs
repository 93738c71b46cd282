//! A scene file with its overrides, which knows where each value was written.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::check::check;
use super::data::Scene;
use super::document::Document;
use super::error::SceneError;
use super::location::Location;
use super::slips::{self, UnitSlip};
use super::{histogram, overrides, preset, read};

/// A scene file larger than this \[bytes\] is not a scene file.
const LARGEST_FILE: u64 = 16 << 20;

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
        let (node, _) = self.document.find(key);
        (node.place != self.document.root.place).then(|| self.document.locate(&node.place))
    }

    /// Whether the file or an override gives `key` a value.
    #[cfg(feature = "sweep")]
    pub(crate) fn names(&self, key: &str) -> bool {
        self.document.find(key).1
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
        check(self).map_err(SceneError::Wrong)
    }
}
