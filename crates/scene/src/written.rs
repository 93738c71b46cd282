//! A tree of values as TOML.

use crate::document::{Content, Entry};
use crate::shown::quoted;

/// The document with these keys: tables and lists of tables of the top level and of `[ground]` as sections, others in braces.
pub fn document(entries: &[Entry]) -> String {
    let mut out = String::new();
    section(&mut out, "", entries);
    out
}

fn section(out: &mut String, path: &str, entries: &[Entry]) {
    let inner = |key: &str| crate::document::joined(path, key);
    let is_section = |entry: &&Entry| match &entry.value.content {
        Content::Table(_) => path.is_empty(),
        Content::Array(items) => {
            let of_tables = items.iter().all(|item| matches!(item.content, Content::Table(_)));
            of_tables && matches!(path, "" | "ground")
        }
        _ => false,
    };
    for Entry { key, value, .. } in entries.iter().filter(|entry| !is_section(entry)) {
        out.extend([key, " = ", &inline(&value.content), "\n"]);
    }
    for Entry { key, value, .. } in entries.iter().filter(is_section) {
        let key = inner(key);
        let (heading, tables) = match &value.content {
            Content::Array(items) => (
                format!("\n[[{key}]]\n"),
                items.iter().map(|item| &item.content).collect(),
            ),
            table => (format!("\n[{key}]\n"), vec![table]),
        };
        for table in tables {
            if let Content::Table(entries) = table {
                *out += &heading;
                section(out, &key, entries);
            }
        }
    }
}

fn inline(content: &Content) -> String {
    match content {
        Content::Text(text) => quoted(text),
        Content::Number {
            integer: Some(whole), ..
        } => whole.to_string(),
        // TOML writes `nan` and `inf`, which no scene may hold, in small letters.
        Content::Number { value, .. } => format!("{value:?}").to_lowercase(),
        Content::Other => "false".to_owned(),
        Content::Array(items) => {
            let items: Vec<String> = items.iter().map(|item| inline(&item.content)).collect();
            format!("[{}]", items.join(", "))
        }
        Content::Table(entries) => {
            let entry = |entry: &Entry| format!("{} = {}", entry.key, inline(&entry.value.content));
            let entries: Vec<String> = entries.iter().map(entry).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}
