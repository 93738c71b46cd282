//! Each kind of bad input is refused with file, line, key, what was found and what is allowed.

use creepage::scene::{Scene, SceneError};

use super::{FULL, read};

#[test]
fn a_missing_section_is_named() {
    // Nothing but the first is told of an empty file.
    for text in ["", "\n\n", "# nothing"] {
        let message = read(text).unwrap_err().to_string();
        assert!(message.contains("key `duct` is missing"), "{message}");
    }
    for section in "duct ground cable friction ends vehicles traffic".split(' ') {
        let others: Vec<String> = FULL
            .split("\n[")
            .filter(|part| !part.trim_start_matches('[').starts_with(section))
            .map(str::to_owned)
            .collect();
        let message = read(&others.join("\n[")).unwrap_err().to_string();
        let missing = format!("key `{section}` is missing; allowed: ");
        assert!(message.contains(&missing), "{message}");
        assert!(message.starts_with("bad.toml, line "), "{message}");
    }
}

#[test]
fn what_is_not_toml_is_located_where_the_parser_gave_up() {
    let deep = format!("a = 1\n[duct]\nlength{} = 1\n", ".a".repeat(100));
    let nested = format!("a = 1\nb = 2\nc = {}1{}\n", "[".repeat(100), "]".repeat(100));
    for (text, line, part) in [
        ("[duct]\nlength = 1.2 m\n", 2, "in quotes"),
        ("[duct\n", 1, "unclosed"),
        ("a = 1\na = 2\n", 2, "duplicate key"),
        ("\n\na = \"x\n", 3, "invalid basic string"),
        ("a = 1\r\nb = = 2\r\n", 2, "extra `=`"),
        (deep.as_str(), 3, "recursion"),
        (&nested, 3, "recursion"),
        ("[duct]\nlength = 1\ndepth = 1\nlength = 2\n", 4, "duplicate key"),
        ("[duct]\nlength = 1\n[cable]\n[duct]\n", 4, "duplicate key"),
        ("a = [\n  { x = 1 y = 2 },\n]\n", 2, ""),
    ] {
        let error = read(text).unwrap_err();
        assert!(matches!(error, SceneError::Syntax { .. }), "{error}");
        assert_eq!(error.location().unwrap().line(), Some(line), "{error}");
        let (said, begin) = (
            error.to_string(),
            format!("bad.toml, line {line}: not valid TOML: "),
        );
        assert!(said.starts_with(&begin) && said.contains(part), "{said}");
    }
}

#[test]
fn a_spring_and_a_stiffness_are_understood_as_each_other_but_not_both() {
    let expected = read(FULL).unwrap();
    let renamed = FULL
        .replace("{ spring = ", "{ stiffness = ")
        .replace("stiffness = \"1 MN/m\"", "spring = \"1 MN/m\"");
    assert_eq!(read(&renamed).unwrap(), expected);
    let later = super::read_with(&["ends.downstream.stiffness=5", "restraints.0.spring=7"]).unwrap();
    assert_eq!(
        (later.ends.downstream, later.restraints[0].stiffness),
        (super::End::Spring(5.0), 7.0)
    );
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let folder = crate::command::folder("unreadable-scenes");
    let missing = Scene::from_file(folder.join("none.toml")).unwrap_err();
    assert!(matches!(missing, SceneError::Unreadable { .. }));
    assert!(missing.to_string().contains("none.toml: cannot be read"));
    assert!(Scene::from_file(&folder).is_err());
    let shift_jis = folder.join("sjis.toml");
    std::fs::write(&shift_jis, b"[duct]\n# \x92\xb7\x82\xb3\nlength = 30\n").unwrap();
    let encoding = Scene::from_file(&shift_jis).unwrap_err().to_string();
    assert!(
        encoding.contains("sjis.toml, line 2: not valid TOML: found text that is not UTF-8"),
        "{encoding}"
    );
    let endless = folder.join("endless.toml");
    std::fs::File::create(&endless).unwrap().set_len(1 << 30).unwrap();
    let error = Scene::from_file(&endless).unwrap_err();
    let source = std::error::Error::source(&error).expect("a cause").to_string();
    assert!(
        source.starts_with("found more than 16777216 bytes; allowed: "),
        "{source}"
    );
}

#[test]
fn a_message_reads_as_a_whole() {
    let message = read(&FULL.replace("depth = \"1.2 m\"", "depth = \"1.2 kN\"  # to the cable"));
    assert_eq!(
        message.unwrap_err().to_string(),
        "bad.toml, line 4: `duct.depth`: found \"1.2 kN\": `kN` is the unit of a force; \
         allowed: a length greater than 0, from 1 cm to 1 km, such as \"1.2 m\" (units: m, cm, mm, um, nm, km, in, ft, yd, mi)\n  \
           |\n\
         4 | depth = \"1.2 kN\"  # to the cable\n  \
           |         ^^^^^^^^"
    );
}
