//! The report: what it says is what a run says, it is well-formed, loads nothing, and no text of a user becomes markup.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use super::xml::{Element, parse};
use creepage::design::{Place, Spring};
use creepage::report::{Report, ReportOptions};
use creepage::scene::TrafficVehicle;
use creepage::{Limits, Readings, Scene};
use serde_json::Value;

const UPPER: &str = "examples/scenes/full-scale-upper.toml";
const FIGURES: [&str; 9] = [
    "Cross-section of the road",
    "Along the duct",
    "Force against passes",
    "Force along the cable",
    "Movement of the ends",
    "Motion of the duct along its axis; and down",
    "Velocity of the duct along its axis",
    "Friction on the cable, pass 1; Friction on the cable, pass 6",
    "Force against movement",
];

/// Head of the table of ways to hold the cable where the upstream end is free.
const HELD_BY: [&str; 6] = [
    "held by",
    "force downstream, N",
    "moved downstream, mm",
    "moved upstream, mm",
    "most on a clamp, N",
    "error",
];

fn creepage(arguments: &[&str]) -> Output {
    Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the command starts")
}

/// An empty folder for files of one test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

fn scene(overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|set| (*set).to_owned()).collect();
    creepage::SceneFile::read(UPPER)
        .and_then(|file| file.with(&overrides)?.scene())
        .expect("a scene")
}

/// The page for a scene of six passes.
fn page(overrides: &[&str], options: &ReportOptions<'_>) -> String {
    let scene = scene(&[&["traffic.passes=6"], overrides].concat());
    Report::new(&scene, options).expect("a report").to_html()
}

/// The elements of a page, which has to be well-formed.
fn elements(page: &str) -> Vec<Element> {
    parse(page.trim().strip_prefix("<!DOCTYPE html>\n").expect("a doctype"))
}

fn texts<'e>(elements: &'e [Element], name: &str) -> Vec<&'e str> {
    let named = elements.iter().filter(|element| element.name == name);
    named.map(|element| element.text.as_str()).collect()
}

/// Rows of the table that begins with the given heads.
fn table(page: &str, heads: &[&str]) -> Vec<Vec<String>> {
    let elements = elements(page);
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut inside = false;
    let mut head: Vec<String> = Vec::new();
    for element in &elements {
        match element.name.as_str() {
            "table" => {
                inside = false;
                head.clear();
            }
            "th" => {
                head.push(element.text.replace('\u{ad}', ""));
                inside = head == heads;
            }
            "tr" if inside => rows.push(Vec::new()),
            "td" if inside => rows.last_mut().expect("a row").push(element.text.clone()),
            _ => {}
        }
    }
    assert!(!rows.is_empty(), "no table with {heads:?}");
    rows
}

