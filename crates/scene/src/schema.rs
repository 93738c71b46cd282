//! The JSON Schema of a scene file.

use serde_json::{Map, Value, json};

use crate::content::{joined, other_name};
use crate::key::{Form, Key};
use crate::presets::of_section;
use crate::range::Quantity;
use crate::rivals::rivals;
use crate::scene::Scene;
use crate::stored::Stored;

/// The JSON Schema of a scene file, by which editors complete its keys and check their values. Of what
/// holds between several keys it says which of them exclude each other.
pub fn schema() -> Value {
    let mut root = table(Scene::KEYS, "");
    root["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    root["title"] = "Scene of creepage".into();
    root
}

fn table(keys: &[Key], path: &str) -> Value {
    let property = |key: &Key| {
        let mut property = match key.name {
            "preset" => json!({ "enum": of_section(path).map(|preset| &preset.name).collect::<Vec<_>>() }),
            name => form(&key.form, &joined(path, name)),
        };
        let default = key.absent.map(|default| format!("if omitted: {default}"));
        let default = default.unwrap_or("required".to_owned());
        let words = format!("{} Allowed: {}; {default}.", key.meaning, key.form.allowed());
        property["description"] = words.into();
        (key.name.to_owned(), property)
    };
    let mut properties: Map<String, Value> = keys.iter().map(property).collect();
    // Keys that have another name.
    for key in keys {
        if let (Some(other), Some(property)) = (other_name(key.name), properties.get(key.name).cloned()) {
            properties.insert(other.to_owned(), property);
        }
    }
    let is_required = |key: &&Key| key.absent.is_none() && other_name(key.name).is_none();
    let required: Vec<&str> = keys.iter().filter(is_required).map(|key| key.name).collect();
    let mut table = json!({ "type": "object", "additionalProperties": false });
    // A preset may give what is required.
    if properties.contains_key("preset") {
        table["anyOf"] = json!([{ "required": ["preset"] }, { "required": required }]);
    } else {
        table["required"] = json!(required);
    }
    table["properties"] = properties.into();
    let rivals = rivals(path).map(|(one, other)| json!({ "required": [one, other] }));
    let rivals: Vec<Value> = rivals.collect();
    if !rivals.is_empty() {
        table["not"] = json!({ "anyOf": rivals });
    }
    table
}

fn form(form: &Form, path: &str) -> Value {
    match form {
        Form::Number(quantity) => number(*quantity),
        Form::Name(_) => json!({ "type": "string", "pattern": "\\S" }),
        Form::Text(_) => json!({ "type": "string" }),
        Form::Any(_) => json!({ "type": ["string", "number"] }),
        Form::Intervals(..) => json!({ "type": "object" }),
        Form::Words(words, _) => json!({ "enum": words }),
        Form::Table(keys) => table(keys, path),
        Form::List([item], least, _) => {
            json!({ "type": "array", "minItems": least, "items": self::form(item, path) })
        }
        Form::List(items, ..) => json!({ "type": "array", "minItems": items.len(), "maxItems": items.len() }),
        Form::Either(one, keys) => json!({ "anyOf": [self::form(one, path), table(keys, path)] }),
    }
}

fn number(quantity: Quantity) -> Value {
    let Quantity {
        least, most, whole, ..
    } = quantity;
    let limit = |value: f64| if whole { json!(value as u64) } else { json!(value) };
    let kind = if whole { "integer" } else { "number" };
    let mut number = json!({ "type": kind, "minimum": limit(least) });
    if most < f64::MAX {
        number["maximum"] = limit(most);
    }
    let Some(dimension) = quantity.dimension else {
        return number;
    };
    let digits = match least {
        ..0.0 => "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)",
        0.0 => "\\+?([0-9]+\\.?[0-9]*|\\.[0-9]+)",
        _ => "\\+?0*\\.?0*[1-9][0-9]*\\.?[0-9]*",
    };
    let units = dimension.units().map(unit).collect::<Vec<_>>().join("|");
    let pattern = format!("^\\s*{digits}([eE][-+]?[0-9]+)?\\s*({units})\\s*$");
    json!({ "anyOf": [number, { "type": "string", "pattern": pattern }] })
}

/// A unit in all its spellings, as a regular expression.
fn unit(symbol: &str) -> String {
    if let Some(inverse) = symbol.strip_prefix("1/") {
        let inverse = unit(inverse);
        return format!("(1\\s*)?/\\s*{inverse}|{inverse}\\s*(\\^?\\s*-\\s*1|⁻\\s*¹)");
    }
    let letter = |(place, letter): (usize, char)| match letter {
        'u' if place == 0 => "[uµμ]".to_owned(),
        '2' if place > 0 => "(\\^?\\s*2|²)".to_owned(),
        '%' => "[%％]".to_owned(),
        letter => letter.to_string(),
    };
    if symbol == "deg" {
        return "deg|°".to_owned();
    }
    let letters = symbol.chars().enumerate().map(letter);
    letters.collect::<Vec<_>>().join("\\s*")
}
