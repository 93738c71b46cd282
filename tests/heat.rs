//! Daily heat, through scenes: keys, days of traffic, every end, and what is said of them.

use creepage::{DayExtremes, ErrorSource, PassRecord, Run, Scene};

use crate::answers::common::{self, assert_within, is_told};
use crate::scenes::{self, assert_near};

/// The full-scale experiment's upper cable, heated by 20 K every day, with few vehicles a day.
const WARM: [&str; 4] = [
    "duct = { length = 30, depth = 1.2 }",
    "traffic = { passes = 48, per_day = 24 }",
    "heat = { expansion = \"17e-6 1/K\", daily_swing = \"20 K\" }",
    "solver = { node_spacing = 0.1, vehicle_step = 0.05 }",
];
/// EA α \[N/K\].
const PER_KELVIN: f64 = 8.01e6 * 17e-6;

/// [`WARM`] with other lines.
fn scene(lines: &[&str]) -> Scene {
    common::scene(&[&common::UPPER, &WARM, lines])
}

fn run(lines: &[&str]) -> Run {
    scenes::run(&scene(lines))
}

fn ends(record: &PassRecord) -> [f64; 2] {
    [record.upstream_force_n, record.downstream_force_n]
}

/// Asserts that the largest and the least force downstream on these days are alike within `allowed` \[N\].
#[track_caller]
fn assert_days(one: &Run, other: &Run, numbers: &[u64], allowed: f64) {
    for &number in numbers {
        let (one, other) = (day(one, number), day(other, number));
        assert_within(one.downstream_max_n, other.downstream_max_n, allowed, number);
        assert_within(one.downstream_min_n, other.downstream_min_n, allowed, number);
    }
}

fn day(run: &Run, day: u64) -> &DayExtremes {
    let found = run.days.iter().find(|record| record.day == day);
    found.expect("a listed day")
}

/// Lines of a scene; force downstream at most and at least \[N\], upstream end at most and at least \[mm\], on the first and the last day, by
/// an independent full-chain program.
type Chain = (&'static [&'static str], [[f64; 4]; 2]);

#[rustfmt::skip]
const CHAIN: [Chain; 3] = [
    (&["traffic = { passes = 144, per_day = 24 }", "heat = { expansion = 17e-6, daily_swing = 40 }"],
        [[814.1, -815.2, 0.003, -19.055], [814.1, -815.2, -1.378, -19.055]]),
    (&["traffic = { passes = 192, per_day = 48 }", "duct = { length = 100, depth = 1.2 }",
        "solver = { node_spacing = 0.2, vehicle_step = 0.1 }"],
        [[2612.5, -460.3, 0.025, -18.250], [2275.2, -535.7, -9.786, -19.001]]),
    (&["traffic = { passes = 96, per_day = 24 }", "ends = { upstream = { spring = 1e6 }, downstream = { spring = 1e6 } }"],
        [[1768.5, 0.4, 0.008, -1.671], [1787.7, 188.7, 0.040, -1.653]]),
];

#[test]
fn days_are_those_of_an_independent_program() {
    for (lines, expected) in CHAIN {
        let run = run(lines);
        let days = [day(&run, 1), run.days.last().expect("days")];
        for (found, expected) in days.into_iter().zip(expected) {
            let most = 1e3 * found.upstream_displacement_max_m;
            let least = 1e3 * found.upstream_displacement_min_m;
            let found = [found.downstream_max_n, found.downstream_min_n, most, least];
            let force = expected[0].abs().max(expected[1].abs());
            let range = expected[2] - expected[3];
            for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                let scale = if k < 2 { force } else { range };
                assert_within(found, expected, 0.01 * scale, lines);
            }
        }
    }
}

