//! `[uncertain]`: keys whose values are known only to lie between two. And what a measure costs, as far as that is known.

use serde::Serialize;

use crate::Scene;
use crate::content::{Content, Node, joined, other_name};
use crate::error::{Result, SceneError, did_you_mean};
use crate::key::{Form, Key, Section as _};
use crate::names::nearest_key;
use crate::shown::shown;
use crate::stored::{Given, Stored};

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
        match given.node.content {
            Content::Table(_) => intervals(&mut found, given, "", given.node).map(|()| found),
            _ => Err(SceneError::value(&given.path, given.node.described(), INTERVALS)),
        }
    }

    fn write(&self, _: Form) -> Content {
        let entry = |uncertain: &'_ Uncertain| {
            let form = form_at(Scene::KEYS, &uncertain.key)?;
            let both = [uncertain.low, uncertain.high].map(|value| value.write(form).into());
            Some((uncertain.key.clone(), Content::List(both.into())))
        };
        let entries: Vec<(String, Content)> = self.iter().filter_map(entry).collect();
        Content::table(entries.iter().map(|(key, both)| (&**key, both.clone())))
    }
}

/// Reads what stands at a key of the table that is given, or below it: `a.b = …` and `"a.b" = …` are the same.
fn intervals(found: &mut Vec<Uncertain>, given: &Given, key: &str, node: &Node) -> Result<()> {
    let path = joined(&given.path, key);
    let both = match &node.content {
        Content::Table(entries) => {
            let mut below = entries.iter();
            return below
                .try_for_each(|entry| intervals(found, given, &joined(key, &entry.key), &entry.value));
        }
        Content::List(both) => both,
        _ => return Err(SceneError::value(&path, node.described(), INTERVAL)),
    };
    let form = form_at(Scene::KEYS, key).ok_or_else(|| {
        let meant = did_you_mean(nearest_key(key).as_deref());
        SceneError::value(&path, format!("`{key}`{meant}"), KEY)
    })?;
    let read = |(index, node)| f64::read(&Given::new(joined(&path, index), node, form));
    let both = both.iter().enumerate().map(read).collect::<Result<Vec<f64>>>()?;
    let [low, high] = both[..] else {
        return Err(SceneError::value(&path, node.described(), INTERVAL));
    };
    if low >= high {
        let both = format!("[{}, {}]", shown(low), shown(high));
        return Err(SceneError::value(&path, both, INTERVAL));
    }
    // What was set later counts.
    found.retain(|other| other.key != key);
    found.push(Uncertain::new(key, low, high));
    Ok(())
}

/// The form of the number at a key such as `vehicles.0.load`, below these keys.
fn form_at(keys: &'static [Key], path: &str) -> Option<Form> {
    let (first, mut rest) = path.split_once('.').unwrap_or((path, ""));
    let is_named = |key: &&Key| key.name == first || other_name(key.name) == Some(first);
    let form = keys.iter().find(is_named)?.form;
    if matches!(form, Form::List(..)) {
        let (index, below) = rest.split_once('.')?;
        index.parse::<usize>().ok()?;
        rest = below;
    }
    if rest.is_empty() {
        return form.quantity().map(|_| form);
    }
    form_at(form.keys(), rest)
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
