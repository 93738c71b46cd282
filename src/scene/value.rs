//! One value of a document, checked.

use std::ops::RangeInclusive;

use super::document::{Content, Document, Node};
use super::error::{SceneError, WrongKind};
use super::keys::joined;
use super::nearest::nearest;
use super::quantity::{QuantityError, leading_number};
use super::range::{Quantity, allowed_whole};
use super::syntax::{with_point, without_thousands};
use super::units::Dimension;

#[derive(Clone)]
pub struct Value<'d> {
    pub document: &'d Document,
    /// Its key with those of the tables around it; empty for the document.
    pub path: String,
    pub node: &'d Node,
}

impl<'d> Value<'d> {
    pub fn root(document: &'d Document) -> Self {
        Self {
            document,
            path: String::new(),
            node: &document.root,
        }
    }

    /// A value within this one.
    pub fn child(&self, key: &str, node: &'d Node) -> Self {
        Self {
            document: self.document,
            path: joined(&self.path, key),
            node,
        }
    }

    pub fn is_table(&self) -> bool {
        matches!(self.node.content, Content::Table(_))
    }

    pub fn items(&self, allowed: &str) -> Result<Vec<Value<'d>>, SceneError> {
        let Content::Array(items) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        let items = items.iter().enumerate();
        Ok(items
            .map(|(index, node)| self.child(&index.to_string(), node))
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

    pub fn quantity(&self, quantity: Quantity) -> Result<f64, SceneError> {
        let allowed = quantity.allowed();
        let value = match (&self.node.content, quantity.dimension) {
            (Content::Number { value, .. }, _) => *value,
            (Content::Text(text), Some(dimension)) => match dimension.parse(text) {
                Ok(value) => value,
                Err(error) => return Err(self.not_a_quantity(text, error, allowed)),
            },
            (Content::Text(text), None) => {
                let meant = bare(text).filter(|&number| quantity.range.contains(number));
                let meant = meant.map_or_else(String::new, |number| format!("{number}: "));
                return Err(self.wrong_type(meant + &allowed));
            }
            _ => return Err(self.wrong_type(allowed)),
        };
        if quantity.range.contains(value) {
            return Ok(value);
        }
        let meant = match self.node.content {
            Content::Number { value, .. } => bare_in(value, quantity),
            _ => String::new(),
        };
        Err(self.out_of_range(allowed + &meant))
    }

    /// A whole number in `range`.
    pub fn integer(&self, range: RangeInclusive<u64>) -> Result<u64, SceneError> {
        let allowed = allowed_whole(&range);
        match self.node.content {
            Content::Number { integer, .. } => integer
                .filter(|integer| range.contains(integer))
                .ok_or_else(|| self.out_of_range(allowed)),
            Content::Text(ref text) => {
                let meant = whole(text).filter(|meant| range.contains(meant));
                let meant = meant.map_or_else(String::new, |meant| format!("{meant}: "));
                Err(self.wrong_type(meant + &allowed))
            }
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
        self.word_of(words, &listed(words))
    }

    /// The error for a word that is no longer one of these `words`, for a `reason`.
    pub fn gone<T>(&self, words: &[(&str, T)], reason: &str) -> SceneError {
        let allowed = format!("{}; {reason}", listed(words));
        self.wrong(
            WrongKind::UnknownWord { suggestion: None },
            self.written(),
            allowed,
        )
    }

    /// What one of the `words` stands for, where `allowed` says more than the words.
    pub fn word_of<T: Copy>(&self, words: &[(&str, T)], allowed: &str) -> Result<T, SceneError> {
        let Content::Text(text) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        if let Some((_, meaning)) = words.iter().find(|(word, _)| word == text) {
            return Ok(*meaning);
        }
        let suggestion = nearest(text, words.iter().map(|(word, _)| *word)).map(str::to_owned);
        Err(self.wrong(WrongKind::UnknownWord { suggestion }, self.written(), allowed))
    }

    /// As it was written.
    pub fn written(&self) -> String {
        self.document.written(&self.node.place)
    }

    fn not_a_quantity(&self, text: &str, error: QuantityError, allowed: String) -> SceneError {
        let kind = match error {
            QuantityError::NotANumber => return self.wrong_type(allowed),
            QuantityError::Comma(with_point) => {
                let thousands = without_thousands(text);
                let or = thousands.map_or_else(String::new, |whole| {
                    format!(", or \"{whole}\" if the comma separates thousands")
                });
                return self.wrong_type(format!("a decimal point, \"{with_point}\"{or}: {allowed}"));
            }
            error => WrongKind::Quantity(error),
        };
        self.wrong(kind, self.written(), allowed)
    }

    pub fn wrong_type(&self, allowed: impl Into<String>) -> SceneError {
        let kind = match self.node.content {
            Content::Text(_) => "the text ",
            Content::Number { .. } => "the number ",
            Content::Other => "",
            Content::Array(_) => "the list ",
            Content::Table(_) => "the table ",
        };
        self.wrong(WrongKind::Value, format!("{kind}{}", self.written()), allowed)
    }

    pub fn out_of_range(&self, allowed: impl Into<String>) -> SceneError {
        self.wrong(WrongKind::OutOfRange, self.written(), allowed)
    }

    /// The error for a value that contradicts another one, or for a table whose keys do.
    pub fn inconsistent(&self, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        self.wrong(WrongKind::Value, found, allowed)
    }

    pub fn wrong(&self, kind: WrongKind, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        let Self {
            document, path, node, ..
        } = self;
        document.wrong(kind, &node.place, path, found, allowed)
    }
}

/// What a bare number out of its range was probably meant in.
fn bare_in(value: f64, quantity: Quantity) -> String {
    let fits = |value| quantity.range.contains(value);
    let (dimension, unit, si) = match quantity.dimension {
        None if value > 1.0 && fits(value / 100.0) => return format!("; did you mean {}?", value / 100.0),
        // Tables give it in millionths.
        Some(dimension @ Dimension::InverseTemperature) => (dimension, "e-6 1/K", "in 1/K"),
        Some(dimension @ Dimension::Length) => (dimension, " mm", "in m"),
        Some(dimension @ Dimension::Pressure) => (dimension, " MPa", "in Pa"),
        Some(dimension @ Dimension::Ratio) => (dimension, " %", "a share of 1"),
        Some(dimension @ Dimension::Slope) => (dimension, " %", "the rise over a distance of 1"),
        _ => return String::new(),
    };
    let meant = format!("{value}{unit}");
    if dimension.parse(&meant).is_ok_and(fits) {
        format!("; a bare number is {si}: did you mean \"{meant}\"?")
    } else {
        String::new()
    }
}

/// A dimensionless number that was written as a percentage, with a comma or with a word behind it, as it is to be written.
fn bare(text: &str) -> Option<f64> {
    let point = with_point(text).unwrap_or_else(|| text.to_owned());
    let number = Dimension::Ratio
        .parse(&point)
        .ok()
        .or_else(|| leading_number(&point).map(|(number, _)| number));
    number.filter(|number: &f64| number.is_finite())
}

/// A whole number that was written with marks between its thousands.
fn whole(text: &str) -> Option<u64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '.' | '\'' | '’' | '_');
    let groups: Vec<&str> = text.trim().split(marks).collect();
    let (first, others) = groups.split_first()?;
    let is_whole =
        (1..=3).contains(&first.len()) && others.iter().all(|group| group.len() == 3) || others.is_empty();
    is_whole.then(|| groups.concat().parse().ok())?
}

/// Words as they are typed, one after the other.
fn listed<T>(words: &[(&str, T)]) -> String {
    let words: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
    words.join(", ")
}
