//! Each kind of bad input is refused with file, line, key, what was found and what is allowed.

use creepage::scene::{Scene, SceneError};

use super::{FULL, assert_refused, read};

/// Line of the scene → what stands in its place, ∅ for nothing | part of the line that is named | parts of the message
const REFUSED: &str = r#"
# an unknown key suggests the nearest
length = "30 m" → lenght = "30 m" | lenght | unknown key `duct.lenght` | did you mean `length`? | allowed: length, depth, lateral_offset, slope, inner_diameter | ^^^^^^
[cable] → [cabel] | [cabel] | unknown key `cabel` | did you mean `cable`?
share = 3 → shares = 3 | shares | unknown key `vehicles.0.shares` | did you mean `share`?
{ spring =  → { sprung =  | sprung | `ends.downstream.sprung` | `spring`?
x = "0 m", y → x = "0 m", z | z = | `vehicles.1.wheels.0.z` | allowed: x, y, load, contact_radius
# a misplaced key is told its section
passes = 60 → passes = 60¶shape_factor = 1 | shape_factor = 1 | unknown key `traffic.shape_factor` | did you mean `friction.shape_factor`?
# a missing key is named at its section
depth = "1.2 m" → ∅ | [duct] | key `duct.depth` is missing; allowed: a length greater than 0, from 1 cm to 1 km, such as "1.2 m"
dynamic_coefficient = 0.25 → ∅ | [friction] | key `friction.dynamic_coefficient` is missing; allowed: a number from 0 to 10
passes = 60 → ∅ | [traffic] | key `traffic.passes` is missing; allowed: a whole number
upstream = "free" → ∅ | [ends] | key `ends.upstream` is missing; allowed: "free", "fixed" or { spring
# a wrong dimension is refused
depth = "1.2 m" → depth = "1.2 kN" | 1.2 kN | `duct.depth`: wrong dimension | found "1.2 kN", a force | allowed: a length greater than 0 |       ^^^^^^^^
speed = "36 km/h" → speed = "36 km" | 36 km | `vehicles.0.speed` | a length | km/h
stiffness = "1 MN/m" → stiffness = "1 MN" | "1 MN" | `restraints.0.stiffness`
# a missing unit is refused
depth = "1.2 m" → depth = "1.2" | depth | `duct.depth` | missing unit | found "1.2" | units: m, cm, mm
# a decimal comma is told
depth = "1.2 m" → depth = "1,2 m" | 1,2 m | `duct.depth` | found the text "1,2 m" | allowed: a decimal point, "1.2 m": a length
depth = "1.2 m" → depth = 1,2 | depth = 1,2 | not valid TOML | decimals are written with a point: depth = 1.2
dynamic_coefficient = 0.25 → dynamic_coefficient = "0,25" | 0,25 | allowed: 0.25: a number from 0 to 10
# percent where a number belongs is told its number
dynamic_coefficient = 0.25 → dynamic_coefficient = "25 %" | 25 % | `friction.dynamic_coefficient` | allowed: 0.25: a number from 0 to 10
tolerance = "2 %" → tolerance = 2 % | tolerance = 2 % | not valid TOML | stands in quotes: tolerance = "2 %"
tolerance = "2 %" → tolerance = 2 | tolerance | out of range: found 2 | such as 0.01 or "1 %"
depth = "1.2 m" → depth = 1.2 m | depth = 1.2 m | not valid TOML | stands in quotes: depth = "1.2 m"
# an unknown unit is refused
young_modulus = "800 MPa" → young_modulus = "800 Mpa" | 800 Mpa | `ground.layers.2.young_modulus` | unknown unit `Mpa` | found "800 Mpa" | did you mean `MPa`?
# what is no number is refused
depth = "1.2 m" → depth = "1,2 m" | 1,2 | `duct.depth` | found the text "1,2 m" | a length greater than 0
depth = "1.2 m" → depth = true | true | found true | allowed: a length
depth = "1.2 m" → depth = [1] | [1] | found the list [1] | allowed: a length
depth = "1.2 m" → depth = {} | {} | found the table {} | allowed: a length
depth = "1.2 m" → depth = 1979-05-27 | 1979 | found 1979-05-27
# a number in quotes is refused where there is no unit
dynamic_coefficient = 0.25 → dynamic_coefficient = "0.25" | 0.25 | `friction.dynamic_coefficient` | the text "0.25" | without quotes
passes = 60 → passes = "60" | passes | `traffic.passes` | without quotes
# a value of the wrong kind is refused
title = "Everything" → title = 3 | title | `title`: found the number 3 | a text
name = "van" → name = 3 | name = 3 | `vehicles.1.name` (vehicle 2): found the number 3
upstream = "free" → upstream = 3 | upstream | found the number 3 | "free", "fixed" or
[[restraints]] → [restraints] | [restraints] | `restraints` | a list of [[restraints]]
[cable] → [[cable]] | [[cable]] | `cable` | a table with the keys preset, weight
  { x = "-2.5 m", y = "-0.9 m", load = "7 kN" }, →   "rear", | rear | `vehicles.1.wheels.1` | "rear" | a table with the keys x, y
# an unknown word suggests the nearest
model = "fem" → model = "winkler" | winkler | allowed: "auto", "boussinesq", "burmister", "fem"
model = "fem" → model = "odemark" | odemark | allowed: "auto", "boussinesq", "burmister", "fem" | no longer there
method = "explicit" → method = "dynamic" | method = "dynamic" | "pass-law"; inertia is computed by "explicit"
# a spring and a stiffness are understood as each other but not both
{ spring =  → { stiffness = 1, spring =  | { stiffness | `ends.downstream.stiffness` | both `spring` and `stiffness` | only one
{ spring = "3 MN/m" } → { stiffness = "3 m" } | { stiffness | `ends.downstream.stiffness` | wrong dimension
# two scalings are refused
longitudinal_peak = "35.7 um" → longitudinal_peak = "35.7 um"¶vertical_peak = "90 um" | vertical_peak | `ground.vertical_peak` | both `longitudinal_peak` and `vertical_peak` | only one
# load and wheels exclude each other and one is needed
load = "20 tf" → load = "20 tf"¶wheels = [{ load = 1 }] | wheels = [{ load | `vehicles.0.wheels` | both `load` and `wheels` | only one
load = "20 tf" → ∅ | [[vehicles]] | `vehicles.0` | neither `load` nor `wheels`
# shape factor belongs to the laws that have one
law = "sigmoid" → law = "coulomb" | shape_factor | `friction.shape_factor` | with `law` = "coulomb" | no `shape_factor`
# layers have a thickness but the last
young_modulus = "800 MPa" → thickness = 2¶young_modulus = "800 MPa" | thickness = 2 | `ground.layers.2.thickness` | found 2 | no thickness in the last layer
thickness = "50 mm" → ∅ | [[ground.layers]] | key `ground.layers.0.thickness` (layer 1) is missing
# order and sequence exclude each other
seed = 7 → sequence = ["van"] | sequence | `traffic.sequence` | both `order` and `sequence`
# a seed needs a random order
order = "random" → ∅ | seed | `traffic.seed` | found 7 with no `order` | `seed` only with order = "random"
order = "random" → order = "interleaved" | seed | 7 with `order` = "interleaved" | `seed` only with order = "random"
# a vehicle without load cannot be scaled
load = "20 tf" → load = 0 | load = 0 | `vehicles.0.load` | without load | `ground.longitudinal_peak`
"#;

#[test]
fn each_fault_is_refused_at_its_line() {
    for case in REFUSED
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with("# "))
    {
        let (old, case) = case.split_once(" → ").unwrap();
        let [new, at, ref parts @ ..] = case.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{case}")
        };
        let new = if new == "∅" {
            String::new()
        } else {
            new.replace('¶', "\n")
        };
        assert_refused(old, &new, at, parts);
    }
}

#[test]
fn a_missing_section_is_named() {
    for section in [
        "duct", "ground", "cable", "friction", "ends", "vehicles", "traffic",
    ] {
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

/// Line of the scene → what stands in its place | key | part of what is allowed
const OUT_OF_RANGE: &str = r#"
depth = "1.2 m" → depth = 0 | duct.depth | a length greater than 0
length = "30 m" → length = "-30 m" | duct.length | a length greater than 0
length = "30 m" → length = nan | duct.length | a length greater than 0
length = "30 m" → length = "NaN m" | duct.length | a length greater than 0
length = "30 m" → length = inf | duct.length | a length greater than 0
length = "30 m" → length = 1e999 | duct.length | a length greater than 0
lateral_offset = "-0.5 m" → lateral_offset = "inf m" | duct.lateral_offset | a length of any sign
slope = "-3 %" → slope = "46 deg" | duct.slope | a slope of any sign, from -100 % to 100 %
slope = "-3 %" → slope = "180 deg" | duct.slope | a slope of any sign, from -100 % to 100 %
inner_diameter = "20 cm" → inner_diameter = 0 | duct.inner_diameter | a length greater than 0, from 1 mm to 10 m
slope = "-3 %" → slope = nan | duct.slope | a slope of any sign, from -100 % to 100 %
slope = "-3 %" → slope = 5 | duct.slope | a bare number is the rise over a distance of 1: did you mean "5 %"?
longitudinal_peak = "35.7 um" → longitudinal_peak = 0 | ground.longitudinal_peak | greater than 0
rigid_base_depth = "12 m" → rigid_base_depth = -1 | ground.rigid_base_depth | greater than 0
rigid_base_depth = "12 m" → rigid_base_depth = "1.05 m" | ground.rigid_base_depth | below the upper layers, greater than 1.05 m
thickness = "50 mm" → thickness = 0 | ground.layers.0.thickness | greater than 0
poisson_ratio = 0.35 → poisson_ratio = 0.51 | ground.layers.0.poisson_ratio | from 0 to 0.5
poisson_ratio = 0.35 → poisson_ratio = -0.1 | ground.layers.0.poisson_ratio | from 0 to 0.5
young_modulus = "800 MPa" → young_modulus = 300 | ground.layers.2.young_modulus | a bare number is in Pa: did you mean "300 MPa"?
depth = "1.2 m" → depth = 1500 | duct.depth | a bare number is in m: did you mean "1500 mm"?
young_modulus = "800 MPa" → young_modulus = 0 | ground.layers.2.young_modulus | greater than 0
top = "60 MPa" → top = 0 | ground.layers.1.young_modulus.top | greater than 0
weight = "108.8 N/m" → weight = -1 | cable.weight | a force per length greater than 0
axial_stiffness = 8.01e6 → axial_stiffness = 0 | cable.axial_stiffness | a force greater than 0
normal_load_factor = 1.5 → normal_load_factor = 0 | cable.normal_load_factor | a number greater than 0
dynamic_coefficient = 0.25 → dynamic_coefficient = -0.1 | friction.dynamic_coefficient | from 0 to 10
dynamic_coefficient = 0.25 → dynamic_coefficient = 25 | friction.dynamic_coefficient | from 0 to 10
dynamic_coefficient = 0.25 → dynamic_coefficient = nan | friction.dynamic_coefficient | from 0 to 10
shape_factor = "2e7 1/m" → shape_factor = 0 | friction.shape_factor | an inverse length greater than 0
spring = "3 MN/m" → spring = "0 MN/m" | ends.downstream.spring | greater than 0
position = "20 m" → position = "31 m" | restraints.0.position | a position in the duct, from 0 m to 30 m
position = "20 m" → position = "-1 m" | restraints.0.position | a position in the duct, from 0 m to 30 m
stiffness = "1 MN/m" → stiffness = 0 | restraints.0.stiffness | greater than 0
speed = "36 km/h" → speed = "0 km/h" | vehicles.0.speed | a speed greater than 0
load = "20 tf" → load = "-20 tf" | vehicles.0.load | a force of at least 0
load = "7 kN" → load = -7 | vehicles.1.wheels.1.load | a force of at least 0
contact_radius = "0.15 m" → contact_radius = -1 | vehicles.1.wheels.0.contact_radius | of at least 0
share = 3 → share = 0 | vehicles.0.share | a number greater than 0
share = 3 → share = -1 | vehicles.0.share | a number greater than 0
passes = 60 → passes = 0 | traffic.passes | a whole number from 1 to 1000000000000
passes = 60 → passes = -60 | traffic.passes | a whole number from 1 to 1000000000000
passes = 60 → passes = 60.5 | traffic.passes | a whole number from 1 to 1000000000000
passes = 60 → passes = 1e30 | traffic.passes | a whole number from 1 to 1000000000000
passes = 60 → passes = 1e13 | traffic.passes | a whole number from 1 to 1000000000000
seed = 7 → seed = -7 | traffic.seed | a whole number of at least 0
tolerance = "2 %" → tolerance = 0 | solver.tolerance | greater than 0 and at most 0.5
tolerance = "2 %" → tolerance = "51 %" | solver.tolerance | greater than 0 and at most 0.5
node_spacing = "0.1 m" → node_spacing = 0 | solver.node_spacing | greater than 0
node_spacing = "0.1 m" → node_spacing = "15.1 m" | solver.node_spacing | at most half the duct's length, 15 m
vehicle_step = "5 cm" → vehicle_step = 0 | solver.vehicle_step | greater than 0
time_step = "0.1 ms" → time_step = 0 | solver.time_step | a time greater than 0
"#;

#[test]
fn values_out_of_range_are_refused() {
    for case in OUT_OF_RANGE.lines().filter(|line| !line.is_empty()) {
        let (old, case) = case.split_once(" → ").unwrap();
        let [new, key, allowed] = case.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{case}")
        };
        let found = new.split_once(" = ").unwrap().1;
        let start = format!(": out of range: found {found}; allowed: ");
        assert_refused(old, new, new, &[&format!("`{key}`"), &start, allowed, "^"]);
    }
}

/// Line of the scene → what stands in its place | key | suggestion
const UNKNOWN_WORDS: &str = r#"
law = "sigmoid" → law = "couloumb" | friction.law | coulomb
model = "fem" → model = "Burmeister" | ground.model | burmister
upstream = "free" → upstream = "fre" | ends.upstream | free
direction = "reverse" → direction = "reversed" | vehicles.1.direction | reverse
order = "random" → order = "randam" | traffic.order | random
method = "explicit" → method = "quasi_static" | solver.method | quasi-static
"#;

#[test]
fn an_unknown_word_suggests_the_nearest() {
    for case in UNKNOWN_WORDS.lines().filter(|line| !line.is_empty()) {
        let (old, case) = case.split_once(" → ").unwrap();
        let [new, key, suggestion] = case.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{case}")
        };
        let found = new.split_once(" = ").unwrap().1;
        let meant = format!(": found {found} (did you mean `{suggestion}`?); allowed: \"");
        assert_refused(old, new, new, &[&format!("`{key}`"), &meant, "^"]);
    }
}

// The file

#[test]
fn what_is_not_toml_is_located() {
    for (text, line) in [
        ("[duct]\nlength = 1.2 m\n", 2),
        ("[duct\n", 1),
        ("a = 1\na = 2\n", 2),
        ("\n\na = \"x\n", 3),
        ("a = 1\r\nb = = 2\r\n", 2),
    ] {
        let error = read(text).unwrap_err();
        assert!(matches!(error, SceneError::Syntax { .. }), "{error}");
        assert_eq!(error.location().unwrap().line, Some(line), "{error}");
        assert!(
            error
                .to_string()
                .starts_with(&format!("bad.toml, line {line}: not valid TOML: ")),
            "{error}"
        );
    }
}

#[test]
fn what_is_not_toml_is_told_where_the_parser_gave_up() {
    let deep = format!("a = 1\n[duct]\nlength{} = 1\n", ".a".repeat(100));
    let nested = format!("a = 1\nb = 2\nc = {}1{}\n", "[".repeat(100), "]".repeat(100));
    for (text, line, part) in [
        (deep.as_str(), 3, "recursion"),
        (&nested, 3, "recursion"),
        (
            "a = 1\nb = \"\"\"x\nc = 2\n[d]\n",
            4,
            "the `\"\"\"` of line 2 is open here",
        ),
        (
            "a = 1\nwheels = [\n  { x = 1 },\n[traffic]\npasses = 2\n",
            5,
            "the `[` of line 2 is open here",
        ),
        (
            "a = [\n  { x = 1,\n  { x = 2 },\n]\n",
            3,
            "the `{` of line 2 is open here",
        ),
        ("[duct]\nlength = 1\ndepth = 1\nlength = 2\n", 4, "duplicate key"),
        ("[duct]\nlength = 1\n[cable]\n[duct]\n", 4, "duplicate key"),
        ("a = [\n  { x = 1 y = 2 },\n]\n", 2, "not valid TOML"),
    ] {
        let error = read(text).unwrap_err();
        assert!(matches!(error, SceneError::Syntax { .. }), "{error}");
        assert_eq!(error.location().unwrap().line, Some(line), "{error}");
        assert!(error.to_string().contains(part), "{error}");
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
fn an_empty_file_lacks_a_duct() {
    for text in ["", "\n\n", "# nothing"] {
        let message = read(text).unwrap_err().to_string();
        assert!(message.contains("key `duct` is missing"), "{message}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let folder = std::env::temp_dir().join(format!("creepage-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let missing = Scene::from_file(folder.join("none.toml")).unwrap_err();
    assert!(matches!(missing, SceneError::Unreadable { .. }));
    assert!(
        missing.to_string().contains("none.toml: cannot be read"),
        "{missing}"
    );
    assert!(Scene::from_file(&folder).is_err());
    let shift_jis = folder.join("sjis.toml");
    std::fs::write(&shift_jis, b"[duct]\n# \x92\xb7\x82\xb3\nlength = 30\n").unwrap();
    let encoding = Scene::from_file(&shift_jis).unwrap_err().to_string();
    assert!(
        encoding.contains("sjis.toml, line 2: found text that is not UTF-8"),
        "{encoding}"
    );
    let endless = folder.join("endless.toml");
    std::fs::File::create(&endless).unwrap().set_len(1 << 30).unwrap();
    assert!(matches!(
        Scene::from_file(&endless),
        Err(SceneError::TooLarge { .. })
    ));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_message_reads_as_a_whole() {
    let message = read(&FULL.replace("depth = \"1.2 m\"", "depth = \"1.2 kN\"  # to the cable"));
    assert_eq!(
        message.unwrap_err().to_string(),
        "bad.toml, line 4: `duct.depth`: wrong dimension: found \"1.2 kN\", a force; \
         allowed: a length greater than 0, from 1 cm to 1 km, such as \"1.2 m\" (units: m, cm, mm, um, nm, km, in, ft, yd, mi)\n  \
           |\n\
         4 | depth = \"1.2 kN\"  # to the cable\n  \
           |         ^^^^^^^^"
    );
}
