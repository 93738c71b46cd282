//! `creepage calibrate`, from outside. What it says of mistakes stands in messages.rs.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::command::{
    SERIES, UPPER, answered, assert_says, folder, json, list, number, output, printed, read, table,
};
use crate::scenes::assert_near;

const COARSE: &str = "--set solver.node_spacing=0.3 --set solver.vehicle_step=0.15";

/// A file of a test's own.
fn file(name: &str, text: &str) -> PathBuf {
    let path = folder(name).join(name);
    fs::write(&path, text).unwrap();
    path
}

fn parameter<'a>(answer: &'a Value, name: &str) -> &'a Value {
    let mut parameters = list(&answer["parameters"]).iter();
    parameters
        .find(|parameter| parameter["name"] == name)
        .expect(name)
}

/// The 95 % interval, whose ends are both closed.
fn interval(parameter: &Value) -> [f64; 2] {
    [0, 1].map(|end| number(&parameter["interval_95"][end]))
}

/// The document's fields, and the values by which the series was made: 0.25 and 2e6 1/m.
#[test]
fn json_and_csv_of_the_synthetic_series() {
    let file = folder("calibrate-fit").join("fit.csv");
    let answer = json(&format!("calibrate UPPER --data SERIES --csv {}", file.display()));
    for (name, truth) in [("dynamic_coefficient", 0.25), ("shape_factor", 2e6)] {
        let parameter = parameter(&answer, name);
        let [value, error] = ["value", "standard_error"].map(|field| number(&parameter[field]));
        // Forty readings with a noise of 4 N tell both, to a tenth of them.
        let off = (value - truth).abs();
        assert!(off < 2.0 * error && error < 0.1 * truth, "{parameter}");
        let [low, high] = interval(parameter);
        assert!(low < value.min(truth) && value.max(truth) < high, "{parameter}");
        assert_eq!(parameter["identifiable"], true);
    }
    let correlation = list(&answer["correlation"]);
    assert_eq!(correlation.len(), 2);
    assert_eq!(correlation[0][1], correlation[1][0]);
    assert_eq!(number(&correlation[0][0]), 1.0);
    let rms = number(&answer["residual_rms_n"]);
    assert!((2.0..6.0).contains(&rms), "{rms}");
    assert!(number(&answer["r_squared"]) > 0.99 && number(&answer["evaluations"]) <= 200.0);
    assert!(list(&answer["warnings"]).is_empty());
    let lack = &answer["lack_of_fit"];
    assert_eq!(lack["suspicious"], false, "{lack}");
    for p in ["p_runs", "p_trend", "p_offset", "p_noise"] {
        assert!((0.02..=1.0).contains(&number(&lack[p])), "{lack}");
    }
    let assumed = answer["assumptions"][0].as_str().unwrap();
    assert_says(assumed, &["10 % softer", "cannot show"]);
    assert_eq!(list(&answer["fit"]).len(), 40);

    let (header, rows) = table(&file);
    let names =
        "series pass force_n fitted_n residual_n weight run line measured at value fitted residual unit";
    assert_eq!(header.join(" "), names);
    let squares = rows.iter().map(|row| row[4].parse::<f64>().unwrap().powi(2));
    let mean = squares.sum::<f64>() / rows.len() as f64;
    assert!((mean.sqrt() - rms).abs() < 1e-6);
}

/// Three readings leave the friction alone, and an open end is null.
#[test]
fn open_ends_are_null_and_warned_of() {
    let data = file(
        "short.csv",
        "pass,force_n,sigma_n\n1,102,10\n2,137,10\n3,160,10\n",
    );
    let line = format!("calibrate UPPER --data {} --fit shape_factor", data.display());
    let (answer, errors) = answered(&line);
    let parameter = &answer["parameters"][0];
    assert_eq!(parameter["identifiable"], false);
    let [low, high] = [0, 1].map(|end| &parameter["interval_95"][end]);
    assert!(low.is_number() && high.is_null(), "{parameter}");
    assert_says(&errors, &["not identifiable"]);
}

#[test]
fn robust_and_overridden() {
    let data = file("spoiled.csv", &read(SERIES).replace("\n13,", "\n13,1"));
    let line = format!(
        "calibrate UPPER --data {} --robust --fit dynamic_coefficient --set 'friction.shape_factor=2e6 1/m' {COARSE}",
        data.display()
    );
    let (answer, errors) = answered(&line);
    let size = &answer["residuals"][0];
    assert_eq!((&size["left_out"], &size["readings"]), (&1.into(), &39.into()));
    let kept = list(&answer["fit"]).iter().filter(|row| row["pass"] != 13);
    let squares: f64 = kept.map(|row| number(&row["residual"]).powi(2)).sum();
    assert_near(number(&size["rms"]), (squares / 39.0).sqrt(), 1e-9, size);
    assert_says(&errors, &["pass 13 (line 16)"]);
    let (status, said, _) = output(&line);
    let coefficient = said
        .lines()
        .find_map(|line| line.strip_prefix("dynamic_coefficient"));
    let value = coefficient.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
    assert_eq!(status, 0);
    assert_near(value.expect("the coefficient"), 0.25, 0.02, &said);
}

