//! Each kind of bad input is refused with its place. The words stand in messages.rs.

use creepage::scene::{End, Location, Scene, SceneError};

use super::{FULL, read, read_with};

#[test]
fn a_missing_section_is_named() {
    for section in "duct ground cable friction ends vehicles traffic".split(' ') {
        let is_other = |part: &&str| !part.trim_start_matches('[').starts_with(section);
        let others: Vec<&str> = FULL.split("\n[").filter(is_other).collect();
        let SceneError::Wrong(wrong) = read(&others.join("\n[")).unwrap_err() else {
            panic!("{section}")
        };
        assert_eq!(wrong.key, section);
        assert!(wrong.location.is_some_and(|location| location.line().is_some()));
    }
}

#[test]
fn what_is_not_toml_is_located_where_the_parser_gave_up() {
    let deep = format!("a = 1\n[duct]\nlength{} = 1\n", ".a".repeat(100));
    let nested = format!("a = 1\nb = 2\nc = {}1{}\n", "[".repeat(100), "]".repeat(100));
    for (text, line) in [
        ("[duct]\nlength = 1.2 m\n", 2),
        ("[duct\n", 1),
        ("a = 1\na = 2\n", 2),
        ("\n\na = \"x\n", 3),
        ("a = 1\r\nb = = 2\r\n", 2),
        (&deep, 3),
        (&nested, 3),
        ("[duct]\nlength = 1\n[cable]\n[duct]\n", 4),
        ("a = [\n  { x = 1 y = 2 },\n]\n", 2),
    ] {
        let error = read(text).unwrap_err();
        assert!(matches!(error, SceneError::Syntax { .. }), "{error}");
        assert_eq!(error.location().and_then(Location::line), Some(line), "{error}");
    }
}

#[test]
fn a_spring_and_a_stiffness_are_understood_as_each_other() {
    let renamed = FULL
        .replace("{ spring = ", "{ stiffness = ")
        .replace("stiffness = \"1 MN/m\"", "spring = \"1 MN/m\"");
    assert_eq!(read(&renamed).unwrap(), read(FULL).unwrap());
    let later = read_with(&["ends.downstream.stiffness=5", "restraints.0.spring=7"]).unwrap();
    assert_eq!(later.ends.downstream, End::Spring(5.0));
    assert_eq!(later.restraints[0].stiffness, 7.0);
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let folder = crate::command::folder("unreadable-scenes");
    let missing = Scene::from_file(folder.join("none.toml")).unwrap_err();
    let is_named = |name: &str| name.ends_with("none.toml");
    assert!(matches!(missing, SceneError::Unreadable(name, _) if is_named(&name)));
    assert!(Scene::from_file(&folder).is_err());
    let shift_jis = folder.join("sjis.toml");
    std::fs::write(&shift_jis, b"[duct]\n# \x92\xb7\x82\xb3\nlength = 30\n").unwrap();
    let encoding = Scene::from_file(&shift_jis).unwrap_err();
    assert!(matches!(encoding, SceneError::Syntax { .. }), "{encoding}");
    assert_eq!(encoding.location().and_then(Location::line), Some(2));
    let endless = folder.join("endless.toml");
    std::fs::File::create(&endless).unwrap().set_len(1 << 30).unwrap();
    let error = Scene::from_file(&endless).unwrap_err();
    assert!(matches!(error, SceneError::Unreadable(..)), "{error:.300}");
}
