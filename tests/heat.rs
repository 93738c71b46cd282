//! Daily heat, through scenes: keys, days of traffic, every end, and what is said of them.

use creepage::{DayExtremes, ErrorSource, Run, Scene};

use crate::scenes;

/// The full-scale experiment's upper cable on a half-space, heated by 20 K every day, with few vehicles a day.
const WARM: [&str; 9] = [
    "duct = { length = 30, depth = 1.2 }",
    "ground = { layers = [{ young_modulus = \"800 MPa\", poisson_ratio = 0.4 }] }",
    "cable = { weight = 108.8, axial_stiffness = 8.01e6 }",
    "friction = { dynamic_coefficient = 0.25, shape_factor = 7352941.0 }",
    "ends = { upstream = \"free\", downstream = \"fixed\" }",
    "vehicles = [{ speed = \"40 km/h\", load = \"20 tf\" }]",
    "traffic = { passes = 48, per_day = 24 }",
    "heat = { expansion = \"17e-6 1/K\", daily_swing = \"20 K\" }",
    "solver = { node_spacing = 0.1, vehicle_step = 0.05 }",
];
/// EA α \[N/K\].
const PER_KELVIN: f64 = 8.01e6 * 17e-6;

fn text(lines: &[&str]) -> String {
    let key = |line: &str| line.split_once(" = ").map(|(key, _)| key.to_owned());
    let mut text: Vec<&str> = WARM.to_vec();
    for line in lines {
        text.retain(|other| key(other) != key(line));
        text.push(line);
    }
    text.join("\n")
}

/// [`WARM`] with other lines.
fn scene(lines: &[&str]) -> Scene {
    Scene::from_toml("warm.toml", &text(lines)).expect("a valid scene")
}

fn run(lines: &[&str]) -> Run {
    scenes::run(&scene(lines))
}

fn day(run: &Run, day: u64) -> &DayExtremes {
    let found = run.days.iter().find(|record| record.day == day);
    found.expect("a listed day")
}

/// Lines of a scene; force downstream at most and at least \[N\], upstream end at most and at least \[mm\], on the first and the last day, by
/// an independent full-chain program.
const CHAIN: &str = r#"
traffic = { passes = 144, per_day = 24 } | 814.1 -815.2 0.009 -8.899 | 814.1 -815.2 -1.324 -8.899
traffic = { passes = 144, per_day = 24 } ; heat = { expansion = 17e-6, daily_swing = 40 } | 814.1 -815.2 0.003 -19.055 | 814.1 -815.2 -1.378 -19.055
LONG | 2612.5 -460.3 0.025 -18.250 | 2275.2 -535.7 -9.786 -19.001
LONG ; ends = { upstream = "free", downstream = "free" } | 0.0 0.0 0.025 -13.310 | 0.0 0.0 0.166 -9.908
traffic = { passes = 96, per_day = 24 } ; ends = { upstream = { spring = 1e6 }, downstream = { spring = 1e6 } } | 1768.5 0.4 0.008 -1.671 | 1787.7 188.7 0.040 -1.653
"#;
const LONG: &str = "traffic = { passes = 192, per_day = 48 } ; duct = { length = 100, depth = 1.2 } ; solver = { node_spacing = 0.2, vehicle_step = 0.1 }";