#[track_caller]
fn number(text: &str) -> f64 {
    let digits = text.split([' ', '\u{a0}']).next().unwrap_or_default();
    digits.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

#[test]
fn the_numbers_are_those_of_the_run() {
    let file = folder("numbers").join("upper.html");
    let output = creepage(&["report", UPPER, "-o", text(&file)]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let errors = String::from_utf8_lossy(&output.stderr);
    let only_progress = errors.lines().all(|line| line.starts_with("progress: "));
    assert!(output.stdout.is_empty() && only_progress, "{output:?}");
    let page = fs::read_to_string(&file).expect("the page");
    let run: Value = serde_json::from_slice(&creepage(&["run", UPPER, "--json"]).stdout).expect("JSON");
    let close = |shown: f64, value: &Value, factor: f64, half_digit: f64| {
        let value = factor * value.as_f64().expect("a number");
        assert!(
            (shown - value).abs() <= half_digit * 1.001,
            "{shown} where the run says {value}"
        );
    };

    let elements = elements(&page);
    let shown: Vec<&Element> = elements
        .iter()
        .filter(|element| element.get("class") == "value")
        .collect();
    assert_eq!(shown.len(), 6);
    let last = &run["passes"][199];
    close(number(&shown[0].text), &run["saturation"]["force_n"], 1.0, 0.05);
    assert_eq!(
        run["saturation"]["passes_to_95_percent"],
        number(&shown[1].text) as u64
    );
    let passes = run["passes"].as_array().expect("a list");
    let largest = passes
        .iter()
        .map(|pass| pass["downstream_peak_n"].as_f64().expect("a number"));
    close(
        number(&shown[2].text),
        &largest.fold(0.0, f64::max).into(),
        1.0,
        0.05,
    );
    close(
        number(&shown[3].text),
        &last["upstream_displacement_m"],
        1e3,
        5e-4,
    );
    close(
        number(&shown[4].text),
        &run["duct_motion"]["peak_longitudinal_m"],
        1e6,
        5e-3,
    );
    close(
        number(&shown[5].text),
        &run["error_estimate"]["relative"],
        100.0,
        5e-3,
    );

    let rows = table(
        &page,
        &["after pass", "force downstream, N", "moved upstream, mm"],
    );
    assert_eq!(rows.len(), 8);
    for row in rows {
        let pass = &run["passes"][number(&row[0]) as usize - 1];
        close(number(&row[1]), &pass["downstream_force_n"], 1.0, 0.05);
        close(number(&row[2]), &pass["upstream_displacement_m"], 1e3, 5e-5);
    }
    let points = texts(&elements, "li");
    for reason in run["plan"]["reasons"].as_array().expect("a list") {
        assert!(points.contains(&reason.as_str().expect("a text")), "{reason}");
    }
    let parts = table(&page, &["part", "error"]);
    close(
        number(&parts[0][1]),
        &run["error_estimate"]["parts"]["mesh"],
        100.0,
        5e-3,
    );
    // Table 1 of the paper, in the words of the page.
    for words in [
        "Duct: 30 m long, 1.2 m from the road surface to the cable",
        "108.8 N/m heavy, axial stiffness EA 8.01 MN",
        "dynamic coefficient 0.25, so at most 27.2 N/m",
        "upstream (x = 0) free, downstream (x = 30 m) fixed",
        "200 passes",
    ] {
        assert!(points.iter().any(|point| point.contains(words)), "{words}");
    }
    let ground = table(&page, &["ground at depth", "Young’s modulus", "Poisson’s ratio"]);
    assert_eq!(ground, [["everywhere", "800 MPa", "0.4"]]);
}

#[test]
fn every_candidate_is_shown_with_its_fate() {
    let layered = [
        "ground.rigid_base_depth=12 m",
        r#"ground.layers=[{thickness="50 mm", young_modulus="4000 MPa", poisson_ratio=0.35}, {young_modulus="800 MPa", poisson_ratio=0.4}]"#,
    ];
    let page = page(&layered, &ReportOptions::default());
    let scene = scene(&[&["traffic.passes=6"], &layered[..]].concat());
    let plan = creepage::plan(&scene).expect("a plan").report();
    let rows = table(
        &page,
        &["model", "before the run: error, time", "why, or why not"],
    );
    assert_eq!(rows.len(), plan.candidates.len());
    for (row, candidate) in rows.iter().zip(&plan.candidates) {
        let fate = match candidate.part {
            _ if candidate.chosen => "chosen",
            creepage::Part::Mesh => "not taken at first",
            _ => "rejected",
        };
        assert_eq!(row[0], format!("{} {}: {fate}", candidate.part, candidate.name));
        assert_eq!(row[2], candidate.reason);
    }
    assert!(plan.candidates.iter().any(|candidate| !candidate.chosen));
    let ground = table(&page, &["ground at depth", "Young’s modulus", "Poisson’s ratio"]);
    assert_eq!(ground[0], ["0 to 0.05 m", "4000 MPa", "0.35"]);
    assert_eq!(ground[2][0], "below 12 m");
}

#[test]
fn all_figures_are_there_and_have_dark_colours() {
    let page = page(&[], &ReportOptions::default());
    let elements = elements(&page);
    let names: Vec<&str> = elements
        .windows(2)
        .filter(|pair| pair[0].name == "svg" && pair[1].name == "title")
        .map(|pair| pair[1].text.as_str())
        .collect();
    assert_eq!(names, FIGURES);
    assert!(!page.contains("could not be drawn"));
    for element in &elements {
        for property in ["fill", "stroke"] {
            let colour = element.get(property);
            let rule = format!("svg [{property}=\"{colour}\"]{{{property}:#");
            assert!(
                ["", "none"].contains(&colour) || page.contains(&rule),
                "{property} {colour} has no dark colour"
            );
        }
    }
}

#[test]
fn figures_and_tables_are_over_time_where_the_vehicles_a_day_are_known() {
    for (years, per_day, label) in [
        ("20", "800", "1 month"),
        ("100", "3", "100 years"),
        ("0.01", "10000", "1 h"),
        ("2", "0.7", "days"),
        ("0.001", "1000", "hours"),
    ] {
        let set = [
            "traffic.passes=",
            &*format!("traffic.years={years}"),
            &*format!("traffic.per_day={per_day}"),
            "duct.length=8 m",
            "solver.tolerance=0.1",
        ];
        let options = ReportOptions {
            measures: Some(&[]),
            ..ReportOptions::default()
        };
        let page = Report::new(&scene(&set), &options).expect("a report").to_html();
        let elements = elements(&page);
        let labels = texts(&elements, "text");
        for text in ["Force against time", label] {
            assert!(
                labels.contains(&text),
                "{years} years, {per_day} a day: {labels:?}"
            );
        }
        assert!(
            !page.contains("could not be drawn"),
            "{years} years, {per_day} a day"
        );
        assert!(
            !table(
                &page,
                &["after pass", "time", "force downstream, N", "moved upstream, mm",]
            )
            .is_empty()
        );
    }
}

#[test]
fn the_page_begins_with_the_answer_and_a_verdict() {
    let mut limits = Limits::default();
    limits.downstream.force_n = Some(1e4);
    limits.upstream.movement_m = Some(1e-6);
    let options = ReportOptions {
        limits,
        measures: Some(&[]),
        ..ReportOptions::default()
    };
    let page = page(&["traffic.per_day=2"], &options);
    let before = page.split("Peak motion").next().expect("the headline");
    for words in [
        "After 6 passes (3 days) the force on the downstream end is ",
        "limit kept: the downstream end is pressed with at most ",
        "limit exceeded: the upstream end moves by up to ",
        ", limit 0.001 mm, first at pass 1, 12 h",
        "1 of 2 limits exceeded",
    ] {
        assert!(before.contains(words), "{words}: {before}");
    }
}

#[test]
fn a_page_loads_nothing() {
    let page = page(&[], &ReportOptions::default()).to_lowercase();
    assert!(page.contains("default-src 'none'; style-src 'unsafe-inline'"));
    for loads in [
        "<script", "<link", "<img", "<iframe", "<object", "src=", "href=", "url(", "@import",
    ] {
        assert!(!page.contains(loads), "{loads}");
    }
    // The name of a dialect, not an address.
    let page = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!page.contains("http://") && !page.contains("https://"));
}

#[test]
fn texts_of_the_user_stay_texts() {
    let nasty = "<script>alert('x')</script> & \"é\" </title><b>";
    let mut scene = scene(&["traffic.passes=2"]);
    scene.title = nasty.into();
    scene.vehicles = vec![TrafficVehicle::point(nasty, 1e5, 10.0)];
    let warning = [nasty.to_owned()];
    let options = ReportOptions {
        warnings: &warning,
        ..ReportOptions::default()
    };
    let page = Report::new(&scene, &options).expect("a report").to_html();
    assert!(!page.contains("<script") && !page.contains("<b>"));
    let elements = elements(&page);
    assert_eq!(texts(&elements, "h1"), [nasty]);
    assert!(texts(&elements, "td").contains(&nasty));
    assert!(texts(&elements, "li").contains(&nasty));
    assert!(texts(&elements, "title")[0].starts_with(nasty));
}

#[test]
fn readings_are_drawn_and_compared() {
    let run = creepage::run(&scene(&["traffic.passes=6"])).expect("a run");
    // Ten newtons above what is computed, one reading beyond the passes, and an overload.
    let rows: Vec<String> = run
        .passes
        .iter()
        .map(|record| format!("{},{},5\n", record.pass, record.downstream_force_n + 10.0))
        .collect();
    let csv = format!("pass,force_n,sigma_n\n{}9,500,5\n10,9.9e37,5\n", rows.concat());
    let readings = Readings::from_csv("cell.csv", csv.as_bytes()).expect("readings");
    let options = ReportOptions {
        readings: Some(&readings),
        ..ReportOptions::default()
    };
    let with = page(&[], &options);
    let said = "7 readings at the downstream end; measured minus computed force of 6 of them: mean 10.0 N, root of the mean square \
                10.0 N, largest reading 500.0 N.";
    assert!(
        with.contains(said) && with.contains("left out: pass 10 (line 9)"),
        "{with}"
    );
    let circles = |page: &str| {
        let drawn = |element: &&Element| element.name == "circle" || element.name == "polyline";
        let elements = elements(page);
        let force = |pair: &[Element]| pair[0].name == "svg" && pair[1].text == "Force against passes";
        let svg = elements.windows(2).position(force).expect("a figure");
        let end = svg
            + 1
            + elements[svg + 1..]
                .iter()
                .position(|element| element.get("role") == "img")
                .expect("another");
        elements[svg..end]
            .iter()
            .filter(drawn)
            .filter(|element| element.get("stroke") == "#009E73")
            .count()
    };
    // Each reading is a circle and a bar; the legend shows one circle more.
    assert_eq!(circles(&with), 2 * 7 + 1);
    assert_eq!(circles(&page(&[], &ReportOptions::default())), 0);

    let free = scene(&["traffic.passes=6", "ends.downstream=free"]);
    let error = Report::new(&free, &options).expect_err("no end is held");
    assert!(
        error.is_bad_input() && error.to_string().contains("load cell"),
        "{error}"
    );
}

#[test]
fn readings_in_another_unit_are_told() {
    let run = creepage::run(&scene(&["traffic.passes=6"])).expect("a run");
    let thousandth =
        |record: &creepage::PassRecord| format!("{},{}\n", record.pass, 1e-3 * record.downstream_force_n);
    let rows: Vec<String> = run.passes.iter().map(thousandth).collect();
    let csv = format!("pass,force_n\n{}", rows.concat());
    let readings = Readings::from_csv("cell.csv", csv.as_bytes()).expect("readings");
    let options = ReportOptions {
        readings: Some(&readings),
        measures: Some(&[]),
        ..ReportOptions::default()
    };
    let report = Report::new(&scene(&["traffic.passes=6"]), &options).expect("a report");
    assert!(
        report.mistakes()[0].contains("are they kN?"),
        "{:?}",
        report.mistakes()
    );
    assert!(report.to_html().contains(&report.mistakes()[0]));
}

#[test]
fn every_clamp_has_its_force_and_rows_their_vehicle() {
    let clamps =
        r#"restraints=[{position="12 m", stiffness="1 MN/m"}, {position="27 m", stiffness="5 MN/m"}]"#;
    let mut scene = scene(&["traffic.passes=6", clamps, "ends.downstream.spring=1 MN/m"]);
    let mut other = TrafficVehicle::point("back", 1e5, 10.0);
    (scene.vehicles[0].share, other.share) = (0.75, 0.25);
    scene.vehicles.push(other);
    let mut limits = Limits::default();
    limits.downstream.movement_m = Some(1.0);
    let measures = [Spring::new(Place::Downstream, 1e6)];
    let options = ReportOptions {
        limits,
        measures: Some(&measures),
        ..ReportOptions::default()
    };
    let report = Report::new(&scene, &options).expect("a report");
    let (page, run) = (report.to_html(), report.run());
    let largest = |place: f64| run.largest(Place::Clamp(place), creepage::Limited::Force);
    let head = [
        "clamp at",
        "force after the last pass, N",
        "force at most during a pass, N",
        "moved at most during a pass, mm",
    ];
    let rows = table(&page, &head);
    for (row, place) in rows.iter().zip([12.0, 27.0]) {
        assert_eq!(number(&row[0]), place);
        assert!((number(&row[2]) - largest(place)).abs() < 0.051, "{row:?}");
    }
    let most = largest(12.0).max(largest(27.0));
    let ways = table(&page, &HELD_BY);
    assert!((number(&ways[0][4]) - most).abs() < 0.051, "{ways:?}");
    let card = page.split("Largest force on a clamp").nth(1).expect("a card");
    assert!(card.contains("during a pass"));
    assert!(page.contains("(--limit-force clamp=FORCE)"));
    let head = [
        "after pass",
        "force downstream, N",
        "moved upstream, mm",
        "moved downstream, mm",
        "vehicle",
    ];
    let rows = table(&page, &head);
    // Of four vehicles, one is the other.
    let back = rows.iter().filter(|row| row[4] == "back").count();
    assert!(rows.len() == 6 && (1..=2).contains(&back), "{rows:?}");
}

#[test]
fn a_way_that_fails_is_told_and_the_others_stay() {
    let measures = [
        Spring::new(Place::Downstream, f64::INFINITY),
        Spring::new(Place::Downstream, 1e6),
        Spring::new(Place::Clamp(99.0), 1e6),
    ];
    let options = ReportOptions {
        measures: Some(&measures),
        ..ReportOptions::default()
    };
    let page = page(&[], &options);
    let rows = table(&page, &HELD_BY);
    assert_eq!(
        rows.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(),
        [
            "fixed end, as in the scene",
            "spring of 1000 kN/m",
            "clamp of 1000 kN/m at 99 m"
        ]
    );
    assert!(number(&rows[0][1]) > number(&rows[1][1]) && number(&rows[1][1]) > 0.0);
    assert_eq!(rows[2][1], "failed");
    assert!(
        page.contains("Failed: clamp of 1000 kN/m at 99 m: position of the clamp: found 99"),
        "{page}"
    );
}

#[test]
fn other_scenes_have_their_pages() {
    // No force at all; both ends free; a lane beside the duct; inertia; more passes than can be computed one by one.
    for (overrides, said) in [
        (
            &["friction.dynamic_coefficient=0"][..],
            "There is no friction here",
        ),
        (&["ends.downstream=free"], "largest compression in the cable"),
        (&["duct.lateral_offset=2 m"], "2 m right of the duct"),
        (
            &[
                "duct.inner_diameter=200 mm",
                "cable.diameter=67 mm",
                "cable.arrangement=trefoil-lower",
            ],
            "it presses on the duct with 1.736 times its weight, as a lower one of three cables in trefoil, 67 mm thick in a duct of 0.2 m.",
        ),
        (
            &[
                "duct.inner_diameter=200 mm",
                "cable.diameter=67 mm",
                "cable.arrangement=trefoil-upper",
            ],
            "wedging alone does not explain the 900 N measured there.",
        ),
        (
            &["traffic.passes=2000000", "solver.tolerance=0.05"],
            "2\u{a0}000\u{a0}000 passes",
        ),
    ] {
        let page = page(overrides, &ReportOptions::default());
        elements(&page);
        assert!(page.contains(said), "{overrides:?}");
        assert!(!page.contains("could not be drawn"), "{overrides:?}");
    }
}

#[track_caller]
fn assert_refused(arguments: &[&str], status: i32, parts: &[&str]) {
    let output = creepage(&[&["report"], arguments].concat());
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {errors}");
    assert!(output.stdout.is_empty());
    for part in parts {
        assert!(errors.contains(part), "{arguments:?}: {part} is not in\n{errors}");
    }
}

#[test]
fn a_page_that_cannot_be_written_has_status_2_before_anything_is_computed() {
    let folder = folder("unwritable");
    let nowhere = folder.join("no-such-folder").join("page.html");
    // Were it computed first, this would take hours.
    let hours = [
        "--set",
        "traffic.passes=900000",
        "--set",
        "solver.method=quasi-static",
    ];
    for file in [&nowhere, &folder] {
        assert_refused(
            &[&[UPPER, "-o", text(file)], &hours[..]].concat(),
            2,
            &[text(file), "cannot be written"],
        );
    }
    assert_refused(&[UPPER], 2, &["--output"]);
    let copy = folder.join("scene.toml");
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join(UPPER), &copy).expect("a copy");
    assert_refused(&[text(&copy), "-o", text(&copy)], 2, &["which is read"]);
    assert!(fs::read_to_string(&copy).expect("the scene").contains("[duct]"));
}