/// Nothing moves as a cable warms between fixed ends: its force comes on top of that of the traffic, below zero where it is colder than laid.
#[test]
fn between_fixed_ends_heat_and_traffic_add_up() {
    let fixed = "ends = { upstream = \"fixed\", downstream = \"fixed\" }";
    let every = "solver = { method = \"quasi-static\", node_spacing = 0.1, vehicle_step = 0.05 }";
    let cold = run(&[fixed, every, "heat = { expansion = 0, daily_swing = 20 }"]);
    let warming = "heat = { expansion = 17e-6, daily_swing = 20, offset = \"-25 K\" }";
    let warm = run(&[fixed, every, warming]);
    assert_eq!(cold.passes.len(), warm.passes.len());
    for (cold, warm) in cold.passes.iter().zip(&warm.passes) {
        let time = ((cold.pass - 1) % 24) as f64 + 0.5;
        let kelvin = 10.0 * (1.0 - (std::f64::consts::TAU * time / 24.0).cos()) - 25.0;
        for (cold, warm) in ends(cold).into_iter().zip(ends(warm)) {
            assert_within(warm - cold, PER_KELVIN * kelvin, 1e-6 * PER_KELVIN, kelvin);
        }
    }
    // Noon lies between two passes.
    let noon = day(&warm, 2).downstream_max_n;
    let expected = cold.passes[35].downstream_force_n - 5.0 * PER_KELVIN;
    assert_within(noon, expected, 1e-6 * noon.abs(), "noon");
}

/// Without heat nothing is different in any bit.
#[test]
fn a_cable_that_does_not_expand_is_computed_as_without_heat() {
    let answer = |scene: &Scene| serde_json::to_string(&scenes::run(scene)).expect("a document");
    let short = "traffic = { passes = 30, per_day = 24 }";
    let mut cold = scene(&[short]);
    cold.heat = None;
    let without = answer(&cold);
    for heat in [
        "heat = { expansion = 0, daily_swing = 20 }",
        "heat = { expansion = 1e-5, daily_swing = 0 }",
    ] {
        assert_eq!(answer(&scene(&[short, heat])), without, "{heat}");
    }
}

/// A slope and no end that holds: traffic takes friction away, and the cable walks down day after day.
#[test]
fn a_cable_walks_down_its_slope_for_twenty_years() {
    let run = run(&[
        "duct = { length = 30, depth = 1.2, slope = \"3 %\" }",
        "ends = { upstream = \"free\", downstream = \"free\" }",
        "traffic = { years = 20, per_day = 800 }",
        "solver = { tolerance = 0.03 }",
    ]);
    let heat = run.heat.as_ref().expect("a heated cable");
    let drift = heat.drift_per_day_m.expect("days that repeat");
    // Measured by an independent program: 19.73 mm a day toward growing x, where vehicles drive.
    assert_near(1e3 * drift, 19.73, 0.02, "mm a day");
    let last = &run.days[run.days.len() - 1];
    assert_eq!((last.day, heat.all_days.day), (7305, 7305));
    assert_near(last.upstream_displacement_max_m, 7305.0 * drift, 1e-2, "m");
    assert!(is_told(&run, "upper bounds"));
    assert!(run.saturation.is_none() && run.range.is_none());
    // A day as it goes, in order.
    assert!(heat.cycle.len() > 20 && heat.cycle.windows(2).all(|pair| pair[0].hour < pair[1].hour));
    let warmest = heat.cycle.iter().map(|point| point.warming_k).fold(0.0, f64::max);
    assert_within(warmest, 20.0, 0.1, "K");
    // Traffic draws a cable together that is warmest at noon before that, and cold it is pulled apart.
    let mean = |profile: &creepage::ForceProfile| profile.force_n.iter().sum::<f64>();
    assert!(mean(&heat.hot_profile) > mean(&heat.cold_profile));
}

/// Days that begin anew in a sequence which goes on over midnight: what that changes is told, and is in the error.
#[test]
fn a_sequence_that_does_not_fit_into_a_day_is_an_error_of_its_own() {
    let vehicles = "vehicles = [{ speed = 10, load = \"20 tf\", share = 2 }, { name = \"back\", speed = 10, load = \"12 tf\", direction = \"reverse\" }]";
    let solver = "solver = { tolerance = 0.05 }";
    let stated = |per_day: u64| {
        let traffic = format!("traffic = {{ passes = {}, per_day = {per_day} }}", 3 * per_day);
        let run = run(&[vehicles, solver, &traffic]);
        let stated = run.error_estimate.parts.temperature;
        (is_told(&run, "began the sequence anew"), stated)
    };
    let (whole, broken) = (stated(402), stated(400));
    assert!(!whole.0 && broken.0);
    assert!(broken.1 > whole.1, "{broken:?} {whole:?}");
}

