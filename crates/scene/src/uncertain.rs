//! `[uncertain]`: keys whose values are known only to lie between two. And what a measure costs, as far as that is known.

use serde::Serialize;

use crate::content::{Content, Node, joined};
use crate::error::{Result, SceneError};
use crate::key::{Form, Key, number_at};
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

impl Stored for Vec<Uncertain> {
    fn read(given: &Given) -> Result<Self> {
        let mut found = Self::new();
        match (given.form, &given.node.content) {
            (Form::Intervals(keys, _), Content::Table(_)) => {
                intervals(&mut found, keys(), &given.path, "", given.node).map(|()| found)
            }
            _ => Err(given.of_other_kind()),
        }
    }

    fn write(&self, form: Form) -> Content {
        let Form::Intervals(keys, _) = form else {
            return Content::Other;
        };
        let interval = |uncertain: &Uncertain| {
            let form = number_at(keys(), "", &uncertain.key).ok()?;
            let both = [uncertain.low, uncertain.high].map(|value| value.write(form).into());
            Some(Content::List(both.into()))
        };
        Content::table(
            self.iter()
                .map(|uncertain| (&*uncertain.key, interval(uncertain))),
        )
    }
}

/// Reads what stands at a key of the table at `path`, or below it: `a.b = …` and `"a.b" = …` are the same.
fn intervals(
    found: &mut Vec<Uncertain>,
    keys: &'static [Key],
    path: &str,
    key: &str,
    node: &Node,
) -> Result<()> {
    let own = joined(path, key);
    let both = match &node.content {
        Content::Table(entries) => {
            let mut entries = entries.iter();
            return entries.try_for_each(|node| intervals(found, keys, path, &joined(key, &node.key), node));
        }
        Content::List(both) => both,
        _ => return Err(SceneError::value(&own, node.described(), INTERVAL)),
    };
    let form = number_at(keys, path, key)?;
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
            .filter(|cost| (0.0..f64::INFINITY).contains(cost));
        let text = content.as_text().map(|text| Self::Text(text.to_owned()));
        let cost = number.map(Self::Number).or(text);
        cost.ok_or_else(|| given.of_other_kind())
    }

    fn write(&self, _: Form) -> Content {
        match self {
            Self::Number(cost) => Content::Number(*cost),
            Self::Text(text) => Content::Text(text.clone()),
        }
    }
}
