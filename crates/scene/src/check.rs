//! What stands in a file beside the form of its key: an error that says what is allowed, or the value in SI.

use crate::content::{Content, Node, joined, other_name};
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::key::{Form, Key};
use crate::names::meant_by;
use crate::nearest::nearest;
use crate::quantity::{QuantityError, leading_number, with_point, without_thousands};
use crate::range::Quantity;
use crate::rivals::contradiction;
use crate::units::Dimension;

/// The content at `path` in SI, with keys by their own names; it suits its `form`.
pub fn checked(node: &Node, form: &Form, path: &str) -> Result<Content, SceneError> {
    match (form, &node.content) {
        (Form::Number(quantity), _) => number(node, *quantity, path),
        (Form::Table(keys) | Form::Either(_, keys, _), Content::Table(_)) => table(node, keys, path),
        (Form::Either(plain, keys, _), _) => plain_or_table(node, plain, keys, path),
        (Form::Text(_), Content::Text(_)) => Ok(node.content.clone()),
        (Form::Name(_), Content::Text(text)) if !text.trim().is_empty() => Ok(node.content.clone()),
        (Form::Name(allowed), Content::Text(_)) => Err(SceneError::value(path, &*node.written, *allowed)),
        (Form::Words { words, gone, .. }, Content::Text(text)) => {
            if words.contains(&&**text) {
                return Ok(node.content.clone());
            }
            let allowed = match gone {
                Some((word, why)) if word == text => format!("{}; {why}", form.allowed()),
                _ => form.allowed(),
            };
            Err(unknown_word(node, text, words, path, allowed))
        }
        (Form::List(_, least, allowed), Content::List(items)) if items.len() < *least => {
            let found = ["an empty list", "one item"][items.len()];
            Err(SceneError::value(path, found, *allowed))
        }
        (Form::List(form, ..), Content::List(items)) => {
            let item = |(index, item)| checked(item, form, &joined(path, index)).map(Node::from);
            let items: Result<_, _> = items.iter().enumerate().map(item).collect();
            items.map(Content::List)
        }
        (Form::Pair(forms, _), Content::List(items)) if items.len() == 2 => {
            let pair = forms.iter().copied().zip(items).enumerate();
            let item = |(index, (form, item))| checked(item, form, &joined(path, index)).map(Node::from);
            pair.map(item).collect::<Result<_, _>>().map(Content::List)
        }
        _ => Err(SceneError::value(path, node.described(), form.allowed())),
    }
}

/// The error for a text that is none of these words.
pub fn unknown_word(node: &Node, text: &str, words: &[&str], path: &str, allowed: String) -> SceneError {
    let near = did_you_mean(nearest(text, words.iter().copied()));
    SceneError::value(path, node.written.clone() + &near, allowed)
}

/// A table, whose unknown keys are told before those that it lacks: a misspelt one is both.
fn table(node: &Node, keys: &[Key], path: &str) -> Result<Content, SceneError> {
    let named = |name: &str| keys.iter().find(|key| key.name == name);
    let entries = node.content.entries();
    let key_of = |name: &str| named(name).or_else(|| named(other_name(name)?));
    if let Some(entry) = entries.iter().find(|entry| key_of(&entry.key).is_none()) {
        let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
        let (meant, elsewhere) = meant_by(&entry.key, &names);
        let (path, allowed) = (joined(path, &entry.key), names.join(", ") + &elsewhere);
        let meant = did_you_mean(meant);
        return Err(SceneError::wrong(WrongKind::UnknownKey, &path, meant, allowed));
    }
    contradiction(path, &node.content)?;
    let mut values = Vec::new();
    for key in keys {
        let path = joined(path, key.name);
        match node.content.entry(key.name) {
            Some(entry) => values.push((key.name, checked(&entry.value, &key.form, &path)?)),
            None if key.absent.is_none() => return Err(SceneError::missing(&path, key.form.allowed())),
            None => {}
        }
    }
    Ok(Content::table(values))
}

