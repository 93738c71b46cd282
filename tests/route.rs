//! Ducts of several sections, bends and clamps that slip, through scenes.

use creepage::calibration::Unknown;
use creepage::{
    CableEnd, CalibrateOptions, ClampLimits, EndLimits, Limited, Limits, PassRecord, Place, Reading,
    Readings, Run, Scene,
};

use crate::answers::common::assert_within;
use crate::scenes::{self, assert_near, largest, last, scene_of};

/// The upper cable of the paper's experiment in a duct of 60 m.
const SCENE: &str = r#"
duct = { length = "60 m", depth = "1.2 m" }
ground = { layers = [{ young_modulus = "800 MPa", poisson_ratio = 0.4 }] }
cable = { weight = "108.8 N/m", axial_stiffness = "8.01e6 N" }
friction = { dynamic_coefficient = 0.25, shape_factor = 7352941.176470588 }
ends = { upstream = "free", downstream = "fixed" }
vehicles = [{ load = "196133 N", speed = "40 km/h" }]
traffic = { passes = 200 }
"#;

fn scene(overrides: &[&str]) -> Scene {
    scene_of(SCENE, overrides)
}

fn run(overrides: &[&str]) -> Run {
    scenes::run(&scene(overrides))
}

/// Forces on the fixed end, on a clamp \[N\] and movements of the free end \[mm\] after 1, 10 and 200 passes, by an independent chain whose
/// mesh is good to 0.3 %.
#[rustfmt::skip]
const CHAIN: [(&str, [[f64; 3]; 3]); 5] = [
    ("route=[{}]", [[102.225, 0.0, 0.01461], [288.77, 0.0, 0.25001], [1019.981, 0.0, 3.63959]]),
    (r#"route=[{length="22.146018366 m"}, {length="15.707963268 m", bend_radius="10 m"}, {}]"#,
        [[102.225, 0.0, 0.01461], [288.76, 0.0, 0.25001], [1031.283, 0.0, 3.67269]]),
    (r#"route=[{length="30 m", slope="3 %"}, {}]"#,
        [[102.223, 0.0, 0.01116], [287.694, 0.0, 0.21993], [933.009, 0.0, 3.14778]]),
    (r#"route=[{length="30 m"}, {dynamic_coefficient=0.35}]"#,
        [[110.141, 0.0, 0.01461], [298.274, 0.0, 0.25001], [1124.028, 0.0, 3.77373]]),
    (r#"restraints=[{position="30 m", stiffness="5 MN/m", holds="200 N"}]"#,
        [[102.215, 95.145, 0.01461], [278.067, 198.241, 0.25001], [846.076, 198.241, 3.0096]]),
];

#[test]
fn routes_are_those_of_an_independent_chain_to_a_per_cent() {
    for (changes, expected) in CHAIN {
        let run = run(&[changes]);
        let [scale, _, moved] = expected[2];
        for (pass, wanted) in [1, 10, 200].into_iter().zip(expected) {
            let index = run.passes.iter().position(|row| row.pass == pass);
            let index = index.expect("a listed pass");
            let row = &run.passes[index];
            let clamp = run.restraints.first();
            let clamp = clamp.map_or(0.0, |clamp| clamp.after_passes_n[index]);
            let found = [row.downstream_force_n, clamp, 1e3 * row.upstream_displacement_m];
            for ((found, wanted), scale) in found.into_iter().zip(wanted).zip([scale, scale, moved]) {
                assert_within(found, wanted, 0.01 * scale, (changes, pass));
            }
        }
    }
}

