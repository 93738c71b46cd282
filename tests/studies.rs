//! `creepage sweep`, `creepage design` and `creepage measures`, from outside.

use std::fs;

use crate::command::{assert_says, folder, json, list, number, output, printed};

const SWEEP: &str = "sweep UPPER --set traffic.passes=1";

#[test]
fn a_sweep_tells_its_failing_points_and_fails_where_all_do() {
    let out = folder("sweep_failing").join("out.csv");
    let sweep = |vary: &str| output(&format!("{SWEEP} --out {} --vary {vary}", out.display()));
    let (status, _, errors) = sweep("friction.dynamic_coefficient=0.2,-1,0.3");
    assert_eq!(status, 0, "{errors}");
    assert_says(&errors, &["1 of 3 points failed", "found -1"]);
    assert_eq!(fs::read_to_string(&out).expect("the table").lines().count(), 4);
    assert_eq!(sweep("friction.dynamic_coefficient=-1,-2").0, 1);
    // A bare number that looks like a slip of units is told here too.
    assert_says(&sweep("vehicles.0.load=20,30").2, &["20 without a unit is 20 N"]);
}

#[test]
fn a_sweep_prints_the_quantiles_of_drawn_keys() {
    let out = folder("sweep_bands").join("out.csv");
    let drawn = "--vary 'friction.dynamic_coefficient=normal(0.25, 0.03)' --samples 20 --seed 4";
    let line = format!("{SWEEP} {drawn} --out {}", out.display());
    let (said, document) = (printed(&line), json(&line));
    let band = &document["bands"][0];
    assert_eq!(band["samples"], 20);
    let [p05, .., p95] = ["p05", "mean", "p50", "p95"].map(|field| {
        let value = number(&band["downstream_force_n"][field]);
        assert_says(&said, &[&format!("{value:.1}")]);
        value
    });
    assert!(p05 < p95);
}

#[test]
fn a_sweep_draws_a_map_of_two_keys() {
    let folder = folder("sweep_map");
    let [out, map] = ["out.csv", "map.svg"].map(|name| folder.join(name));
    printed(&format!(
        "{SWEEP} --set 'solver.node_spacing=0.5 m' --vary duct.depth=1m:2m:0.5m --vary ends.upstream=free,fixed \
         --out {} --map {}",
        out.display(),
        map.display()
    ));
    let svg = fs::read_to_string(&map).expect("a map");
    assert_says(&svg, &["duct.depth, m", "ends.upstream", "fixed", "force, N"]);
}

#[test]
fn design_answers_in_words_and_as_json() {
    const DESIGN: &str =
        "design UPPER --set traffic.passes=8 --set 'duct.length=15 m' --set 'solver.node_spacing=0.25 m'";
    let line = format!("{DESIGN} --limit-force '150 N'");
    let (said, document) = (printed(&line), json(&line));
    let answer = &document["answer"];
    let stiffness = number(&answer["stiffness_n_per_m"]);
    assert!(number(&answer["force_n"]) <= 150.0 && stiffness > 0.0);
    assert_says(&said, &[&format!("a spring of {:.0} kN/m", 1e-3 * stiffness)]);
    let curve = list(&document["curve"]);
    assert!(curve.len() > 10 && said.lines().count() > curve.len());
    // The free end moves farther than that, which counts where no end is named.
    for limits in ["", "--limit-movement 'downstream=1 um'"] {
        let fixed = printed(&format!("{DESIGN} --limit-force '10 kN' {limits}"));
        assert_says(&fixed, &["answer: fixed; force on the"]);
    }
    assert_eq!(output(&format!("{DESIGN} --limit-movement '1 um'")).0, 1);
    // Nothing keeps these limits: the nearest is the answer, with status 1.
    let hard = format!("{DESIGN} --limit-force '1 N' --limit-movement 'downstream=0.1 mm'");
    assert_eq!(output(&hard).0, 1);
    let (status, document, _) = output(&format!("{hard} --json"));
    let document: serde_json::Value = serde_json::from_str(&document).expect("JSON and nothing else");
    assert!(status == 1 && document["answer"].is_null(), "{document}");
    assert!(number(&document["nearest"]["downstream_force_n"]) > 1.0);
}

#[test]
fn design_takes_pairs_several_places_and_limits_of_clamps() {
    const SHORT: &str = "UPPER --set traffic.passes=4 --set 'duct.length=15 m'";
    let design = format!("design {SHORT} --set 'solver.node_spacing=0.3 m'");
    let pair = "--at 'upstream + downstream' --limit-force 10N --limit-movement 0.01mm";
    let (status, said, failed) = output(&format!("{design} {pair}"));
    assert_eq!(status, 1);
    let both = [
        "kN/m at the upstream end and a spring of ",
        "force on the downstream end",
    ];
    assert_says(&said, &both);
    assert_says(&failed, &["the nearest is on standard output"]);
    let clamps = format!(
        "{design} --at 5m --at 13m --limit-force 0.1kN --limit-force clamp=0.15kN --limit-movement 13m=1mm"
    );
    assert_says(
        &printed(&clamps),
        &["2 ways to hold the cable", "best: clamp at 13 m"],
    );
    let document = json(&clamps);
    let candidates = list(&document["candidates"]);
    assert_eq!(candidates.len(), 2);
    assert_eq!(document["place"]["clamp"], 13.0);
    assert_eq!(document["limits"]["clamps"][0]["position_m"], 13.0);
    assert_eq!(document["answer"], candidates[1]["answer"]);
    // A clamp of the scene has its verdict.
    let clamp = "--set 'restraints=[{ position = 13, stiffness = 1e5 }]'";
    let limits = "--limit-force 13m=1N --limit-movement clamp=1m";
    let parts = [
        "limit exceeded: the clamp at 13 m",
        "limit kept: the cable at the clamp at 13 m",
    ];
    assert_says(&printed(&format!("run {SHORT} {clamp} {limits}")), &parts);
}

#[test]
fn measures_are_compared_in_words_and_as_json() {
    const MEASURES: &str = "measures UPPER --set traffic.passes=8 --set 'duct.length=15 m' \
                            --set 'measures=[{ name = \"fixed\", upstream = \"fixed\" }]' \
                            --uncertain friction.dynamic_coefficient=0.2:0.4 --uncertain ground.vertical_peak=20um:40um";
    let kept = format!("{MEASURES} --limit-force '10 kN' --limit-movement '0.1 m'");
    assert_says(&printed(&kept), &["15 combinations", "Recommended: as it is"]);
    let document = json(&kept);
    assert_eq!(document["recommended"], "as it is");
    let fixed = &document["measures"][1];
    assert!(fixed["name"] == "fixed" && fixed["within_limits"] == true);
    assert_eq!(fixed["ends"]["upstream"], "fixed");
    assert_eq!(list(&fixed["restraints"]).len(), 0);
    let [worst, nominal] = ["worst", "nominal"].map(|name| &fixed[name]);
    let [largest, in_middle] = [worst, nominal].map(|outcome| number(&outcome["value"]));
    assert_eq!(worst["quantity"], worst["verdicts"][0]["quantity"]);
    assert_eq!(worst["value"], worst["verdicts"][0]["largest"]);
    assert!(in_middle <= largest && largest < number(&worst["limit"]));
    assert_eq!(worst["at"].as_object().expect("keys").len(), 2, "{worst}");
    // Nothing holds: what comes nearest, and status 1.
    let (status, said, failed) = output(&format!("{MEASURES} --limit-force '1 N'"));
    assert_eq!(status, 1);
    assert_says(&said, &["comes nearest"]);
    assert!(!failed.is_empty());
}
