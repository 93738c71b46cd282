//! Types whose values stand in a file. Each is read together with the form of its key: an error says what is allowed.

use crate::content::{Content, Node, joined};
use crate::error::{Result, SceneError, did_you_mean};
use crate::key::{Form, Key, unknown_key};
use crate::nearest::nearest;
use crate::range::Quantity;
use crate::rivals::contradiction;

/// A type whose values stand in a file.
pub trait Stored: Sized {
    /// The keys of a type that is a table of the file.
    const KEYS: &'static [Key] = &[];
    /// The value in SI.
    fn read(given: &Given) -> Result<Self>;
    /// The value as it is written, quantities in SI with their units.
    fn write(&self, form: Form) -> Content;
}

/// What stands at a key, and what may stand there.
pub struct Given<'n> {
    pub path: String,
    pub node: &'n Node,
    pub form: Form,
}

impl<'n> Given<'n> {
    pub fn new(path: String, node: &'n Node, form: Form) -> Self {
        Self { path, node, form }
    }

    /// The error of a value that is not allowed.
    fn wrong(&self, found: impl AsRef<str>) -> SceneError {
        SceneError::value(&self.path, found, self.form.allowed())
    }

    /// The error of a value of a kind that is not allowed.
    pub fn of_other_kind(&self) -> SceneError {
        self.wrong(self.node.described())
    }

    /// Refuses what is no table, and keys of a table that are not known or exclude each other. An unknown key is reported before one that
    /// is missing: a misspelt one is both.
    pub fn check_table(&self) -> Result<()> {
        let keys = self.form.keys();
        let is_unknown = |node: &&Node| !keys.iter().any(|key| key.is_named(&node.key));
        match (&self.node.content, self.form) {
            (Content::Table(entries), _) => match entries.iter().find(is_unknown) {
                Some(node) => Err(unknown_key(&self.path, &node.key, keys)),
                None => contradiction(&self.path, self.node),
            },
            (Content::Text(_), Form::Either(..)) => Ok(()),
            _ => Err(self.of_other_kind()),
        }
    }

    /// The value at a key of a table, or what counts if it is left out. A text in place of a table stands at the first of its keys.
    pub fn value<T: Stored>(&self, name: &str, form: Form, absent: Option<T>) -> Result<T> {
        let is_first = || self.form.keys().first().is_some_and(|key| key.name == name);
        let node = match self.node.content {
            Content::Text(_) => Some(self.node).filter(|_| is_first()),
            _ => self.node.content.get(name),
        };
        let path = joined(&self.path, name);
        match node {
            Some(node) => T::read(&Given::new(path, node, form)),
            None => absent.ok_or_else(|| SceneError::missing(&path, form.allowed())),
        }
    }

    /// What the word that is given stands for.
    pub fn word<T: Copy>(&self, words: &[(&str, T)], allowed: String) -> Result<T> {
        let Some(text) = self.node.content.as_text() else {
            return Err(SceneError::value(&self.path, self.node.described(), allowed));
        };
        let known = words.iter().find(|(word, _)| *word == text);
        known.map(|(_, value)| *value).ok_or_else(|| {
            let meant = did_you_mean(nearest(text, words.iter().map(|(word, _)| *word)));
            SceneError::value(&self.path, self.node.written() + &meant, allowed)
        })
    }
}

/// The value as it is written at its key, unless it counts without being written.
pub fn written<T: Stored + PartialEq>(value: &T, form: Form, absent: Option<&T>) -> Option<Content> {
    (absent != Some(value)).then(|| value.write(form))
}

impl Stored for f64 {
    fn read(given: &Given) -> Result<Self> {
        let (content, written) = (&given.node.content, given.node.written());
        let quantity = given.form.quantity().ok_or_else(|| given.of_other_kind())?;
        let wrong = |why| given.wrong(format!("{written}: {why}"));
        let value = match (content.as_text(), quantity.dimension) {
            (Some(text), Some(dimension)) => dimension.parse(text).map_err(wrong)?,
            _ => content.as_number().ok_or_else(|| given.of_other_kind())?,
        };
        if quantity.contains(value) {
            return Ok(value);
        }
        let bare = quantity.dimension.filter(|_| content.as_text().is_none());
        let unit = bare.map(|dimension| dimension.si().unwrap_or("1, not in %"));
        let bare = unit.map_or_else(String::new, |unit| format!("; a bare number is in {unit}"));
        let allowed = given.form.allowed() + &bare;
        Err(SceneError::value(&given.path, written, allowed))
    }

    fn write(&self, form: Form) -> Content {
        match form.quantity().and_then(Quantity::unit) {
            Some(unit) => Content::Text(format!("{self:?} {unit}")),
            None => Content::Number(*self),
        }
    }
}

impl Stored for u64 {
    fn read(given: &Given) -> Result<Self> {
        f64::read(given)?;
        match given.node.content {
            Content::Whole(whole) => Ok(whole),
            _ => Err(given.wrong(given.node.written())),
        }
    }

    fn write(&self, _: Form) -> Content {
        Content::Whole(*self)
    }
}

impl Stored for String {
    fn read(given: &Given) -> Result<Self> {
        let is_blank = |text: &str| matches!(given.form, Form::Name(_)) && text.trim().is_empty();
        let text = given.node.content.as_text().filter(|text| !is_blank(text));
        text.map(str::to_owned).ok_or_else(|| given.of_other_kind())
    }

    fn write(&self, _: Form) -> Content {
        Content::Text(self.clone())
    }
}

impl<T: Stored> Stored for Option<T> {
    fn read(given: &Given) -> Result<Self> {
        T::read(given).map(Some)
    }

    fn write(&self, form: Form) -> Content {
        self.as_ref().map_or(Content::Other, |value| value.write(form))
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn read(given: &Given) -> Result<Self> {
        let (Form::List(forms, least, _), Content::List(items)) = (given.form, &given.node.content) else {
            return Err(given.of_other_kind());
        };
        if items.len() < least {
            return Err(given.wrong(["an empty list", "one item"][items.len().min(1)]));
        }
        let item = |(index, (node, form)): (usize, (_, &Form))| {
            T::read(&Given::new(joined(&given.path, index), node, *form))
        };
        let items = items.iter().zip(forms.iter().cycle());
        items.enumerate().map(item).collect()
    }

    fn write(&self, form: Form) -> Content {
        let Form::List(forms, ..) = form else {
            return Content::Other;
        };
        let items = self.iter().zip(forms.iter().cycle());
        Content::List(items.map(|(item, form)| item.write(*form).into()).collect())
    }
}

/// A list of two.
impl<T: Stored + Copy> Stored for (T, T) {
    fn read(given: &Given) -> Result<Self> {
        match Vec::<T>::read(given)?[..] {
            [first, second] => Ok((first, second)),
            _ => Err(given.of_other_kind()),
        }
    }

    fn write(&self, form: Form) -> Content {
        vec![self.0, self.1].write(form)
    }
}
