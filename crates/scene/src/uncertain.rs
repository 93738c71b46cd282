//! `[uncertain]`: keys whose values are known only to lie between two. And what a measure costs, as far as that is known.

use serde::Serialize;

use crate::content::{Content, Node, joined};
use crate::error::{Result, SceneError};
use crate::key::{Form, number_at};
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
        match given.node.content {
            Content::Table(_) => intervals(given, "", given.node),
            _ => Err(given.of_other_kind()),
        }
    }

    fn write(&self, form: Form) -> Content {
        let Form::Intervals(keys, _) = form else {
            return Content::Other;
        };
        Content::table(self.iter().map(|uncertain| {
            let form = number_at(keys(), "", &uncertain.key).ok();
            let both = |form| [uncertain.low, uncertain.high].map(|value| value.write(form).into());
            (&*uncertain.key, form.map(|form| Content::List(both(form).into())))
        }))
    }
}

/// What stands at a key of the table that is given, or below it: `a.b = …` and `"a.b" = …` are the same.
fn intervals(given: &Given, key: &str, node: &Node) -> Result<Vec<Uncertain>> {
    let own = joined(&given.path, key);
    let both = match (&node.content, given.form) {
        (Content::Table(entries), _) => {
            let mut found = Vec::new();
            for entry in entries {
                for interval in intervals(given, &joined(key, &entry.key), entry)? {
                    // What was set later counts.
                    found.retain(|other: &Uncertain| other.key != interval.key);
                    found.push(interval);
                }
            }
            return Ok(found);
        }
        (Content::List(both), Form::Intervals(keys, _)) => {
            let form = number_at(keys(), &given.path, key)?;
            let read = |(index, node)| f64::read(&Given::new(joined(&own, index), node, form));
            both.iter().enumerate().map(read).collect::<Result<Vec<f64>>>()?
        }
        _ => return Err(SceneError::value(&own, node.described(), INTERVAL)),
    };
    if let [low, high] = both[..]
        && low < high
    {
        return Ok(vec![Uncertain::new(key, low, high)]);
    }
    let values: Vec<String> = both.into_iter().map(shown).collect();
    let found = format!("[{}]", values.join(", "));
    Err(SceneError::value(&own, found, INTERVAL))
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
        match (given.node.content.as_text(), given.node.content.as_number()) {
            (Some(text), _) => Ok(Self::Text(text.to_owned())),
            (_, Some(cost)) if (0.0..f64::INFINITY).contains(&cost) => Ok(Self::Number(cost)),
            _ => Err(given.of_other_kind()),
        }
    }

    fn write(&self, _: Form) -> Content {
        match self {
            Self::Number(cost) => Content::Number(*cost),
            Self::Text(text) => Content::Text(text.clone()),
        }
    }
}
