//! One table of a document: checked values by their keys.
//!
//! A [`Table`] knows its keys when it is opened, so that a misspelt key is reported as such and not as the lack of the
//! right one. Every error is made here or in the few checks across keys, with the place where the value was written.

use std::cmp::Ordering;

use ground_field::GroundError;

use super::document::{Content, Entry};
use super::error::{SceneError, WrongKind};
use super::keys::{self, joined};
use super::range::Quantity;
use super::value::Value;

pub struct Table<'d> {
    pub value: Value<'d>,
    entries: &'d [Entry],
}

impl<'d> Table<'d> {
    /// Opens a table, which may hold only its keys.
    pub fn new(value: Value<'d>) -> Result<Self, SceneError> {
        let known = keys::of(&value.path);
        let Content::Table(entries) = &value.node.content else {
            let allowed = format!("a table with the keys {known}");
            return Err(value.wrong(WrongKind::Value, value.written(), allowed));
        };
        if let Some(entry) = entries.iter().find(|entry| !keys::holds(known, &entry.key)) {
            let kind = WrongKind::UnknownKey {
                suggestion: keys::suggestion(&entry.key, known),
            };
            let key = joined(&value.path, &entry.key);
            let document = value.document;
            let allowed = keys::and_where_else(&entry.key, known);
            return Err(document.wrong(kind, &entry.key_place, &key, "", allowed));
        }
        let table = Self { value, entries };
        for key in known.split(", ") {
            if let Some(other) = keys::other_name(key) {
                table.alternatives_of(key, other)?;
            }
        }
        Ok(table)
    }

    /// Refuses two names of one thing that were given at the same time.
    fn alternatives_of(&self, key: &str, other: &str) -> Result<(), SceneError> {
        let has = |name: &str| self.entries.iter().find(|entry| entry.key == name);
        if let (Some(a), Some(b)) = (has(key), has(other)) {
            let (a, b) = (self.value.child(key, &a.value), self.value.child(other, &b.value));
            if self.order(&a, &b) == Ordering::Equal {
                return Err(b.inconsistent(format!("both `{key}` and `{other}`"), "only one of the two"));
            }
        }
        Ok(())
    }

    /// The value at `key`, by whichever of its names it was given later.
    pub fn optional(&self, key: &str) -> Option<Value<'d>> {
        let at = |name: &str| {
            let entry = self.entries.iter().find(|entry| entry.key == name)?;
            Some(self.value.child(name, &entry.value))
        };
        let other = keys::other_name(key).and_then(at);
        match (at(key), other) {
            (Some(value), Some(other)) if self.order(&other, &value) == Ordering::Greater => Some(other),
            (value, other) => value.or(other),
        }
    }

    pub fn required(&self, key: &str, allowed: &str) -> Result<Value<'d>, SceneError> {
        self.optional(key).ok_or_else(|| {
            // The section that lacks it is shown.
            let Value { document, path, node } = &self.value;
            let key = joined(path, key);
            document.wrong(WrongKind::MissingKey, &node.place, &key, "", allowed)
        })
    }

    pub fn table(&self, key: &str) -> Result<Table<'d>, SceneError> {
        let allowed = format!("a section [{key}] with the keys {}", keys::of(key));
        Table::new(self.required(key, &allowed)?)
    }

    pub fn quantity(&self, key: &str, quantity: Quantity) -> Result<f64, SceneError> {
        self.required(key, &quantity.allowed())?.quantity(quantity)
    }

    pub fn optional_quantity(&self, key: &str, quantity: Quantity) -> Result<Option<f64>, SceneError> {
        let value = self.optional(key);
        value.map(|value| value.quantity(quantity)).transpose()
    }

    /// One of the `words` at `key`, or `default`.
    pub fn word<T: Copy>(&self, key: &str, words: &[(&str, T)], default: T) -> Result<T, SceneError> {
        self.optional(key).map_or(Ok(default), |value| value.word(words))
    }

    /// The same, where one word that earlier versions knew is refused for a reason.
    pub fn word_unless<T: Copy>(
        &self,
        key: &str,
        words: &[(&str, T)],
        default: T,
        (gone, reason): (&str, &str),
    ) -> Result<T, SceneError> {
        match self.optional(key) {
            Some(value) if value.text("").is_ok_and(|text| text == gone) => Err(value.gone(words, reason)),
            _ => self.word(key, words, default),
        }
    }

    /// Which of two values was given later.
    pub fn order(&self, one: &Value, other: &Value) -> Ordering {
        let rank = |value: &Value| self.value.document.rank(&value.node.place);
        rank(one).cmp(&rank(other))
    }

    /// Two keys that exclude each other. Of two that were set at different times the later one stands.
    pub fn alternatives(&self, first: &str, second: &str) -> Result<[Option<Value<'d>>; 2], SceneError> {
        match [self.optional(first), self.optional(second)] {
            [Some(a), Some(b)] => match self.order(&a, &b) {
                Ordering::Greater => Ok([Some(a), None]),
                Ordering::Less => Ok([None, Some(b)]),
                Ordering::Equal => {
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
        let beside = match self.optional(choice) {
            Some(chosen) if self.order(&chosen, &value) == Ordering::Greater => return Ok(()),
            Some(chosen) => format!("`{choice}` = {}", chosen.written()),
            None => format!("no `{choice}`"),
        };
        Err(value.inconsistent(format!("{} with {beside}", value.written()), allowed))
    }

    /// The error for what `ground-field` does not accept.
    pub fn rejected(&self, error: GroundError) -> SceneError {
        self.value.wrong(WrongKind::Rejected(error), "", "")
    }
}