/// A value that stands alone or for the first key of its table.
fn plain_or_table(node: &Node, plain: &Form, keys: &[Key], path: &str) -> Result<Content, SceneError> {
    let content = checked(node, plain, path).map_err(|mut error| {
        // What stands there may belong into the table: `"3 MN/m"` in place of `{ spring = "3 MN/m" }`.
        if let (SceneError::Wrong(wrong), Some(key), Some(text)) =
            (&mut error, keys.first(), node.content.as_text())
            && let Some(dimension) = key.form.quantity().and_then(|quantity| quantity.dimension)
            && dimension.parse(text).is_ok()
        {
            let meant = ["; did you mean { ", key.name, " = ", &node.written, " }?"];
            wrong.allowed.extend(meant);
        }
        error
    })?;
    Ok(match plain {
        Form::Text(_) => Content::table(keys.first().map(|key| (key.name, content))),
        _ => content,
    })
}

/// A number with its unit, in SI.
fn number(node: &Node, quantity: Quantity, path: &str) -> Result<Content, SceneError> {
    let text = match (node.content.as_number(), node.content.as_text()) {
        (Some(value), _) => return in_range(node, quantity, path, value),
        (None, Some(text)) => text,
        (None, None) => return Err(SceneError::value(path, node.described(), quantity.allowed())),
    };
    let wrong_type = |allowed| SceneError::value(path, node.described(), allowed);
    let Some(dimension) = quantity.dimension else {
        let meant = if quantity.whole { grouped(text) } else { bare(text) };
        let meant = meant.filter(|&number| quantity.contains(number));
        return Err(wrong_type(before(meant, quantity)));
    };
    let (problem, meant) = match dimension.parse(text) {
        Ok(value) => return in_range(node, quantity, path, value),
        Err(QuantityError::NotANumber) => return Err(wrong_type(quantity.allowed())),
        Err(QuantityError::Comma(point)) => {
            let or = |whole| format!(", or \"{whole}\" if the comma separates thousands");
            let whole = without_thousands(text).map(or).unwrap_or_default();
            let meant = format!("a decimal point, \"{point}\"{whole}");
            return Err(wrong_type(before(Some(meant), quantity)));
        }
        Err(QuantityError::MissingUnit) => ("missing unit".to_owned(), String::new()),
        Err(QuantityError::UnknownUnit { unit, nearest }) => {
            (format!("unknown unit `{unit}`"), did_you_mean(nearest))
        }
        Err(QuantityError::WrongDimension { dimension, .. }) => {
            ("wrong dimension".to_owned(), format!(", {}", dimension.noun()))
        }
    };
    let (kind, found) = (WrongKind::Unit(problem), node.written.clone() + &meant);
    Err(SceneError::wrong(kind, path, found, quantity.allowed()))
}

fn in_range(node: &Node, quantity: Quantity, path: &str, value: f64) -> Result<Content, SceneError> {
    match node.content {
        Content::Whole(whole) if quantity.contains(value) && quantity.whole => {
            return Ok(Content::Whole(whole));
        }
        _ if quantity.contains(value) && !quantity.whole => return Ok(Content::Number(value)),
        _ => {}
    }
    let is_bare = !node.written.is_empty() && node.content.as_number().is_some();
    let meant = is_bare.then(|| quantity.bare_number_meant(value));
    let allowed = quantity.allowed() + &meant.unwrap_or_default();
    let found = quantity.written(value);
    Err(SceneError::wrong(WrongKind::OutOfRange, path, found, allowed))
}

/// What is allowed, behind the number that was probably meant.
fn before(meant: Option<impl ToString>, quantity: Quantity) -> String {
    meant.map_or_else(String::new, |meant| meant.to_string() + ": ") + &quantity.allowed()
}

/// A number without a dimension that was written as a percentage, with a comma or with a word behind it.
fn bare(text: &str) -> Option<f64> {
    let point = with_point(text).unwrap_or_else(|| text.to_owned());
    let percentage = Dimension::Ratio.parse(&point).ok();
    let number = percentage.or_else(|| leading_number(&point).map(|(number, _)| number));
    number.filter(|number: &f64| number.is_finite())
}

/// A whole number that was written with marks between its thousands.
fn grouped(text: &str) -> Option<f64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '.' | '\'' | '’' | '_');
    let groups: Vec<&str> = text.trim().split(marks).collect();
    let (first, others) = groups.split_first()?;
    let thousands = (1..=3).contains(&first.len()) && others.iter().all(|group| group.len() == 3);
    let whole: u64 = groups.concat().parse().ok()?;
    (thousands || others.is_empty()).then_some(whole as f64)
}
