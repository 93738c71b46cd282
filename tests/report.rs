//! The report: what it says is what a run says, it is well-formed, loads nothing, and no text of a user becomes markup.

use std::fs;

use super::xml::{Element, parse};
use creepage::report::{Report, ReportOptions};
use creepage::scene::TrafficVehicle;
use creepage::{PassRecord, Place, Readings, Scene};
use serde_json::Value;

use crate::command::{UPPER, answer, assert_says, command, folder, json, list, number as value, output};
use crate::scenes::{largest, run as run_of, upper};

const FIGURES: [&str; 8] = [
    "Cross-section of the road",
    "Along the duct",
    "Force against passes",
    "Force along the cable",
    "Movement of the ends",
    "Motion of the duct along its axis; Motion of the duct down",
    "Velocity of the duct along its axis",
    "Friction on the cable, pass 1; Friction on the cable, pass 6",
];
const LAYERED: [&str; 2] = [
    "ground.rigid_base_depth=12 m",
    r#"ground.layers=[{thickness="50 mm", young_modulus="4000 MPa", poisson_ratio=0.35}, {young_modulus="800 MPa", poisson_ratio=0.4}]"#,
];

const CLAMPS: &str =
    r#"restraints=[{position="12 m", stiffness="1 MN/m"}, {position="27 m", stiffness="50 kN/m"}]"#;

/// A scene of six passes.
fn scene(overrides: &[&str]) -> Scene {
    upper(&[&["traffic.passes=6"], overrides].concat())
}

fn report(scene: &Scene, options: &ReportOptions<'_>) -> Report {
    Report::new(scene, options).expect("a report")
}

fn html(scene: &Scene) -> String {
    report(scene, &ReportOptions::default()).to_html()
}

/// The page for a scene of six passes.
fn page(overrides: &[&str]) -> String {
    html(&scene(overrides))
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
fn table(page: &str, heads: &str) -> Vec<Vec<String>> {
    let (mut rows, mut inside, mut head) = (Vec::<Vec<String>>::new(), false, Vec::new());
    for element in &elements(page) {
        match element.name.as_str() {
            "table" => (inside, head) = (false, Vec::new()),
            "th" => {
                head.push(element.text.replace('\u{ad}', ""));
                inside = head.join(" | ") == heads;
            }
            "tr" if inside => rows.push(Vec::new()),
            "td" if inside => rows.last_mut().expect("a row").push(element.text.clone()),
            _ => {}
        }
    }
    assert!(!rows.is_empty(), "no table with {heads:?}");
    rows
}

/// The value of the card with this title.
fn card<'e>(elements: &'e [Element], title: &str) -> &'e str {
    let at = elements.iter().position(|element| element.text == title);
    let mut after = elements[at.expect(title)..].iter();
    let shown = after.find(|element| element.get("class") == "value");
    &shown.expect("a value").text
}

/// The elements of the figure with this title.
fn figure<'e>(elements: &'e [Element], title: &str) -> &'e [Element] {
    let begins = |pair: &[Element]| pair[0].name == "svg" && pair[1].text == title;
    let start = elements.windows(2).position(begins).expect("the figure");
    let rest = &elements[start..];
    let end = rest.iter().position(|element| element.name == "figcaption");
    &rest[..end.expect("a caption")]
}

