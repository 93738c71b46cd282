//! Sweeps: the grid, its table, what survives an interruption, and quantiles of drawn keys.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use creepage::readings::TableOptions;
use creepage::scene::End;
use creepage::sweep::{Axis, Band, Distribution, Samples, Sweep, SweepError, SweepOptions, SweepSummary};
use creepage::{Error, ErrorSource, Run, Scene, SceneFile};

use crate::command::{folder, read, table};
use crate::scenes::{by_threads, run as run_of, upper_file};

const FRICTION: &str = "friction.dynamic_coefficient";

fn sweep_of(axes: &[&str], samples: Samples) -> Sweep {
    let axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
    Sweep::new(upper_file(&["traffic.passes=1"]), axes, samples).unwrap()
}

fn sweep(axes: &[&str]) -> Sweep {
    sweep_of(axes, Samples::default())
}

/// A path for a test's output, with nothing there.
fn output(name: &str) -> PathBuf {
    folder(&format!("sweep/{name}")).join("out.csv")
}

fn unfinished(output: &Path) -> PathBuf {
    output.with_extension("csv.unfinished")
}

/// How a point is answered.
type Evaluate<'a> = &'a (dyn Fn(&Scene) -> Result<Run, Error> + Sync);

/// A run whose downstream force follows from the scene by a formula; the rest is that of a real run.
fn formula(force: impl Fn(&Scene) -> f64 + Sync) -> impl Fn(&Scene) -> Result<Run, Error> + Sync {
    let template = run_of(&sweep(&["traffic.passes=1"]).scene(0).unwrap());
    move |scene| {
        let mut run = template.clone();
        run.passes[0].downstream_force_n = force(scene);
        Ok(run)
    }
}

fn run_by(
    sweep: &Sweep,
    output: &Path,
    threads: usize,
    evaluate: Evaluate<'_>,
) -> Result<SweepSummary, SweepError> {
    let options = SweepOptions {
        evaluate: Some(evaluate),
        ..SweepOptions::default()
    };
    by_threads(threads, || sweep.run(output, &options))
}

