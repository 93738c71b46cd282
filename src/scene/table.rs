//! One table of a document: checked values by their keys.
//!
//! A [`Table`] knows its keys when it is opened, so that a misspelt key is reported as such and not as the lack of the
//! right one. Every error is made here or in the few checks across keys, with the place where the value was written.

use ground_field::GroundError;

use super::document::{Content, Document, Entry, Node, Place};
use super::keys::{OTHER_NAMES, SECTIONS};
use super::nearest::nearest;
use super::range::{Range, allowed_number, allowed_quantity};
use super::value::Value;
use super::{Dimension, SceneError};

/// A table of the document.
pub(super) struct Table<'d> {
    document: &'d Document,
    /// Its key with those of the tables around it; empty for the document.
    path: String,
    place: &'d Place,
    entries: &'d [Entry],
}

impl<'d> Table<'d> {
    /// Opens a table that may hold only the keys `known`.
    pub fn new(
        document: &'d Document,
        path: String,
        node: &'d Node,
        known: &'static [&'static str],
    ) -> Result<Self, SceneError> {
        let Content::Table(entries) = &node.content else {
            return Err(SceneError::WrongType {
                location: document.locate(&node.place),
                found: document.written(&node.place),
                key: path,
                allowed: format!("a table with the keys {}", known.join(", ")),
            });
        };
        if let Some(entry) = entries.iter().find(|entry| !known.contains(&entry.key.as_str())) {
            let elsewhere = || {
                SECTIONS
                    .iter()
                    .find(|(_, keys)| keys.contains(&entry.key.as_str()))
                    .map(|(section, _)| format!("{section}.{}", entry.key))
            };
            return Err(SceneError::UnknownKey {
                location: document.locate(&entry.key_place),
                key: joined(&path, &entry.key),
                allowed: known.join(", "),
                suggestion: nearest(&entry.key, known.iter().copied())
                    .or_else(|| other_name(&entry.key, known))
                    .map(str::to_owned)
                    .or_else(elsewhere),
            });
        }
        Ok(Self {
            document,
            path,
            place: &node.place,
            entries,
        })
    }

    pub fn optional(&self, key: &str) -> Option<Value<'d>> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(Value {
            document: self.document,
            path: joined(&self.path, key),
            node: &entry.value,
        })
    }

    pub fn required(&self, key: &str, allowed: &str) -> Result<Value<'d>, SceneError> {
        self.optional(key).ok_or_else(|| SceneError::MissingKey {
            location: self.document.locate(self.place),
            key: joined(&self.path, key),
            allowed: allowed.to_owned(),
        })
    }

    /// The required table at `key`.
    pub fn table(&self, key: &str, known: &'static [&'static str]) -> Result<Table<'d>, SceneError> {
        self.required(
            key,
            &format!("a section [{key}] with the keys {}", known.join(", ")),
        )?
        .table(known)
    }

    /// The required quantity at `key`; `example` shows how to write one.
    pub fn quantity(
        &self,
        key: &str,
        dimension: Dimension,
        range: Range,
        example: &str,
    ) -> Result<f64, SceneError> {
        self.required(key, &allowed_quantity(dimension, range, example))?
            .quantity(dimension, range, example)
    }

    pub fn optional_quantity(
        &self,
        key: &str,
        dimension: Dimension,
        range: Range,
        example: &str,
    ) -> Result<Option<f64>, SceneError> {
        self.optional(key)
            .map(|value| value.quantity(dimension, range, example))
            .transpose()
    }

    /// The required dimensionless number at `key`.
    pub fn number(&self, key: &str, range: Range) -> Result<f64, SceneError> {
        self.required(key, &allowed_number(range))?.number(range)
    }

    pub fn optional_number(&self, key: &str, range: Range) -> Result<Option<f64>, SceneError> {
        self.optional(key).map(|value| value.number(range)).transpose()
    }

    /// One of the `words` at `key`, or `default`.
    pub fn word<T: Copy>(&self, key: &str, words: &[(&str, T)], default: T) -> Result<T, SceneError> {
        self.optional(key).map_or(Ok(default), |value| value.word(words))
    }

    fn rank(&self, value: &Value) -> usize {
        self.document.rank(&value.node.place)
    }

    /// Two keys that exclude each other. Of two that were set at different times the later one stands.
    pub fn alternatives(&self, first: &str, second: &str) -> Result<[Option<Value<'d>>; 2], SceneError> {
        match [self.optional(first), self.optional(second)] {
            [Some(a), Some(b)] => match self.rank(&a).cmp(&self.rank(&b)) {
                std::cmp::Ordering::Greater => Ok([Some(a), None]),
                std::cmp::Ordering::Less => Ok([None, Some(b)]),
                std::cmp::Ordering::Equal => {
                    Err(b.inconsistent(format!("both `{first}` and `{second}`"), "only one of the two"))
                }
            },
            both => Ok(both),
        }
    }

    /// Refuses `key`, which has no meaning with what was chosen at the key `choice`. Where the choice was made later, by
    /// an override, it stands and `key` is left aside.
    pub fn refuse(&self, key: &str, choice: &str, allowed: &str) -> Result<(), SceneError> {
        let Some(value) = self.optional(key) else {
            return Ok(());
        };
        let chosen = self.optional(choice);
        if chosen
            .as_ref()
            .is_some_and(|chosen| self.rank(chosen) > self.rank(&value))
        {
            return Ok(());
        }
        let beside = chosen.map_or_else(
            || format!("no `{choice}`"),
            |chosen| format!("`{choice}` = {}", self.document.written(&chosen.node.place)),
        );
        Err(value.inconsistent(format!("{} with {beside}", value.written()), allowed))
    }

    /// The error for what `ground-field` does not accept.
    pub fn rejected(&self, source: GroundError) -> SceneError {
        SceneError::Rejected {
            location: self.document.locate(self.place),
            key: self.path.clone(),
            source,
        }
    }

    /// The error for a table whose keys contradict each other or another one.
    pub fn inconsistent(&self, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        SceneError::Inconsistent {
            location: self.document.locate(self.place),
            key: self.path.clone(),
            found: found.into(),
            allowed: allowed.into(),
        }
    }
}

/// The known key that has the meaning of this one elsewhere.
fn other_name(key: &str, known: &[&'static str]) -> Option<&'static str> {
    let (_, name) = OTHER_NAMES.iter().find(|(other, _)| *other == key)?;
    known.contains(name).then_some(*name)
}

pub(super) fn joined(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}
