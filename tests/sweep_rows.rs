//! Rows of a sweep: any part can be computed anywhere, samples follow from their row alone, and coarse meshes are as good as they say.

use std::mem::discriminant;
use std::ops::ControlFlow;

use creepage::sweep::{
    AnswerColumn, AnswerValues, Axis, PointLimits, Samples, Sweep, SweepError, SweepOptions,
};
use creepage::{CableEnd, Limited, Limits, Progress, SceneFile, Verdict};

use crate::command::{UPPER, folder, output, read, table as table_of};
use crate::scenes::{by_threads, last, run, upper_file as file};

const FRICTION: &str = "friction.dynamic_coefficient";

/// What makes a run of a few milliseconds.
const QUICK: [&str; 2] = ["traffic.passes=1", "solver.tolerance=0.1"];

fn table(columns: &[(&str, &[&str])]) -> Vec<(String, Vec<String>)> {
    let texts = |values: &[&str]| values.iter().map(|value| (*value).to_owned()).collect();
    columns
        .iter()
        .map(|(key, values)| ((*key).to_owned(), texts(values)))
        .collect()
}

fn answers(sweep: &Sweep) -> Vec<AnswerColumn> {
    sweep.answers(&SweepOptions::default()).unwrap()
}

fn numbers<'a>(columns: &'a [AnswerColumn], name: &str) -> &'a [Option<f64>] {
    match &columns.iter().find(|column| column.name == name).unwrap().values {
        AnswerValues::Numbers(numbers) => numbers,
        _ => panic!("{name} holds no numbers"),
    }
}

/// With the ground that another row has left behind, too.
#[test]
fn a_row_is_the_run_of_its_scene_to_the_last_bit() {
    let keys = "friction.dynamic_coefficient=0.3; cable.axial_stiffness=9e6; duct.length=40 m; duct.depth=2 m; \
        vehicles.0.load=10 tf; ground.layers.0.young_modulus=400 MPa; vehicles.0.lateral_offset=1 m; ground.vertical_peak=90 um";
    // In each row one key of them, and none in the last.
    let columns = keys.split("; ").enumerate().map(|(at, set)| {
        let (key, value) = set.split_once('=').unwrap();
        let cell = |row| {
            if row == at {
                value.to_owned()
            } else {
                String::new()
            }
        };
        (key.to_owned(), (0..9).map(cell).collect())
    });
    let base = file(&["traffic.passes=2", "solver.tolerance=0.1"]);
    let sweep = Sweep::of_table(base, columns.collect(), Samples::default()).unwrap();
    let found = by_threads(1, || answers(&sweep));
    for row in 0..9 {
        let run = run(&sweep.scene(row).unwrap());
        for (name, alone) in [
            ("downstream_force_n", last(&run).downstream_force_n),
            ("max_compression_n", last(&run).max_compression_n),
            ("upstream_displacement_m", last(&run).upstream_displacement_m),
            ("error_estimate", run.error_estimate.relative),
        ] {
            assert_eq!(numbers(&found, name)[row], Some(alone), "{row}: {name}");
        }
    }
}

/// The verdict of a row is that of its run.
#[test]
fn rows_are_judged_by_limits() {
    let base = file(&["traffic.passes=20", "traffic.per_day=4", "solver.tolerance=0.05"]);
    let columns = table(&[(FRICTION, &["0.1", "0.3", "0.5"])]);
    let sweep = Sweep::of_table(base, columns, Samples::default()).unwrap();
    let runs: Vec<_> = (0..3).map(|row| run(&sweep.scene(row).unwrap())).collect();
    let largest = |run| creepage::Run::largest(run, CableEnd::Downstream, Limited::Force);
    let limits = Limits::both(Some(0.5 * (largest(&runs[0]) + largest(&runs[1]))), None);
    let own = limits.clone();
    let found = answers(&sweep.with_limits(PointLimits::new("half way", move |_| Ok(own.clone()))));
    let exceeded = found.iter().find(|column| column.name == "limit_exceeded");
    let verdicts: Vec<_> = runs.iter().map(|run| limits.verdicts(run)[1]).collect();
    let expected: Vec<_> = verdicts
        .iter()
        .map(|verdict| Some(verdict.is_exceeded()))
        .collect();
    assert!(expected.contains(&Some(true)) && expected.contains(&Some(false)));
    assert_eq!(exceeded.unwrap().values, AnswerValues::Flags(expected));
    let years = |verdict: &Verdict| verdict.reached_after.and_then(|reached| reached.years);
    let years: Vec<_> = verdicts.iter().map(years).collect();
    assert_eq!(numbers(&found, "limit_reached_after_years"), years);
}

