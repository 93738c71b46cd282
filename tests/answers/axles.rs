//! Many passes of an axle histogram: stand-ins compared with every axle at random.

use creepage::{CableEnd, Limited, PassRecord, Scene};

use super::common::assert_within;
use crate::scene::histogram::read;
use crate::scenes::{self, assert_near, last};

/// What differs from the scene of the tests of histograms.
const OWN: [&str; 5] = [
    "ends.downstream={ spring = 3e6 }",
    "traffic.passes=1400",
    "solver.tolerance=0.05",
    "solver.node_spacing=0.15",
    "solver.vehicle_step=0.075",
];
/// Passes after which nothing but the order of the axles changes.
const SETTLED: usize = 300;

/// Light axles, most of them near 60 kN, and one in a hundred far heavier, in a folder of this name.
fn scene(name: &str, overrides: &[&str]) -> Scene {
    let row = |load: i32| {
        let off = (f64::from(load) - 60.0) / 25.0;
        format!("{load} kN,{:.3},0.15 m\n", 1000.0 * (-0.5 * off * off).exp())
    };
    let rows: Vec<String> = (5..=120).step_by(5).map(row).collect();
    let heavy = "170 kN,80,0.15 m\n210 kN,40,0.15 m\n";
    let table = format!("load,count,contact_radius\n{}{heavy}", rows.concat());
    read(name, &table, &[&OWN, overrides].concat()).expect("a scene")
}

/// When the mean has come near to its end does not depend on how many axles come afterwards.
#[test]
#[ignore = "seven seconds: .ci/run runs it"]
fn the_mean_levels_off_after_as_many_axles_in_one_year_as_in_ten() {
    let levelled = [20_000, 200_000].map(|passes| {
        let run = creepage::run(&scene("levels", &[&format!("traffic.passes={passes}")])).expect("an answer");
        let after = run.saturation.expect("a saturation").passes_to_95_percent;
        // By the rows themselves: the first within 5 % of the last.
        let last = last(&run).downstream_force_n;
        let is_near = |pass: &&PassRecord| pass.downstream_force_n >= 0.95 * last;
        let near = run.passes.iter().find(is_near);
        assert_eq!(after, near.expect("the last at least").pass);
        after
    });
    assert_eq!(levelled[0], levelled[1]);
}

/// The stand-ins' force is the mean of all axles', within the stated error, and the stated spread is theirs.
#[test]
fn stand_ins_keep_the_mean_force_and_the_spread_of_all_axles() {
    let jumps = creepage::run(&scene("axles", &["solver.method=pass-law"])).expect("an answer");
    let one_by_one = ["solver.method=quasi-static", "traffic.seed=5"];
    let every = creepage::run(&scene("axles", &one_by_one)).expect("an answer");
    assert!(jumps.cost.simulated_passes < 400, "{:?}", jumps.cost);
    let mut forces = scenes::forces(&every).split_off(SETTLED);
    let mean = forces.iter().sum::<f64>() / forces.len() as f64;
    let error = jumps.error_estimate.relative;
    assert_near(last(&jumps).downstream_force_n, mean, error.max(0.01), "mean");

    forces.sort_by(f64::total_cmp);
    let at = |share: f64| forces[(share * (forces.len() - 1) as f64) as usize];
    let spread = jumps.random.expect("a spread").downstream;
    // Of some hundred passes each.
    let width = at(0.95) - at(0.05);
    for (found, share) in [(spread.q05_n, 0.05), (spread.q50_n, 0.5), (spread.q95_n, 0.95)] {
        assert_within(found, at(share), 0.25 * width, share);
    }
    // Limits are judged on single axles, the heaviest at the worst time among them.
    let largest = [&jumps, &every].map(|run| run.largest(CableEnd::Downstream, Limited::Force));
    assert!(largest[1] > 1.1 * mean, "{largest:?} {mean}");
    assert_within(largest[0], largest[1], 0.5 * width, "largest");
}

/// The rows of a cable that still creeps lie within the spread of single axles, which is not that of a later time.
#[test]
fn the_spread_is_that_of_the_last_passes() {
    let long = ["solver.method=pass-law", "traffic.passes=100", "duct.length=60 m"];
    let run = creepage::run(&scene("creeps", &long)).expect("an answer");
    let last = last(&run).downstream_force_n;
    let spread = run.random.expect("a spread").downstream;
    let saturation = run.saturation.map(|saturation| saturation.force_n);
    assert!(saturation.is_none_or(|force| force > 1.1 * last));
    assert!(spread.q05_n < last && last < spread.q95_n, "{spread:?} {last}");
}

/// What a mix that stands in cannot answer as exactly as asked, all axles do where they are few.
#[test]
fn few_axles_are_simulated_one_by_one() {
    let method = |overrides: &[&str]| {
        let scene = scene("few", overrides);
        creepage::plan(&scene).expect("a plan").report().cable
    };
    let (loose, tight) = ("solver.tolerance=0.05", "solver.tolerance=0.01");
    assert_eq!(method(&[tight]), "quasi-static");
    assert_eq!(method(&[loose, "traffic.passes=20000"]), "pass-law");
    assert_eq!(method(&[tight, "traffic.passes=1000000"]), "pass-law");
}
