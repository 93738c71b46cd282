//! `traffic.histogram`: a table of axle loads in place of vehicles.

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use creepage::scene::Order;
use creepage::{RunOptions, Scene, SceneError, SceneFile};
use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};

use crate::command::folder;
use crate::scenes::{assert_near, forces, run};

const SCENE: &str = r#"
duct = { length = "15 m", depth = "1.2 m" }
ground.layers = [{ young_modulus = "100 MPa", poisson_ratio = 0.4 }]
cable.preset = "xlpe-800-single-core"
friction = { law = "coulomb", dynamic_coefficient = 0.25 }
ends = { upstream = "free", downstream = "fixed" }
traffic = { histogram = "axles.csv", passes = 3 }
solver = { tolerance = 0.1, node_spacing = "0.2 m", vehicle_step = "0.1 m" }
"#;

/// A scene in a folder with this table.
fn written(test: &str, table: impl AsRef<[u8]>) -> PathBuf {
    let folder = folder(&format!("histogram-{test}"));
    fs::write(folder.join("axles.csv"), table).expect("a table");
    fs::write(folder.join("duct.toml"), SCENE).expect("a scene");
    folder.join("duct.toml")
}

pub fn read(test: &str, table: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    SceneFile::read(written(test, table))?.with(overrides)?.scene()
}

/// Load, contact radius and share of each class.
fn classes(scene: &Scene) -> Vec<(f64, f64, f64)> {
    let class = |(traffic, share): (&creepage::scene::TrafficVehicle, f64)| {
        let [wheel] = traffic.wheels()[..] else {
            panic!("one wheel");
        };
        (wheel.load, wheel.contact_radius, share)
    };
    scene.vehicles.iter().zip(scene.shares()).map(class).collect()
}

#[test]
fn every_row_is_an_axle_with_its_share() {
    let expected = [(5e4, 0.15, 0.75), (1e5, 0.2, 0.25)];
    for table in [
        "load,count,contact_radius\n50 kN,300,0.15 m\n80 kN,0,0.15 m\n100 kN,100,20 cm\n",
        "\u{feff}# counted in May\nCount; Load; contact_radius\r\n\"300\"; 50000 ; 150 mm\r\n\r\n100;0.1 MN;0.2\r\n",
        "site\tload\tcount\tcontact_radius\nA\t50 kN\t3\t0.15\nA\t100 kN\t1\t0.2\n",
        "Achslast [kN];Anzahl;contact_radius (cm)\n50,0;300;15\n100;100;0,2 m\n",
        "Station 12, May\nload,count,contact_radius\nkN,-,m\n50,\"3,000\",0.15\n100,\"1,000.0\",0.2\n",
    ] {
        let scene = read("rows", table, &[]).unwrap();
        assert_eq!(classes(&scene), expected, "{table}");
        assert_eq!(scene.order(), Order::Random { seed: 1 });
        assert_eq!(scene.vehicles[0].speed, 40.0 / 3.6);
        assert_eq!(Scene::from_toml("duct.toml", &scene.to_toml()).unwrap(), scene);
        scene.validate().unwrap();
    }
    let set = ["traffic.speed=5", "traffic.seed=9"];
    let points = read("points", "load,count\n1 tf,1\n", &set).unwrap();
    assert_eq!(classes(&points), [(9806.65, 0.0, 1.0)]);
    assert_eq!(points.order(), Order::Random { seed: 9 });
    assert_eq!(points.vehicles[0].speed, 5.0);
}

/// Tables as stations and spreadsheets write them: a table, how many newtons its lighter axles have of 5 or 50.
const TABLES: &str = "\
axle load [kips],count¶10,300¶20,100 | 44482.216152605
Load (kip),Axles¶10,\"3,000.0\"¶20,\"1,000.0\" | 44482.216152605
axle load [t];count¶5;3¶10;1 | 49033.25
Achslast t;Anzahl¶5,0;3¶10,0;1 | 49033.25
load [kg],count¶5000,3¶10000,1 | 49033.25
load,count¶lb,-¶10000,3¶20000,1 | 44482.216152605
load,count¶10000 lbs,3¶20000 lbs,1 | 44482.216152605
Station 12¶Lane;2¶load [kN];count¶50;3¶100;1 | 5e4
class;load [kN];count¶1;50;3¶2;100;1¶Total;150;4 | 5e4
Achslast [kN];Anzahl¶50;3¶100;1¶Summe;4 | 5e4
load [kN];count [%]¶50;75¶100;25 | 5e4
load [kN];count¶50;75 %¶100;25 % | 5e4
Achslast [kN];Anteil¶50;0,75¶100;0,25 | 5e4
class number,load [kN],count¶1,50,3¶2,100,1 | 5e4
~load;count¶~kN;-¶50;3¶100;1 | 5e4";

