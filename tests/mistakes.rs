//! Typical mistakes of a cable engineer, each with what its message has to say: the line, the key, what was found, what is allowed, and
//! advice that is right.

#![cfg(feature = "cli")]

use std::process::Command;

use tempfile::TempDir;

use crate::scene::FULL;

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

/// What stands in the scene → what an engineer writes in its place (`¶` begins a line, `∅` is nothing) | exit status of `check` | line of the
/// message | parts of it. What is only hardly meant is a warning.
const IN_THE_SCENE: &str = r#"
weight = "110 N/m" → weight = 11 | 0 | 17 | `cable.weight`: 11 without a unit is 11 N/m: did you mean kg/m?
weight = "110 N/m" → weight = "11 kg/m" | 0 | 17 | `cable.weight`: "11 kg/m" is a mass per length: times g it weighs 107.9 N/m
axial_stiffness = "60 MN" → axial_stiffness = "60 kN" | 0 | 18 | `cable.axial_stiffness` is 0.06 MN, but that of power cables is from 0.5 to 1000 MN
axial_stiffness = "60 MN" → axial_stiffness = 8e9 | 0 | 18 | `cable.axial_stiffness` is 8000 MN
weight = "110 N/m" → weight = "1088 N/m" | 0 | 17 | `cable.weight` is 1088 N/m, but that of power cables is from 5 to 600 N/m
load = "50 kN" → load = "2500 kN" | 0 | 31 | `vehicles.0.wheels.0.load` (vehicle 1, wheel 1) is 2500 kN, but a wheel on a road carries from 1 to 200 kN
length = "180 m" → length = "1 m" | 0 | 5 | `duct.depth` is 1.3 m, more than the duct is long, 1 m: were they exchanged?
young_modulus = "4000 MPa" → young_modulus = "3 MPa" | 0 | 9 | `ground.layers.0.young_modulus` (layer 1) is 27 times less than that of the last layer, 80 MPa: layers stand from the top down
speed = "50 km/h" → speed = "500 km/h" | 0 | 30 | `vehicles.0.speed` (vehicle 1) is 500 km/h, but trucks drive at 20 to 100 km/h
speed = "50 km/h" → speed = "30 mi/h" | 2 | 30 | found "30 mi/h": `mi/h` is not a known unit (did you mean `mph`?)
axial_stiffness = "60 MN" → axial_stiffness = "120 GPa" | 2 | 18 | `cable.axial_stiffness`: found "120 GPa": `GPa` is the unit of a pressure or modulus; allowed: a force
speed = "50 km/h" → speed = 50 | 0 | 30 | `vehicles.0.speed` (vehicle 1): 50 without a unit is 50 m/s: did you mean km/h?
load = 50e3 → load = 5 | 0 | 31 | `vehicles.0.wheels.1.load` (vehicle 1, wheel 2): 5 without a unit is 5 N: did you mean tf or kN?
load = "50 kN" → load = "5 t" | 2 | 31 | found "5 t": `t` is not a known unit (did you mean `tf`?)
contact_radius = "0.15 m" → contact_radius = 15 | 0 | 31 | `vehicles.0.wheels.0.contact_radius` (vehicle 1, wheel 1) is 15 m: that of tyres is from 0.1 to 0.3 m
shape_factor = "7e6 1/m" → shape_factor = 7 | 0 | 22 | `friction.shape_factor` is 7 1/m: friction builds up over more than traffic moves a cable
depth = "1.3 m" → depth = 130 | 0 | 5 | `duct.depth` is 130 m, but ducts lie below roads at depths from 0.2 to 20 m
depth = "1.3 m" → depth = "130 mm" | 0 | 5 | `duct.depth` is 0.13 m
length = "180 m" → length = "180 meters" | 2 | 4 | found "180 meters": `meters` is not a known unit (did you mean `m`?)
passes = 20 → passes = 292.000 | 0 | 34 | `traffic.passes`: 292.000 is 292, as decimals follow a point: did you mean 292000?
passes = 20 → passes = 5,844,000 | 2 | 34 | decimals have a point
passes = 20 → passes = "292 000" | 2 | 34 | `traffic.passes`: found the text "292 000"; allowed: a whole number
passes = 20 → per_day = 800¶years = "20 years" | 2 | 35 | `traffic.years`: found the text "20 years"; allowed: a number
passes = 20 → per_day = 800¶years = 2026 | 0 | 33 | lasts 2026 years | a number of years, not a date
passes = 20 → passes = 20¶per_day = 5844000 | 0 | 35 | `traffic.per_day` is 5844000: no road has more than 200000 vehicles a day
poisson_ratio = 0.4 → poisson_ratio = 40 | 2 | 14 | `ground.layers.1.poisson_ratio` (layer 2): found 40; allowed: a number from 0 to 0.5
dynamic_coefficient = 0.3 → dynamic_coefficient = 30 | 2 | 21 | found 30; allowed: a number from 0 to 10
[cable] → [[route]]¶radius = "10 m"¶[cable] | 2 | 17 | unknown key `route.0.radius` | did you mean `bend_radius`?
[[ground.layers]]  # soil → [[ground.layer]] | 2 | 12 | unknown key `ground.layer` (did you mean `layers`?)
[[vehicles]] → [[vehicle]] | 2 | 28 | unknown key `vehicle` (did you mean `vehicles`?)
{ spring = "3 MN/m" } → "spring" | 2 | 26 | `ends.downstream`: found "spring"; allowed: "free", "fixed" or { spring = "3 MN/m" }
{ spring = "3 MN/m" } → "5 MN/m" | 2 | 26 | `ends.downstream`: found "5 MN/m" | allowed: "free", "fixed" or { spring = "3 MN/m" }
{ spring = "3 MN/m" } → { spring = 3 } | 0 | 26 | `ends.downstream.spring`: 3 without a unit is 3 N/m: did you mean MN/m?
{ spring = "3 MN/m" } → { spring = "300 N/m" } | 0 | 26 | `ends.downstream.spring` is 300 N/m, which holds nothing: springs and clamps are from 0.1 to 1000 MN/m
upstream = "free" → left = "free" | 2 | 25 | unknown key `ends.left` (did you mean `upstream`?)
[traffic] → [[clamps]]¶position = "90 m"¶[traffic] | 2 | 33 | unknown key `clamps` (did you mean `restraints`?)
[[ground.layers]]  # asphalt → [[soil.layers]] | 2 | 7 | unknown key `soil` (did you mean `ground`?)
dynamic_coefficient = 0.3 → friction_coefficient = 0.3 | 2 | 21 | unknown key `friction.friction_coefficient` (did you mean `dynamic_coefficient`?)
weight = "110 N/m" → weight = "11 kg" | 2 | 17 | found "11 kg": `kg` is not a known unit (did you mean `kg/m`?)
load = 50e3 → load = "5000 kg" | 2 | 31 | found "5000 kg": `kg` is not a known unit (did you mean `kgf`?)
passes = 20 → passes = 20¶[solver]¶tolerance = 5 | 2 | 36 | found 5; allowed: a ratio greater than 0 and at most 0.5 | a bare number is in 1, not in %
dynamic_coefficient = 0.3 → mu = 0.3 | 2 | 21 | unknown key `friction.mu` (did you mean `dynamic_coefficient`?)
axial_stiffness = "60 MN" → EA = "60 MN" | 2 | 18 | unknown key `cable.EA` (did you mean `axial_stiffness`?)
young_modulus = "80 MPa" → E = "80 MPa" | 2 | 13 | unknown key `ground.layers.1.E` (layer 2) (did you mean `young_modulus`?)
speed = "50 km/h" → velocity = "50 km/h" | 2 | 30 | unknown key `vehicles.0.velocity` (vehicle 1) (did you mean `speed`?)
passes = 20 → years = 20¶trucks_per_day = 800 | 2 | 35 | unknown key `traffic.trucks_per_day` (did you mean `per_day`?)
length = "180 m" → length = "180 m"¶diameter = "200 mm" | 2 | 5 | unknown key `duct.diameter` (did you mean `inner_diameter`?)
depth = "1.3 m" → Depth = "1.3 m" | 2 | 5 | unknown key `duct.Depth` (did you mean `depth`?)
depth = "1.3 m" → depth = "1.3 m | 2 | 5 | line 5: not valid TOML: invalid basic string, expected `"`
depth = "1.3 m" → depth = 1,3 | 2 | 5 | not valid TOML: | decimals have a point
depth = "1.3 m" → depth = 1.3 m | 2 | 5 | not valid TOML: | quantities stand in quotes
depth = "1.3 m" → depth = | 2 | 5 | not valid TOML: string values must be quoted
depth = "1.3 m" → depth == 1.3 | 2 | 5 | not valid TOML: extra `=`
depth = "1.3 m" → dep th = 1.3 | 2 | 5 | not valid TOML: key with no value, expected `=`
depth = "1.3 m" → length = "20 m" | 2 | 5 | not valid TOML: duplicate key
[traffic] → [traffic | 2 | 33 | not valid TOML: unclosed table, expected `]`
depth = "1.3 m" → depth "1.3 m" | 2 | 5 | not valid TOML: key with no value, expected `=`
[friction] → friction | 2 | 20 | key with no value, expected `=`
title = "Harbour road, 66 kV" → title = Harbour road | 2 | 1 | string values must be quoted
passes = 20 → passes = 20¶title = "Harbour" | 2 | 35 | unknown key `traffic.title` | it stands above the first section
[traffic] → [duct]¶slope = "3 %"¶[traffic] | 2 | 33 | not valid TOML: duplicate key
speed = "50 km/h" → speed = "50 km/h"¶direction = "northbound" | 2 | 31 | found "northbound"; allowed: "forward", "reverse"; forward is toward the downstream end
passes = 20 → passes = 20¶sequence = ["t-25"] | 2 | 35 | `traffic.sequence.0`: found "t-25"; allowed: "truck"
passes = 20 → passes = 20¶[heat]¶expansion = "17e-6 1/K"¶daily_swing = "20 °C" | 2 | 37 | `heat.daily_swing`: found "20 °C": `°C` is not a known unit | did you mean `K`?
passes = 20 → passes = 20¶[heat]¶expansion = 17¶daily_swing = "20 K" | 2 | 36 | `heat.expansion`: found 17 | a bare number is in 1/K
depth = "1.3 m" → depth = "１．３ m" | 2 | 5 | `duct.depth`: found "１．３ m": not a number with a unit, its decimals after a point; allowed: a length
young_modulus = "80 MPa" → young_modulus = { top = 1e6, bottom = 2e6 } | 2 | 13 | `ground.layers.1.young_modulus` (layer 2): found a modulus that varies with depth
young_modulus = "4000 MPa" → young_modulus = "4 000 MPa" | 2 | 9 | found "4 000 MPa": `000 MPa` is not a known unit
young_modulus = "4000 MPa" → young_modulus = "4,000 MPa" | 2 | 9 | found "4,000 MPa": not a number with a unit, its decimals after a point; allowed: a pressure
young_modulus = "4000 MPa" → young_modulus = 4,000 MPa | 2 | 9 | not valid TOML: | decimals have a point
passes = 20 → passes = 5,844 | 2 | 34 | not valid TOML: | decimals have a point
passes = 20 → passes = 1..5 | 2 | 34 | invalid fraction, expected digits
shape_factor = "7e6 1/m" → shape_factor = "7 x 10^6 1/m" | 2 | 22 | found "7 x 10^6 1/m": `x 10^6 1/m` is not a known unit
shape_factor = "7e6 1/m" → # none | 2 | 20 | key `friction.shape_factor` is missing | law = "coulomb" needs none
passes = 20 → passes = 20¶[heat]¶expansion = "17e-6 1/°C"¶daily_swing = "20 K" | 2 | 36 | `1/°C` is not a known unit | did you mean `1/K`?
[traffic] → [vehicles]¶name = "second"¶[traffic] | 2 | 33 | not valid TOML: duplicate key
weight = "110 N/m" → weight = "11.2 kg/km" | 0 | 17 | `cable.weight`: "11.2 kg/km" is a mass per length: times g it weighs 0.1098 N/m
axial_stiffness = "60 MN" → young_modulus = "75 GPa" | 2 | 16 | key `cable.conductor_area` is missing | an area | mm2
axial_stiffness = "60 MN" → conductor_area = "800 mm2" | 2 | 16 | key `cable.young_modulus` is missing
axial_stiffness = "60 MN" → axial_stiffness = "60 MN"¶young_modulus = "75 GPa" | 2 | 19 | both `axial_stiffness` and `young_modulus` | only one of the two
axial_stiffness = "60 MN" → young_modulus = "75 GPa"¶conductor_area = 800 | 0 | 16 | `cable.axial_stiffness`
speed = "50 km/h" → speed = "50 km/h"¶share = "20 kN" | 2 | 31 | `vehicles.0.share` (vehicle 1): found "20 kN": `kN` is the unit of a force
passes = 20 → passes = 20¶per_day = 10¶[heat]¶expansion = "17e-6 1/K"¶daily_swing = "200 K" | 0 | 38 | `heat.daily_swing` is 200 K, but a cable's temperature changes by less than 100 K a day
passes = 20 → passes = 20¶[heat]¶expansion = 17e-6¶daily_swing = 20 | 2 | 35 | no `traffic.per_day` | `per_day` in [traffic]
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6 | 2 | 36 | neither `daily_swing` nor `profile`
passes = 20 → passes = 20¶per_day = 24¶[heat]¶daily_swing = 20 | 2 | 36 | key `heat.expansion` is missing
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = "17e-6 K"¶daily_swing = 20 | 2 | 37 | a difference of temperatures; allowed: an expansion per degree
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶daily_swing = 20¶profile = [[0, 0], [3600, 5]] | 2 | 39 | both `daily_swing` and `profile`
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶profile = [["8 h", "5 K"], ["6 h", "0 K"]] | 2 | 38 | heat.profile.1.0 | after that of the point before
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶profile = [["0 h", "0 K"], ["24 h", "5 K"]] | 2 | 38 | before 24 h
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶profile = [["8 h", "5 K"]] | 2 | 38 | one item | two points of the day or more
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶daily_swings = 20 | 2 | 38 | did you mean `daily_swing`?
passes = 20 → passes = 20¶per_day = 24¶[heat]¶expansion = 17e-6¶daily_swing = 20¶[solver]¶method = "explicit" | 2 | 36 | `solver.method` = "explicit" | without inertia
depth = "1.3 m" → depth = "0.5 m" | 0 | 5 | `duct.depth` is 0.5 m between the wheels of "truck" | the cable may creep backward
"#;

/// The same of the scene that uses every key; lines that begin with `#` say what follows.
const IN_A_FULL_SCENE: &str = r#"
# an unknown key suggests the nearest
length = "30 m" → lenght = "30 m" | 2 | 3 | unknown key `duct.lenght` | did you mean `length`? | allowed: length, depth, lateral_offset, slope, inner_diameter | ^^^^^^
[cable] → [cabel] | 2 | 23 | unknown key `cabel` | did you mean `cable`?
share = 3 → shares = 3 | 2 | 41 | unknown key `vehicles.0.shares` | did you mean `share`?
{ spring =  → { sprung =  | 2 | 33 | `ends.downstream.sprung` | `spring`?
x = "0 m", y → x = "0 m", z | 2 | 46 | `vehicles.1.wheels.0.z` | allowed: x, y, load, contact_radius
# a misplaced key is told its section
passes = 60 → passes = 60¶shape_factor = 1 | 2 | 53 | unknown key `traffic.shape_factor` | did you mean `friction.shape_factor`?
# a missing key is named at its section
depth = "1.2 m" → ∅ | 2 | 2 | key `duct.depth` is missing; allowed: a length greater than 0, from 1 cm to 1 km, such as "1.2 m"
dynamic_coefficient = 0.25 → ∅ | 2 | 27 | key `friction.dynamic_coefficient` is missing; allowed: a number from 0 to 10
passes = 60 → ∅ | 2 | 51 | key `traffic.passes` is missing; allowed: a whole number | or `years` with `per_day`
upstream = "free" → ∅ | 2 | 31 | key `ends.upstream` is missing; allowed: "free", "fixed" or { spring
# a wrong dimension is refused
depth = "1.2 m" → depth = "1.2 kN" | 2 | 4 | `duct.depth`: found "1.2 kN": `kN` is the unit of a force; allowed: a length greater than 0 | ^^^^^^^^
speed = "36 km/h" → speed = "36 km" | 2 | 39 | `vehicles.0.speed` | `km` is the unit of a length | km/h
stiffness = "1 MN/m" → stiffness = "1 MN" | 2 | 36 | `restraints.0.stiffness`
# a missing unit is refused
depth = "1.2 m" → depth = "1.2" | 2 | 4 | `duct.depth` | found "1.2": the unit is missing | units: m, cm, mm
# a decimal comma is told
depth = "1.2 m" → depth = "1,2 m" | 2 | 4 | `duct.depth` | found "1,2 m": not a number with a unit, its decimals after a point; allowed: a length | a length greater than 0
depth = "1.2 m" → depth = 1,2 | 2 | 4 | not valid TOML | decimals have a point
dynamic_coefficient = 0.25 → dynamic_coefficient = "0,25" | 2 | 29 | allowed: a number from 0 to 10
# percent where a number belongs is told its number
dynamic_coefficient = 0.25 → dynamic_coefficient = "25 %" | 2 | 29 | `friction.dynamic_coefficient` | allowed: a number from 0 to 10
tolerance = "2 %" → tolerance = 2 % | 2 | 58 | not valid TOML | quantities stand in quotes
tolerance = "2 %" → tolerance = 2 | 2 | 58 | found 2 | such as 0.01 or "1 %"
depth = "1.2 m" → depth = 1.2 m | 2 | 4 | not valid TOML | quantities stand in quotes
# an unknown unit is refused
young_modulus = "800 MPa" → young_modulus = "800 Mpa" | 2 | 21 | `ground.layers.2.young_modulus` | `Mpa` is not a known unit | found "800 Mpa" | did you mean `MPa`?
# what is no number is refused
depth = "1.2 m" → depth = true | 2 | 4 | found true | allowed: a length
depth = "1.2 m" → depth = [1] | 2 | 4 | found the list [1] | allowed: a length
depth = "1.2 m" → depth = {} | 2 | 4 | found the table {} | allowed: a length
depth = "1.2 m" → depth = 1979-05-27 | 2 | 4 | found 1979-05-27
# a number in quotes is refused where there is no unit
dynamic_coefficient = 0.25 → dynamic_coefficient = "0.25" | 2 | 29 | `friction.dynamic_coefficient` | the text "0.25" | without quotes
passes = 60 → passes = "60" | 2 | 52 | `traffic.passes` | without quotes
# a value of the wrong kind is refused
title = "Everything" → title = 3 | 2 | 1 | `title`: found the number 3 | a text
name = "van" → name = 3 | 2 | 43 | `vehicles.1.name` (vehicle 2): found the number 3
upstream = "free" → upstream = 3 | 2 | 32 | found the number 3 | "free", "fixed" or
[[restraints]] → [restraints] | 2 | 34 | `restraints` | a list of [[restraints]]
[cable] → [[cable]] | 2 | 23 | `cable` | a table with the keys preset, weight
  { x = "-2.5 m", y = "-0.9 m", load = "7 kN" }, →   "rear", | 2 | 47 | `vehicles.1.wheels.1` | "rear" | a table with the keys x, y
# an unknown word suggests the nearest
model = "fem" → model = "winkler" | 2 | 9 | allowed: "auto", "boussinesq", "burmister", "fem"
model = "fem" → model = "odemark" | 2 | 9 | allowed: "auto", "boussinesq", "burmister", "fem" | no longer there
method = "explicit" → method = "dynamic" | 2 | 57 | "pass-law"; inertia is computed by "explicit": dynamic is no longer there
# a spring and a stiffness are understood as each other but not both
{ spring =  → { stiffness = 1, spring =  | 2 | 33 | `ends.downstream. | both `spring` and `stiffness` | only one
{ spring = "3 MN/m" } → { stiffness = "3 m" } | 2 | 33 | `ends.downstream. | `m` is the unit of a length
# two scalings are refused
longitudinal_peak = "35.7 um" → longitudinal_peak = "35.7 um"¶vertical_peak = "90 um" | 2 | 12 | `ground.vertical_peak` | both `longitudinal_peak` and `vertical_peak` | only one
# load and wheels exclude each other and one is needed
load = "20 tf" → load = "20 tf"¶wheels = [{ load = 1 }] | 2 | 41 | `vehicles.0.wheels` | both `load` and `wheels` | only one
load = "20 tf" → ∅ | 2 | 37 | `vehicles.0` | neither `load` nor `wheels`
# shape factor belongs to the laws that have one
law = "sigmoid" → law = "coulomb" | 2 | 30 | `friction.shape_factor` | with `law` = "coulomb" | no `shape_factor` | no `shape_factor` with the law "coulomb"
# layers have a thickness but the last
young_modulus = "800 MPa" → thickness = 2¶young_modulus = "800 MPa" | 2 | 21 | `ground.layers.2.thickness` | found 2 | no thickness in the last layer
thickness = "50 mm" → ∅ | 2 | 12 | key `ground.layers.0.thickness` (layer 1) is missing
# order and sequence exclude each other
seed = 7 → sequence = ["van"] | 2 | 55 | `traffic.sequence` | both `order` and `sequence`
# a seed needs a random order
order = "random" → ∅ | 2 | 55 | `traffic.seed` | found 7 with no `order` | `seed` only with order = "random"
order = "random" → order = "interleaved" | 2 | 55 | 7 with `order` = "interleaved" | `seed` only with order = "random"
# a vehicle without load cannot be scaled
load = "20 tf" → load = 0 | 2 | 40 | `vehicles.0.load` | without load | `ground.longitudinal_peak`
# what contradicts
order = "random"¶seed = 7 → sequence = ["truck", "vam"] | 2 | 54 | `traffic.sequence.1`: found "vam" (did you mean `van`?) | allowed: "truck", "van"
order = "random"¶seed = 7 → sequence = [] | 2 | 54 | `traffic.sequence`: found an empty list
order = "random"¶seed = 7 → sequence = "truck" | 2 | 54 | `traffic.sequence`: found the text "truck"; allowed: a list
seed = 7 → seed = 7¶sequence = ["van"] | 2 | 56 | both `order` and `sequence`
order = "random" → sequence = ["van"] | 2 | 55 | `traffic.seed`: found 7 with `sequence` = ["van"]
name = "van" → name = "truck" | 2 | 43 | `vehicles.1.name` (vehicle 2): found "truck"; allowed: a name
name = "van" → name = "" | 2 | 43 | `vehicles.1.name` (vehicle 2): found the text ""; allowed: a name
name = "van" → name = " " | 2 | 43 | `vehicles.1.name` (vehicle 2): found the text " "; allowed: a name
method = "explicit" → method = "quasi-static" | 2 | 61 | `solver.time_step` | with `method` = "quasi-static" | "explicit"
method = "explicit" → method = "pass-law" | 2 | 61 | `solver.time_step` | with `method` = "pass-law"
shape_factor = "2e7 1/m" → ∅ | 2 | 27 | key `friction.shape_factor` is missing
passes = 60 → passes = 60¶years = 2 | 2 | 53 | `traffic.years` | both `passes` and `years` | only one of the two
passes = 60¶per_day = 800 → years = 2 | 2 | 51 | `traffic.per_day` is missing | vehicles a day beside `years`
# values out of their ranges
depth = "1.2 m" → depth = 0 | 2 | 4 | `duct.depth` | : found 0; allowed: | a length greater than 0
length = "30 m" → length = "-30 m" | 2 | 3 | `duct.length` | : found "-30 m"; allowed: | a length greater than 0
length = "30 m" → length = nan | 2 | 3 | `duct.length` | : found nan; allowed: | a length greater than 0
length = "30 m" → length = "NaN m" | 2 | 3 | `duct.length` | : found "NaN m"; allowed: | a length greater than 0
length = "30 m" → length = inf | 2 | 3 | `duct.length` | : found inf; allowed: | a length greater than 0
length = "30 m" → length = 1e999 | 2 | 3 | `duct.length` | : found 1e999; allowed: | a length greater than 0
lateral_offset = "-0.5 m" → lateral_offset = "inf m" | 2 | 5 | `duct.lateral_offset` | : found "inf m"; allowed: | a length of any sign
slope = "-3 %" → slope = "46 deg" | 2 | 6 | `duct.slope` | : found "46 deg"; allowed: | a slope of any sign, from -100 % to 100 %
slope = "-3 %" → slope = "180 deg" | 2 | 6 | `duct.slope` | : found "180 deg"; allowed: | a slope of any sign, from -100 % to 100 %
inner_diameter = "20 cm" → inner_diameter = 0 | 2 | 7 | `duct.inner_diameter` | : found 0; allowed: | a length greater than 0, from 1 mm to 10 m
slope = "-3 %" → slope = nan | 2 | 6 | `duct.slope` | : found nan; allowed: | a slope of any sign, from -100 % to 100 %
slope = "-3 %" → slope = 5 | 2 | 6 | `duct.slope` | : found 5; allowed: | a bare number is in 1, not in %
longitudinal_peak = "35.7 um" → longitudinal_peak = 0 | 2 | 11 | `ground.longitudinal_peak` | : found 0; allowed: | greater than 0
rigid_base_depth = "12 m" → rigid_base_depth = -1 | 2 | 10 | `ground.rigid_base_depth` | : found -1; allowed: | greater than 0
rigid_base_depth = "12 m" → rigid_base_depth = "1.05 m" | 2 | 10 | `ground.rigid_base_depth` | : found "1.05 m"; allowed: | below the upper layers, greater than 1.05 m
thickness = "50 mm" → thickness = 0 | 2 | 13 | `ground.layers.0.thickness` | : found 0; allowed: | greater than 0
poisson_ratio = 0.35 → poisson_ratio = 0.51 | 2 | 15 | `ground.layers.0.poisson_ratio` | : found 0.51; allowed: | from 0 to 0.5
poisson_ratio = 0.35 → poisson_ratio = -0.1 | 2 | 15 | `ground.layers.0.poisson_ratio` | : found -0.1; allowed: | from 0 to 0.5
young_modulus = "800 MPa" → young_modulus = 300 | 2 | 21 | `ground.layers.2.young_modulus` | : found 300; allowed: | a bare number is in Pa
depth = "1.2 m" → depth = 1500 | 2 | 4 | `duct.depth` | : found 1500; allowed: | a bare number is in m
young_modulus = "800 MPa" → young_modulus = 0 | 2 | 21 | `ground.layers.2.young_modulus` | : found 0; allowed: | greater than 0
top = "60 MPa" → top = 0 | 2 | 18 | `ground.layers.1.young_modulus.top` | : found 0; allowed: | greater than 0
weight = "108.8 N/m" → weight = -1 | 2 | 24 | `cable.weight` | : found -1; allowed: | per length greater than 0
axial_stiffness = 8.01e6 → axial_stiffness = 0 | 2 | 25 | `cable.axial_stiffness` | : found 0; allowed: | a force greater than 0
normal_load_factor = 1.5 → normal_load_factor = 0 | 2 | 26 | `cable.normal_load_factor` | : found 0; allowed: | a number greater than 0
dynamic_coefficient = 0.25 → dynamic_coefficient = -0.1 | 2 | 29 | `friction.dynamic_coefficient` | : found -0.1; allowed: | from 0 to 10
dynamic_coefficient = 0.25 → dynamic_coefficient = 25 | 2 | 29 | `friction.dynamic_coefficient` | : found 25; allowed: | from 0 to 10
dynamic_coefficient = 0.25 → dynamic_coefficient = nan | 2 | 29 | `friction.dynamic_coefficient` | : found nan; allowed: | from 0 to 10
shape_factor = "2e7 1/m" → shape_factor = 0 | 2 | 30 | `friction.shape_factor` | : found 0; allowed: | an inverse length greater than 0
spring = "3 MN/m" → spring = "0 MN/m" | 2 | 33 | `ends.downstream.spring` | : found "0 MN/m"; allowed: | greater than 0
position = "20 m" → position = "31 m" | 2 | 35 | `restraints.0.position` | : found "31 m"; allowed: | a position in the duct, from 0 m to 30 m
position = "20 m" → position = "-1 m" | 2 | 35 | `restraints.0.position` | : found "-1 m"; allowed: | a position in the duct, from 0 m to 30 m
stiffness = "1 MN/m" → stiffness = "1 MN/m"¶holds = 0 | 2 | 37 | `restraints.0.holds` | : found 0; allowed: | a force greater than 0
stiffness = "1 MN/m" → stiffness = 0 | 2 | 36 | `restraints.0.stiffness` | : found 0; allowed: | greater than 0
speed = "36 km/h" → speed = "0 km/h" | 2 | 39 | `vehicles.0.speed` | : found "0 km/h"; allowed: | a speed greater than 0
load = "20 tf" → load = "-20 tf" | 2 | 40 | `vehicles.0.load` | : found "-20 tf"; allowed: | a force of at least 0
load = "7 kN" → load = -7 | 2 | 47 | `vehicles.1.wheels.1.load` | : found -7; allowed: | a force of at least 0
contact_radius = "0.15 m" → contact_radius = -1 | 2 | 46 | `vehicles.1.wheels.0.contact_radius` | : found -1; allowed: | of at least 0
share = 3 → share = 0 | 2 | 41 | `vehicles.0.share` | : found 0; allowed: | a ratio greater than 0
share = 3 → share = -1 | 2 | 41 | `vehicles.0.share` | : found -1; allowed: | a ratio greater than 0
passes = 60 → passes = 0 | 2 | 52 | `traffic.passes` | : found 0; allowed: | a whole number from 1 to 1000000000000
passes = 60 → passes = -60 | 2 | 52 | `traffic.passes` | : found -60; allowed: | a whole number from 1 to 1000000000000
passes = 60 → passes = 60.5 | 2 | 52 | `traffic.passes` | : found 60.5; allowed: | a whole number from 1 to 1000000000000
passes = 60 → passes = 1e30 | 2 | 52 | `traffic.passes` | : found 1e30; allowed: | a whole number from 1 to 1000000000000
passes = 60 → passes = 1e13 | 2 | 52 | `traffic.passes` | : found 1e13; allowed: | a whole number from 1 to 1000000000000
seed = 7 → seed = -7 | 2 | 55 | `traffic.seed` | : found -7; allowed: | a whole number of at least 0
tolerance = "2 %" → tolerance = 0 | 2 | 58 | `solver.tolerance` | : found 0; allowed: | greater than 0 and at most 0.5
tolerance = "2 %" → tolerance = "51 %" | 2 | 58 | `solver.tolerance` | : found "51 %"; allowed: | greater than 0 and at most 0.5
node_spacing = "0.1 m" → node_spacing = 0 | 2 | 59 | `solver.node_spacing` | : found 0; allowed: | greater than 0
node_spacing = "0.1 m" → node_spacing = "15.1 m" | 2 | 59 | `solver.node_spacing` | : found "15.1 m"; allowed: | at most half the duct's length, 15 m
vehicle_step = "5 cm" → vehicle_step = 0 | 2 | 60 | `solver.vehicle_step` | : found 0; allowed: | greater than 0
time_step = "0.1 ms" → time_step = 0 | 2 | 61 | `solver.time_step` | : found 0; allowed: | a time greater than 0
# heat needs a state of rest
[solver] → [heat]¶expansion = 17e-6¶daily_swing = 20¶[solver] | 2 | 56 | `friction.law` = "sigmoid" | state of rest
# the nearest word
law = "sigmoid" → law = "couloumb" | 2 | 28 | `friction.law` | : found "couloumb" (did you mean `coulomb`?); allowed: "
model = "fem" → model = "Burmeister" | 2 | 9 | `ground.model` | : found "Burmeister" (did you mean `burmister`?); allowed: "
upstream = "free" → upstream = "fre" | 2 | 32 | `ends.upstream` | : found "fre" (did you mean `free`?); allowed: "
direction = "reverse" → direction = "reversed" | 2 | 50 | `vehicles.1.direction` | : found "reversed" (did you mean `reverse`?); allowed: "
order = "random" → order = "randam" | 2 | 54 | `traffic.order` | : found "randam" (did you mean `random`?); allowed: "
method = "explicit" → method = "quasi_static" | 2 | 57 | `solver.method` | : found "quasi_static" (did you mean `quasi-static`?); allowed: "
"#;

/// Changes of SCENE to a route at odds with itself, its duct or its cable: nothing that a schema of single keys can see.
const IN_A_ROUTE: &str = r#"
depth = "1.3 m" → depth = "1.3 m"¶slope = "1 %"¶[[route]]¶slope = "2 %" | 2 | 6 | `duct.slope` | found a slope beside [[route]]; allowed: the slopes of the sections in [[route]]
[cable] → [[route]]¶length = "10 m"¶[[route]]¶length = "15 m"¶[cable] | 2 | 16 | `route` | found sections of 25 m together; allowed: as long as the duct, 180 m
[cable] → [[route]]¶slope = "1 %"¶[[route]]¶[cable] | 2 | 16 | `route.0.length` | the last section needs none
[cable] → [[route]]¶bend_radius = "1 m"¶[cable] | 2 | 17 | `route.0.bend_radius` | allowed: a bend no tighter than the duct is deep, at least 1.3 m
[cable] → [[route]]¶dynamic_coefficient = 0¶[cable] | 2 | 17 | `route.0.dynamic_coefficient` | greater than 0 if that of [friction] is
"#;

/// What an engineer types; SCENE and DATA are good files, DUCTS and RAGGED are not | parts of the message.
const ON_THE_COMMAND_LINE: &str = r#"
run DATA | data.csv, line 1: not valid TOML: key with no value
check SCENE --set friction.dynamic_coefficient=0 --set traffic.per_day=24 --set heat={expansion=17e-6,daily_swing=20} | [heat] without friction
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
design SCENE | required arguments were not provided | --limit-force
design SCENE --limit-force 2kN --at 500m | --at: found 500 m; allowed: a position in the duct, from 0 m to 180 m
sweep SCENE --out o.csv --vary duct.depth=1m:2m:5 | found 1m:2m:5 | a distance in their unit and no number of values
sweep SCENE --out o.csv --vary traffic.passes=10:20:50 | found 10:20:50 | a STEP that leads from A to B
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
presets vehicel | found `vehicel`; allowed: a name that `creepage presets` lists: t-25
run . | .: cannot be read: this is a folder; a scene is a file
"#;

/// Runs the program in `folder`: its exit status, and what it says on standard error.
fn run(folder: &TempDir, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program to run");
    (
        output.status.code(),
        String::from_utf8(output.stderr).expect("UTF-8"),
    )
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
    let rows = |table: &'static str| {
        table
            .lines()
            .filter(|row| !row.is_empty() && !row.starts_with("# "))
    };
    let scenes = rows(IN_THE_SCENE).chain(rows(IN_A_ROUTE)).map(|row| (SCENE, row));
    for (scene, row) in scenes.chain(rows(IN_A_FULL_SCENE).map(|row| (FULL, row))) {
        let (old, row) = row.split_once(" → ").expect("→");
        let cells: Vec<&str> = row.split(" | ").collect();
        let [old, new] = [old, cells[0]].map(|text| text.replace('¶', "\n").replace('∅', ""));
        assert!(scene.contains(&old), "{old} is a place of the scene");
        write("scene.toml", &scene.replacen(&old, &new, 1));
        let (status, message) = run(&folder, &["check", "scene.toml"]);
        assert_eq!(
            status.map(|status| status.to_string()).as_deref(),
            Some(cells[1]),
            "{new}: {message}"
        );
        let line = format!("scene.toml, line {}: ", cells[2]);
        judge(&new, &message, &[&[&*line], &cells[3..]].concat());
    }
    write("scene.toml", SCENE);
    let (status, message) = run(&folder, &["check", "scene.toml"]);
    // A little more than is measured under roads.
    let is_alone =
        message.starts_with("warning: the duct goes down by 304 µm") && message.lines().count() == 1;
    assert!(status == Some(0) && is_alone, "{message}");
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
        let (_, message) = run(&folder, &arguments);
        judge(cells[0], &message, &cells[1..]);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    // Nothing half made is left.
    for output in ["o.csv", "o.xls", "m.svg", "page.pdf"] {
        assert!(!folder.path().join(output).exists(), "{output}");
    }
}
