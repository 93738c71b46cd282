//! The values of a scene file with what was set on top of it, each with the text in which it stands.

use crate::content::{Node, Place};
use crate::error::{SceneError, did_you_mean};
use crate::location::Location;
use crate::names::elsewhere;

/// The texts, and the tree of their values.
#[derive(Debug, Clone)]
pub struct Document {
    /// The file, and behind it presets and overrides as they are named.
    pub sources: Vec<Source>,
    pub root: Node,
}

/// The text of the file, of an override or of a preset.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub text: String,
    pub is_preset: bool,
}

impl Document {
    pub fn new(root: Node) -> Self {
        let sources = Vec::new();
        Self { sources, root }
    }

    /// Adds a text: its number.
    pub fn add(&mut self, name: String, text: &str, is_preset: bool) -> usize {
        let text = text.to_owned();
        self.sources.push(Source {
            name,
            text,
            is_preset,
        });
        self.sources.len() - 1
    }

    /// The text in which a value stands.
    pub fn source(&self, node: &Node) -> &Source {
        &self.sources[node.place.source]
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    pub fn find(&self, key: &str) -> (&Node, bool) {
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
    pub fn location(&self, place: &Place) -> Location {
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
    pub fn located(&self, error: SceneError) -> SceneError {
        let SceneError::Wrong(mut wrong) = error else {
            return error;
        };
        let (section, key) = wrong.key.rsplit_once('.').unwrap_or(("", &wrong.key));
        let entry = self.find(section).0.content.entry(key);
        let unknown = entry.filter(|_| wrong.is_unknown);
        let place = unknown.map_or(&self.find(&wrong.key).0.place, |entry| &entry.place);
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
