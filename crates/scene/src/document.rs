//! The values of a scene file with what was set on top of it, each with the text in which it stands.

use crate::content::{Node, Place, entries_of};
use crate::error::{Result, SceneError, did_you_mean};
use crate::location::Location;
use crate::names::elsewhere;

/// The text of the file, of an override or of a preset.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub text: String,
    pub is_preset: bool,
}

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
/// assert!(file.locate("duct.depth").unwrap().text.starts_with("depth = \"1.2 m\""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// The file, and behind it presets and overrides as they are named.
    pub(crate) sources: Vec<Source>,
    /// The values.
    pub(crate) root: Node,
}

impl SceneFile {
    /// Adds a text: its number.
    pub(crate) fn add(&mut self, name: String, text: &str, is_preset: bool) -> usize {
        self.sources.push(Source {
            name,
            text: text.to_owned(),
            is_preset,
        });
        self.sources.len() - 1
    }

    /// Adds a text of TOML: its entries.
    pub(crate) fn parsed(&mut self, name: String, text: &str, is_preset: bool) -> Result<Vec<Node>> {
        let source = self.add(name, text, is_preset);
        entries_of(&self.sources[source].name, text, source)
    }

    /// The text in which a value stands.
    pub(crate) fn source(&self, node: &Node) -> &Source {
        &self.sources[node.place.source]
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    pub(crate) fn find(&self, key: &str) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.split('.') {
            match node.content.get(segment) {
                Some(inner) => node = inner,
                None => return (node, false),
            }
        }
        (node, true)
    }

    /// A place as a message shows it.
    pub(crate) fn location(&self, place: &Place) -> Location {
        let Source { name, text, .. } = &self.sources[place.source];
        if *place != self.root.place {
            return Location::new(name, text, place.bytes.clone(), place.source == 0);
        }
        // What the top level lacks would be added at the end, but is not on its last line.
        let end = text.trim_end().len();
        Location {
            text: String::new(),
            marked: 0..0,
            ..Location::new(name, &text[..end], end..end, true)
        }
    }

    /// The error with the place of its key; if nothing stands there, with that of the section that lacks it.
    pub(crate) fn located(&self, error: SceneError) -> SceneError {
        let SceneError::Wrong(mut wrong) = error else {
            return error;
        };
        let (section, key) = wrong.key.rsplit_once('.').unwrap_or(("", &wrong.key));
        let entry = self.find(section).0.content.entry(key);
        let unknown = entry.filter(|_| wrong.is_unknown);
        let place = unknown.map_or(&self.find(&wrong.key).0.place, |node| &node.key_place);
        wrong.location = Some(self.location(place));
        if wrong.is_unknown {
            let (other, words) = elsewhere(key);
            if !wrong.found.ends_with("?)") {
                wrong.found += &did_you_mean(other);
            }
            wrong.allowed += words;
        }
        SceneError::Wrong(wrong)
    }
}