/// A sweep in whose table's place a folder comes while it computes: the rows of all points are left, and nothing else.
fn blocked(sweep: &Sweep, output: &Path, evaluate: Evaluate<'_>) {
    let evaluate = |scene: &Scene| {
        let _ = fs::create_dir(output);
        evaluate(scene)
    };
    assert!(run_by(sweep, output, 2, &evaluate).is_err());
    fs::remove_dir(output).unwrap();
    let left: Vec<_> = fs::read_dir(output.parent().unwrap()).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn the_last_key_changes_fastest() {
    let sweep = sweep(&["friction.dynamic_coefficient=0.2:0.4:0.1", "duct.depth=1m,2m"]);
    assert_eq!(sweep.count(), 6);
    let values: Vec<String> = (0..6).map(|i| sweep.values(i).join(" ")).collect();
    assert_eq!(
        values.join(", "),
        "0.2 1m, 0.2 2m, 0.3 1m, 0.3 2m, 0.4 1m, 0.4 2m"
    );
    let scene = sweep.scene(3).unwrap();
    assert_eq!((scene.friction.dynamic_coefficient, scene.duct.depth), (0.3, 2.0));
}

#[test]
fn a_row_is_the_run_of_its_point_and_a_failing_point_stops_nothing() {
    let output = output("rows");
    let sweep = sweep(&[
        "friction.dynamic_coefficient=0.2,-1",
        "ends.downstream=fixed,{ spring = \"3 MN/m\" }",
        "vehicles.0.load=10 tf,200 kN",
        "traffic.passes=1,100",
    ]);
    let summary = sweep.run(&output, &SweepOptions::default()).unwrap();
    assert_eq!((summary.points, summary.failed, summary.resumed), (16, 8, 0));
    assert!(summary.first_error.unwrap().contains("found -1"));
    let (header, rows) = table(&output);
    assert_eq!(header[..3], [FRICTION, "ends.downstream", "vehicles.0.load"]);
    assert_eq!(rows.len(), 16);
    for (index, row) in rows.iter().enumerate() {
        let cell = |name: &str| &*row[header.iter().position(|found| found == name).unwrap()];
        if index >= 8 {
            assert_eq!((cell("status"), cell("downstream_force_n")), ("error", ""));
            assert!(cell("error").contains("found -1"), "{row:?}");
            continue;
        }
        let run = run_of(&sweep.scene(index).unwrap());
        let last = run.passes.last().unwrap();
        let saturation = run.saturation.as_ref();
        assert!(cell("status") == "ok" && saturation.is_some() == (index % 2 == 1));
        for (name, expected) in [
            ("downstream_force_n", Some(last.downstream_force_n)),
            ("upstream_displacement_m", Some(last.upstream_displacement_m)),
            ("downstream_displacement_m", Some(last.downstream_displacement_m)),
            ("max_compression_n", Some(last.max_compression_n)),
            ("error_estimate", Some(run.error_estimate.relative)),
            ("saturation_force_n", saturation.map(|level| level.force_n)),
            (
                "passes_to_95_percent",
                saturation.map(|level| level.passes_to_95_percent as f64),
            ),
            // In SI, whatever the unit of the list.
            ("vehicles.0.load", Some([98_066.5, 200e3][index / 2 % 2])),
        ] {
            assert_eq!(cell(name).parse().ok(), expected, "{name}");
        }
    }
    assert!(!unfinished(&output).exists());
}

/// One that panics, and one whose answer is no number.
#[test]
fn points_without_an_answer_fail_alone() {
    let output = output("failing");
    let sweep = sweep(&["duct.length=10m,20m,30m,40m"]);
    let evaluate = formula(|scene| match scene.duct.length {
        10.0 => f64::NAN,
        20.0 => f64::INFINITY,
        30.0 => panic!("a panic that this test wants"),
        _ => 1.0,
    });
    let summary = run_by(&sweep, &output, 2, &evaluate).unwrap();
    assert_eq!((summary.points, summary.failed), (4, 3));
    let (_, rows) = table(&output);
    let words = ["came out as NaN", "came out as inf", "broke off", ""];
    for (row, words) in rows.iter().zip(words) {
        let error = row.last().unwrap();
        assert!(error.contains(words) && error.is_empty() == words.is_empty());
    }
    let is_infinite = |cell: &String| cell.parse().is_ok_and(|value: f64| !value.is_finite());
    assert!(!rows.iter().flatten().any(is_infinite), "{rows:?}");
}

#[test]
fn wherever_a_sweep_was_cut_off_it_ends_with_the_same_file() {
    let output = output("resume");
    let sweep = sweep(&["friction.dynamic_coefficient=0.1:1:0.1", "duct.length=20m,30m"]);
    let force = formula(|scene| scene.duct.length * scene.friction.dynamic_coefficient.sqrt());
    let calls = AtomicUsize::new(0);
    let evaluate = |scene: &Scene| {
        calls.fetch_add(1, Ordering::SeqCst);
        if scene.friction.dynamic_coefficient == 0.5 {
            // Fails, and stays failed: a finished point is not redone.
            return Err(Error::Inaccurate {
                reached: 1.0,
                asked: 0.1,
                cause: ErrorSource::Mesh,
            });
        }
        force(scene)
    };
    run_by(&sweep, &output, 2, &evaluate).unwrap();
    let undisturbed = fs::read(&output).unwrap();
    assert_eq!(calls.swap(0, Ordering::SeqCst), 20);

    fs::remove_file(&output).unwrap();
    blocked(&sweep, &output, &evaluate);
    let whole = fs::read(unfinished(&output)).unwrap();
    calls.store(0, Ordering::SeqCst);

    for cut in (0..=whole.len()).step_by(67).chain([whole.len()]) {
        fs::write(unfinished(&output), &whole[..cut]).unwrap();
        let lines = whole[..cut].split(|&byte| byte == b'\n').count();
        let kept = lines.saturating_sub(3);
        let summary = run_by(&sweep, &output, 3, &evaluate).unwrap();
        assert_eq!(summary.resumed, kept, "cut at {cut}");
        assert_eq!(calls.swap(0, Ordering::SeqCst), 20 - kept, "cut at {cut}");
        assert_eq!((summary.points, summary.failed), (20, 2));
        assert_eq!(fs::read(&output).unwrap(), undisturbed, "cut at {cut}");
        assert!(!unfinished(&output).exists());
    }

    // In whatever order its rows were finished.
    let text = String::from_utf8(whole).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let turned = lines[..2].iter().chain(lines[2..].iter().rev());
    let turned: Vec<String> = turned.map(|line| format!("{line}\n")).collect();
    fs::write(unfinished(&output), turned.concat()).unwrap();
    assert_eq!(run_by(&sweep, &output, 2, &evaluate).unwrap().resumed, 20);
    assert_eq!(fs::read(&output).unwrap(), undisturbed);

    // What is no row costs what follows it, and nothing else.
    let mut lines = lines;
    lines[12] = "0.5,20,much";
    fs::write(unfinished(&output), lines.join("\n")).unwrap();
    assert_eq!(run_by(&sweep, &output, 1, &evaluate).unwrap().resumed, 10);
    assert_eq!(fs::read(&output).unwrap(), undisturbed);
}

#[test]
fn rows_of_something_else_are_refused_and_kept() {
    let evaluate = formula(|_| 1.0);
    let text = read("examples/scenes/full-scale-upper.toml");
    let of = |axis: &str, text: &str| {
        let file = SceneFile::from_toml("scene", text).unwrap();
        Sweep::new(file, vec![Axis::parse(axis).unwrap()], Samples::default()).unwrap()
    };
    let output = output("other");
    let first = of("duct.length=10m,20m", &text);
    blocked(&first, &output, &evaluate);
    let left = fs::read(unfinished(&output)).unwrap();
    for other in [
        of("duct.length=10m,30m", &text),
        of("friction.dynamic_coefficient=0.1,0.2", &text),
        of(
            "duct.length=10m,20m",
            &text.replace("passes = 200", "passes = 201"),
        ),
    ] {
        let error = run_by(&other, &output, 1, &evaluate).unwrap_err();
        let is_other = matches!(error, SweepError::OtherRows { .. });
        assert!(is_other && error.is_bad_input(), "{error}");
        assert_eq!(fs::read(unfinished(&output)).unwrap(), left);
    }
    // Remarks in a scene make no other sweep.
    let remarked = text.replace("passes = 200", "passes  =  200  # enough");
    let remarked = of("duct.length=10m,20m", &format!("# a remark\n\n{remarked}"));
    assert_eq!(run_by(&remarked, &output, 1, &evaluate).unwrap().resumed, 2);
    fs::write(unfinished(&output), "my notes\n").unwrap();
    let refused = run_by(&first, &output, 1, &evaluate);
    assert!(matches!(refused, Err(SweepError::OtherRows { .. })));
    assert_eq!(fs::read(unfinished(&output)).unwrap(), b"my notes\n");
}

#[cfg(unix)]
#[test]
fn what_comes_to_the_output_meanwhile_is_kept() {
    let output = output("meanwhile");
    let notes = output.with_file_name("notes");
    std::os::unix::fs::symlink(&notes, &output).unwrap();
    let sweep = sweep(&["duct.length=10m,20m"]);
    let force = formula(|_| 1.0);
    let evaluate = |scene: &Scene| {
        fs::write(&notes, "notes\n").unwrap();
        force(scene)
    };
    let refused = run_by(&sweep, &output, 1, &evaluate);
    assert!(matches!(refused, Err(SweepError::Output(_))));
    assert_eq!(fs::read(&notes).unwrap(), b"notes\n");
    // With another place for the notes nothing is computed again.
    fs::remove_file(&notes).unwrap();
    assert_eq!(run_by(&sweep, &output, 1, &force).unwrap().resumed, 2);
}

#[test]
fn two_sweeps_do_not_write_the_same_file() {
    let output = output("busy");
    let sweep = sweep(&["friction.dynamic_coefficient=0.1,0.2"]);
    let force = formula(|_| 1.0);
    let inner = Mutex::new(None);
    let evaluate = |scene: &Scene| {
        inner
            .lock()
            .unwrap()
            .get_or_insert_with(|| run_by(&sweep, &output, 1, &force));
        force(scene)
    };
    run_by(&sweep, &output, 1, &evaluate).unwrap();
    let inner = inner.into_inner().unwrap().unwrap();
    assert!(matches!(inner, Err(SweepError::Busy { .. })), "{inner:?}");
}

/// What is drawn by other laws follows from their quantiles, which tests of creepage-study know.
#[test]
fn quantiles_of_a_linear_key_are_those_of_its_distribution() {
    let count = 2000;
    let law = "normal(0.25, 0.03)";
    let sweep = sweep_of(&[&format!("{FRICTION}={law}")], Samples { count, seed: 3 });
    let evaluate = formula(|scene| 1000.0 * scene.friction.dynamic_coefficient);
    let summary = run_by(&sweep, &output("quantiles"), 2, &evaluate).unwrap();
    let [band] = &summary.bands[..] else {
        panic!("{:?}", summary.bands)
    };
    assert_eq!((band.samples, band.failed), (count, 0));
    let drawn = Distribution::parse(law).expect("a call").expect("a distribution");
    let forces = band.downstream_force_n.unwrap();
    let found = [forces.p05, forces.p25, forces.p50, forces.p75, forces.p95];
    for (p, found) in [0.05, 0.25, 0.5, 0.75, 0.95_f64].into_iter().zip(found) {
        // The share of samples below a value, to four times its standard error.
        let error = 4.0 * (p * (1.0 - p) / count as f64).sqrt();
        let [low, high] = [p - error, p + error].map(|p| 1000.0 * drawn.quantile(p).0);
        assert!(
            low < found && found < high,
            "{p} at {found}, not from {low} to {high}"
        );
    }
}

#[test]
fn every_point_of_the_grid_has_a_band_and_failed_samples_are_counted() {
    let output = output("bands");
    let samples = Samples { count: 300, seed: 5 };
    let axes = [
        "friction.dynamic_coefficient=normal(0, 0.1)",
        "duct.length=10m,20m",
    ];
    let sweep = sweep_of(&axes, samples);
    let evaluate = formula(|scene| scene.duct.length * scene.friction.dynamic_coefficient);
    let summary = run_by(&sweep, &output, 2, &evaluate).unwrap();
    assert_eq!(summary.bands.len(), 2);
    for (band, length) in summary.bands.iter().zip(["10m", "20m"]) {
        assert_eq!(band.at, [("duct.length".to_owned(), length.to_owned())]);
        // Half the draws are below 0, which no friction coefficient is.
        assert_eq!(band.samples + band.failed, 300);
        assert!((100..200).contains(&band.failed), "{}", band.failed);
    }
    assert_eq!(summary.failed, summary.bands[0].failed + summary.bands[1].failed);
    // The same samples at both points.
    let p50 = |band: &Band| band.downstream_force_n.unwrap().p50;
    assert!((p50(&summary.bands[1]) / p50(&summary.bands[0]) - 2.0).abs() < 1e-12);
}

#[test]
fn an_axis_without_values_and_a_probability_that_is_none_are_no_panics() {
    let (key, values) = ("duct.depth".into(), Vec::new());
    assert!(Sweep::new(upper_file(&[]), vec![Axis { key, values }], Samples::default()).is_err());
    let laws = "normal(1, 2); lognormal(1, 2); uniform(1, 2); triangular(1, 2, 3); normal(1, 2, max=3)";
    for law in laws.split("; ") {
        let distribution = Distribution::parse(law).expect("a call").expect("a distribution");
        for probability in [f64::NAN, -0.1, 1.1, f64::INFINITY] {
            let quantile = distribution.quantile(probability).0;
            assert!(quantile.is_nan(), "{law} {probability}");
        }
        assert!(!distribution.quantile(0.0).0.is_nan() && !distribution.quantile(1.0).0.is_nan());
    }
}

// rows

fn rows(name: &str, table: &str) -> (PathBuf, Sweep) {
    let output = output(name);
    let ducts = output.with_file_name("ducts.csv");
    fs::write(&ducts, table).unwrap();
    let (file, none) = (upper_file(&["traffic.passes=1"]), Samples::default());
    let sweep = Sweep::of_rows(file, &ducts, &TableOptions::default(), none);
    (output, sweep.unwrap())
}

/// What the forms of a table may be stands in the tests of creepage-tables.
#[test]
fn a_row_is_a_duct_with_its_own_values_and_the_scenes_where_it_has_none() {
    for table in [
        "id,duct.length,duct.depth,ends.downstream\nA-007,40 m,1.5,\n\"B, north\",,90 cm,free\n",
        "id;duct.length [m];duct.depth;ends.downstream\n;;cm;\nA-007;40,0;150;\nB, north;;90;free\n",
    ] {
        let (output, sweep) = rows("rows of ducts", table);
        assert_eq!(sweep.count(), 2);
        let scenes = [0, 1].map(|row| sweep.scene(row).unwrap());
        let ducts = scenes.map(|scene| (scene.duct.length, scene.duct.depth, scene.ends.downstream));
        assert_eq!(ducts, [(40.0, 1.5, End::Fixed), (30.0, 0.9, End::Free)]);

        let evaluate = formula(|scene| scene.duct.length + scene.duct.depth);
        let summary = run_by(&sweep, &output, 1, &evaluate).unwrap();
        assert_eq!((summary.points, summary.failed), (2, 0));
        let text = fs::read_to_string(&output).unwrap();
        for (line, begin) in text.lines().zip([
            "id,duct.length,duct.depth,ends.downstream,downstream_force_n,",
            "A-007,40,1.5,,41.5,",
            "\"B, north\",,0.9,free,30.9,",
        ]) {
            assert!(line.starts_with(begin), "{text}");
        }
    }
    // A value that is wrong is its row's.
    let (output, sweep) = rows("one bad row", "duct.depth\n1 m\n1 kN\n");
    let summary = sweep.run(&output, &SweepOptions::default()).unwrap();
    assert_eq!((summary.points, summary.failed), (2, 1));
}
