//! A scene that is written to a file and read again is the same scene. Scenes at random are those that fuzz:: accepts.

use creepage::scene::{GroundModel, Scene, SolverMethod};

use super::{read, read_with};
use crate::scenes::upper;

#[test]
fn every_example_is_written_and_read_as_it_was() {
    let folder = std::fs::read_dir("examples/scenes").expect("the examples");
    let paths = folder.map(|entry| entry.expect("an entry").path());
    let mut scenes: Vec<Scene> = paths
        .map(|path| Scene::from_file(path).expect("a scene"))
        .collect();
    assert!(scenes.len() >= 2, "{}", scenes.len());
    // The same with a profile of the day's heat, with clamps that slip, and with names and numbers that are hard to write.
    let heat =
        "heat={ expansion = \"1.2e-5 /K\", profile = [[\"1 h\", \"0.1 K\"], [\"50000 s\", \"13 K\"]] }";
    scenes.push(upper(&["traffic.per_day=24", heat]));
    scenes.push(upper(&[
        "restraints=[{ position = 3, stiffness = 1e6, holds = 1000 }]",
    ]));
    let mut odd = read_with(&[]).unwrap();
    (odd.title, odd.traffic.seed) = ("\"quoted\" \\ \t 名\n".to_owned(), u64::MAX);
    odd.vehicles[0].name = "\"\\\n名ü ".to_owned();
    odd.duct.depth = 0.1 + 0.2;
    scenes.push(odd);
    for scene in scenes {
        let text = scene.to_toml();
        let again = read(&text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again, scene, "{text}");
        assert_eq!(again.to_toml(), text);
    }
}

#[test]
fn words_are_those_of_the_file() {
    for (word, model) in GroundModel::WORDS {
        assert_eq!((model.to_string().as_str(), word.parse()), (*word, Ok(*model)));
    }
    for (word, method) in SolverMethod::WORDS {
        assert_eq!((method.to_string().as_str(), word.parse()), (*word, Ok(*method)));
    }
    assert!("newton".parse::<SolverMethod>().is_err());
}
