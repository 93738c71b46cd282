//! The values of a scene file with what was set on top of it, each with the text in which it stands.

use crate::content::Node;
use crate::error::{SceneError, did_you_mean};
use crate::names::elsewhere;

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
    /// Its values; its own place is the end of the file.
    pub(crate) root: Node,
}

impl SceneFile {
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

    /// The error with the place of its key; if nothing stands there, with that of the section that lacks it.
    pub(crate) fn located(&self, error: SceneError) -> SceneError {
        let SceneError::Wrong(mut wrong) = error else {
            return error;
        };
        let (section, key) = wrong.key.rsplit_once('.').unwrap_or(("", &wrong.key));
        let (node, _) = self.find(&wrong.key);
        let unknown = self.find(section).0.content.entry(key);
        let unknown = unknown.filter(|_| wrong.is_unknown);
        let mut location = unknown.map_or(&node.place, |node| &node.key_place).location();
        // What the top level lacks would be added at the end, but is not on its last line.
        if unknown.is_none() && std::ptr::eq(node, &self.root) {
            (location.text, location.marked) = (String::new(), 0..0);
        }
        wrong.location = Some(location);
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