#[track_caller]
fn number(text: &str) -> f64 {
    let digits = text.split([' ', '\u{a0}']).next().unwrap_or_default();
    digits.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

#[test]
fn the_numbers_are_those_of_the_run() {
    let file = folder("report-numbers").join("upper.html");
    let (status, said, errors) = output(&format!("report UPPER -o {}", file.display()));
    assert_eq!((status, &*said, &*errors), (0, "", ""));
    let page = fs::read_to_string(&file).expect("the page");
    let run = json("run UPPER");
    let close = |shown: &str, found: &Value, factor: f64, half_digit: f64| {
        let (shown, found) = (number(shown), factor * value(found));
        let is_close = (shown - found).abs() <= half_digit * 1.001;
        assert!(is_close, "{shown} where the run says {found}");
    };
    let elements = elements(&page);
    let shown = elements.iter().filter(|element| element.get("class") == "value");
    let shown: Vec<&str> = shown.map(|element| element.text.as_str()).collect();
    let passes = list(&run["passes"]);
    let largest = largest(passes.iter().map(|pass| value(&pass["downstream_peak_n"])));
    let cards = [
        (run["saturation"]["force_n"].clone(), 1.0, 0.05),
        (run["saturation"]["passes_to_95_percent"].clone(), 1.0, 0.0),
        (largest.into(), 1.0, 0.05),
        (passes[199]["upstream_displacement_m"].clone(), 1e3, 5e-4),
        (run["duct_motion"]["peak_longitudinal_m"].clone(), 1e6, 5e-3),
        (run["error_estimate"]["relative"].clone(), 100.0, 5e-3),
    ];
    assert_eq!(shown.len(), cards.len());
    for (shown, (found, factor, half_digit)) in shown.into_iter().zip(cards) {
        close(shown, &found, factor, half_digit);
    }
    let rows = table(&page, "after pass | force downstream, N | moved upstream, mm");
    assert_eq!(rows.len(), 8);
    for row in rows {
        let pass = &passes[number(&row[0]) as usize - 1];
        close(&row[1], &pass["downstream_force_n"], 1.0, 0.05);
        close(&row[2], &pass["upstream_displacement_m"], 1e3, 5e-5);
    }
    let points = texts(&elements, "li");
    for reason in list(&run["plan"]["reasons"]) {
        assert!(points.contains(&reason.as_str().expect("a text")), "{reason}");
    }
    let parts = table(&page, "part | error");
    close(&parts[0][1], &run["error_estimate"]["parts"]["mesh"], 100.0, 5e-3);
    // Table 1 of the paper.
    let numbers = "30 m; 1.2 m; 108.8 N/m; 8.01 MN; 0.25; 27.2 N/m; 200 passes";
    assert_says(&points.join("\n"), &numbers.split("; ").collect::<Vec<_>>());
    let ground = table(&page, "ground at depth | Young’s modulus | Poisson’s ratio");
    assert_eq!(ground, [["everywhere", "800 MPa", "0.4"]]);
}

#[test]
fn every_candidate_is_shown_with_its_fate() {
    let page = page(&LAYERED);
    let plan = creepage::plan(&scene(&LAYERED)).expect("a plan").report();
    let rows = table(&page, "model | before the run: error, time | why, or why not");
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
    let ground = table(&page, "ground at depth | Young’s modulus | Poisson’s ratio");
    assert_eq!(ground[0], ["0 to 0.05 m", "4000 MPa", "0.35"]);
    assert_eq!(ground[2][0], "below 12 m");
}

#[test]
fn all_figures_are_there_with_dark_colours_and_a_page_loads_nothing() {
    let page = page(&[]);
    let all = elements(&page);
    let is_title = |pair: &&[Element]| pair[0].name == "svg" && pair[1].name == "title";
    let titles = all.windows(2).filter(is_title);
    assert!(titles.map(|pair| pair[1].text.as_str()).eq(FIGURES));
    assert!(!page.contains("could not be drawn"));
    for element in &all {
        for property in ["fill", "stroke"] {
            let colour = element.get(property);
            let rule = format!("svg [{property}=\"{colour}\"]{{{property}:#");
            let is_dark = ["", "none"].contains(&colour) || page.contains(&rule);
            assert!(is_dark, "{property} {colour} has no dark colour");
        }
    }
    // The name of a dialect, not an address.
    let dialect = "xmlns=\"http://www.w3.org/2000/svg\"";
    let page = page.to_lowercase().replace(dialect, "");
    assert!(page.contains("default-src 'none'; style-src 'unsafe-inline'"));
    for loads in "<script <link <img <iframe <object src= href= url( @import http:// https://".split(' ') {
        assert!(!page.contains(loads), "{loads}");
    }
}

#[test]
fn figures_and_tables_are_over_time_where_the_vehicles_a_day_are_known() {
    let heads = "after pass | time | force downstream, N | moved upstream, mm";
    for (years, per_day, label) in [
        (20.0, 800.0, "1 month"),
        (100.0, 3.0, "100 years"),
        (0.01, 10000.0, "1 h"),
        (2.0, 0.7, "days"),
        (0.001, 1000.0, "hours"),
    ] {
        let traffic = format!("traffic={{ years = {years}, per_day = {per_day} }}");
        let page = html(&upper(&[&traffic, "duct.length=8 m", "solver.tolerance=0.1"]));
        let all = elements(&page);
        let labels = texts(&all, "text");
        for text in ["Force against time", label] {
            assert!(labels.contains(&text), "{traffic}: {labels:?}");
        }
        assert!(!page.contains("could not be drawn"), "{traffic}");
        table(&page, heads);
    }
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
    let page = report(&scene, &options).to_html();
    assert!(!page.contains("<script") && !page.contains("<b>"));
    let all = elements(&page);
    assert_eq!(texts(&all, "h1"), [nasty]);
    assert!(["td", "li"].iter().all(|name| texts(&all, name).contains(&nasty)));
    assert!(texts(&all, "title")[0].starts_with(nasty));
}

/// A load cell's table of six passes, each reading made from its record, and further lines.
fn cell(reading: impl Fn(&PassRecord) -> f64, more: &str) -> Readings {
    let run = run_of(&scene(&[]));
    let row = |record: &PassRecord| format!("{},{},5\n", record.pass, reading(record));
    let rows = run.passes.iter().map(row);
    let csv = format!("pass,force_n,sigma_n\n{}{more}", rows.collect::<String>());
    Readings::from_csv("cell.csv", csv.as_bytes()).expect("readings")
}

#[test]
fn readings_are_drawn_and_compared() {
    // Ten newtons above what is computed, one reading beyond the passes, and an overload.
    let higher = |record: &PassRecord| record.downstream_force_n + 10.0;
    let readings = cell(higher, "9,500,5\n10,9.9e37,5\n");
    let options = ReportOptions {
        readings: Some(&readings),
        ..ReportOptions::default()
    };
    let with = report(&scene(&[]), &options).to_html();
    let sizes = ["of 6 of them: mean 10.0 N", "10.0 N, largest reading 500.0 N"];
    assert_says(
        &with,
        &[&sizes[..], &["7 readings", "left out: pass 10 (line 9)"]].concat(),
    );
    let circles = |page: &str| {
        let all = elements(page);
        let drawn = figure(&all, "Force against passes").iter();
        let drawn = drawn.filter(|element| element.name == "circle" || element.name == "polyline");
        drawn.filter(|element| element.get("stroke") == "#009E73").count()
    };
    // Each reading is a circle and a bar; the legend shows one circle more.
    assert_eq!((circles(&with), circles(&page(&[]))), (2 * 7 + 1, 0));
    let error = Report::new(&scene(&["ends.downstream=free"]), &options).expect_err("no end is held");
    assert!(error.is_bad_input(), "{error}");

    let readings = cell(|record| 1e-3 * record.downstream_force_n, "");
    let options = ReportOptions {
        readings: Some(&readings),
        ..ReportOptions::default()
    };
    let report = report(&scene(&[]), &options);
    assert_says(&report.mistakes()[0], &["are they kN?"]);
    assert_says(&report.to_html(), &[&report.mistakes()[0]]);
}

#[test]
fn every_clamp_has_its_force_and_rows_their_vehicle() {
    let mut scene = scene(&[CLAMPS, "ends.downstream.spring=1 MN/m"]);
    let mut other = TrafficVehicle::point("back", 1e5, 10.0);
    (scene.vehicles[0].share, other.share) = (0.75, 0.25);
    scene.vehicles.push(other);
    let mut options = ReportOptions::default();
    options.limits.downstream.movement_m = Some(1.0);
    let report = report(&scene, &options);
    let (page, run) = (report.to_html(), report.run());
    let largest = |place: f64| run.largest(Place::Clamp(place), creepage::Limited::Force);
    let head = "clamp at | force after the last pass, N | force at most during a pass, N | moved at most during a pass, mm";
    for (row, place) in table(&page, head).iter().zip([12.0, 27.0]) {
        assert_eq!(number(&row[0]), place);
        assert!((number(&row[2]) - largest(place)).abs() < 0.051, "{row:?}");
    }
    let card = page.split("Largest force on a clamp").nth(1).expect("a card");
    assert_says(card, &["during a pass"]);
    assert_says(&page, &["(--limit-force clamp=FORCE)"]);
    let head = "after pass | force downstream, N | moved upstream, mm | moved downstream, mm | vehicle";
    let rows = table(&page, head);
    // Of four vehicles, one is the other.
    let back = rows.iter().filter(|row| row[4] == "back").count();
    assert!(rows.len() == 6 && (1..=2).contains(&back), "{rows:?}");
}

/// No force at all; both ends free; a lane beside the duct; cables in trefoil; more passes than can be computed one by one.
#[test]
fn other_scenes_have_their_pages() {
    let trefoil = "duct.inner_diameter=200 mm; cable.diameter=67 mm; cable.arrangement=trefoil";
    for (overrides, said) in [
        ("friction.dynamic_coefficient=0", "no friction"),
        ("ends.downstream=free", "largest compression in the cable"),
        ("duct.lateral_offset=2 m", "2 m right of the duct"),
        (&format!("{trefoil}-lower"), "1.736 times its weight"),
        (&format!("{trefoil}-upper"), "compute the others too"),
        (
            "traffic.passes=2000000; solver.tolerance=0.05",
            "2\u{a0}000\u{a0}000 passes",
        ),
    ] {
        let page = page(&overrides.split("; ").collect::<Vec<_>>());
        elements(&page);
        assert_says(&page, &[said]);
        assert!(!page.contains("could not be drawn"), "{overrides}");
    }
}

#[test]
fn a_life_in_parts_is_drawn_on_one_axis() {
    let first = creepage::run(&scene(&["traffic.passes=20"])).expect("the first part");
    let options = ReportOptions {
        start: first.state.as_ref(),
        ..ReportOptions::default()
    };
    let report = report(&scene(&["traffic.passes=30"]), &options);
    let page = report.to_html();
    assert!(!page.contains("What to fit"));
    let all = elements(&page);
    let force = texts(figure(&all, "Force against passes"), "text");
    // The passes of this part alone would end at 30.
    assert!(force.contains(&"40"), "{force:?}");
    // What the first part left, after some of its passes and the last.
    let history = first.state.as_ref().expect("a state").history();
    let last = history.last().expect("a pass");
    let force = first.passes[19].downstream_force_n;
    assert_eq!((last.pass, last.force_n[1]), (20, force));
    let both = report.run().state.as_ref().expect("a state").history();
    assert_eq!((&both[..history.len()], both[both.len() - 1].pass), (history, 50));
}

/// Places of a drawing's points \[px\].
fn points(element: &Element) -> Vec<(f64, f64)> {
    let pair = |point: &str| {
        let (x, y) = point.split_once(',').expect("x,y");
        (number(x), number(y))
    };
    element.get("points").split_whitespace().map(pair).collect()
}

#[test]
fn the_cross_section_is_to_scale_and_lanes_are_on_their_side() {
    let mut scene = scene(&[
        "traffic.passes=2",
        "ground.rigid_base_depth=4 m",
        r#"ground.layers=[{thickness="50 cm", young_modulus="400 MPa", poisson_ratio=0.35}, {young_modulus="80 MPa", poisson_ratio=0.4}]"#,
        "duct.lateral_offset=1 m",
        "duct.depth=3 m",
    ]);
    let mut other = TrafficVehicle::point("back", 1e5, 10.0);
    (other.direction, other.lateral_offset) = (ground_field::Direction::Reverse, -3.0);
    (scene.vehicles[0].share, other.share) = (0.75, 0.25);
    scene.vehicles.push(other);
    let all = elements(&html(&scene));
    let drawing = figure(&all, "Cross-section of the road");
    let words = texts(drawing, "text");
    assert!(words.contains(&"duct, 3 m deep"), "{words:?}");
    // The signs of direction, the duct as a disc, layers as boxes from the left to the right edge.
    let signs = ["⊗", "⊙"].map(|sign| drawing.iter().find(|element| element.text == sign).expect(sign));
    let signs = signs.map(|sign| number(sign.get("x")));
    let polygons = drawing.iter().filter(|element| element.name == "polygon");
    let polygons: Vec<Vec<(f64, f64)>> = polygons.map(points).collect();
    let disc = polygons.iter().rfind(|disc| disc.len() == 24).expect("the duct");
    let mean = |of: fn(&(f64, f64)) -> f64| disc.iter().map(of).sum::<f64>() / 24.0;
    let duct = (mean(|point| point.0), mean(|point| point.1));
    let is_box = |shape: &&Vec<(f64, f64)>| shape.len() == 4 && shape[1].0 - shape[0].0 > 100.0;
    let boxes: Vec<_> = polygons.iter().filter(is_box).collect();
    assert_eq!(boxes.len(), 3, "two layers and rock");
    // The reverse lane lies 3 m to the right of the other one, and the duct 1 m to the left.
    let scale = (signs[1] - signs[0]) / 3.0;
    let surface = boxes[0][0].1;
    for (found, expected) in [
        (signs[0] - duct.0, scale),
        (duct.1 - surface, 3.0 * scale),
        (boxes[0][2].1 - surface, 0.5 * scale),
        (boxes[1][2].1 - surface, 4.0 * scale),
    ] {
        assert!((found - expected).abs() < 0.2, "{found} px, {expected} px");
    }
}

#[test]
fn the_side_view_has_clamps_at_their_places_and_ends_where_the_duct_does() {
    let page = page(&[CLAMPS, "duct.slope=-0.02"]);
    let all = elements(&page);
    let drawing = figure(&all, "Along the duct");
    let (words, points) = (texts(drawing, "text"), texts(&all, "li"));
    for text in ["0", "30", "free", "fixed"] {
        assert!(words.contains(&text), "{words:?}");
    }
    for text in ["Clamp 1: 1000 kN/m at 12 m.", "Clamp 2: 50 kN/m at 27 m."] {
        assert!(points.contains(&text), "{text}: {points:?}");
    }
    let at = |label: &str| {
        let text = drawing.iter().rfind(|element| element.text == label);
        number(text.expect("a label").get("x"))
    };
    // The labels of the axis are 30 m apart, the numbers of the clamps stand above them.
    let scale = (at("30") - at("0")) / 30.0;
    for (clamp, place) in [("1", 12.0), ("2", 27.0)] {
        assert!((at(clamp) - at("0") - place * scale).abs() < 0.2, "clamp {clamp}");
    }
    assert_says(&page, &["it falls with x by 2 %, and "]);
    let along = texts(figure(&all, "Force along the cable"), "text");
    assert!(along.contains(&"30") && !along.contains(&"40"), "{along:?}");
}

/// \[N\] and \[m\].
const KIP: f64 = 4448.2216152605;
const INCH: f64 = 0.0254;

#[test]
fn a_page_is_in_the_units_that_were_typed() {
    const SCENE: &str = "examples/scenes/imperial-units.toml --set traffic.passes=6";
    let file = folder("imperial").join("page.html");
    let limits = "--limit-force 2kip --limit-force '50 ft=1kip'";
    let done = output(&format!("report {SCENE} -o {} {limits}", file.display()));
    assert_eq!(done.0, 0, "{done:?}");
    let page = fs::read_to_string(&file).expect("the page");
    let run = json(&format!("run {SCENE}"));

    let all = elements(&page);
    let last = &run["passes"][5];
    let force = format!("{:.5}", value(&last["downstream_force_n"]) / KIP);
    let moved = format!("{:.5}", value(&last["upstream_displacement_m"]) / INCH);
    assert_eq!(card(&all, "Force after the last pass"), format!("{force} kip"));
    assert_eq!(card(&all, "Movement of an end"), format!("{moved} in"));
    let heads = "after pass | force downstream, kip | moved upstream, in | moved downstream, in";
    let rows = table(&page, heads);
    assert_eq!(rows.last().expect("a row")[1..3], [force, moved]);
    let typed = "2 kip;50 ft;98 ft;4 ft;7.5 lbf/ft;1800 kip;20 kip/in;5 kip/in;300000 psi;44 kip";
    assert_says(&page, &typed.split(';').collect::<Vec<_>>());
    // Axes end where the duct does, and the force along it is that of the table.
    let along = texts(figure(&all, "Force along the cable"), "text");
    for name in ["98", "force, kip", "place along the duct, ft"] {
        assert!(along.contains(&name), "{along:?}");
    }
    // Nothing but the duct's motion, which is in µm and mm/s, and what the program says of its mesh is metric.
    let metric = ["N", "kN", "MN", "N/m", "kN/m", "MN/m", "mm", "MPa"];
    for element in &all {
        let said = element.text.replace("μ N′", "");
        let mut words = said.split([' ', '\n', '\u{a0}']);
        let is_metric = |word: &str| metric.contains(&word.trim_end_matches(['.', ',', ';', ':']));
        assert!(!words.any(is_metric), "{said}");
    }
}

#[test]
fn a_page_says_what_it_was_made_from_and_can_be_made_again() {
    let file = folder("record").join("page.html");
    let line = format!(
        "report UPPER -o {} --set traffic.passes=2 --trucks-per-day 50",
        file.display()
    );
    let report = |epoch: &str| {
        let output = command(&line).env("SOURCE_DATE_EPOCH", epoch).output();
        answer(output.expect("an answer"))
    };
    let (status, _, errors) = report("tomorrow");
    assert_eq!(status, 2, "{errors}");
    let [page, again] = [(), ()].map(|()| {
        assert_eq!(report("951782400").0, 0);
        fs::read_to_string(&file).expect("the page")
    });
    assert_eq!(page, again);
    // 29 February 2000.
    assert_says(&page, &["computed on 2000-02-29 00:00 UTC by creepage"]);
    let all = elements(&page);
    let points = texts(&all, "li");
    assert!(points.contains(&"traffic.passes=2") && points.contains(&"traffic.per_day=50"));
    let read = table(&page, "read | SHA-256");
    assert_eq!((read.len(), &*read[0][0]), (1, "full-scale-upper.toml"));
    let sum = std::process::Command::new("sha256sum").arg(UPPER).output();
    let sum = String::from_utf8(sum.expect("sha256sum").stdout).expect("UTF-8");
    assert!(sum.starts_with(&read[0][1]) && read[0][1].len() == 64, "{sum}");
}
