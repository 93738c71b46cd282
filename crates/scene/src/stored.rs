//! Types whose values stand in a file. Each is read beside the form of its key: an error says what is allowed.

use crate::content::{Content, Entry, Node, joined, other_name};
use crate::error::{SceneError, did_you_mean};
use crate::key::{Form, Key};
use crate::names::meant_by;
use crate::nearest::nearest;
use crate::rivals::contradiction;

/// A type whose values stand in a file.
pub trait Stored: Sized {
    /// The value that stands at `path`, in SI.
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError>;
    /// The value as it is written, quantities in SI with their units.
    fn write(&self, form: Form) -> Content;
}

/// The entries of a table, whose keys are known and do not exclude each other.
pub struct Entries<'n> {
    node: &'n Node,
    keys: &'static [Key],
    path: &'n str,
}

impl<'n> Entries<'n> {
    /// An unknown key is told before one that is missing: a misspelt one is both.
    pub fn of(node: &'n Node, form: Form, path: &'n str) -> Result<Self, SceneError> {
        let keys = form.keys();
        match (&node.content, form) {
            (Content::Table(entries), _) => {
                let is_known = |name: &str| keys.iter().any(|key| key.name == name);
                let is_known = |name: &str| is_known(name) || other_name(name).is_some_and(is_known);
                if let Some(entry) = entries.iter().find(|entry| !is_known(&entry.key)) {
                    return Err(unknown_key(entry, keys, path));
                }
                contradiction(path, node)?;
            }
            (Content::Text(_), Form::Either(..)) => {}
            _ => return Err(SceneError::value(path, node.described(), form.allowed())),
        }
        Ok(Self { node, keys, path })
    }

    /// The value at a key, or what counts if it is left out. A text in place of a table stands at the first of its keys.
    pub fn value<T: Stored>(&self, name: &str, absent: Option<T>) -> Result<T, SceneError> {
        let is_first = self.keys.first().is_some_and(|key| key.name == name);
        let node = match self.node.content {
            Content::Text(_) => Some(self.node).filter(|_| is_first),
            _ => self.node.content.get(name),
        };
        let (path, form) = (joined(self.path, name), form_of(self.keys, name));
        match node {
            Some(node) => T::read(node, form, &path),
            None => absent.ok_or_else(|| SceneError::missing(&path, form.allowed())),
        }
    }
}

fn form_of(keys: &[Key], name: &str) -> Form {
    let key = keys.iter().find(|key| key.name == name);
    key.map_or(Form::Text(""), |key| key.form)
}

fn unknown_key(entry: &Entry, keys: &[Key], path: &str) -> SceneError {
    let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
    let (meant, elsewhere) = meant_by(&entry.key, &names);
    let (path, allowed) = (joined(path, &entry.key), names.join(", ") + elsewhere);
    SceneError::unknown(&path, meant, allowed)
}

/// The entry of a table for a value, unless it counts without one.
pub fn entry<'k, T: Stored + PartialEq>(
    keys: &[Key],
    name: &'k str,
    value: &T,
    absent: Option<T>,
) -> Option<(&'k str, Content)> {
    let is_needed = absent.as_ref() != Some(value);
    is_needed.then(|| (name, value.write(form_of(keys, name))))
}

/// What the word at `path` stands for.
pub fn word<T: Copy>(words: &[(&str, T)], node: &Node, path: &str, allowed: String) -> Result<T, SceneError> {
    let Some(text) = node.content.as_text() else {
        return Err(SceneError::value(path, node.described(), allowed));
    };
    if let Some((_, value)) = words.iter().find(|(word, _)| *word == text) {
        return Ok(*value);
    }
    let meant = did_you_mean(nearest(text, words.iter().map(|(word, _)| *word)));
    Err(SceneError::value(path, node.written.clone() + &meant, allowed))
}

impl Stored for f64 {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        let wrong = |found| Err(SceneError::value(path, found, form.allowed()));
        let dimension = form.quantity().and_then(|quantity| quantity.dimension);
        let value = match (node.content.as_number(), node.content.as_text(), dimension) {
            (Some(value), ..) => value,
            (_, Some(text), Some(dimension)) => {
                let parsed = dimension.parse(text);
                parsed.or_else(|why| wrong(format!("{}: {why}", node.written)))?
            }
            _ => return wrong(node.described()),
        };
        if form.quantity().is_none_or(|quantity| quantity.contains(value)) {
            return Ok(value);
        }
        let bare = match dimension.filter(|_| node.content.as_text().is_none()) {
            Some(dimension) => format!(
                "; a bare number is in {}",
                dimension.si().unwrap_or("1, not in %")
            ),
            None => String::new(),
        };
        Err(SceneError::value(path, &*node.written, form.allowed() + &bare))
    }

    fn write(&self, form: Form) -> Content {
        let unit = form.quantity().and_then(|quantity| quantity.unit());
        unit.map_or(Content::Number(*self), |unit| {
            Content::Text(format!("{self:?} {unit}"))
        })
    }
}

impl Stored for u64 {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        f64::read(node, form, path)?;
        match node.content {
            Content::Whole(whole) => Ok(whole),
            _ => Err(SceneError::value(path, &*node.written, form.allowed())),
        }
    }

    fn write(&self, _: Form) -> Content {
        Content::Whole(*self)
    }
}

impl Stored for String {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        let text = node.content.as_text().map(str::to_owned);
        text.ok_or_else(|| SceneError::value(path, node.described(), form.allowed()))
    }

    fn write(&self, _: Form) -> Content {
        Content::Text(self.clone())
    }
}

impl<T: Stored> Stored for Option<T> {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        T::read(node, form, path).map(Some)
    }

    fn write(&self, form: Form) -> Content {
        self.as_ref().map_or(Content::Other, |value| value.write(form))
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        let (Form::List(of_item, least, _), Content::List(items)) = (form, &node.content) else {
            return Err(SceneError::value(path, node.described(), form.allowed()));
        };
        if items.len() < least {
            let found = ["an empty list", "one item"][items.len().min(1)];
            return Err(SceneError::value(path, found, form.allowed()));
        }
        let item = |(index, item)| T::read(item, *of_item, &joined(path, index));
        items.iter().enumerate().map(item).collect()
    }

    fn write(&self, form: Form) -> Content {
        let Form::List(of_item, ..) = form else {
            return Content::Other;
        };
        Content::List(self.iter().map(|item| item.write(*of_item).into()).collect())
    }
}

/// A list of two.
impl<T: Stored> Stored for (T, T) {
    fn read(node: &Node, form: Form, path: &str) -> Result<Self, SceneError> {
        match (form, &node.content) {
            (Form::Pair([first, second], _), Content::List(items)) if items.len() == 2 => Ok((
                T::read(&items[0], *first, &joined(path, 0))?,
                T::read(&items[1], *second, &joined(path, 1))?,
            )),
            _ => Err(SceneError::value(path, node.described(), form.allowed())),
        }
    }

    fn write(&self, form: Form) -> Content {
        let Form::Pair([first, second], _) = form else {
            return Content::Other;
        };
        Content::List(
            [self.0.write(*first), self.1.write(*second)]
                .map(Node::from)
                .into(),
        )
    }
}
