//! `creepage calibrate`, from outside.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const UPPER: &str = "examples/scenes/full-scale-upper.toml";
const SYNTHETIC: &str = "examples/data/synthetic-upper.csv";

fn creepage(arguments: &[&str]) -> Output {
    Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the command starts")
}

/// A file of this test's own.
fn file(name: &str, text: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).unwrap();
    path
}

#[track_caller]
fn refused(arguments: &[&str], code: i32, words: &[&str]) {
    let output = creepage(arguments);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {errors}");
    assert!(output.stdout.is_empty());
    for word in words {
        assert!(errors.contains(word), "{arguments:?}: no {word:?} in {errors}");
    }
}

/// The document's fields, and the values by which the series was made: 0.25 and 2e6 1/m.
#[test]
fn json_and_csv_of_the_synthetic_series() {
    let table = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("calibrate-fit.csv");
    let output = creepage(&[
        "calibrate",
        UPPER,
        "--data",
        SYNTHETIC,
        "--json",
        "--csv",
        table.to_str().unwrap(),
    ]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let answer: Value = serde_json::from_slice(&output.stdout).expect("one document and nothing else");
    let names = ["dynamic_coefficient", "shape_factor"];
    for ((parameter, name), truth) in answer["parameters"]
        .as_array()
        .unwrap()
        .iter()
        .zip(names)
        .zip([0.25, 2e6])
    {
        assert_eq!(parameter["name"], name);
        let number = |value: &Value| value.as_f64().unwrap();
        let (value, error) = (number(&parameter["value"]), number(&parameter["standard_error"]));
        // Forty readings with a noise of 4 N tell both, to a tenth of them.
        assert!(
            (value - truth).abs() < 2.0 * error && error < 0.1 * truth,
            "{parameter}"
        );
        let interval = parameter["interval_95"].as_array().unwrap();
        for held in [value, truth] {
            assert!(
                number(&interval[0]) < held && held < number(&interval[1]),
                "{parameter}"
            );
        }
        assert_eq!(parameter["identifiable"], true);
    }
    let correlation = answer["correlation"].as_array().unwrap();
    assert_eq!(correlation.len(), 2);
    assert_eq!(correlation[0][1], correlation[1][0]);
    assert_eq!(correlation[0][0], 1.0);
    let rms = answer["residual_rms_n"].as_f64().unwrap();
    assert!((2.0..6.0).contains(&rms), "{rms}");
    assert!(answer["r_squared"].as_f64().unwrap() > 0.99);
    assert!(answer["evaluations"].as_u64().unwrap() <= 200);
    assert!(answer["warnings"].as_array().unwrap().is_empty());
    let lack = &answer["lack_of_fit"];
    assert_eq!(lack["suspicious"], false, "{lack}");
    for p in ["p_runs", "p_trend", "p_offset", "p_noise"] {
        assert!((0.02..=1.0).contains(&lack[p].as_f64().unwrap()), "{lack}");
    }
    let assumed = answer["assumptions"][0].as_str().unwrap();
    assert!(
        assumed.contains("10 % softer") && assumed.contains("cannot show"),
        "{assumed}"
    );
    assert_eq!(answer["fit"].as_array().unwrap().len(), 40);

    let mut rows = csv::Reader::from_path(&table).unwrap();
    let header = rows
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect::<Vec<_>>();
    assert_eq!(
        header,
        [
            "series",
            "pass",
            "force_n",
            "fitted_n",
            "residual_n",
            "weight",
            "run",
            "line",
            "measured",
            "at",
            "value",
            "fitted",
            "residual",
            "unit"
        ]
    );
    let squares: Vec<f64> = rows
        .records()
        .map(|row| row.unwrap()[4].parse::<f64>().unwrap().powi(2))
        .collect();
    assert!(((squares.iter().sum::<f64>() / squares.len() as f64).sqrt() - rms).abs() < 1e-6);
}

/// Two readings leave the friction alone, and an open end is null.
#[test]
fn open_ends_are_null_and_warned_of() {
    let data = file(
        "calibrate-short.csv",
        "pass,force_n,sigma_n\n1,102,10\n2,137,10\n3,160,10\n",
    );
    let output = creepage(&[
        "calibrate",
        UPPER,
        "--data",
        data.to_str().unwrap(),
        "--fit",
        "shape_factor",
        "--json",
    ]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let parameter = &answer["parameters"][0];
    assert_eq!(parameter["identifiable"], false);
    assert!(
        parameter["interval_95"][0].is_number() && parameter["interval_95"][1].is_null(),
        "{parameter}"
    );
    assert!(
        String::from_utf8(output.stderr)
            .unwrap()
            .contains("not identifiable")
    );
}

#[test]
fn robust_and_overridden() {
    let spoiled = fs::read_to_string(SYNTHETIC).unwrap().replace("\n13,", "\n13,1");
    let data = file("calibrate-spoiled.csv", &spoiled);
    let arguments = ["calibrate", UPPER, "--data", data.to_str().unwrap(), "--robust"];
    let fixed = [
        "--fit",
        "dynamic_coefficient",
        "--set",
        "friction.shape_factor=2e6 1/m",
    ];
    let (answer, _) = document(&[&arguments[..], &fixed[..]].concat());
    let size = &answer["residuals"][0];
    assert_eq!((&size["left_out"], &size["readings"]), (&1.into(), &39.into()));
    let kept = answer["fit"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|row| row["pass"] != 13);
    let squares: f64 = kept.map(|row| row["residual"].as_f64().unwrap().powi(2)).sum();
    assert!(
        (size["rms"].as_f64().unwrap() - (squares / 39.0).sqrt()).abs() < 1e-9,
        "{size}"
    );
    let output = creepage(&[&arguments[..], &fixed[..]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0));
    let value: f64 = text
        .lines()
        .find_map(|line| line.strip_prefix("dynamic_coefficient"))
        .and_then(|rest| rest.split_whitespace().next())
        .and_then(|value| value.parse().ok())
        .expect("a line with the coefficient");
    assert!((value / 0.25 - 1.0).abs() < 0.02, "{text}");
    assert!(text.contains("N rms of 39 readings, 1 left out"), "{text}");
    assert!(
        String::from_utf8(output.stderr)
            .unwrap()
            .contains("pass 13 (line 16)")
    );
}

#[test]
fn bad_input_ends_with_two() {
    let bad = file("calibrate-bad.csv", "pass,force_n\n1,113\n2,many\n");
    refused(
        &["calibrate", UPPER, "--data", bad.to_str().unwrap()],
        2,
        &["calibrate-bad.csv:3", "many"],
    );
    let few = file("calibrate-few.csv", "pass,force_n\n1,113\n");
    refused(
        &["calibrate", UPPER, "--data", few.to_str().unwrap()],
        2,
        &["1 readings", "needed"],
    );
    refused(
        &["calibrate", UPPER, "--data", "no-such.csv"],
        2,
        &["no-such.csv"],
    );
    refused(&["calibrate", UPPER], 2, &["--data"]);
    refused(
        &["calibrate", UPPER, "--data", SYNTHETIC, "--fit", "friction"],
        2,
        &["friction", "shape_factor"],
    );
    refused(
        &["calibrate", UPPER, "--data", SYNTHETIC, "--deflection", "115 um"],
        2,
        &["deflection-sigma"],
    );
    let free = ["--set", "ends.downstream=free"];
    refused(
        &[&["calibrate", UPPER, "--data", SYNTHETIC][..], &free[..]].concat(),
        2,
        &["load cell"],
    );
    let limit = ["--max-evaluations", "5"];
    refused(
        &[&["calibrate", UPPER, "--data", SYNTHETIC][..], &limit[..]].concat(),
        1,
        &["5 model runs"],
    );
}

/// A share beyond all sense is refused with what was found and what is allowed; readings that are all 0 have no share.
#[test]
fn a_discrepancy_needs_a_share_of_something() {
    for share in [
        "1e-300", "1e6", "0.009 %", "1001 %", "0", "-1", "nan", "inf", "much",
    ] {
        let option = format!("--discrepancy={share}");
        refused(
            &["calibrate", UPPER, "--data", SYNTHETIC, &option],
            2,
            &["--discrepancy", &format!("found \"{share}\""), "0.01 % to 1000 %"],
        );
    }
    let fit = ["--fit", "dynamic_coefficient"];
    for (name, size) in [("zero", "0"), ("tiny", "1e-300")] {
        let rows = ["0", "1", "2", "5", "10", "20"].map(|pass| format!("{pass},{size}\n"));
        let data = file(
            &format!("calibrate-{name}.csv"),
            &format!("pass,force_n\n{}", rows.concat()),
        );
        let asked = [
            "calibrate",
            UPPER,
            "--data",
            data.to_str().unwrap(),
            "--discrepancy",
        ];
        refused(
            &[&asked[..], &fit[..]].concat(),
            2,
            &["a largest reading of 0", "leave the discrepancy out"],
        );
    }
    // At one pass readings say nothing of it, and the friction is as uncertain as was said.
    let once = file(
        "calibrate-once.csv",
        "pass,force_n\n20,100\n20,101\n20,99\n20,100.5\n20,99.5\n20,101\n",
    );
    let errors = ["--discrepancy=0.01 %", "--discrepancy=3 %", "--discrepancy=6 %"].map(|share| {
        let asked = ["calibrate", UPPER, "--data", once.to_str().unwrap(), share];
        let (answer, _) = document(&[&asked[..], &fit[..]].concat());
        let share = share.split('=').next_back().unwrap();
        let intervals = answer["method"]["intervals"].as_str().unwrap();
        assert!(
            intervals.contains(&format!("smooth error of the model of {share}")),
            "{intervals}"
        );
        assert!(answer["parameters"].as_array().unwrap().len() == 1);
        answer["parameters"][0]["standard_error"].as_f64().unwrap()
    });
    assert!(errors[1] > 2.0 * errors[0], "{errors:?}");
    assert!((1.5..2.5).contains(&(errors[2] / errors[1])), "{errors:?}");
}

/// The synthetic series as a drifting cell would have read it, in kN and between semicolons.
fn drifting(name: &str) -> PathBuf {
    let text = fs::read_to_string(SYNTHETIC).unwrap();
    let mut rows = String::from("Überfahrt;Kraft [kN]\n");
    for line in text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
    {
        let (pass, force) = line.split_once(',').unwrap();
        let force = force.parse::<f64>().unwrap() + 0.8 * pass.parse::<f64>().unwrap();
        rows += &format!("{pass};{:.4}\n", force / 1e3).replace('.', ",");
    }
    file(name, &rows)
}

fn document(arguments: &[&str]) -> (Value, String) {
    let output = creepage(&[arguments, &["--json"]].concat());
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{errors}");
    (serde_json::from_slice(&output.stdout).unwrap(), errors)
}

/// A drift of 0.8 N a pass becomes friction, but not friction that is called identifiable; fitted as what it is, it comes back.
#[test]
fn a_drift_is_told_and_fitted_when_asked() {
    let data = drifting("calibrate-drifting.csv");
    let arguments = ["calibrate", UPPER, "--data", data.to_str().unwrap()];
    let (answer, errors) = document(&arguments);
    assert_eq!(answer["lack_of_fit"]["suspicious"], true, "{answer}");
    assert!(
        errors.contains("a drift") && errors.contains("--fit dynamic_coefficient,shape_factor,drift"),
        "{errors}"
    );
    for parameter in answer["parameters"].as_array().unwrap() {
        assert_eq!(parameter["identifiable"], false, "{parameter}");
    }
    let fit = ["--fit", "dynamic_coefficient,shape_factor,drift"];
    let (answer, _) = document(&[&arguments[..], &fit[..]].concat());
    for (place, truth) in [(0, 0.25), (2, 0.8)] {
        let parameter = &answer["parameters"][place];
        let end = |k: usize| parameter["interval_95"][k].as_f64().unwrap();
        assert!(end(0) < truth && truth < end(1), "{parameter}");
    }
    assert_eq!(answer["parameters"][2]["name"], "drift");
    assert_eq!(answer["lack_of_fit"]["suspicious"], false);
    assert_eq!(answer["lack_of_fit"]["p_trend"], Value::Null);
    // What is known of the cell narrows what it may do.
    let told = ["--drift-sigma", "0.01 N"];
    let (answer, _) = document(&[&arguments[..], &fit[..], &told[..]].concat());
    assert!(answer["parameters"][2]["value"].as_f64().unwrap() < 0.1);
}

#[test]
fn two_scenes_are_fitted_jointly() {
    let pair = format!("{UPPER}={SYNTHETIC}");
    let other = file(
        "calibrate-other.toml",
        &fs::read_to_string(UPPER)
            .unwrap()
            .replace("Full-scale", "The same"),
    );
    let second = format!("{}={SYNTHETIC}", other.display());
    let fit = "dynamic_coefficient_1,dynamic_coefficient_2,shape_factor";
    let (answer, _) = document(&[
        "calibrate",
        "--scene-data",
        &pair,
        "--scene-data",
        &second,
        "--fit",
        fit,
    ]);
    let value = |k: usize| answer["parameters"][k]["value"].as_f64().unwrap();
    assert_eq!(answer["titles"].as_array().unwrap().len(), 2);
    assert!(
        (value(0) / value(1) - 1.0).abs() < 1e-3 && (value(0) / 0.25 - 1.0).abs() < 0.05,
        "{answer}"
    );
    assert_eq!(answer["fit"].as_array().unwrap().len(), 80);
    refused(&["calibrate", "--scene-data", "only.toml"], 2, &["SCENE=FILE"]);
    refused(&["calibrate", "--data", SYNTHETIC], 2, &["SCENE"]);
}

/// Force at both ends, movement of an end and force inside the cable, made by a run, give its friction back.
#[test]
fn whatever_is_measured_is_fitted() {
    let scene = [
        "--set",
        "ends.upstream.spring=10 MN/m",
        "--set",
        "friction.shape_factor=2e6 1/m",
        "--set",
        "friction.dynamic_coefficient=0.3",
    ];
    let table = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("calibrate-made.csv");
    let made = creepage(
        &[
            &[
                "run",
                UPPER,
                "--set",
                "traffic.passes=25",
                "--force",
                "--csv",
                table.to_str().unwrap(),
            ][..],
            &scene[..],
        ]
        .concat(),
    );
    assert_eq!(
        made.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let named = [
        "--column-movement",
        "upstream=upstream_displacement_m",
        "--fit",
        "dynamic_coefficient",
    ];
    let start = [
        "--set",
        "ends.upstream.spring=10 MN/m",
        "--set",
        "friction.shape_factor=2e6 1/m",
    ];
    let data = ["calibrate", UPPER, "--data", table.to_str().unwrap()];
    let (answer, _) = document(&[&data[..], &named[..], &start[..]].concat());
    let value = answer["parameters"][0]["value"].as_f64().unwrap();
    assert!((value / 0.3 - 1.0).abs() < 0.02, "{value}");
    let rows = answer["fit"].as_array().unwrap();
    let kinds: Vec<String> = rows
        .iter()
        .take(3)
        .map(|row| format!("{} {}", row["measured"], row["at"]).replace('"', ""))
        .collect();
    assert_eq!(
        (rows.len(), kinds.join(", ")),
        (75, "force downstream, force upstream, movement upstream".into())
    );
    assert!(rows[2]["force_n"].is_null() && rows[2]["unit"] == "m");
    let units: Vec<&Value> = answer["residuals"]
        .as_array()
        .unwrap()
        .iter()
        .map(|size| &size["unit"])
        .collect();
    assert_eq!(units, ["N", "m"]);
}

/// A thousandth of what the model moves: no friction explains that, and the answer says so.
#[test]
fn a_model_that_misses_its_readings_by_far_has_status_1() {
    let data = file("missed.csv", "pass,movement_m\n0,0\n10,1e-7\n20,2e-7\n");
    let free = [
        "calibrate",
        UPPER,
        "--set",
        "ends.downstream=free",
        "--fit",
        "dynamic_coefficient",
    ];
    let output = creepage(&[&free[..], &["--json", "--data", data.to_str().unwrap()]].concat());
    assert_eq!(output.status.code(), Some(1));
    let answer: Value = serde_json::from_slice(&output.stdout).expect("a document all the same");
    assert_eq!(answer["lack_of_fit"]["suspicious"], Value::Bool(true));
    assert_eq!(answer["parameters"][0]["identifiable"], Value::Bool(false));
}
