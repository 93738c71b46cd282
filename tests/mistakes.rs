//! Typical mistakes of a cable engineer, each with what its message has to say: the line, the key, what was found, what is allowed, and
//! advice that is right.

#![cfg(feature = "cli")]

use std::process::Command;

use tempfile::TempDir;

const SCENE: &str = r#"title = "Harbour road, 66 kV"

[duct]
length = "180 m"
depth = "1.3 m"

[[ground.layers]]  # asphalt
thickness = "20 cm"
young_modulus = "4000 MPa"
poisson_ratio = 0.35

[[ground.layers]]  # soil
young_modulus = "80 MPa"
poisson_ratio = 0.4

[cable]
weight = "110 N/m"
axial_stiffness = "60 MN"

[friction]
dynamic_coefficient = 0.3
shape_factor = "7e6 1/m"

[ends]
upstream = "free"
downstream = { spring = "3 MN/m" }

[[vehicles]]
name = "truck"
speed = "50 km/h"
wheels = [{ y = "0.9 m", load = "50 kN", contact_radius = "0.15 m" }, { y = "-0.9 m", load = 50e3 }]

[traffic]
passes = 20
"#;

/// What stands in the scene → what an engineer writes in its place (`¶` begins a line) | the line of the message | parts of it.
/// Some are refused; what is only hardly meant is a warning.
const IN_THE_SCENE: &str = r#"
weight = "110 N/m" → weight = 11 | 17 | `cable.weight`: 11 without a unit is 11 N/m: did you mean "11 kgf/m"?
weight = "110 N/m" → weight = "11 kg/m" | 17 | `cable.weight`: unknown unit `kg/m`: found "11 kg/m" (did you mean `kgf/m`?) | units: N/m, kN/m
axial_stiffness = "60 MN" → axial_stiffness = "60 kN" | 18 | `cable.axial_stiffness` is 0.06 MN, but that of power cables is from 0.5 to 1000 MN
axial_stiffness = "60 MN" → axial_stiffness = 8e9 | 18 | `cable.axial_stiffness` is 8000 MN
weight = "110 N/m" → weight = "1088 N/m" | 17 | `cable.weight` is 1088 N/m, but that of power cables is from 5 to 600 N/m
load = "50 kN" → load = "2500 kN" | 31 | `vehicles.0.wheels.0.load` (vehicle 1, wheel 1) is 2500 kN, but a wheel on a road carries from 1 to 200 kN
length = "180 m" → length = "1 m" | 5 | `duct.depth` is 1.3 m, more than the duct is long, 1 m: were they exchanged?
young_modulus = "4000 MPa" → young_modulus = "3 MPa" | 9 | `ground.layers.0.young_modulus` (layer 1) is 27 times less than that of the last layer, 80 MPa: layers stand from the top down
speed = "50 km/h" → speed = "500 km/h" | 30 | `vehicles.0.speed` (vehicle 1) is 500 km/h, but trucks drive at 20 to 100 km/h
speed = "50 km/h" → speed = "30 mi/h" | 30 | unknown unit `mi/h`: found "30 mi/h" (did you mean `mph`?)
axial_stiffness = "60 MN" → axial_stiffness = "120 GPa" | 18 | `cable.axial_stiffness`: wrong dimension: found "120 GPa", a pressure or modulus; allowed: a force
speed = "50 km/h" → speed = 50 | 30 | `vehicles.0.speed` (vehicle 1): 50 without a unit is 50 m/s, 180 km/h: did you mean "50 km/h"?
load = 50e3 → load = 5 | 31 | `vehicles.0.wheels.1.load` (vehicle 1, wheel 2): 5 without a unit is 5 N | did you mean "5 tf" or "5 kN"?
load = "50 kN" → load = "5 t" | 31 | unknown unit `t`: found "5 t" (did you mean `tf`?)
contact_radius = "0.15 m" → contact_radius = 15 | 31 | `vehicles.0.wheels.0.contact_radius` (vehicle 1, wheel 1) is 15 m: that of tyres is from 0.1 to 0.3 m
shape_factor = "7e6 1/m" → shape_factor = 7 | 22 | `friction.shape_factor` is 7 1/m: friction builds up over 285.7 mm
depth = "1.3 m" → depth = 130 | 5 | `duct.depth` is 130 m, but ducts lie below roads at depths from 0.2 to 20 m
depth = "1.3 m" → depth = "130 mm" | 5 | `duct.depth` is 0.13 m
length = "180 m" → length = "180 meters" | 4 | unknown unit `meters`: found "180 meters" (did you mean `m`?)
passes = 20 → passes = 292.000 | 34 | `traffic.passes`: 292.000 without a unit is 292 passes | did you mean 292000?
passes = 20 → passes = 5,844,000 | 34 | numbers have no thousands separators: passes = 5844000
passes = 20 → passes = "292 000" | 34 | `traffic.passes`: found the text "292 000"; allowed: 292000: a whole number
passes = 20 → per_day = 800¶years = "20 years" | 35 | `traffic.years`: found the text "20 years"; allowed: 20: a number
passes = 20 → per_day = 800¶years = 2026 | 33 | lasts 2026 years | a number of years, not a date
passes = 20 → passes = 20¶per_day = 5844000 | 35 | `traffic.per_day` is 5844000: no road has more than 200000 vehicles a day
poisson_ratio = 0.4 → poisson_ratio = 40 | 14 | `ground.layers.1.poisson_ratio` (layer 2): out of range: found 40; allowed: a number from 0 to 0.5 | did you mean 0.4?
dynamic_coefficient = 0.3 → dynamic_coefficient = 30 | 21 | found 30; allowed: a number from 0 to 10 | did you mean 0.3?
[[ground.layers]]  # soil → [[ground.layer]] | 12 | unknown key `ground.layer` (did you mean `layers`?)
[[vehicles]] → [[vehicle]] | 28 | unknown key `vehicle` (did you mean `vehicles`?)
{ spring = "3 MN/m" } → "spring" | 26 | `ends.downstream`: found "spring"; allowed: "free", "fixed" or { spring = "3 MN/m" }
{ spring = "3 MN/m" } → "5 MN/m" | 26 | `ends.downstream`: found "5 MN/m" | did you mean { spring = "5 MN/m" }?
{ spring = "3 MN/m" } → { spring = 3 } | 26 | `ends.downstream.spring` is 3 N/m, which holds nothing | did you mean "3 MN/m"?
{ spring = "3 MN/m" } → { spring = "300 N/m" } | 26 | `ends.downstream.spring` is 300 N/m, which holds nothing: springs and clamps are from 0.1 to 1000 MN/m
upstream = "free" → left = "free" | 25 | unknown key `ends.left` (did you mean `upstream`?)
[traffic] → [[clamps]]¶position = "90 m"¶[traffic] | 33 | unknown key `clamps` (did you mean `restraints`?)
[[ground.layers]]  # asphalt → [[soil.layers]] | 7 | unknown key `soil` (did you mean `ground`?)
dynamic_coefficient = 0.3 → friction_coefficient = 0.3 | 21 | unknown key `friction.friction_coefficient` (did you mean `dynamic_coefficient`?)
weight = "110 N/m" → weight = "11 kg" | 17 | unknown unit `kg`: found "11 kg" (did you mean `kgf/m`?)
load = 50e3 → load = "5000 kg" | 31 | unknown unit `kg`: found "5000 kg" (did you mean `kgf`?)
passes = 20 → passes = 20¶[solver]¶tolerance = 5 | 36 | found 5; allowed: a ratio greater than 0 and at most 0.5 | did you mean "5 %"?
dynamic_coefficient = 0.3 → mu = 0.3 | 21 | unknown key `friction.mu` (did you mean `dynamic_coefficient`?)
axial_stiffness = "60 MN" → EA = "60 MN" | 18 | unknown key `cable.EA` (did you mean `axial_stiffness`?)
young_modulus = "80 MPa" → E = "80 MPa" | 13 | unknown key `ground.layers.1.E` (layer 2) (did you mean `young_modulus`?)
speed = "50 km/h" → velocity = "50 km/h" | 30 | unknown key `vehicles.0.velocity` (vehicle 1) (did you mean `speed`?)
passes = 20 → years = 20¶trucks_per_day = 800 | 35 | unknown key `traffic.trucks_per_day` (did you mean `per_day`?)
length = "180 m" → length = "180 m"¶diameter = "200 mm" | 5 | unknown key `duct.diameter` (did you mean `inner_diameter`?)
depth = "1.3 m" → Depth = "1.3 m" | 5 | unknown key `duct.Depth` (did you mean `depth`?)
depth = "1.3 m" → depth = "1.3 m | 5 | line 5: not valid TOML: invalid basic string, expected `"`
depth = "1.3 m" → depth = 1,3 | 5 | not valid TOML: decimals are written with a point: depth = 1.3
depth = "1.3 m" → depth = 1.3 m | 5 | not valid TOML: a quantity with its unit stands in quotes: depth = "1.3 m"
depth = "1.3 m" → depth = | 5 | not valid TOML: string values must be quoted
depth = "1.3 m" → depth == 1.3 | 5 | not valid TOML: extra `=`
depth = "1.3 m" → dep th = 1.3 | 5 | not valid TOML: key with no value, expected `=`
depth = "1.3 m" → length = "20 m" | 5 | not valid TOML: duplicate key
[traffic] → [traffic | 33 | not valid TOML: unclosed table, expected `]`
depth = "1.3 m" → depth "1.3 m" | 5 | not valid TOML: key with no value, expected `=`
[friction] → friction | 20 | key with no value, expected `=`
title = "Harbour road, 66 kV" → title = Harbour road | 1 | string values must be quoted
passes = 20 → passes = 20¶title = "Harbour" | 35 | unknown key `traffic.title` | `title` stands above the first section
[traffic] → [duct]¶slope = "3 %"¶[traffic] | 33 | not valid TOML: duplicate key
speed = "50 km/h" → speed = "50 km/h"¶direction = "northbound" | 31 | found "northbound"; allowed: "forward", toward the downstream end, or "reverse"
passes = 20 → passes = 20¶sequence = ["t-25"] | 35 | `traffic.sequence.0`: found "t-25"; allowed: "truck"
passes = 20 → passes = 20¶[heat]¶expansion = "17e-6 1/K"¶daily_swing = "20 °C" | 37 | `heat.daily_swing`: unknown unit `°C` | did you mean `K`?
passes = 20 → passes = 20¶[heat]¶expansion = 17¶daily_swing = "20 K" | 36 | `heat.expansion`: out of range: found 17 | did you mean "17e-6 1/K"?
depth = "1.3 m" → depth = "１．３ m" | 5 | `duct.depth`: found the text "１．３ m"; allowed: a length
young_modulus = "4000 MPa" → young_modulus = "4 000 MPa" | 9 | unknown unit `000 MPa`: found "4 000 MPa"; allowed: a pressure
young_modulus = "4000 MPa" → young_modulus = "4,000 MPa" | 9 | a decimal point, "4.000 MPa", or "4000 MPa" if the comma separates thousands: a pressure
young_modulus = "4000 MPa" → young_modulus = 4,000 MPa | 9 | with a point: young_modulus = "4.000 MPa", or "4000 MPa" if the comma separates thousands
passes = 20 → passes = 5,844 | 34 | or 5844 if the comma separates thousands
passes = 20 → passes = 1..5 | 34 | a key has one value; `creepage sweep --vary KEY=A:B:STEP` computes a range
shape_factor = "7e6 1/m" → shape_factor = "7 x 10^6 1/m" | 22 | unknown unit `x 10^6 1/m`: found "7 x 10^6 1/m"; allowed: an inverse length
shape_factor = "7e6 1/m" → # none | 20 | key `friction.shape_factor` is missing | law = "coulomb" needs none
passes = 20 → passes = 20¶[heat]¶expansion = "17e-6 1/°C"¶daily_swing = "20 K" | 36 | unknown unit `1/°C` | did you mean `1/K`?
[traffic] → [vehicles]¶name = "second"¶[traffic] | 33 | not valid TOML: duplicate key
"#;

/// What an engineer types; SCENE and DATA are good files, DUCTS and RAGGED are not | parts of the message.
const ON_THE_COMMAND_LINE: &str = r#"
run DATA | data.csv, line 1: not valid TOML: key with no value
SCENE | A command stands before the scene: creepage run | scene.toml
check SCENE --set depth=1.5m | --set depth=1.5m: found unknown key `depth` (did you mean `duct.depth`?)
check SCENE --set ground.layers[1].young_modulus=60MPa | allowed: `ground.layers.1.young_modulus`: an item of a list by its number
run SCENE --set traffic.passes=1 --limit-movement 10 | --limit-movement is 10 m: did you mean 10mm?
run SCENE --set traffic.passes=1 --limit-force 2 | --limit-force is 2 N: did you mean 2kN?
run SCENE --limit-force left=2kN | left=2kN | allowed before `=`: upstream, downstream, clamp
run SCENE --years 20 | --trucks-per-day: found none, and `traffic.per_day` is missing in the scene; allowed: how many vehicles a day
sweep SCENE --out o.csv --vary friction.dynamic_coefficient=0.1-0.5 | found 0.1-0.5; allowed: A:B:STEP for a range, such as 0.1:0.5:STEP
design SCENE --limit-force 2kg | `kg` is not a known unit (did you mean `kgf`?); allowed: a force (units: N, kN
run SCENE --years 20 --trucks-per-day 800/day | a number of vehicles a day greater than 0, from 1e-6 to 1e9, such as 800
presets t25 | found `t25` (did you mean `t-25`?)
run SCENE --days 1 | --trucks-per-day: found none
run SCENE --years 20fortnights --trucks-per-day 800 | allowed: a number of years greater than 0 | "30 days"
run SCENE --days 1 --years 1 --trucks-per-day 800 | '--days <N>' cannot be used with '--years <N>'
run SCENE --xlsx o.csv | --xlsx: found o.csv; allowed: a workbook of Excel | a table of text is written with --csv
run SCENE --csv o.xls | --csv: found o.xls; allowed: a table of text
sweep SCENE --out o.csv --rows DUCTS | the column `cable.wieght`, which is no key (did you mean `cable.weight`?)
sweep SCENE --out o.csv --rows DATA | the column `pass`, which is no key
sweep SCENE --out o.csv --rows RAGGED | ragged.csv | ragged.csv:3: 3 cells where the first row has 2
design SCENE | --limit-force: found no limit; | such as --limit-force 2kN
design SCENE --limit-force 2kN --at 500m | --at: found 500 m; allowed: a position in the duct, from 0 m to 180 m
sweep SCENE --out o.csv --vary duct.depth=1m:2m:5 | found 1m:2m:5 | a unit at the STEP too: it is a distance
sweep SCENE --out o.csv --vary traffic.passes=10:20:50 | found 10:20:50 | a STEP that is at most B - A
sweep SCENE --out o.csv --vary duct.depth=2m:1m:0.1m | found 2m:1m:0.1m | a STEP that leads from A to B
sweep SCENE --out o.csv --vary friction.dynamic_coefficient=normal(0.3) --samples 4 | found normal(0.3) | normal(MEAN, SD)
sweep SCENE --out o.xls --vary duct.depth=1m,2m | o.xls | .csv
sweep SCENE --out o.csv --vary duct.depth=1m,2m --vary duct.length=30m,60m --vary duct.slope=0,0.01 --map m.svg | --map with 3 varied keys; allowed: a map of two keys
calibrate SCENE --data DATA --fit mu | found "mu"; allowed: dynamic_coefficient
calibrate SCENE --data DATA --column-force Kraft | data.csv:1: no column Kraft in
calibrate SCENE --data DATA --unit kg | the unit `kg`; allowed: N, kN, daN, kgf
profile SCENE --positions 0-180 | found "0-180"; allowed: positions in m with commas between them
report SCENE -o page.pdf | found page.pdf; allowed: a page of HTML, such as my-duct.html
run SCENE --limit-force -2kN | '-2kN' for '--limit-force | a limit is positive
run SCENE --limit-force -2 | '-2' for '--limit-force | a limit is positive
run SCENE --limit-force downstream=-2kN | a limit is positive
run SCENE --limit-movement -5mm | '-5mm' for '--limit-movement | a limit is positive
run SCENE --limit-force downstrem=2kN | found `downstrem` (did you mean `downstream`?); allowed before `=`: upstream
run SCENE --limit-force clmap=2kN | found `clmap` (did you mean `clamp`?)
run SCENE --limit-force downstream:2kN | a place stands before `=`: downstream=2kN
run SCENE --limit-force 2t | `t` is not a known unit (did you mean `tf`?)
prfile SCENE | a similar subcommand exists: 'profile'
design SCENE --limit-force 2kN --at downstrm | found `downstrm` (did you mean `downstream`?); allowed: upstream
design SCENE --limit-force 2kN --at downstream+upstrem | (did you mean `upstream`?)
design SCENE --limit-force 2kN --at -5m | --at: found -5 m; allowed: a position in the duct, from 0 m to 180 m
run SCENE --years -1 --trucks-per-day 800 | '-1' for '--years <N>' | a number of years greater than 0 | from 1e-9 to 1e6 years
design SCENE --limit-force 2kN --years 0 --trucks-per-day 800 | '0' for '--years <N>'
run SCENE --years 1e9 --trucks-per-day 800 | '1e9' for '--years <N>'
run SCENE --years 1 --trucks-per-day -800 | '-800' for '--trucks-per-day <N>' | greater than 0, from 1e-6 to 1e9, such as 800
plan SCENE --days 3 --trucks-per-day 1e30 | '1e30' for '--trucks-per-day <N>'
run SCENE --passes 500 | A key of the scene is set with --set traffic.passes=VALUE
calibrate SCENE --data DATA --shape-factor 2e7 | A key of the scene is set with --set friction.shape_factor=VALUE
presets vehicel | found `vehicel`; allowed: a name that `creepage presets` lists: t-25
run . | .: cannot be read: this is a folder; a scene is a file
"#;

/// Runs the program in `folder`; what it says on standard error.
fn said(folder: &TempDir, arguments: &[&str]) -> String {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program to run");
    String::from_utf8(output.stderr).expect("UTF-8")
}

#[test]
fn each_mistake_gets_a_message_that_helps() {
    let folder = TempDir::new().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("data.csv", "pass,force_n\n1,90\n2,114\n5,168\n10,222\n");
    write("ducts.csv", "id;duct.depth;cable.wieght\na;1,5 m;110\n");
    write("ragged.csv", "id,duct.depth\na,1.5\nb,1,5\n");
    let mut failures = Vec::new();
    let mut judge = |what: &str, message: &str, parts: &[&str]| {
        if let Some(part) = parts.iter().find(|part| !message.contains(**part)) {
            failures.push(format!("{what}\n  lacks: {part}\n  said: {message}"));
        }
    };
    let rows = |table: &'static str| table.lines().filter(|row| !row.is_empty());
    for row in rows(IN_THE_SCENE) {
        let (old, row) = row.split_once(" → ").expect("→");
        let cells: Vec<&str> = row.split(" | ").collect();
        let (new, line, parts) = (cells[0].replace('¶', "\n"), cells[1], &cells[2..]);
        assert_eq!(SCENE.matches(old).count(), 1, "{old} is one place of the scene");
        write("scene.toml", &SCENE.replace(old, &new));
        let message = said(&folder, &["check", "scene.toml"]);
        judge(
            &new,
            &message,
            &[&[&*format!("scene.toml, line {line}: ")], parts].concat(),
        );
    }
    write("scene.toml", SCENE);
    assert_eq!(said(&folder, &["check", "scene.toml"]), "");
    for row in rows(ON_THE_COMMAND_LINE) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let file = |word| match word {
            "SCENE" => "scene.toml",
            "DATA" => "data.csv",
            "DUCTS" => "ducts.csv",
            "RAGGED" => "ragged.csv",
            word => word,
        };
        let arguments: Vec<&str> = cells[0].split(' ').map(file).collect();
        let message = said(&folder, &arguments);
        judge(cells[0], &message, &cells[1..]);
        assert!(!message.contains("use '-- "), "{message}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    // Nothing half made is left.
    for output in ["o.csv", "o.xls", "m.svg", "page.pdf"] {
        assert!(!folder.path().join(output).exists(), "{output}");
    }
}