#[test]
fn bad_input_has_status_2_and_a_failure_leaves_the_older_page() {
    let folder = folder("older");
    let file = folder.join("page.html");
    let older = "<!DOCTYPE html><meta name=\"generator\" content=\"creepage 0.0.0\"/>";
    fs::write(&file, older).expect("a file");
    let data = folder.join("data.csv");
    fs::write(&data, "pass,force_n\n1,many\n").expect("a file");
    let output = ["-o", text(&file)];
    assert_refused(
        &[&[UPPER, "--data", text(&data)], &output[..]].concat(),
        2,
        &["data.csv:2", "many"],
    );
    assert_refused(
        &[&["no-such-scene.toml"], &output[..]].concat(),
        2,
        &["no-such-scene.toml"],
    );
    assert_refused(
        &[&[UPPER, "--set", "duct.depth=1 kN"], &output[..]].concat(),
        2,
        &["duct.depth"],
    );
    let too_stiff = [
        UPPER,
        "--set",
        "cable.axial_stiffness=1e15 N",
        "--set",
        "solver.node_spacing=1 mm",
        "--set",
        "duct.length=3 m",
        "--set",
        "traffic.passes=1",
    ];
    assert_refused(&[&too_stiff[..], &output].concat(), 1, &["stiff"]);
    assert_eq!(fs::read_to_string(&file).expect("the older page"), older);

    let done = creepage(&[&["report", UPPER, "--set", "traffic.passes=2"], &output[..]].concat());
    assert_eq!(done.status.code(), Some(0), "{done:?}");
    assert!(
        fs::read_to_string(&file)
            .expect("the page")
            .ends_with("</html>\n")
    );
    let left: Vec<_> = fs::read_dir(&folder)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

/// Places of a drawing's points \[px\].
fn points(element: &Element) -> Vec<(f64, f64)> {
    let pair = |point: &str| {
        let (x, y) = point.split_once(',').expect("x,y");
        (number(x), number(y))
    };
    element.get("points").split_whitespace().map(pair).collect()
}

fn centre(points: &[(f64, f64)]) -> (f64, f64) {
    let count = points.len() as f64;
    let sum = points
        .iter()
        .fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
    (sum.0 / count, sum.1 / count)
}

/// The elements of the figure with this title.
fn figure<'e>(elements: &'e [Element], title: &str) -> &'e [Element] {
    let begins = |pair: &[Element]| pair[0].name == "svg" && pair[1].text == title;
    let start = elements.windows(2).position(begins).expect("the figure");
    let length = elements[start..]
        .iter()
        .position(|element| element.name == "figcaption");
    &elements[start..start + length.expect("a caption")]
}

