//! Types whose values stand in a file.

use crate::content::{Content, Node};

/// A type whose values stand in a file, here in SI.
pub trait Stored: Sized {
    /// The value of a content that suits the form of its key.
    fn read(content: &Content) -> Option<Self>;
    fn write(&self) -> Content;
}

/// The value at `key` of a table, or what counts if it is left out.
pub fn value<T: Stored>(table: &Content, key: &str, absent: Option<T>) -> Option<T> {
    table.get(key).map_or(absent, |node| T::read(&node.content))
}

/// The entry of a table for a value, unless it counts without one.
pub fn entry<'k, T: Stored + PartialEq>(
    key: &'k str,
    value: &T,
    absent: Option<T>,
) -> Option<(&'k str, Content)> {
    match absent {
        Some(absent) if absent == *value => None,
        _ => Some((key, value.write())),
    }
}

impl Stored for f64 {
    fn read(content: &Content) -> Option<Self> {
        content.as_number()
    }

    fn write(&self) -> Content {
        Content::Number(*self)
    }
}

impl Stored for u64 {
    fn read(content: &Content) -> Option<Self> {
        match content {
            Content::Whole(whole) => Some(*whole),
            _ => None,
        }
    }

    fn write(&self) -> Content {
        Content::Whole(*self)
    }
}

impl Stored for String {
    fn read(content: &Content) -> Option<Self> {
        content.as_text().map(str::to_owned)
    }

    fn write(&self) -> Content {
        Content::Text(self.clone())
    }
}

impl<T: Stored> Stored for Option<T> {
    fn read(content: &Content) -> Option<Self> {
        T::read(content).map(Some)
    }

    fn write(&self) -> Content {
        self.as_ref().map_or(Content::Other, T::write)
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn read(content: &Content) -> Option<Self> {
        match content {
            Content::List(items) => items.iter().map(|item| T::read(&item.content)).collect(),
            _ => None,
        }
    }

    fn write(&self) -> Content {
        Content::List(self.iter().map(|item| item.write().into()).collect())
    }
}

impl<T: Stored> Stored for (T, T) {
    fn read(content: &Content) -> Option<Self> {
        let item = |index| content.get(index).and_then(|node| T::read(&node.content));
        Some((item("0")?, item("1")?))
    }

    fn write(&self) -> Content {
        Content::List([&self.0, &self.1].map(|item| Node::from(item.write())).into())
    }
}