#[test]
fn tables_of_every_country_are_read() {
    for row in TABLES.lines() {
        let (table, load) = row.split_once(" | ").expect("a load");
        let load: f64 = load.parse().expect("newtons");
        let scene = read("countries", &(table.replace('¶', "\n") + "\n"), &[]);
        let scene = scene.unwrap_or_else(|error| panic!("{table}: {error}"));
        let found = classes(&scene);
        assert_eq!(found.len(), 2, "{table}");
        for ((found, _, share), (times, expected)) in found.into_iter().zip([(1.0, 0.75), (2.0, 0.25)]) {
            assert_near(found, times * load, 1e-12, table);
            assert_near(share, expected, 1e-12, table);
        }
        assert!(!warns_of_groups(&scene), "{table}");
    }
    for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        let text = "\u{feff}Achslast [kN];Anzahl\n50,5;3\n100;1\n";
        let text: Vec<u8> = text.encode_utf16().flat_map(bytes).collect();
        let scene = Scene::from_file(written("utf-16", text)).unwrap();
        assert_eq!(classes(&scene)[0], (5.05e4, 0.0, 0.75));
    }
}

fn warns_of_groups(scene: &Scene) -> bool {
    let mut warnings = creepage::scene::unusual(scene).into_iter();
    warnings.any(|warning| warning.contains("a column of groups"))
}

/// A tandem in one row moves the cable more than its two axles do.
#[test]
fn groups_of_axles_are_warned_of() {
    for table in [
        "group,load [kN],count\nsingle,50,3\ntandem,180,1\n",
        "load [kN];Tandem;count\n50;no;3\n180;yes;1\n",
    ] {
        let scene = read("groups", table, &[]).unwrap();
        assert!(warns_of_groups(&scene), "{table}");
        assert_eq!(Scene::from_toml("duct.toml", &scene.to_toml()).unwrap(), scene);
    }
}

/// What a reader cannot know of a table is said in the scene.
#[test]
fn a_scene_says_how_its_table_is_written() {
    let table = "load;count\nAchslast;Zahl\n1.200;3\n2.400;1\n";
    let told = "traffic.histogram={ file = \"axles.csv\", decimal = \"comma\", header_line = 2, unit = \"kN\", column_load = \"Achslast\", column_count = \"Zahl\" }";
    let found = classes(&read("told", table, &[told]).unwrap());
    assert_eq!(found, [(1.2e6, 0.0, 0.75), (2.4e6, 0.0, 0.25)]);
    for (set, part) in [
        ("decimal = \"dot\"", "point, comma"),
        ("header_line = \"two\"", "whole number"),
        ("decimals = 3", "decimal"),
    ] {
        let set = format!("traffic.histogram={{ file = \"axles.csv\", {set} }}");
        let message = read("told", table, &[&set]).expect_err(&set).to_string();
        assert!(message.contains(part), "{message}");
    }
}

/// A table, and what its message holds besides the place in the scene.
const BAD: &str = "\
∅ | no rows | load, count
load¶50 kN | axles.csv:1 | no column count
load,count | no row with axles
load,count¶50 kN,0 | no row with axles
load,count¶¶50 m,3 | axles.csv:3: load: found \"50 m\" | a force
load,count¶0,3 | load: found \"0\" | greater than 0
load,count¶-5 kN,3 | load: found \"-5 kN\"
load,count¶5 kN,-3 | count: found \"-3\" | at least 0
load,count¶5 kN,nan | count: found \"nan\"
load,count¶5 kN, | count: found \"\"
load,count¶5 kN | 1 cells where the first row has 2
load,count¶40,3¶130,1¶80,2 | axles.csv:3: load: 130 N as the heaviest axle | \"130 kN\" | \"load [kN]\"
load [kN];count¶20;5.200 | axles.csv:2: count: found \"5.200\", 5.2 or 5200
load,count¶20 kN,5,7 | axles.csv:2: 3 cells
load [kg],count¶3000-3999,3 | axles.csv:2: load | found \"3000-3999\"
class,load [kN],count¶1,50,3¶,,3 | axles.csv:3: load [kN]: found \"\"
load from [kN],load to [kN],count¶40,50,3 | axles.csv:1: a second column load to
load [kN];count¶50;75 %¶100;25 | axles.csv:3: count: found \"25\" | among others in %
load [m],count¶40,3 | load [m]: found \"40\" | a force
load,count,contact_radius¶5 kN,1,1 km | contact_radius: found \"1 km\"";