#[test]
fn days_are_those_of_an_independent_program() {
    for row in CHAIN.lines().filter(|row| !row.is_empty()) {
        let row = row.replace("LONG", LONG);
        let [lines, first, last] = row.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{row}")
        };
        let run = run(&lines.split(" ; ").collect::<Vec<_>>());
        let count = run.days.last().expect("days").day;
        for (number, expected) in [(1, first), (count, last)] {
            let expected: Vec<f64> = expected
                .split(' ')
                .map(|number| number.parse().expect(&row))
                .collect();
            let found = day(&run, number);
            let found = [
                found.downstream_max_n,
                found.downstream_min_n,
                1e3 * found.upstream_displacement_max_m,
                1e3 * found.upstream_displacement_min_m,
            ];
            let force = expected[0].abs().max(expected[1].abs()).max(1.0);
            let range = expected[2] - expected[3];
            for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                let apart = (found - expected).abs() / if k < 2 { force } else { range };
                assert!(apart < 0.01, "{lines}, day {number}: {found}, {expected}");
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
    let warm = run(&[
        fixed,
        every,
        "heat = { expansion = 17e-6, daily_swing = 20, offset = \"-25 K\" }",
    ]);
    assert_eq!(cold.passes.len(), warm.passes.len());
    for (cold, warm) in cold.passes.iter().zip(&warm.passes) {
        let time = ((cold.pass - 1) % 24) as f64 + 0.5;
        let kelvin = 10.0 * (1.0 - (std::f64::consts::TAU * time / 24.0).cos()) - 25.0;
        for (cold, warm) in [
            (cold.upstream_force_n, warm.upstream_force_n),
            (cold.downstream_force_n, warm.downstream_force_n),
        ] {
            let apart = warm - cold - PER_KELVIN * kelvin;
            assert!(apart.abs() < 1e-6 * PER_KELVIN, "{cold} {warm} {kelvin}");
        }
    }
    // Noon lies between two passes.
    let noon = day(&warm, 2).downstream_max_n;
    assert!((noon - cold.passes[35].downstream_force_n + 5.0 * PER_KELVIN).abs() < 1e-6 * noon.abs());
}

/// Without heat nothing is different in any bit.
#[test]
fn a_cable_that_does_not_expand_is_computed_as_without_heat() {
    let answer = |text: &str| {
        let scene = Scene::from_toml("warm.toml", text).expect("a valid scene");
        serde_json::to_string(&creepage::run(&scene).expect("an answer")).expect("a document")
    };
    let short = "traffic = { passes = 30, per_day = 24 }";
    let warm = text(&[short]);
    let cold: Vec<&str> = warm.lines().filter(|line| !line.starts_with("heat")).collect();
    let without = answer(&cold.join("\n"));
    for heat in [
        "heat = { expansion = 0, daily_swing = 20 }",
        "heat = { expansion = 1e-5, daily_swing = 0 }",
    ] {
        assert_eq!(answer(&text(&[short, heat])), without, "{heat}");
    }
}

/// Seen in a mirror ends, slope and traffic change places, and so does the answer.
#[test]
fn heat_in_the_mirror_mirrors_the_answer() {
    let common = [
        "traffic = { passes = 600, per_day = 120 }",
        "heat = { expansion = 17e-6, profile = [[\"2 h\", \"-3 K\"], [\"15 h\", \"22 K\"]], offset = 4 }",
        "solver = { tolerance = 0.03 }",
    ];
    let of = |own: &[&str]| run(&[&common[..], own].concat());
    let one = of(&[
        "duct = { length = 30, depth = 1.2, slope = 0.04 }",
        "ends = { upstream = { spring = 3e5 }, downstream = { spring = 2e6 } }",
    ]);
    let other = of(&[
        "duct = { length = 30, depth = 1.2, slope = -0.04 }",
        "ends = { upstream = { spring = 2e6 }, downstream = { spring = 3e5 } }",
        "vehicles = [{ speed = \"40 km/h\", load = \"20 tf\", direction = \"reverse\" }]",
    ]);
    assert_eq!(one.days.len(), 5);
    for (a, b) in one.days.iter().zip(&other.days) {
        let pairs = [
            (a.upstream_max_n, b.downstream_max_n),
            (a.upstream_min_n, b.downstream_min_n),
            (a.downstream_max_n, b.upstream_max_n),
            (
                1e6 * a.upstream_displacement_max_m,
                -1e6 * b.downstream_displacement_min_m,
            ),
            (
                1e6 * a.downstream_displacement_min_m,
                -1e6 * b.upstream_displacement_max_m,
            ),
        ];
        for (a, b) in pairs {
            // Solvers of both ways remember other windows.
            assert!((a - b).abs() < 2e-4 * 1600.0, "{a} {b}");
        }
    }
}

/// Days of which few passes are simulated, or none, against every pass on the same mesh; the last day is cut short.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn few_real_passes_are_enough_within_the_stated_error() {
    let cases: [&[&str]; 3] = [
        &[],
        &[
            "ends = { upstream = \"free\", downstream = \"free\" }",
            "duct = { length = 25, depth = 1, slope = 0.03 }",
        ],
        &[
            "vehicles = [{ speed = 10, load = \"20 tf\", share = 2 }, { name = \"back\", speed = 10, load = \"12 tf\", direction = \"reverse\" }]",
            "restraints = [{ position = 20, stiffness = 1e6 }]",
        ],
    ];
    for lines in cases {
        let answer = |method: &str| {
            let solver = format!(
                "solver = {{ method = \"{method}\", node_spacing = 0.2, vehicle_step = 0.1, tolerance = 0.02 }}"
            );
            run(&[lines, &["traffic = { passes = 4305, per_day = 801 }", &solver]].concat())
        };
        let (every, few) = (answer("quasi-static"), answer("auto"));
        assert_eq!(
            (every.cost.simulated_passes, every.days.len(), few.days.len()),
            (4305, 6, 6)
        );
        assert!(few.cost.simulated_passes < 3000, "{}", few.cost.simulated_passes);
        let stated = few.error_estimate.parts.temperature;
        assert!(stated < 0.02, "{stated}");
        for (right, found) in every.days.iter().zip(&few.days) {
            assert_eq!(right.day, found.day);
            let forces = |day: &DayExtremes| {
                [
                    day.upstream_max_n,
                    day.upstream_min_n,
                    day.downstream_max_n,
                    day.downstream_min_n,
                    day.max_compression_n,
                    day.max_tension_n,
                ]
            };
            let largest = forces(right)
                .into_iter()
                .fold(0.0_f64, |most, force| most.max(force.abs()));
            for (right_force, found_force) in forces(right).into_iter().zip(forces(found)) {
                let apart = (right_force - found_force).abs() / largest;
                assert!(
                    // A quarter of the tolerance is not worth an estimate.
                    apart < stated.max(5e-3),
                    "{lines:?}, day {}: {right_force} {found_force}, {stated}",
                    right.day
                );
            }
        }
        let last = [&every, &few].map(|run| run.passes[run.passes.len() - 1]);
        assert_eq!(last.map(|record| record.pass), [4305, 4305]);
        // The end of the cable is where its last row says it is, and the day stops there.
        assert_eq!(few.heat.as_ref().map(|heat| heat.all_days.day), Some(6));
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
    let heat = run.heat.expect("a heated cable");
    let drift = heat.drift_per_day_m.expect("days that repeat");
    // Measured by an independent program: 19.73 mm a day toward growing x, where vehicles drive.
    assert!((1e3 * drift / 19.73 - 1.0).abs() < 0.02, "{drift} m");
    let last = &run.days[run.days.len() - 1];
    assert_eq!((last.day, heat.all_days.day), (7305, 7305));
    assert!((last.upstream_displacement_max_m / (7305.0 * drift) - 1.0).abs() < 1e-2);
    assert!(
        run.warnings
            .iter()
            .any(|warning| warning.contains("upper bounds"))
    );
    assert!(run.saturation.is_none() && run.range.is_none());
    // A day as it goes, in order.
    assert!(heat.cycle.len() > 20 && heat.cycle.windows(2).all(|pair| pair[0].hour < pair[1].hour));
    let warmest = heat.cycle.iter().map(|point| point.warming_k).fold(0.0, f64::max);
    assert!((warmest - 20.0).abs() < 0.1, "{warmest} K");
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
        let told = |warning: &String| warning.contains("began the sequence anew");
        (
            run.warnings.iter().any(told),
            run.error_estimate.parts.temperature,
        )
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
    let told = |warning: &String| warning.contains("in the same order");
    assert!(mix.warnings.iter().any(told));
    let (found, right) = (day(&mix, 6).downstream_max_n, day(&every, 6).downstream_max_n);
    let stated = mix.error_estimate.relative;
    assert!((found / right - 1.0).abs() <= stated, "{found} {right} {stated}");
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
        let (long, every) = (day(&long, number), day(&every, number));
        for (found, right) in [
            (long.downstream_max_n, every.downstream_max_n),
            (long.downstream_min_n, every.downstream_min_n),
        ] {
            assert!(
                (found - right).abs() < 1e-3 * every.downstream_max_n,
                "day {number}: {found} {right}"
            );
        }
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
    assert!(
        found.error_estimate.relative < 0.056,
        "{:?}",
        found.error_estimate
    );
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
    for (few, many) in [
        (few.downstream_max_n, many.downstream_max_n),
        (few.downstream_min_n, many.downstream_min_n),
    ] {
        assert!((few / many - 1.0).abs() < allowed, "{few} {many} {allowed}");
    }
}

/// Up to a hundred vehicles a day, of several kinds: days are jumped over and held to days of all of them, within what is stated.
#[test]
fn days_of_few_vehicles_of_two_kinds_are_jumped_over() {
    let lines = |method: &str| {
        [
            "duct = { length = 60, depth = 1.2 }".to_owned(),
            "vehicles = [{ speed = 10, load = \"20 tf\" }, { name = \"light\", speed = 10, load = \"6 tf\" }]".to_owned(),
            "traffic = { passes = 1200, per_day = 24 }".to_owned(),
            format!("solver = {{ method = \"{method}\", node_spacing = 0.4, vehicle_step = 0.4, tolerance = 0.1 }}"),
        ]
    };
    let of = |method: &str| run(&lines(method).each_ref().map(String::as_str));
    let (jumped, every) = (of("pass-law"), of("quasi-static"));
    assert_eq!(every.cost.simulated_passes, 1200);
    assert!(jumped.cost.simulated_passes < 600, "{:?}", jumped.cost);
    let largest = day(&every, 50).downstream_max_n;
    let allowed = largest * jumped.error_estimate.relative;
    for number in [1, 10, 50] {
        let (jumped, every) = (day(&jumped, number), day(&every, number));
        for (jumped, every) in [
            (jumped.downstream_max_n, every.downstream_max_n),
            (jumped.downstream_min_n, every.downstream_min_n),
        ] {
            assert!(
                (jumped - every).abs() < allowed,
                "day {number}: {jumped} {every} {allowed}"
            );
        }
    }
}

/// On days of heat too the parts of the error sum to the whole.
#[test]
fn the_parts_of_the_error_sum_to_the_whole() {
    let error = run(&[
        "traffic = { passes = 4800, per_day = 960 }",
        "solver = { tolerance = 0.03 }",
    ])
    .error_estimate;
    let parts = ErrorSource::ALL.map(|source| error.parts.of(source));
    assert!(error.parts.of(ErrorSource::Days) > 0.0, "{error:?}");
    let sum: f64 = parts.iter().sum();
    assert!(
        (sum - error.relative).abs() < 1e-12,
        "{parts:?}, {}",
        error.relative
    );
}