#[test]
fn a_life_in_parts_is_drawn_on_one_axis() {
    let first = creepage::run(&scene(&["traffic.passes=20"])).expect("the first part");
    let options = ReportOptions {
        start: first.state.as_ref(),
        ..ReportOptions::default()
    };
    let report = Report::new(&scene(&["traffic.passes=30"]), &options).expect("a report");
    let page = report.to_html();
    assert!(!page.contains("Ways to hold the cable"));
    let all = elements(&page);
    let force = texts(figure(&all, "Force against passes"), "text");
    // The passes of this part alone would end at 30.
    assert!(
        force.contains(&"40") && page.contains("before the vertical line"),
        "{force:?}"
    );
    // What the first part left, after some of its passes and the last.
    let history = first.state.as_ref().expect("a state").history();
    let last = history.last().expect("a pass");
    assert_eq!(
        (last.pass, last.force_n[1]),
        (20, first.passes[19].downstream_force_n)
    );
    let both = report.run().state.as_ref().expect("a state").history();
    assert_eq!(
        (both[..history.len()] == *history, both[both.len() - 1].pass),
        (true, 50)
    );
}

#[test]
fn the_cross_section_is_to_scale_and_lanes_are_on_their_side() {
    let overrides = [
        "traffic.passes=2",
        "ground.rigid_base_depth=4 m",
        r#"ground.layers=[{thickness="50 cm", young_modulus="400 MPa", poisson_ratio=0.35}, {young_modulus="80 MPa", poisson_ratio=0.4}]"#,
        "duct.lateral_offset=1 m",
        "duct.depth=3 m",
    ];
    let mut scene = scene(&overrides);
    let mut other = TrafficVehicle::point("back", 1e5, 10.0);
    other.direction = ground_field::Direction::Reverse;
    other.lateral_offset = -3.0;
    (scene.vehicles[0].share, other.share) = (0.75, 0.25);
    scene.vehicles.push(other);
    let options = ReportOptions {
        measures: Some(&[]),
        ..ReportOptions::default()
    };
    let page = Report::new(&scene, &options).expect("a report").to_html();
    let elements = elements(&page);
    let drawing = figure(&elements, "Cross-section of the road");
    let words = texts(drawing, "text");
    assert!(words.contains(&"duct, 3 m deep"), "{words:?}");
    let shapes = |name: &str| -> Vec<Vec<(f64, f64)>> {
        let named = drawing.iter().filter(|element| element.name == name);
        named.map(points).collect()
    };
    let polygons = shapes("polygon");
    // The signs of direction, the duct as a disc, layers as boxes from the left to the right edge.
    let signs = ["⊗", "⊙"].map(|sign| drawing.iter().find(|element| element.text == sign).expect(sign));
    let signs = signs.map(|sign| number(sign.get("x")));
    let duct = polygons.iter().rfind(|disc| disc.len() == 24).expect("the duct");
    let duct = centre(duct);
    let boxes: Vec<_> = polygons
        .iter()
        .filter(|shape| shape.len() == 4 && shape[1].0 - shape[0].0 > 100.0)
        .collect();
    assert_eq!(boxes.len(), 3, "two layers and rock");
    // The reverse lane lies 3 m to the right of the other one, and the duct 1 m to the left.
    let scale = (signs[1] - signs[0]) / 3.0;
    let near = |one: f64, other: f64| assert!((one - other).abs() < 0.2, "{one} px, {other} px");
    near(signs[0] - duct.0, scale);
    let surface = boxes[0][0].1;
    near(duct.1 - surface, 3.0 * scale);
    near(boxes[0][2].1 - surface, 0.5 * scale);
    near(boxes[1][2].1 - surface, 4.0 * scale);
}

