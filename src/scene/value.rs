//! One value of a document, checked.

use std::ops::RangeInclusive;

use super::document::{Content, Document, Node};
use super::nearest::nearest;
use super::range::{Range, allowed_number, allowed_quantity, allowed_whole};
use super::syntax::with_point;
use super::table::{Table, joined};
use super::{Dimension, QuantityError, SceneError};

/// A value of the document.
#[derive(Clone)]
pub(super) struct Value<'d> {
    pub document: &'d Document,
    pub path: String,
    pub node: &'d Node,
}

impl<'d> Value<'d> {
    pub fn table(&self, known: &'static [&'static str]) -> Result<Table<'d>, SceneError> {
        Table::new(self.document, self.path.clone(), self.node, known)
    }

    pub fn is_table(&self) -> bool {
        matches!(self.node.content, Content::Table(_))
    }

    /// The items of a list.
    pub fn items(&self, allowed: &str) -> Result<Vec<Value<'d>>, SceneError> {
        let Content::Array(items) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        Ok(items
            .iter()
            .enumerate()
            .map(|(index, node)| Value {
                document: self.document,
                path: joined(&self.path, &index.to_string()),
                node,
            })
            .collect())
    }

    /// The items of a list of at least one.
    pub fn some_items(&self, allowed: &str) -> Result<Vec<Value<'d>>, SceneError> {
        let items = self.items(allowed)?;
        if items.is_empty() {
            return Err(self.inconsistent("an empty list", allowed));
        }
        Ok(items)
    }

    pub fn quantity(&self, dimension: Dimension, range: Range, example: &str) -> Result<f64, SceneError> {
        let allowed = || allowed_quantity(dimension, range, example);
        let value = match &self.node.content {
            Content::Number { value, .. } => {
                let meant = || format!("{}{}", allowed(), bare_in(*value, dimension, range));
                return self.within(*value, range, meant);
            }
            Content::Text(text) => dimension
                .parse(text)
                .map_err(|error| self.not_a_quantity(error, allowed()))?,
            _ => return Err(self.wrong_type(allowed())),
        };
        self.within(value, range, allowed)
    }

    pub fn number(&self, range: Range) -> Result<f64, SceneError> {
        let allowed = || allowed_number(range);
        match &self.node.content {
            Content::Number { value, .. } => self.within(*value, range, allowed),
            Content::Text(text) => Err(self.wrong_type(match bare(text) {
                Some(number) => format!("{number}: {}", allowed()),
                None => allowed(),
            })),
            _ => Err(self.wrong_type(allowed())),
        }
    }

    /// A whole number in `range`.
    pub fn integer(&self, range: RangeInclusive<u64>) -> Result<u64, SceneError> {
        let allowed = allowed_whole(&range);
        match self.node.content {
            Content::Number { integer, .. } => integer
                .and_then(|integer| u64::try_from(integer).ok())
                .filter(|integer| range.contains(integer))
                .ok_or_else(|| self.out_of_range(allowed)),
            _ => Err(self.wrong_type(allowed)),
        }
    }

    pub fn text(&self, allowed: &str) -> Result<String, SceneError> {
        match &self.node.content {
            Content::Text(text) => Ok(text.clone()),
            _ => Err(self.wrong_type(allowed)),
        }
    }

    /// What one of the `words` stands for.
    pub fn word<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, SceneError> {
        let list: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        self.word_of(words, &list.join(", "))
    }

    /// What one of the `words` stands for, where `allowed` says more than the words.
    pub fn word_of<T: Copy>(&self, words: &[(&str, T)], allowed: &str) -> Result<T, SceneError> {
        let Content::Text(text) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        words
            .iter()
            .find(|(word, _)| word == text)
            .map(|(_, meaning)| *meaning)
            .ok_or_else(|| SceneError::UnknownWord {
                location: self.document.locate(&self.node.place),
                key: self.path.clone(),
                found: self.written(),
                allowed: allowed.to_owned(),
                suggestion: nearest(text, words.iter().map(|(word, _)| *word)).map(str::to_owned),
            })
    }

    /// As it was written.
    pub fn written(&self) -> String {
        self.document.written(&self.node.place)
    }

    fn within(&self, value: f64, range: Range, allowed: impl Fn() -> String) -> Result<f64, SceneError> {
        if range.contains(value) {
            Ok(value)
        } else {
            Err(self.out_of_range(allowed()))
        }
    }

    fn not_a_quantity(&self, error: QuantityError, allowed: String) -> SceneError {
        let location = self.document.locate(&self.node.place);
        let key = self.path.clone();
        let found = self.written();
        match error {
            QuantityError::NotANumber => self.wrong_type(allowed),
            QuantityError::Comma { with_point } => {
                self.wrong_type(format!("a decimal point, \"{with_point}\": {allowed}"))
            }
            QuantityError::MissingUnit => SceneError::MissingUnit {
                location,
                key,
                found,
                allowed,
            },
            QuantityError::UnknownUnit { unit, nearest } => SceneError::UnknownUnit {
                location,
                key,
                unit,
                found,
                allowed,
                suggestion: nearest,
            },
            QuantityError::WrongDimension { dimension, .. } => SceneError::WrongDimension {
                location,
                key,
                found,
                dimension: dimension.noun(),
                allowed,
            },
        }
    }

    pub fn wrong_type(&self, allowed: impl Into<String>) -> SceneError {
        let kind = match self.node.content {
            Content::Text(_) => "the text ",
            Content::Number { .. } => "the number ",
            Content::Other => "",
            Content::Array(_) => "the list ",
            Content::Table(_) => "the table ",
        };
        SceneError::WrongType {
            location: self.document.locate(&self.node.place),
            key: self.path.clone(),
            found: format!("{kind}{}", self.written()),
            allowed: allowed.into(),
        }
    }

    pub fn out_of_range(&self, allowed: impl Into<String>) -> SceneError {
        SceneError::OutOfRange {
            location: self.document.locate(&self.node.place),
            key: self.path.clone(),
            found: self.written(),
            allowed: allowed.into(),
        }
    }

    pub fn inconsistent(&self, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        SceneError::Inconsistent {
            location: self.document.locate(&self.node.place),
            key: self.path.clone(),
            found: found.into(),
            allowed: allowed.into(),
        }
    }
}

/// What a bare number out of its range was probably meant in.
fn bare_in(value: f64, dimension: Dimension, range: Range) -> String {
    let unit = match dimension {
        Dimension::Length => "mm",
        Dimension::Pressure => "MPa",
        _ => return String::new(),
    };
    let meant = format!("{value} {unit}");
    if dimension.parse(&meant).is_ok_and(|value| range.contains(value)) {
        let si = dimension.units().next().unwrap_or_default();
        format!("; a bare number is in {si}: did you mean \"{meant}\"?")
    } else {
        String::new()
    }
}

/// A dimensionless number that was written as a percentage or with a comma, as it is to be written.
fn bare(text: &str) -> Option<f64> {
    let point = with_point(text).unwrap_or_else(|| text.to_owned());
    let number = Dimension::Ratio
        .parse(&point)
        .ok()
        .or_else(|| point.trim().parse().ok());
    number.filter(|number: &f64| number.is_finite())
}
