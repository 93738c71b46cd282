//! `[uncertain]`: keys whose values are known only to lie between two. And what a measure costs, as far as that is known.

use serde::Serialize;

use crate::content::{Content, Node, joined, other_name};
use crate::error::{Result, SceneError, did_you_mean};
use crate::key::{Form, Key};
use crate::nearest::nearest;
use crate::shown::shown;
use crate::stored::{Given, Stored};

/// A key of a number that lies between two values, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertain {
    /// The key with the numbers of list items: `vehicles.0.load`.
    pub key: String,
    /// Its lowest value.
    pub low: f64,
    /// Its highest value, greater than the lowest.
    pub high: f64,
}

const INTERVAL: &str = "the lowest value and a greater one, such as [0.2, 0.5]";
const KEY: &str = "a key of the scene that takes a number, such as \"friction.dynamic_coefficient\" (`creepage explain` lists them)";

impl Stored for Vec<Uncertain> {
    fn read(given: &Given) -> Result<Self> {
        let (Form::Intervals(all), Content::Table(_)) = (given.form, &given.node.content) else {
            let (found, allowed) = (given.node.described(), given.form.allowed());
            return Err(SceneError::value(&given.path, found, allowed));
        };
        let mut intervals = Vec::new();
        values("", given.node, &mut intervals);
        let mut found: Self = Vec::new();
        for (key, node) in intervals {
            let known = interval(all(), &given.path, &key, node)?;
            // What was set later counts.
            found.retain(|other| other.key != known.key);
            found.push(known);
        }
        Ok(found)
    }

    fn write(&self, form: Form) -> Content {
        let Form::Intervals(all) = form else {
            return Content::Other;
        };
        let entry = |uncertain: &'_ Uncertain| {
            let form = form_at(all(), &uncertain.key)?;
            let both = [uncertain.low, uncertain.high].map(|value| value.write(form).into());
            Some((uncertain.key.clone(), Content::List(both.into())))
        };
        let entries: Vec<(String, Content)> = self.iter().filter_map(entry).collect();
        Content::table(entries.iter().map(|(key, both)| (&**key, both.clone())))
    }
}

/// All that is no table below a node, with its key: `a.b = …` and `"a.b" = …` are the same.
fn values<'n>(path: &str, node: &'n Node, found: &mut Vec<(String, &'n Node)>) {
    match &node.content {
        Content::Table(entries) => {
            for entry in entries {
                values(&joined(path, &entry.key), &entry.value, found);
            }
        }
        _ => found.push((path.to_owned(), node)),
    }
}

fn interval(all: &'static [Key], path: &str, key: &str, node: &Node) -> Result<Uncertain> {
    let path = joined(path, key);
    let Some(form) = form_at(all, key) else {
        let mut known = Vec::new();
        numbers("", all, &mut known);
        let meant = did_you_mean(nearest(key, known.iter().map(String::as_str)));
        return Err(SceneError::value(&path, format!("`{key}`{meant}"), KEY));
    };
    let Content::List(both) = &node.content else {
        return Err(SceneError::value(&path, node.described(), INTERVAL));
    };
    let read = |(index, node)| f64::read(&Given::new(joined(&path, index), node, form));
    let both = both.iter().enumerate().map(read).collect::<Result<Vec<f64>>>()?;
    match both[..] {
        [low, high] if low < high => Ok(Uncertain {
            key: key.to_owned(),
            low,
            high,
        }),
        _ => {
            let values = both.into_iter().map(shown).collect::<Vec<_>>().join(", ");
            Err(SceneError::value(&path, format!("[{values}]"), INTERVAL))
        }
    }
}

/// The form of the number at a key such as `vehicles.0.load`, below these keys.
fn form_at(keys: &'static [Key], path: &str) -> Option<Form> {
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    let is_named = |key: &&Key| key.name == first || other_name(key.name) == Some(first);
    let form = keys.iter().find(is_named)?.form;
    let rest = match form {
        Form::List(..) => {
            rest.split_once('.')
                .filter(|(index, _)| index.parse::<usize>().is_ok())?
                .1
        }
        _ => rest,
    };
    if rest.is_empty() {
        return form.quantity().map(|_| form);
    }
    form_at(form.keys(), rest)
}

/// Every key of a number, in lists that of the first item.
fn numbers(path: &str, keys: &[Key], found: &mut Vec<String>) {
    for key in keys {
        let path = joined(path, key.name);
        found.extend(key.form.quantity().map(|_| path.clone()));
        let is_list = matches!(key.form, Form::List(..));
        let below = if is_list { joined(&path, 0) } else { path };
        numbers(&below, key.form.keys(), found);
    }
}

/// What a measure costs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cost {
    /// In any currency, or parts: numbers are compared.
    Number(f64),
    /// In words, which are only shown.
    Text(String),
}

impl Stored for Cost {
    fn read(given: &Given) -> Result<Self> {
        let content = &given.node.content;
        let number = content
            .as_number()
            .filter(|cost| *cost >= 0.0 && cost.is_finite());
        let text = content.as_text().map(|text| Self::Text(text.to_owned()));
        number.map(Self::Number).or(text).ok_or_else(|| {
            let allowed = "a number of at least 0, or a text";
            SceneError::value(&given.path, given.node.described(), allowed)
        })
    }

    fn write(&self, _: Form) -> Content {
        match self {
            Self::Number(cost) => Content::Number(*cost),
            Self::Text(text) => Content::Text(text.clone()),
        }
    }
}
