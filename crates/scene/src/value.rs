//! One value of a document, read.

use crate::document::{Content, Document, Node, joined};
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::nearest::nearest;
use crate::quantity::{QuantityError, leading_number, with_point, without_thousands};
use crate::range::Quantity;
use crate::units::Dimension;

#[derive(Clone)]
pub struct Value<'d> {
    pub document: &'d Document,
    /// Its key with those of the tables around it; empty for the document.
    pub path: String,
    pub node: &'d Node,
}

impl<'d> Value<'d> {
    /// A value within this one.
    pub fn child(&self, key: &str, node: &'d Node) -> Self {
        let (document, path) = (self.document, joined(&self.path, key));
        Self { document, path, node }
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

    /// A quantity in SI, whatever its range.
    pub fn quantity(&self, quantity: Quantity) -> Result<f64, SceneError> {
        let allowed = quantity.allowed();
        match (&self.node.content, quantity.dimension) {
            (Content::Number { value, .. }, _) => Ok(*value),
            (Content::Text(text), Some(dimension)) => dimension
                .parse(text)
                .map_err(|error| self.not_a_quantity(text, error, allowed)),
            (Content::Text(text), None) => {
                let meant = bare(text).filter(|&number| quantity.contains(number));
                let meant = meant.map_or_else(String::new, |number| format!("{number}: "));
                Err(self.wrong_type(meant + &allowed))
            }
            _ => Err(self.wrong_type(allowed)),
        }
    }

    /// A whole number in the range of a quantity.
    pub fn integer(&self, quantity: Quantity) -> Result<u64, SceneError> {
        let allowed = quantity.allowed();
        let fits = |whole: &u64| quantity.contains(*whole as f64);
        match &self.node.content {
            Content::Number { integer, .. } => integer
                .filter(fits)
                .ok_or_else(|| self.wrong(WrongKind::OutOfRange, self.written(), allowed)),
            Content::Text(text) => {
                let meant = whole(text).filter(fits);
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
    pub fn word<T: Copy>(&self, words: &[(&str, T)], allowed: &str) -> Result<T, SceneError> {
        let Content::Text(text) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        if let Some((_, meaning)) = words.iter().find(|(word, _)| word == text) {
            return Ok(*meaning);
        }
        let meant = did_you_mean(nearest(text, words.iter().map(|(word, _)| *word)));
        Err(self.wrong(WrongKind::Value, self.written() + &meant, allowed))
    }

    /// As it was written.
    pub fn written(&self) -> String {
        self.document.written(&self.node.place)
    }

    fn not_a_quantity(&self, text: &str, error: QuantityError, allowed: String) -> SceneError {
        let (problem, meant) = match error {
            QuantityError::NotANumber => return self.wrong_type(allowed),
            QuantityError::Comma(with_point) => {
                let thousands = without_thousands(text);
                let or = thousands.map_or_else(String::new, |whole| {
                    format!(", or \"{whole}\" if the comma separates thousands")
                });
                return self.wrong_type(format!("a decimal point, \"{with_point}\"{or}: {allowed}"));
            }
            QuantityError::MissingUnit => ("missing unit".to_owned(), String::new()),
            QuantityError::UnknownUnit { unit, nearest } => {
                (format!("unknown unit `{unit}`"), did_you_mean(nearest))
            }
            QuantityError::WrongDimension { dimension, .. } => {
                ("wrong dimension".to_owned(), format!(", {}", dimension.noun()))
            }
        };
        self.wrong(WrongKind::Unit(problem), self.written() + &meant, allowed)
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

    pub fn wrong(&self, kind: WrongKind, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        self.document
            .wrong(kind, &self.node.place, &self.path, found, allowed)
    }
}

/// A dimensionless number that was written as a percentage, with a comma or with a word behind it, as it is to be written.
fn bare(text: &str) -> Option<f64> {
    let point = with_point(text).unwrap_or_else(|| text.to_owned());
    let percentage = Dimension::Ratio.parse(&point).ok();
    let number = percentage.or_else(|| leading_number(&point).map(|(number, _)| number));
    number.filter(|number: &f64| number.is_finite())
}

/// A whole number that was written with marks between its thousands.
fn whole(text: &str) -> Option<u64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '.' | '\'' | '’' | '_');
    let groups: Vec<&str> = text.trim().split(marks).collect();
    let (first, others) = groups.split_first()?;
    let thousands = (1..=3).contains(&first.len()) && others.iter().all(|group| group.len() == 3);
    (thousands || others.is_empty()).then(|| groups.concat().parse().ok())?
}
