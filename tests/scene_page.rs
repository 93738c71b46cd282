//! docs/scene.md is what `creepage explain` says of every key.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use creepage::scene::key_meanings;

const HEAD: &str = "# The scene file

Every key of a scene, as `creepage explain` says it. This page is generated: a test compares it with the program, and leaves a new one in
`target/tmp/scene.md` where they differ. A quantity is a text with its unit or a bare number in SI.
";

/// The page: what stands at the top level, and a table of the keys below.
fn page() -> String {
    let mut page = HEAD.to_owned();
    let keys = key_meanings();
    for (index, key) in keys.iter().enumerate() {
        let default = key
            .default
            .map_or("required".to_owned(), |default| format!("if omitted: {default}"));
        let row = [&key.key, key.meaning, &key.allowed, &default].map(|cell| cell.replace('|', "\\|"));
        if key.key.contains('.') {
            writeln!(page, "| `{}` | {} | {} | {} |", row[0], row[1], row[2], row[3]).unwrap();
            continue;
        }
        write!(page, "\n## `{}`\n\n{} ({})\n", key.key, row[1], row[3]).unwrap();
        if keys.get(index + 1).is_some_and(|next| next.key.contains('.')) {
            page += "\n| key | meaning | allowed | default |\n|---|---|---|---|\n";
        }
    }
    page
}

#[test]
fn the_page_on_scenes_has_every_key_with_its_meaning() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scene.md");
    let new = Path::new(env!("CARGO_TARGET_TMPDIR")).join("scene.md");
    fs::write(&new, page()).unwrap();
    let docs = fs::read_to_string(docs).unwrap_or_default();
    assert!(
        docs == page(),
        "docs/scene.md is not what the program says: copy {}",
        new.display()
    );
}