/// Limits of clamps are those of every point; one that a point does not have is its error.
#[test]
fn clamps_are_judged_where_they_are() {
    let out = folder("sweep-clamps").join("clamps.csv");
    let sweep = |limit: &str| {
        let scene = "--set 'restraints=[{ position = 10, stiffness = 1e6 }]' --set traffic.passes=3 --set solver.tolerance=0.1";
        let vary = "--vary restraints.0.position=10m,20m";
        output(&format!(
            "sweep UPPER {scene} {vary} --limit-force '{limit}' --out {}",
            out.display()
        ));
        let (names, rows) = table_of(&out);
        let flag = names.iter().position(|name| name == "limit_exceeded").unwrap();
        rows.into_iter().map(|row| row[flag].clone()).collect::<Vec<_>>()
    };
    assert_eq!(sweep("clamp=1N"), ["true", "true"]);
    assert_eq!(sweep("10 m=1N"), ["true", ""]);
}

#[test]
fn samples_follow_from_the_seed_the_id_the_key_and_their_number_alone() {
    let base = || file(&QUICK);
    let samples = Samples { count: 3, seed: 7 };
    let law = "normal(0.25, 0.03)";
    let both = table(&[
        ("id", &["A", "B"]),
        ("duct.depth", &["1.2", "2"]),
        (FRICTION, &[law, law]),
    ]);
    let both = answers(&Sweep::of_table(base(), both, samples).unwrap());
    // Another part, other columns, the distribution in the scene in place of the table.
    let file = base().with(&[format!("{FRICTION}={law}")]).unwrap();
    let alone = table(&[("duct.depth", &["2"]), ("id", &["B"])]);
    let alone = answers(&Sweep::of_table(file, alone, samples).unwrap());
    for name in [FRICTION, "downstream_force_n"] {
        assert_eq!(numbers(&both, name)[3..], *numbers(&alone, name), "{name}");
        assert_ne!(numbers(&both, name)[..3], numbers(&both, name)[3..], "{name}");
    }
    // Another drawn key leaves them as they are, and another seed does not.
    let more = table(&[
        ("id", &["B"]),
        ("duct.depth", &["uniform(1, 2)"]),
        (FRICTION, &[law]),
    ]);
    let more = answers(&Sweep::of_table(base(), more, samples).unwrap());
    assert_eq!(numbers(&more, FRICTION), numbers(&alone, FRICTION));
    let other = table(&[("id", &["B"]), ("duct.depth", &["2"]), (FRICTION, &[law])]);
    let other = Sweep::of_table(base(), other, Samples { count: 3, seed: 8 }).unwrap();
    assert_ne!(numbers(&answers(&other), FRICTION), numbers(&alone, FRICTION));
}

#[test]
fn distributions_of_rows_that_do_not_fit_are_refused() {
    let none = Samples::default();
    let two = Samples { count: 2, seed: 1 };
    let depths = ("duct.depth", &["1", "2"][..]);
    for (columns, samples) in [
        (vec![depths, (FRICTION, &["normal(0.2, 0.1)", ""][..])], none),
        (vec![depths, (FRICTION, &["normal(0.2)", ""])], two),
        (vec![depths, (FRICTION, &["0.2"])], none),
        (vec![("id", &["1", "2"])], none),
    ] {
        let refused = Sweep::of_table(file(&[]), table(&columns), samples);
        assert!(refused.is_err_and(|error| error.is_bad_input()), "{columns:?}");
    }
}

/// The errors that samples on coarse meshes state, against runs that find theirs out.
#[test]
fn samples_on_a_coarse_mesh_are_as_good_as_they_say_and_cheap() {
    let base = || file(&["solver.tolerance=0.02", "traffic.passes=30"]);
    let law = "normal(0.25, 0.04)";
    let samples = Samples { count: 15, seed: 3 };
    let sweep = Sweep::of_table(base(), table(&[(FRICTION, &[law])]), samples).unwrap();
    let answers = answers(&sweep);
    for sample in (0..15).step_by(5) {
        let of = |name| numbers(&answers, name)[sample].unwrap();
        let set = [
            format!("{FRICTION}={}", of(FRICTION)),
            "solver.tolerance=0.005".to_owned(),
        ];
        let run = run(&base().with(&set).unwrap().scene().unwrap());
        assert!(run.cost.node_updates > 3_000_000);
        let off = (of("max_compression_n") / last(&run).max_compression_n - 1.0).abs();
        let stated = of("error_estimate");
        assert!(off <= stated && stated <= 0.05, "{sample} {off} {stated}");
        assert_ne!(off, 0.0, "it was computed on the same mesh");
    }
}

