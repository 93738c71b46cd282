//! What may stand at a key: a number with a unit, a text, a word, a list, a table.

use std::marker::PhantomData;

use crate::document::{Content, Entry, Node, joined};
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::key::{Form, Keys, Kind, Table, Visit};
use crate::quantity::{QuantityError, leading_number, with_point, without_thousands};
use crate::range::Quantity;
use crate::units::Dimension;
use crate::value::Value;

impl Kind for Quantity {
    type Value = f64;

    fn read(&self, value: &Value) -> Result<f64, SceneError> {
        let allowed = self.allowed();
        if let Some(number) = value.node.content.as_number() {
            return Ok(number);
        }
        let text = value.text(&allowed)?;
        let Some(dimension) = self.dimension else {
            let meant = bare(text).filter(|&number| self.contains(number));
            return Err(value.wrong_type(before(meant, &allowed)));
        };
        dimension.parse(text).map_err(|error| {
            let (problem, meant) = match error {
                QuantityError::NotANumber => return value.wrong_type(allowed),
                QuantityError::Comma(point) => {
                    let thousands = without_thousands(text)
                        .map(|whole| format!(", or \"{whole}\" if the comma separates thousands"));
                    let thousands = thousands.unwrap_or_default();
                    return value.wrong_type(format!("a decimal point, \"{point}\"{thousands}: {allowed}"));
                }
                QuantityError::MissingUnit => ("missing unit".to_owned(), String::new()),
                QuantityError::UnknownUnit { unit, nearest } => {
                    (format!("unknown unit `{unit}`"), did_you_mean(nearest))
                }
                QuantityError::WrongDimension { dimension, .. } => {
                    ("wrong dimension".to_owned(), format!(", {}", dimension.noun()))
                }
            };
            value.wrong(WrongKind::Unit(problem), value.written() + &meant, allowed)
        })
    }

    fn write(&self, value: &f64) -> Option<Content> {
        Some(match self.dimension.and_then(Dimension::si) {
            Some(unit) => Content::Text(format!("{value:?} {unit}")),
            None => Content::number(*value),
        })
    }

    fn each(&self, value: &f64, path: &str, visit: &mut Visit) {
        visit(path, *value, *self);
    }

    fn form(&self) -> Form {
        Form::Quantity(*self)
    }
}

/// What is allowed, behind the number that was probably meant.
fn before(meant: Option<impl ToString>, allowed: &str) -> String {
    meant.map_or_else(String::new, |meant| meant.to_string() + ": ") + allowed
}

/// A number without a dimension that was written as a percentage, with a comma or with a word behind it.
fn bare(text: &str) -> Option<f64> {
    let point = with_point(text).unwrap_or_else(|| text.to_owned());
    let percentage = Dimension::Ratio.parse(&point).ok();
    let number = percentage.or_else(|| leading_number(&point).map(|(number, _)| number));
    number.filter(|number: &f64| number.is_finite())
}

/// A whole number.
pub struct Whole(pub Quantity);

impl Kind for Whole {
    type Value = u64;

    fn read(&self, value: &Value) -> Result<u64, SceneError> {
        let allowed = self.0.allowed();
        let fits = |whole: &u64| self.0.contains(*whole as f64);
        match &value.node.content {
            Content::Whole(whole) if fits(whole) => Ok(*whole),
            Content::Whole(_) | Content::Number(_) => {
                Err(value.wrong(WrongKind::OutOfRange, value.written(), allowed))
            }
            _ => {
                let meant = whole(value.text(&allowed)?).filter(fits);
                Err(value.wrong_type(before(meant, &allowed)))
            }
        }
    }

    fn write(&self, value: &u64) -> Option<Content> {
        Some(Content::Whole(*value))
    }

    fn each(&self, value: &u64, path: &str, visit: &mut Visit) {
        visit(path, *value as f64, self.0);
    }

    fn form(&self) -> Form {
        Form::Quantity(self.0)
    }
}

/// A whole number that was written with marks between its thousands.
fn whole(text: &str) -> Option<u64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '.' | '\'' | '’' | '_');
    let groups: Vec<&str> = text.trim().split(marks).collect();
    let (first, others) = groups.split_first()?;
    let thousands = (1..=3).contains(&first.len()) && others.iter().all(|group| group.len() == 3);
    (thousands || others.is_empty()).then(|| groups.concat().parse().ok())?
}