/// A sequence that takes longer than a day: a mix of its vehicles that fits into the day stands in for it, and its error covers what that changes.
#[test]
#[ignore = "six seconds: .ci/run runs it"]
fn a_sequence_longer_than_a_day_is_answered_by_its_mix() {
    let sequence = vec!["\"v\""; 149].join(", ");
    let by = |method: &str| {
        run(&[
            "duct = { length = 10, depth = 1.2 }",
            "vehicles = [{ name = \"v\", speed = 10, load = \"20 tf\" }, { name = \"back\", speed = 10, load = \"12 tf\", direction = \"reverse\" }]",
            &format!("traffic = {{ passes = 720, per_day = 120, sequence = [{sequence}, \"back\"] }}"),
            &format!("solver = {{ method = \"{method}\", node_spacing = 0.25, vehicle_step = 0.125 }}"),
        ])
    };
    let (mix, every) = (by("auto"), by("quasi-static"));
    assert!(is_told(&mix, "in the same order"));
    let (found, right) = (day(&mix, 6).downstream_max_n, day(&every, 6).downstream_max_n);
    assert_near(found, right, mix.error_estimate.relative, "N");
}

/// Traffic that takes away little of friction's hold leaves steps of many periods nowhere to go: all passes of a day are simulated, and few
/// days.
#[test]
fn days_under_weak_traffic_are_those_of_every_pass() {
    let weak = [
        "duct = { length = 5, depth = 0.74 }",
        "ground = { layers = [{ young_modulus = \"460 MPa\", poisson_ratio = 0.4 }] }",
        "cable = { weight = 116, axial_stiffness = 4.3e7 }",
        "friction = { law = \"coulomb\", dynamic_coefficient = 0.56 }",
        "ends = { upstream = \"free\", downstream = { spring = 2.3e5 } }",
        "vehicles = [{ speed = 7, lateral_offset = -2.5, load = 2e4 }]",
        "heat = { expansion = 8.6e-6, daily_swing = 2.7 }",
    ];
    let by = |passes: u64, method: &str| {
        let traffic = format!("traffic = {{ passes = {passes}, per_day = 250 }}");
        let solver = format!(
            "solver = {{ method = \"{method}\", node_spacing = 0.2, vehicle_step = 0.2, tolerance = 0.1 }}"
        );
        run(&[&weak[..], &[&traffic, &solver]].concat())
    };
    let (long, every) = (by(275_000, "auto"), by(2500, "quasi-static"));
    assert!(long.cost.simulated_passes < 10_000, "{:?}", long.cost);
    for number in [1, 2, 5, 10] {
        let allowed = 1e-3 * day(&every, number).downstream_max_n;
        assert_days(&long, &every, &[number], allowed);
    }
}

/// A step of many periods that finds no balance here, which the last digits decide, leads nowhere either.
#[test]
fn days_whose_long_steps_find_no_balance_simulate_all_passes() {
    let unbalanced = [
        "duct = { length = 202.89072008426925, depth = 2.109119643236021, inner_diameter = 0.18128580166390712 }",
        "ground = { layers = [{ thickness = 0.3856005215823146, young_modulus = 1461672518.1878016, poisson_ratio = 0.32821445547694783 }, \
         { young_modulus = 2550517117.0922976, poisson_ratio = 0.32492663338746663 }] }",
        "cable = { weight = 45.66868459332579, axial_stiffness = 6056994.133002049, arrangement = \"trefoil-lower\", \
         diameter = 0.04791035618479776 }",
        "friction = { dynamic_coefficient = 0.3417479544315181, shape_factor = 24626453.862040892 }",
        "ends = { upstream = \"fixed\", downstream = \"free\" }",
        "vehicles = [{ speed = 6.330168568465899, load = 27803.477591494968 }]",
        "traffic = { passes = 400, per_day = 314 }",
        "heat = { expansion = 0.000012319635191418012, daily_swing = 25.281687740573034 }",
        "solver = { tolerance = 0.0561057916876616 }",
    ];
    let found = run(&unbalanced);
    let stated = found.error_estimate.relative;
    assert!(stated < 0.056, "{stated}");
    assert_eq!(found.cost.simulated_passes, 400);
}