#[test]
fn the_side_view_has_clamps_at_their_places_and_ends_where_the_duct_does() {
    let clamps =
        r#"restraints=[{position="12 m", stiffness="1 MN/m"}, {position="27 m", stiffness="50 kN/m"}]"#;
    let options = ReportOptions {
        measures: Some(&[]),
        ..ReportOptions::default()
    };
    let page = page(&[clamps, "duct.slope=-0.02"], &options);
    let elements = elements(&page);
    let drawing = figure(&elements, "Along the duct");
    let words = texts(drawing, "text");
    for text in ["0", "30", "free", "fixed"] {
        assert!(words.contains(&text), "{text}: {words:?}");
    }
    let points = texts(&elements, "li");
    for text in ["Clamp 1: 1000 kN/m at 12 m.", "Clamp 2: 50 kN/m at 27 m."] {
        assert!(points.contains(&text), "{text}: {points:?}");
    }
    let at = |label: &str| -> f64 {
        let text = drawing.iter().rfind(|element| element.text == label);
        number(text.expect("a label").get("x"))
    };
    // The labels of the axis are 30 m apart, the numbers of the clamps stand above them.
    let scale = (at("30") - at("0")) / 30.0;
    for (clamp, place) in [("1", 12.0), ("2", 27.0)] {
        assert!((at(clamp) - at("0") - place * scale).abs() < 0.2, "clamp {clamp}");
    }
    assert!(page.contains("The duct falls by 2 % toward growing x, which is not drawn."));
    let along = texts(figure(&elements, "Force along the cable"), "text");
    assert!(along.contains(&"30") && !along.contains(&"40"), "{along:?}");
}