/// A clamp that slips says how far; one that does not holds the cable of the independent chain: 320 N are left for the joint.
#[test]
fn a_clamp_that_has_slipped_says_so() {
    let slipping = run(&[r#"restraints=[{position="30 m", stiffness="5 MN/m", holds="200 N"}]"#]);
    let slipped = slipping.restraints[0].slipped_m.expect("a clamp that slips");
    // The cable there has moved by ∫ F/EA dx up to the fixed end, and the clamp's spring by its force over its stiffness.
    let profile = &slipping.force_profile;
    let spacing = profile.positions_m[1] - profile.positions_m[0];
    let beyond = |middle: &f64| (middle - 30.0 + 0.5 * spacing).clamp(0.0, spacing);
    let pieces = profile.positions_m.iter().map(beyond).zip(&profile.force_n);
    let moved = pieces.map(|(length, force)| length * force).sum::<f64>() / 8.01e6;
    let expected = moved - slipping.restraints[0].force_n / 5e6;
    assert_near(slipped, expected, 1e-6, ());
    let firm = run(&[r#"restraints=[{position="30 m", stiffness="5 MN/m"}]"#]);
    assert_eq!(firm.restraints[0].slipped_m, None);
    assert_near(last(&firm).downstream_force_n, 320.0, 0.01, ());
}

/// Seen from the other side of the road, vehicles of very different weight over a tight bend leave the same forces all along the cable.
#[test]
fn a_tight_bend_has_no_direction() {
    let left_by = |ends: &str, directions: [&str; 3]| {
        let [light, heavy, back] = directions;
        let vehicles = format!(
            r#"vehicles=[{{load="2 tf", speed="40 km/h", direction="{light}"}}, {{load="50 tf", speed="40 km/h", direction="{heavy}"}},
            {{load="50 tf", speed="40 km/h", direction="{back}"}}]"#
        );
        let run = run(&[
            "duct.length=120 m",
            r#"route=[{length="30 m"}, {length="60 m", bend_radius="2 m"}, {}]"#,
            "ground.layers.0.young_modulus=60 MPa",
            r#"friction={law="coulomb", dynamic_coefficient=0.3}"#,
            ends,
            &vehicles,
            "traffic.passes=3",
            r#"solver={method="quasi-static", tolerance=0.4, node_spacing=0.1, vehicle_step=0.6}"#,
        ]);
        run.force_profile.force_n
    };
    let (forward, reverse) = ("forward", "reverse");
    let [ends, swapped] = [
        r#"ends={upstream="free", downstream={spring=1e5}}"#,
        r#"ends={upstream={spring=1e5}, downstream="free"}"#,
    ];
    let own = left_by(ends, [forward, reverse, forward]);
    let mirrored = left_by(swapped, [reverse, forward, reverse]);
    let largest = largest(own.iter().copied());
    for (force, other) in own.iter().zip(mirrored.iter().rev()) {
        assert_within(*force, *other, 1e-9 * largest, "N");
    }
}

/// A mesh of its own, so that both parts have the same.
const MESH: [&str; 2] = ["solver.node_spacing=0.15 m", "solver.vehicle_step=0.075 m"];

/// A run that goes on from the state of another one.
fn go_on(before: &Run, changes: &[&str]) -> Result<Run, creepage::Error> {
    let options = creepage::RunOptions {
        start: before.state.as_ref(),
        ..creepage::RunOptions::default()
    };
    creepage::run_with(&scene(changes), &options)
}

#[test]
fn two_parts_are_one_life() {
    let route = r#"route=[{length="22 m", slope="2 %"}, {length="15 m", bend_radius="6 m"}, {}]"#;
    let clamp = r#"restraints=[{position="31.3 m", stiffness="5 MN/m", holds="100 N"}]"#;
    let ends = r#"ends={upstream={spring="1 MN/m"}, downstream="fixed"}"#;
    for method in ["solver.method=quasi-static", "solver.method=pass-law"] {
        let common = [MESH[0], MESH[1], route, clamp, ends, method];
        let with = |passes: &'static str| [&common[..], &[passes]].concat();
        let whole = run(&with("traffic.passes=60"));
        let first = run(&with("traffic.passes=25"));
        let second = go_on(&first, &with("traffic.passes=35")).expect("a second part");
        assert_eq!(second.start.expect("a start").passes, 25);
        let [one, two] = [&whole, &second].map(last);
        let accuracy = if method.ends_with("static") { 1e-9 } else { 0.01 };
        for (a, b) in [
            (one.downstream_force_n, two.downstream_force_n),
            (one.upstream_force_n, two.upstream_force_n),
            (one.upstream_displacement_m, two.upstream_displacement_m),
            (whole.restraints[0].force_n, second.restraints[0].force_n),
        ] {
            assert_near(b, a, accuracy, method);
        }
        let [one_slip, two_slip] = [&whole, &second].map(|run| run.restraints[0].slipped_m.expect("a slip"));
        assert_near(two_slip, one_slip, accuracy, method);
        // On meshes that the plan chooses.
        let changes = [route, clamp, ends, "traffic.passes=35"];
        let other = go_on(&first, &changes).expect("another mesh");
        let found = last(&other).downstream_force_n;
        assert_near(found, one.downstream_force_n, 0.02, method);
    }
}

/// What is new bears nothing at first, and what was there goes on bearing what it bore.
#[test]
fn new_clamps_and_new_ends_bear_nothing_at_first() {
    let common = [MESH[0], MESH[1], "traffic.passes=40"];
    let first = run(&common);
    let force = |run: &Run| run.passes[0].downstream_force_n;
    let with = |before: &Run, change: &str| {
        let one_more = [MESH[0], MESH[1], "traffic.passes=1", change];
        go_on(before, &one_more).unwrap_or_else(|error| panic!("{change}: {error}"))
    };
    let plain = with(&first, "restraints=[]");
    // So soft that one pass loads it by far less than what the cable has moved.
    let clamp = r#"restraints=[{position="2 m", stiffness="1 kN/m"}]"#;
    let clamped = with(&first, clamp);
    let moved = last(&first).upstream_displacement_m;
    assert!(clamped.restraints[0].force_n.abs() < 0.2 * 1e3 * moved);
    assert_near(force(&clamped), force(&plain), 1e-3, "N");
    // One that slips has not slipped yet, wherever the cable had moved before.
    let holds = r#"restraints=[{position="2 m", stiffness="1 kN/m", holds="1 kN"}]"#;
    let held = with(&first, holds);
    assert_eq!(held.restraints[0].slipped_m, Some(0.0));
    assert_eq!(with(&held, holds).restraints[0].slipped_m, Some(0.0));
    // Nor does one that was moved, whatever it bore where it was.
    let stiff = r#"restraints=[{position="5 m", stiffness="1 MN/m"}]"#;
    let held = run(&[&common[..], &[stiff]].concat());
    for moved_to in [clamp, r#"restraints=[{position="5 m", stiffness="1 kN/m"}]"#] {
        let force = with(&held, moved_to).restraints[0].force_n;
        assert!(force.abs() < 0.2 * 1e3 * moved, "{moved_to}");
    }
    // The joint gives way: its new spring bears nothing, and the cable springs back.
    let spring = r#"ends={upstream="free", downstream={spring="1 kN/m"}}"#;
    let soft = with(&first, spring);
    assert!(force(&soft) < 0.05 * force(&plain), "{} N", force(&soft));
    // And held again where it is: no step in any force.
    let again = with(&soft, spring);
    assert!(again.passes[0].downstream_displacement_m >= soft.passes[0].downstream_displacement_m);
}

#[test]
fn a_state_of_another_duct_is_refused() {
    let first = run(&[MESH[0], MESH[1], "traffic.passes=2"]);
    for (change, key) in [
        ("duct.length=61 m", "duct.length"),
        ("cable.weight=100 N/m", "cable.weight"),
        ("cable.axial_stiffness=9 MN", "cable.axial_stiffness"),
        (r#"route=[{length="30 m"}, {slope="1 %"}]"#, "sections"),
        ("friction.dynamic_coefficient=0.3", "friction of section 1"),
        ("friction.dynamic_coefficient=0", "friction"),
    ] {
        let refused = go_on(&first, &["traffic.passes=2", change]).expect_err(change);
        assert!(refused.is_bad_input(), "{refused}");
        assert!(refused.to_string().contains(key), "{refused}");
    }
    // Read and written to the last bit; changed, it is refused.
    let text = serde_json::to_string(&first.state).expect("JSON");
    let state: creepage::SavedState = serde_json::from_str(&text).expect("a state");
    assert_eq!(Some(&state), first.state.as_ref());
    let changed = text.replacen("108.8", "108.9", 1);
    let changed: creepage::SavedState = serde_json::from_str(&changed).expect("a state");
    let options = creepage::RunOptions {
        start: Some(&changed),
        ..creepage::RunOptions::default()
    };
    let refused = creepage::run_with(&scene(&["traffic.passes=2"]), &options).expect_err("a changed state");
    assert!(refused.to_string().contains("changed after"), "{refused}");
}

/// Readings by the independent chain of a duct whose second half rubs with 0.35.
#[test]
fn the_friction_of_a_section_is_fitted() {
    let section: Unknown = "route.1.dynamic_coefficient".parse().expect("an unknown");
    let options = CalibrateOptions {
        unknowns: vec![section],
        ..CalibrateOptions::default()
    };
    let forces = [Reading::force(1, 110.141), Reading::force(10, 298.274)];
    let readings: Readings = forces.into_iter().collect();
    let halves = scene(&[r#"route=[{length="30 m"}, {}]"#]);
    let fit = creepage::calibrate(&halves, &readings, &options).expect("a fit");
    let [found] = &fit.parameters[..] else {
        panic!("{:?}", fit.parameters);
    };
    assert_eq!(found.name, "route.1.dynamic_coefficient");
    assert_near(found.value, 0.35, 0.01, "fitted");
    let error = creepage::calibrate(&scene(&[]), &readings, &options).expect_err("no route");
    assert!(error.is_bad_input(), "{error}");
    assert!(error.to_string().contains("route"), "{error}");
}

/// What was reached once is not undone by passes that drive it back.
#[test]
fn a_clamp_that_slips_to_and_fro_has_moved_as_far_as_it_did() {
    let vehicles = r#"vehicles=[{ name = "there", load = "196133 N", speed = "40 km/h" },
        { name = "back", load = "196133 N", speed = "40 km/h", direction = "reverse" }]"#;
    let names = [vec!["\"there\""; 15], vec!["\"back\""; 15]].concat().join(", ");
    let sequence = format!("traffic.sequence=[{names}]");
    let clamp = r#"restraints=[{position="30 m", stiffness="5 MN/m", holds="100 N"}]"#;
    let of = |passes: &str| {
        let common = [vehicles, &sequence, clamp, "ends.downstream=free"];
        let run = run(&[&common[..], &MESH, &[passes]].concat());
        let limits = EndLimits {
            force_n: Some(100.0),
            movement_m: None,
        };
        let position_m = 30.0;
        let limits = Limits {
            clamps: vec![ClampLimits { position_m, limits }],
            ..Limits::default()
        };
        // It bears what it holds and no more: a limit of that is kept.
        assert!(limits.verdicts(&run).iter().all(|verdict| !verdict.is_exceeded()));
        assert!(largest(run.restraints[0].during_passes_n.iter().copied()) > 99.0);
        run.largest(Place::Clamp(30.0), Limited::Movement)
    };
    let (there, back) = (of("traffic.passes=15"), of("traffic.passes=30"));
    assert!(there > 1e-4 && back >= there, "{there} {back}");
}

/// A spring that was put on when the cable had moved bears nothing at first: its end moves with the force from there on.
#[test]
fn the_end_on_a_later_spring_moves_by_its_force_over_its_stiffness() {
    let free = run(&[MESH[0], MESH[1], "traffic.passes=20", "ends.downstream=free"]);
    let spring = r#"ends.downstream={spring="3 MN/m"}"#;
    let sprung = go_on(&free, &[MESH[0], MESH[1], "traffic.passes=2", spring]).expect("a second part");
    let during = |pass: &PassRecord| [pass.downstream_peak_n, pass.downstream_least_n];
    let after = sprung.passes.iter().map(|pass| pass.downstream_force_n);
    let stretch = largest(sprung.passes.iter().flat_map(during).chain(after)) / 3e6;
    let moved = sprung.largest(CableEnd::Downstream, Limited::Movement);
    assert_within(moved, last(&free).downstream_displacement_m, 1.01 * stretch, "m");
}
