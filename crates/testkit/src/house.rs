//! How the files of a package lie.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The files of Rust below `root`, as paths from it.
pub fn files(root: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root).into_iter().flatten() {
        let name = entry.expect("an entry").file_name();
        let name = name.to_str().expect("UTF-8").to_owned();
        let below = files(&format!("{root}/{name}"));
        found.extend(below.iter().map(|file| format!("{name}/{file}")));
        if Path::new(&name).extension().is_some_and(|end| end == "rs") {
            found.push(name);
        }
    }
    found
}

/// Pairs of top-level modules on a circle, of which one names the other, from paths of files and their code. Tests stand at a file's
/// end, and import what they like.
pub fn circles(sources: &[(String, String)]) -> BTreeSet<(String, String)> {
    let word = |text: &str| {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
        text[..end.unwrap_or(text.len())].to_owned()
    };
    let mut arrows = BTreeSet::new();
    for (file, code) in sources {
        let code = code.split("#[cfg(test)]").next().unwrap_or_default();
        for line in code.lines().filter(|line| !line.trim().starts_with("//")) {
            for rest in line.split("crate::").skip(1) {
                let names = rest.split(['{', ',']).map(str::trim);
                arrows.extend(names.map(|name| (word(file), word(name))));
            }
        }
    }
    arrows.retain(|(from, to)| from != to);
    // What nothing leads to, or from, lies on no circle.
    for _ in 0..arrows.len() {
        let all = arrows.clone();
        let leads = |to: &String| all.iter().any(|arrow| arrow.1 == *to);
        let starts = |from: &String| all.iter().any(|arrow| arrow.0 == *from);
        arrows.retain(|(from, to)| leads(from) && starts(to));
    }
    arrows
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_circle_is_seen_and_a_way_is_none() {
        let sources = [
            ("a/x.rs", "use crate::{b::B};"),
            ("b.rs", "use crate::a::A; use crate::c::C;"),
            (
                "c.rs",
                "// crate::a\n#[cfg(test)]\nmod tests { use crate::a::A; }",
            ),
        ];
        let sources = sources.map(|(file, code)| (file.to_owned(), code.to_owned()));
        assert_eq!(super::circles(&sources).len(), 2);
        assert_eq!(super::circles(&sources[1..]).len(), 0);
    }
}