#[test]
fn one_scene_has_one_force() {
    let mut limits = Limits::default();
    limits.downstream.force_n = Some(1.0);
    limits.downstream.movement_m = Some(1.0);
    let own = ["ends.downstream.spring=1 MN/m", "traffic.passes=30"];
    let report = Report::new(
        &scene(&own),
        &ReportOptions {
            limits,
            ..ReportOptions::default()
        },
    )
    .expect("a report");
    let page = report.to_html();
    let rows = table(&page, &HELD_BY);
    let own = rows
        .iter()
        .find(|row| row[0].ends_with("as in the scene"))
        .expect("a row");
    let largest = report.run().passes.iter().map(|pass| pass.downstream_peak_n);
    assert_eq!(own[1], format!("{:.1}", largest.fold(0.0, f64::max)));
    let moved = 1e3 * report.run().passes[29].upstream_displacement_m;
    assert!(
        (number(&own[3]) / moved - 1.0).abs() < 5e-4,
        "{} for {moved}",
        own[3]
    );
    let value = format!("<dd class=\"value\">{} N</dd>", own[1]);
    assert!(page.contains(&value), "{value}");
    assert!(page.contains(&format!("up to {} N", own[1])) || page.contains(&format!("at most {} N", own[1])));
    // The free end stands in the table and leaves the chart to the others.
    assert_eq!((rows[0][0].as_str(), rows[0][1].as_str()), ("free end", "0"));
    assert!(page.contains(&format!("moves {} mm and is not drawn", rows[0][2])));
}