/// With few real periods a day this short duct never comes to days that are alike: it takes more of them, and many days end as few do.
#[test]
#[ignore = "six seconds: .ci/run runs it"]
fn days_that_few_real_periods_keep_restless_settle_with_more() {
    let restless = [
        "duct = { length = 4.2, depth = 2.2, slope = -0.06 }",
        "ground = { layers = [{ thickness = 0.1, young_modulus = \"37 MPa\", poisson_ratio = 0.4 }, \
         { thickness = 0.4, young_modulus = \"0.1 MPa\", poisson_ratio = 0.4 }, { young_modulus = \"130 MPa\", poisson_ratio = 0.27 }] }",
        "cable = { weight = 390, axial_stiffness = 1.1e8 }",
        "friction = { law = \"coulomb\", dynamic_coefficient = 0.18 }",
        "ends = { upstream = { spring = 5e4 }, downstream = { spring = 3e6 } }",
        "heat = { expansion = 16e-6, daily_swing = 11.5 }",
        "solver = { tolerance = 0.03 }",
    ];
    let lived = |passes: &str| run(&[&restless[..], &[passes]].concat());
    let few = lived("traffic = { passes = 2780, per_day = 278 }");
    let many = lived("traffic = { passes = 1112000, per_day = 278 }");
    let allowed = few.error_estimate.relative + many.error_estimate.relative;
    let (few, many) = (day(&few, 10), day(&many, 4000));
    assert_near(few.downstream_max_n, many.downstream_max_n, allowed, "N");
    assert_near(few.downstream_min_n, many.downstream_min_n, allowed, "N");
}

/// Up to a hundred vehicles a day, of several kinds: days are jumped over and held to days of all of them, within what is stated; the last
/// day is cut short.
#[test]
fn days_of_few_vehicles_of_two_kinds_are_jumped_over() {
    let lines = |method: &str| {
        [
            "duct = { length = 60, depth = 1.2 }".to_owned(),
            "vehicles = [{ speed = 10, load = \"20 tf\" }, { name = \"light\", speed = 10, load = \"6 tf\" }]".to_owned(),
            "traffic = { passes = 709, per_day = 24 }".to_owned(),
            format!("solver = {{ method = \"{method}\", node_spacing = 0.4, vehicle_step = 0.4, tolerance = 0.1 }}"),
        ]
    };
    let of = |method: &str| run(&lines(method).each_ref().map(String::as_str));
    let (jumped, every) = (of("pass-law"), of("quasi-static"));
    assert_eq!(every.cost.simulated_passes, 709);
    assert!(jumped.cost.simulated_passes < 500, "{:?}", jumped.cost);
    let largest = day(&every, 30).downstream_max_n;
    let allowed = largest * jumped.error_estimate.relative;
    assert_days(&jumped, &every, &[1, 10, 30], allowed);
}

/// On days of heat too the parts of the error sum to the whole.
#[test]
fn the_parts_of_the_error_sum_to_the_whole() {
    let traffic = "traffic = { passes = 4800, per_day = 960 }";
    let error = run(&[traffic, "solver = { tolerance = 0.03 }"]).error_estimate;
    let parts = ErrorSource::ALL.map(|source| error.parts.of(source));
    assert!(error.parts.of(ErrorSource::Days) > 0.0, "{error:?}");
    assert_within(parts.iter().sum(), error.relative, 1e-12, parts);
}
