//! What was typed at the keys of a scene, and in which unit.

use super::document::{Content, Node, Origin};
use super::file::SceneFile;
use super::keys::joined;
use super::units::{Dimension, Unit};

/// A key and what stands there, as it was typed or as a preset has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Typed {
    /// The key with the numbers of list items: `vehicles.0.speed`.
    pub key: String,
    /// What stands there.
    pub value: TypedValue,
    /// The file, the override or the preset that gives it.
    pub source: String,
}

/// A value of a scene file as it was typed.
#[derive(Debug, Clone, PartialEq)]
pub enum TypedValue {
    /// A bare number.
    Number(f64),
    /// A text, quantities with their units among them.
    Text(String),
}

impl SceneFile {
    /// Every key that the file, its overrides or its presets give a value, in their order.
    pub fn typed(&self) -> Vec<Typed> {
        let mut found = Vec::new();
        self.collect("", &self.document.root, &mut found);
        found
    }

    fn collect(&self, key: &str, node: &Node, found: &mut Vec<Typed>) {
        let value = match &node.content {
            Content::Table(entries) => {
                for entry in entries {
                    self.collect(&joined(key, &entry.key), &entry.value, found);
                }
                return;
            }
            Content::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    self.collect(&joined(key, &index.to_string()), item, found);
                }
                return;
            }
            Content::Number { value, .. } => TypedValue::Number(*value),
            Content::Text(text) => TypedValue::Text(text.clone()),
            Content::Other => TypedValue::Text(self.document.written(&node.place)),
        };
        found.push(Typed {
            key: key.to_owned(),
            value,
            source: self.document.source(&node.place).to_owned(),
        });
    }

    /// The unit of the quantity that was typed at `key`; none for a bare number, and for what a preset gives.
    pub fn typed_unit(&self, key: &str, dimension: Dimension) -> Option<Unit> {
        let (node, true) = self.document.find(key) else {
            return None;
        };
        let Content::Text(text) = &node.content else {
            return None;
        };
        let is_typed = self.document.rank(&node.place).1 == Origin::Written;
        dimension.unit_of(text).filter(|_| is_typed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file() -> SceneFile {
        let text = "[duct]\nlength = \"98 ft\"\ndepth = 1.2\n[[vehicles]]\npreset = \"t-25\"\n[ends]\ndownstream = { spring = \"3 MN / m\" }";
        let file = SceneFile::from_toml("duct.toml", text).expect("a file");
        file.with(&["duct.slope=2 %"]).expect("a file")
    }

    #[test]
    fn units_are_those_that_were_typed() {
        let symbol = |key, dimension| file().typed_unit(key, dimension).map(|unit| unit.symbol());
        assert_eq!(symbol("duct.length", Dimension::Length), Some("ft"));
        assert_eq!(
            symbol("ends.downstream.spring", Dimension::ForcePerLength),
            Some("MN/m")
        );
        assert_eq!(symbol("duct.slope", Dimension::Slope), Some("%"));
        for (key, dimension) in [
            ("duct.depth", Dimension::Length),
            ("duct.length", Dimension::Force),
            ("duct", Dimension::Length),
            ("ends.upstream.spring", Dimension::ForcePerLength),
            // A preset's.
            ("vehicles.0.wheels.0.load", Dimension::Force),
        ] {
            assert_eq!(symbol(key, dimension), None, "{key}");
        }
    }

    #[test]
    fn every_value_stands_in_the_list_with_what_gave_it() {
        let typed = file().typed();
        let of = |key: &str| {
            let found = typed.iter().find(|typed| typed.key == key).expect(key);
            (found.value.clone(), found.source.clone())
        };
        let text = |text: &str| TypedValue::Text(text.into());
        assert_eq!(of("duct.length"), (text("98 ft"), "duct.toml".into()));
        assert_eq!(of("duct.depth"), (TypedValue::Number(1.2), "duct.toml".into()));
        assert_eq!(of("duct.slope"), (text("2 %"), "--set duct.slope=2 %".into()));
        assert_eq!(of("vehicles.0.wheels.0.load").1, "preset t-25");
    }
}