/// A duct in feet, inches and kips.
const IMPERIAL: &str = r#"
title = "Imperial"
duct = { length = "98 ft", depth = "4 ft", slope = "2 %" }
ground.layers = [
    { thickness = "4 in", young_modulus = "300000 psi", poisson_ratio = 0.35 },
    { young_modulus = "116 ksi", poisson_ratio = 0.4 },
]
cable = { weight = "7.5 lbf/ft", axial_stiffness = "1800 kip" }
friction = { law = "elastic-plastic", dynamic_coefficient = 0.25, shape_factor = "7.35e6 1/m" }
ends = { upstream = "free", downstream = { spring = "20 kip/in" } }
restraints = [{ position = "50 ft", stiffness = "5 kip/in" }]
vehicles = [{ name = "truck", load = "44 kip", speed = "40 km/h", direction = "forward" }]
traffic = { passes = 6 }
"#;
/// \[N\] and \[m\].
const KIP: f64 = 4448.2216152605;
const INCH: f64 = 0.0254;

#[test]
fn a_page_is_in_the_units_that_were_typed() {
    let folder = folder("imperial");
    let (scene, file) = (folder.join("scene.toml"), folder.join("page.html"));
    fs::write(&scene, IMPERIAL).expect("a scene");
    let limits = ["--limit-force", "2kip", "--limit-force", "50 ft=1kip"];
    let output = creepage(&[&["report", text(&scene), "-o", text(&file)], &limits[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let page = fs::read_to_string(&file).expect("the page");
    let run: Value =
        serde_json::from_slice(&creepage(&["run", text(&scene), "--json"]).stdout).expect("JSON");

    let all = elements(&page);
    let card = |title: &str| {
        let at = all
            .iter()
            .position(|element| element.text == title)
            .expect("a card");
        all[at..].iter().find(|element| element.get("class") == "value")
    };
    let last = &run["passes"][5];
    let force = last["downstream_force_n"].as_f64().expect("a force") / KIP;
    assert_eq!(
        card("Force after the last pass").expect("a value").text,
        format!("{force:.5} kip")
    );
    let moved = last["upstream_displacement_m"].as_f64().expect("a movement") / INCH;
    assert_eq!(
        card("Movement of an end").expect("a value").text,
        format!("{moved:.5} in")
    );
    let heads = [
        "after pass",
        "force downstream, kip",
        "moved upstream, in",
        "moved downstream, in",
    ];
    let rows = table(&page, &heads);
    let shown = rows.last().expect("a row");
    assert_eq!(shown[1], format!("{force:.5}"));
    assert_eq!(shown[2], format!("{moved:.5}"));

    for words in [
        "limit 2 kip",
        "the clamp at 50 ft bears at most",
        "Duct: 98 ft long, 4 ft from the road surface",
        "7.5 lbf/ft heavy, axial stiffness EA 1800 kip",
        "spring of 20 kip/in",
        "Clamp 1: 5 kip/in at 50 ft.",
        "300000 psi",
        "44 kip, concentrated",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // Axes end where the duct does, and the force along it is that of the table.
    let along = figure(&all, "Force along the cable");
    assert!(texts(along, "text").contains(&"98"));
    for name in ["force, kip", "place along the duct, ft"] {
        assert!(texts(along, "text").contains(&name), "{name}");
    }
    // Nothing but the duct's motion, which is in µm and mm/s, and what the program says of its mesh is metric.
    let metric = ["N", "kN", "MN", "N/m", "kN/m", "MN/m", "mm", "MPa"];
    for element in &all {
        let said = element.text.replace("μ N′", "");
        let mut words = said
            .split_whitespace()
            .map(|word| word.trim_end_matches(['.', ',', ';', ':']));
        assert!(!words.any(|word| metric.contains(&word)), "{said}");
    }
}

#[test]
fn a_page_says_what_it_was_made_from_and_can_be_made_again() {
    let folder = folder("record");
    let file = folder.join("page.html");
    let report = |epoch: &str| {
        let output = Command::new(assert_cmd::cargo::cargo_bin!("creepage"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args([
                "report",
                UPPER,
                "-o",
                text(&file),
                "--set",
                "traffic.passes=2",
                "--trucks-per-day",
                "50",
            ])
            .env("SOURCE_DATE_EPOCH", epoch)
            .stdin(Stdio::null())
            .output()
            .expect("the command starts");
        (
            output.status.code(),
            String::from_utf8(output.stderr).expect("UTF-8"),
        )
    };
    let (status, errors) = report("tomorrow");
    assert_eq!(status, Some(2), "{errors}");
    assert!(
        errors.contains("SOURCE_DATE_EPOCH") && errors.contains("tomorrow"),
        "{errors}"
    );
    let mut pages = [String::new(), String::new()];
    for page in &mut pages {
        assert_eq!(report("951782400").0, Some(0));
        *page = fs::read_to_string(&file).expect("the page");
    }
    assert_eq!(pages[0], pages[1]);
    // 29 February 2000.
    assert!(pages[0].contains("computed on 2000-02-29 00:00 UTC by creepage"));
    let elements = elements(&pages[0]);
    let points = texts(&elements, "li");
    assert!(points.contains(&"traffic.passes=2") && points.contains(&"traffic.per_day=50"));
    let read = table(&pages[0], &["read", "SHA-256"]);
    assert_eq!(read.len(), 1);
    assert_eq!(read[0][0], "full-scale-upper.toml");
    let sum = Command::new("sha256sum")
        .arg(UPPER)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    let sum = String::from_utf8(sum.expect("sha256sum").stdout).expect("UTF-8");
    assert!(sum.starts_with(&read[0][1]) && read[0][1].len() == 64, "{sum}");
}