/// The synthetic series as a drifting cell would have read it, in kN and between semicolons. A drift of 0.8 N a pass becomes
/// friction, but not friction that is called identifiable; fitted as what it is, it comes back.
#[test]
fn a_drift_is_told_and_fitted_when_asked() {
    let series = read(SERIES);
    let rows = series.lines().filter_map(|line| {
        let (pass, force) = line.split_once(',')?;
        let force = force.parse::<f64>().ok()? + 0.8 * pass.parse::<f64>().ok()?;
        Some(format!("{pass};{:.4}\n", force / 1e3).replace('.', ","))
    });
    let rows = format!("Überfahrt;Kraft [kN]\n{}", rows.collect::<String>());
    let data = file("drifting.csv", &rows);
    let line = format!("calibrate UPPER --data {} {COARSE}", data.display());
    let (answer, errors) = answered(&line);
    assert_eq!(answer["lack_of_fit"]["suspicious"], true, "{answer}");
    let fit = "--fit dynamic_coefficient,shape_factor,drift";
    assert_says(&errors, &["a drift", fit]);
    let mut parameters = list(&answer["parameters"]).iter();
    assert!(parameters.all(|parameter| parameter["identifiable"] == false));
    let line = format!("{line} {fit}");
    let (answer, _) = answered(&line);
    for (name, truth) in [("dynamic_coefficient", 0.25), ("drift", 0.8)] {
        let [low, high] = interval(parameter(&answer, name));
        assert!(low < truth && truth < high, "{answer}");
    }
    assert_eq!(answer["lack_of_fit"]["suspicious"], false);
    assert_eq!(answer["lack_of_fit"]["p_trend"], Value::Null);
    // What is known of the cell narrows what it may do.
    let (answer, _) = answered(&format!("{line} --drift-sigma '0.01 N'"));
    assert!(number(&parameter(&answer, "drift")["value"]) < 0.1);
}

#[test]
fn two_scenes_are_fitted_jointly() {
    let other = file("other.toml", &read(UPPER).replace("Full-scale", "The same"));
    let fit = "--fit dynamic_coefficient_1,dynamic_coefficient_2,shape_factor";
    let (answer, _) = answered(&format!(
        "calibrate --scene-data {UPPER}={SERIES} --scene-data {}={SERIES} {fit} {COARSE}",
        other.display()
    ));
    let value = |k: usize| number(&answer["parameters"][k]["value"]);
    assert_eq!(list(&answer["titles"]).len(), 2);
    assert_near(value(0), value(1), 1e-3, ());
    assert_near(value(0), 0.25, 0.05, ());
    assert_eq!(list(&answer["fit"]).len(), 80);
}

/// Force at both ends, movement of an end and force inside the cable, made by a run, give its friction back.
#[test]
fn whatever_is_measured_is_fitted() {
    let table = folder("calibrate-made").join("made.csv");
    let scene = "--set 'ends.upstream.spring=10 MN/m' --set 'friction.shape_factor=2e6 1/m'";
    printed(&format!(
        "run UPPER --set traffic.passes=25 --csv {} {scene} --set friction.dynamic_coefficient=0.3",
        table.display()
    ));
    let (answer, _) = answered(&format!(
        "calibrate UPPER --data {} --column-movement upstream=upstream_displacement_m --fit dynamic_coefficient {scene}",
        table.display()
    ));
    let value = number(&answer["parameters"][0]["value"]);
    assert_near(value, 0.3, 0.02, ());
    let rows = list(&answer["fit"]);
    for (row, [measured, at]) in rows.iter().zip([
        ["force", "downstream"],
        ["force", "upstream"],
        ["movement", "upstream"],
    ]) {
        assert_eq!((&row["measured"], &row["at"]), (&measured.into(), &at.into()));
    }
    assert_eq!(rows.len(), 75);
    assert!(rows[2]["force_n"].is_null() && rows[2]["unit"] == "m");
    let units = list(&answer["residuals"]).iter().map(|size| &size["unit"]);
    assert!(units.eq(["N", "m"]));
}

/// A thousandth of what the model moves: no friction explains that, and the answer says so.
#[test]
fn a_model_that_misses_its_readings_by_far_has_status_1() {
    let data = file("missed.csv", "pass,movement_m\n0,0\n10,1e-7\n20,2e-7\n");
    let free = "calibrate UPPER --set ends.downstream=free --fit dynamic_coefficient --json";
    let (status, said, _) = output(&format!("{free} --data {}", data.display()));
    assert_eq!(status, 1);
    let answer: Value = serde_json::from_str(&said).expect("a document all the same");
    assert_eq!(answer["lack_of_fit"]["suspicious"], true);
    assert_eq!(answer["parameters"][0]["identifiable"], false);
}
