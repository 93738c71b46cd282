//! The name of a column, taken apart.

/// A column's name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Name {
    /// As the file has it.
    pub text: String,
    /// Without its unit, if this stands in brackets or after a slash.
    pub bare: String,
    /// Its words in small letters.
    pub words: Vec<String>,
    /// Its unit: in brackets, after a slash, or as its last word. A row of units below the header adds those of other columns.
    pub unit: Option<String>,
}

impl Name {
    /// From `text`, where `unit` knows units by their words.
    pub fn of(text: &str, unit: impl Fn(&str) -> Option<&'static str>) -> Self {
        let (bare, mut found) = bracketed(text, &unit);
        let words = bare.split(|c: char| !c.is_alphanumeric());
        let mut words: Vec<String> = words.filter(|word| !word.is_empty()).map(str::to_owned).collect();
        if found.is_none()
            && words.len() > 1
            && let Some(known) = words.last().and_then(|last| unit(last))
        {
            words.pop();
            found = Some(known.to_owned());
            if words.last().is_some_and(|word| word == "in") {
                words.pop();
            }
        }
        Self {
            text: text.to_owned(),
            words: words.iter().map(|word| word.to_lowercase()).collect(),
            bare,
            unit: found,
        }
    }

    /// Whether one of its words is in this list.
    pub fn has(&self, list: &[&str]) -> bool {
        self.words.iter().any(|word| list.contains(&&**word))
    }
}

/// The name without the unit that stands in brackets or after a slash, and that unit.
fn bracketed(text: &str, unit: impl Fn(&str) -> Option<&'static str>) -> (String, Option<String>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((before, rest)) = text.split_once(open)
            && let Some((inside, after)) = rest.split_once(close)
        {
            let bare = format!("{} {}", before.trim(), after.trim());
            return (bare.trim().to_owned(), Some(inside.trim().to_owned()));
        }
    }
    match text.rsplit_once('/') {
        Some((before, after)) if unit(after.trim()).is_some() => {
            (before.trim().to_owned(), Some(after.trim().to_owned()))
        }
        _ => (text.trim().to_owned(), None),
    }
}