#[test]
fn a_bad_table_is_refused_with_its_line() {
    let many: Vec<String> = (1000..2001).map(|load| format!("{load},1")).collect();
    let many = format!("load,count¶{} | 1001 classes | at most 1000", many.join("¶"));
    for row in BAD.lines().chain([&*many]) {
        let (table, parts) = row.split_once(" | ").expect("parts");
        let table = table.replace('¶', "\n").replace('∅', "");
        let message = read("bad", &table, &[]).expect_err(row).to_string();
        let place = ["line 7: `traffic.histogram`", "axles.csv"];
        for part in place.into_iter().chain(parts.split(" | ")) {
            assert!(message.contains(part), "{part} is not in {message}");
        }
    }
}

#[test]
fn what_contradicts_a_histogram_is_refused() {
    let table = "load,count\n50 kN,3\n100 kN,1\n";
    let vehicle = "vehicles=[{ load = \"20 tf\", speed = 10 }]";
    for (set, part) in [
        ("traffic.histogram=nowhere.csv", "nowhere.csv"),
        ("traffic.histogram=3", "the name of a table"),
        ("traffic.order=interleaved", "come at random"),
        ("traffic.sequence=['axle 1']", "come at random"),
        ("ground.longitudinal_peak=30 um", "vertical_peak"),
    ] {
        let message = read("contradictions", table, &[set]).expect_err(set).to_string();
        let is_told = message.contains("`traffic.") && message.contains(part);
        assert!(is_told, "{message}");
    }
    let both = format!("{SCENE}[[vehicles]]\nload = \"20 tf\"\nspeed = 10\n");
    let message = Scene::from_toml("both.toml", &both).unwrap_err().to_string();
    let both = "both `vehicles` and `traffic.histogram`";
    assert!(message.contains(both), "{message}");
    // What was set later counts.
    let later = read("contradictions", table, &[vehicle]).unwrap();
    assert_eq!((later.vehicles.len(), later.order()), (1, Order::Interleaved));
    let none = ["traffic.histogram=", vehicle, "traffic.speed=3"];
    let message = read("contradictions", table, &none).unwrap_err().to_string();
    assert!(message.contains("`traffic.speed`"), "{message}");
}

/// Clay under a point load, which counts how often it is asked.
struct Counted(AtomicUsize);

impl GroundField for Counted {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        self.0.fetch_add(1, Ordering::Relaxed);
        Ok(testkit::johnson(
            testkit::soil(1e8, 0.5),
            load.force(),
            radius,
            depth,
        ))
    }
}

#[test]
fn classes_of_one_radius_share_one_computation_of_the_ground() {
    let asked = |rows: &str| {
        let table = format!("load,count,contact_radius\n{rows}");
        let scene = read("shared", &table, &[]).unwrap();
        let ground = Counted(AtomicUsize::new(0));
        let options = RunOptions {
            ground: Some(&ground),
            ..RunOptions::default()
        };
        let run = creepage::run_with(&scene, &options).unwrap();
        (ground.0.into_inner(), run.duct_motion.peak_longitudinal_m)
    };
    let rows: Vec<String> = (1..=40).map(|k| format!("{k} tf,{k},0.1\n")).collect();
    let one = asked("1 tf,1,0.1\n");
    assert_eq!(asked(&rows.concat()), one);
    assert!(asked("1 tf,1,0.1\n2 tf,1,0.2\n").0 > one.0);
}

/// A class is what the same wheel in `[[vehicles]]` is.
#[test]
fn a_table_of_one_class_is_a_vehicle() {
    let table = read("one", "load,count,contact_radius\n10 tf,5,0.15 m\n", &[]).unwrap();
    let wheel =
        "vehicles=[{ speed = \"40 km/h\", wheels = [{ load = \"10 tf\", contact_radius = \"0.15 m\" }] }]";
    let listed = read("one", "load,count\n1,1\n", &[wheel]).unwrap();
    assert_eq!(forces(&run(&table)), forces(&run(&listed)));
}
