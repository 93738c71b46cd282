//! `[uncertain]`: keys whose values are known only to lie between two. And what a measure costs, as far as that is known.

use serde::Serialize;

use crate::content::{Content, Node, joined, other_name};
use crate::error::{Result, SceneError};
use crate::key::{Form, Key};
use crate::shown::shown;
use crate::stored::{Given, Stored};
use crate::synonym::meant_by;

/// A key of a number that lies between two values, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Uncertain {
    /// The key with the numbers of list items: `vehicles.0.load`.
    pub key: String,
    /// Its lowest value.
    pub low: f64,
    /// Its highest value, greater than the lowest.
    pub high: f64,
}

/// Intervals that are wider have their middle at the geometric mean.
const WIDE: f64 = 3.0;

impl Uncertain {
    /// The key between these values.
    pub fn new(key: &str, low: f64, high: f64) -> Self {
        let key = key.to_owned();
        Self { key, low, high }
    }

    /// The middle of its interval.
    pub fn middle(&self) -> f64 {
        if self.low > 0.0 && self.high > WIDE * self.low {
            return (self.low * self.high).sqrt();
        }
        0.5 * (self.low + self.high)
    }
}

pub const INTERVALS: &str = "keys of numbers, each with its lowest and its highest value, such as \"friction.dynamic_coefficient\" = [0.2, 0.5] \
                             or \"ground.vertical_peak\" = [\"90 um\", \"150 um\"]";
const INTERVAL: &str = "the lowest value and a greater one, such as [0.2, 0.5]";
const KEY: &str = "a key of the scene that takes a number, such as \"friction.dynamic_coefficient\" (`creepage explain` lists them)";

impl Stored for Vec<Uncertain> {
    fn read(given: &Given) -> Result<Self> {
        let mut found = Self::new();
        match (given.form, &given.node.content) {
            (Form::Intervals(all, _), Content::Table(_)) => {
                intervals(&mut found, all(), &given.path, "", given.node).map(|()| found)
            }
            _ => Err(SceneError::value(
                &given.path,
                given.node.described(),
                given.form.allowed(),
            )),
        }
    }

    fn write(&self, form: Form) -> Content {
        let Form::Intervals(all, _) = form else {
            return Content::Other;
        };
        let entry = |uncertain: &'_ Uncertain| {
            let form = form_at(all(), "", &uncertain.key).ok()?;
            let both = [uncertain.low, uncertain.high].map(|value| value.write(form).into());
            Some((uncertain.key.clone(), Content::List(both.into())))
        };
        let entries: Vec<(String, Content)> = self.iter().filter_map(entry).collect();
        Content::table(entries.iter().map(|(key, both)| (&**key, both.clone())))
    }
}

/// Reads what stands at a key of the table at `path`, or below it: `a.b = …` and `"a.b" = …` are the same.
fn intervals(
    found: &mut Vec<Uncertain>,
    all: &'static [Key],
    path: &str,
    key: &str,
    node: &Node,
) -> Result<()> {
    let own = joined(path, key);
    let both = match &node.content {
        Content::Table(entries) => {
            let mut below = entries.iter();
            return below
                .try_for_each(|entry| intervals(found, all, path, &joined(key, &entry.key), &entry.value));
        }
        Content::List(both) => both,
        _ => return Err(SceneError::value(&own, node.described(), INTERVAL)),
    };
    let form = form_at(all, path, key)?;
    let read = |(index, node)| f64::read(&Given::new(joined(&own, index), node, form));
    let both = both.iter().enumerate().map(read).collect::<Result<Vec<f64>>>()?;
    match both[..] {
        [low, high] if low < high => {
            // What was set later counts.
            found.retain(|other| other.key != key);
            found.push(Uncertain::new(key, low, high));
            Ok(())
        }
        _ => {
            let values = both.into_iter().map(shown).collect::<Vec<_>>().join(", ");
            Err(SceneError::value(&own, format!("[{values}]"), INTERVAL))
        }
    }
}

/// The form of the number at a key such as `vehicles.0.load`, below these keys, which stand at `path`.
fn form_at(keys: &'static [Key], path: &str, key: &str) -> Result<Form> {
    let (first, rest) = key.split_once('.').unwrap_or((key, ""));
    let path = joined(path, first);
    let is_named = |key: &&Key| key.name == first || other_name(key.name) == Some(first);
    let Some(Key { form, .. }) = keys.iter().find(is_named) else {
        let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
        return Err(SceneError::unknown(
            &path,
            meant_by(first, &names),
            names.join(", "),
        ));
    };
    match (form, rest.split_once('.')) {
        (Form::List(..), Some((index, below))) if index.parse::<usize>().is_ok() => {
            form_at(form.keys(), &joined(&path, index), below)
        }
        (Form::List(..), _) => Err(SceneError::value(&path, format!("`{key}`"), KEY)),
        _ if rest.is_empty() && form.quantity().is_some() => Ok(*form),
        _ if rest.is_empty() || form.keys().is_empty() => {
            Err(SceneError::value(&path, format!("`{key}`"), KEY))
        }
        _ => form_at(form.keys(), &path, rest),
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