/// A text, and what is allowed in words.
pub struct Text(pub &'static str);

impl Kind for Text {
    type Value = String;

    fn read(&self, value: &Value) -> Result<String, SceneError> {
        value.text(self.0).map(str::to_owned)
    }

    fn write(&self, value: &String) -> Option<Content> {
        Some(Content::Text(value.clone()))
    }

    fn form(&self) -> Form {
        Form::Text(self.0)
    }
}

/// One of some words.
pub struct Word<T: 'static> {
    pub words: &'static [(&'static str, T)],
    /// What is allowed, if that says more than the words.
    pub allowed: Option<&'static str>,
    /// A word that is no longer one of them, and why.
    pub gone: Option<(&'static str, &'static str)>,
}

impl<T> Word<T> {
    /// One of these words.
    pub const fn of(words: &'static [(&'static str, T)]) -> Self {
        let (allowed, gone) = (None, None);
        Self { words, allowed, gone }
    }
}

impl<T: Copy + PartialEq> Kind for Word<T> {
    type Value = T;

    fn read(&self, value: &Value) -> Result<T, SceneError> {
        let mut allowed = self.form().allowed();
        if let Some((word, reason)) = self.gone
            && value.text("").is_ok_and(|text| text == word)
        {
            allowed = format!("{allowed}; {reason}");
        }
        value.word(self.words, &allowed)
    }

    fn write(&self, value: &T) -> Option<Content> {
        let (word, _) = self.words.iter().find(|(_, meaning)| meaning == value)?;
        Some(Content::Text((*word).to_owned()))
    }

    fn form(&self) -> Form {
        Form::Words(self.words.iter().map(|(word, _)| *word).collect(), self.allowed)
    }
}

/// What may be left out.
pub struct Optional<K>(pub K);

impl<K: Kind> Kind for Optional<K> {
    type Value = Option<K::Value>;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        self.0.read(value).map(Some)
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        self.0.write(value.as_ref()?)
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        if let Some(value) = value {
            self.0.each(value, path, visit);
        }
    }

    fn form(&self) -> Form {
        self.0.form()
    }

    fn absent(&self) -> Option<Self::Value> {
        Some(None)
    }
}

/// What has a value of its own if it is left out.
pub struct Or<K: Kind>(pub K, pub K::Value);

impl<K: Kind<Value: Clone + PartialEq>> Kind for Or<K> {
    type Value = K::Value;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        self.0.read(value)
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        self.0.write(value).filter(|_| *value != self.1)
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        self.0.each(value, path, visit);
    }

    fn form(&self) -> Form {
        self.0.form()
    }

    fn absent(&self) -> Option<Self::Value> {
        Some(self.1.clone())
    }
}

/// A list of so many items at least, and what is allowed in words.
pub struct List<K>(pub K, pub usize, pub &'static str);

impl<K: Kind> Kind for List<K> {
    type Value = Vec<K::Value>;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        let items = value.items(self.2)?;
        if items.len() < self.1 {
            let found = ["an empty list", "one item"][items.len()];
            return Err(value.wrong(WrongKind::Value, found, self.2));
        }
        items.iter().map(|item| self.0.read(item)).collect()
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        let items = value.iter().filter_map(|item| self.0.write(item).map(Node::from));
        let items: Vec<Node> = items.collect();
        (!items.is_empty()).then_some(Content::List(items))
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        for (index, item) in value.iter().enumerate() {
            self.0.each(item, &joined(path, &index.to_string()), visit);
        }
    }

    fn form(&self) -> Form {
        Form::List(Box::new(self.0.form()), self.1, self.2)
    }

    fn absent(&self) -> Option<Self::Value> {
        (self.1 == 0).then(Vec::new)
    }
}

/// A table with the keys of `T`.
pub struct Section<T>(PhantomData<T>);

/// A table with the keys of `T`.
pub const fn section<T: Keys>() -> Section<T> {
    Section(PhantomData)
}

impl<T: Keys> Kind for Section<T> {
    type Value = T;

    fn read(&self, value: &Value) -> Result<T, SceneError> {
        T::read(&Table::open(value, &T::keys())?)
    }

    fn write(&self, value: &T) -> Option<Content> {
        let entry = |(key, content): (&str, Content)| Entry {
            key: key.to_owned(),
            span: 0..0,
            value: content.into(),
        };
        Some(Content::Table(value.write().into_iter().map(entry).collect()))
    }

    fn each(&self, value: &T, path: &str, visit: &mut Visit) {
        value.each(path, visit);
    }

    fn form(&self) -> Form {
        Form::Table(T::keys())
    }
}
