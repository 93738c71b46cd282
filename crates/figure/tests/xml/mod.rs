//! XML for tests of figures and pages.

#![allow(dead_code, reason = "each test uses a part of it")]

/// An element: its name, its attributes, and its text.
#[derive(Debug)]
pub struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub text: String,
}

impl Element {
    pub fn get(&self, name: &str) -> &str {
        let found = self.attributes.iter().find(|attribute| attribute.0 == name);
        found.map_or("", |attribute| attribute.1.as_str())
    }

    pub fn number(&self, name: &str) -> f64 {
        self.get(name)
            .parse()
            .unwrap_or_else(|_| panic!("{name} of {self:?}"))
    }

    pub fn points(&self) -> Vec<(f64, f64)> {
        let pair = |pair: &str| {
            let (x, y) = pair.split_once(',').expect("a point");
            (x.parse().expect("x"), y.parse().expect("y"))
        };
        self.get("points").split_whitespace().map(pair).collect()
    }
}

/// Reads XML of elements, attributes and text, and fails where it is not well-formed.
pub fn parse(svg: &str) -> Vec<Element> {
    let text = |raw: &str| {
        for part in raw.split('&').skip(1) {
            let entity = part.split(';').next().expect("an entity");
            assert!(
                ["lt", "gt", "amp", "quot", "apos"].contains(&entity),
                "&{entity} in {raw}"
            );
        }
        assert!(
            !raw.contains('>') && !raw.chars().any(|c| c.is_control() && c != '\n'),
            "{raw}"
        );
        raw.replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&quot;", "\"")
            .replace("&apos;", "'")
            .replace("&amp;", "&")
    };
    let mut elements: Vec<Element> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut parts = svg.split('<');
    assert_eq!(parts.next(), Some(""), "text before the root");
    for part in parts {
        assert!(elements.is_empty() || !open.is_empty(), "a second root");
        let (tag, after) = part.split_once('>').expect("an end of the tag");
        if let Some(name) = tag.strip_prefix('/') {
            let closed = open.pop().expect("an open element");
            assert_eq!(elements[closed].name, name);
        } else {
            let (tag, single) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
            let (name, mut rest) = tag.split_once(' ').unwrap_or((tag, ""));
            let mut attributes: Vec<(String, String)> = Vec::new();
            while !rest.trim().is_empty() {
                let (key, value) = rest.trim_start().split_once("=\"").expect("an attribute");
                let (value, next) = value.split_once('"').expect("the attribute's end");
                assert!(
                    attributes.iter().all(|attribute| attribute.0 != key),
                    "{key} twice"
                );
                attributes.push((key.into(), text(value)));
                rest = next;
            }
            elements.push(Element {
                name: name.into(),
                attributes,
                text: String::new(),
            });
            if !single {
                open.push(elements.len() - 1);
            }
        }
        let after = text(after);
        if let Some(&inside) = open.last() {
            elements[inside].text += after.trim();
        } else {
            assert!(after.trim().is_empty());
        }
    }
    assert!(open.is_empty(), "an element is not closed");
    elements
}