/// What a row says of an end as a whole counts, also where the scene draws that end's spring.
#[test]
fn a_row_replaces_a_section_in_which_the_scene_draws() {
    let file = file(&[
        "traffic.passes=1",
        "solver.tolerance=0.1",
        "ends.downstream={ spring = \"normal(0.3 MN/m, 0.03 MN/m)\" }",
    ]);
    let rows = table(&[("ends.downstream", &["fixed", ""])]);
    let sweep = Sweep::of_table(file, rows, Samples { count: 2, seed: 1 }).unwrap();
    let columns = answers(&sweep);
    let forces = numbers(&columns, "downstream_force_n");
    assert!(forces[..2].iter().all(|force| *force > Some(90.0)), "{forces:?}");
    assert!(forces[2..].iter().all(|force| *force < Some(30.0)), "{forces:?}");
}

/// A table of axle loads that only the rows name is part of the sweep: answers of two tables do not mix.
#[test]
fn a_sweep_does_not_go_on_with_another_table_of_axles() {
    let folder = folder("rows-of-axles");
    let text = read(UPPER);
    let text = text[..text.find("[[vehicles]]").unwrap()].to_owned()
        + "[traffic]\npasses = 2\nspeed = \"40 km/h\"\n[solver]\ntolerance = 0.1\n";
    let axles =
        |load: &str| std::fs::write(folder.join("axles.csv"), format!("load,count\n{load},1\n")).unwrap();
    let run = |stop: bool| {
        let name = folder.join("scene.toml");
        let file = SceneFile::from_toml(name.to_str().unwrap(), &text).unwrap();
        let rows = table(&[
            ("traffic.histogram", &["axles.csv"; 2]),
            ("duct.depth", &["1.2", "2"]),
        ]);
        let sweep = Sweep::of_table(file, rows, Samples::default()).unwrap();
        assert!(sweep.files().into_iter().eq([folder.join("axles.csv")]));
        let halt = |share| match share {
            share if stop && share > 0.0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let options = SweepOptions {
            progress: Progress::new(&halt),
            ..SweepOptions::default()
        };
        by_threads(1, || sweep.run(&folder.join("out.csv"), &options))
    };
    axles("100 kN");
    let stopped = run(true).unwrap_err();
    assert!(matches!(stopped, SweepError::Stopped) && !stopped.is_bad_input());
    axles("120 kN");
    assert!(matches!(run(false), Err(SweepError::OtherRows(..))));
    axles("100 kN");
    let summary = run(false).unwrap();
    assert_eq!((summary.resumed, summary.failed), (1, 0));
}

#[test]
fn a_text_where_others_draw_fails_in_its_row_alone() {
    let base = || file(&QUICK);
    let samples = Samples { count: 2, seed: 1 };
    let cells = table(&[("id", &["A", "B"]), (FRICTION, &["normal(0.25, 0.03)", "much"])]);
    let whole = answers(&Sweep::of_table(base(), cells, samples).unwrap());
    assert!(numbers(&whole, FRICTION)[..2].iter().all(Option::is_some));
    assert_eq!(numbers(&whole, FRICTION)[2..], [None, None]);
    // A part of it in which nothing is drawn has the same columns.
    let cells = table(&[("id", &["B"]), (FRICTION, &["much"])]);
    assert!(Sweep::of_table(base(), cells.clone(), samples).is_err());
    let part = Sweep::of_part(base(), cells, samples, [FRICTION.to_owned()]).unwrap();
    let form = |column: &AnswerColumn| (column.name.clone(), discriminant(&column.values));
    assert!(answers(&part).iter().map(form).eq(whole.iter().map(form)));
}

#[test]
fn a_row_without_an_id_is_known_by_its_number() {
    let base = || file(&QUICK);
    let law = "normal(0.25, 0.03)";
    let drawn = |ids: &[&str]| {
        let cells = table(&[("id", ids), (FRICTION, &[law; 2])]);
        let sweep = Sweep::of_table(base(), cells, Samples { count: 1, seed: 1 }).unwrap();
        [sweep.values(0)[1].clone(), sweep.values(1)[1].clone()]
    };
    assert_eq!(drawn(&["", "B"])[0], drawn(&["0", "1"])[0]);
    assert_ne!(drawn(&["", "B"])[1], drawn(&["", ""])[1]);
}

/// A grid draws what the scene draws, the same at all its points.
#[test]
fn a_grid_draws_what_the_scene_draws() {
    let drawn = file(&["friction.dynamic_coefficient=normal(0.25, 0.03)"]);
    let axis = || vec![Axis::parse("duct.depth=1 m,2 m").unwrap()];
    assert!(Sweep::new(drawn.clone(), axis(), Samples::default()).is_err());
    let sweep = Sweep::new(drawn, axis(), Samples { count: 3, seed: 1 }).unwrap();
    let friction = |point| sweep.scene(point).unwrap().friction.dynamic_coefficient;
    let scattered: Vec<f64> = (0..6).map(friction).collect();
    assert_eq!(scattered[..3], scattered[3..]);
    assert!(scattered[0] != scattered[1] && sweep.scene(3).unwrap().duct.depth == 2.0);
}
