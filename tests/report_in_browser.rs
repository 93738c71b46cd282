//! The report in a browser: nothing on the console, every figure seen, no sideways scroll on a phone, legible in light and dark.
//!
//! Needs Chromium (Debian's package `chromium`, or `CHROMIUM` in the environment), so it is run by
//! `cargo test --test report_in_browser -- --ignored`; `.ci/run` does.

#[allow(
    dead_code,
    reason = "keys are pressed on the page of `creepage explore` alone"
)]
#[path = "explore/devtools.rs"]
mod devtools;

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use creepage::report::{Report, ReportOptions};
use creepage::scene::{Dimension, TrafficVehicle, Unit};
use creepage::{Readings, Scene, Units};
use serde_json::{Value, json};

use devtools::Browser;

const PHONE: u32 = 390;
const DESK: u32 = 1200;
/// A4 without its margins of 15 mm, at 96 px an inch.
const SHEET: u32 = 680;
/// Smallest text of a figure that is read on a phone \[px\].
const SMALLEST_TEXT: f64 = 10.0;
/// Least contrast of text (WCAG 2.1, success criterion 1.4.3).
const LEAST_CONTRAST: f64 = 4.5;
const PATIENCE: Duration = Duration::from_secs(60);

/// What the page measures of itself.
const MEASURE: &str = r#"(() => {
  const channels = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map((c) => {
    const share = c / 255;
    return share <= 0.03928 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  const luminance = (colour) => {
    const [red, green, blue] = channels(colour);
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const contrast = (one, other) => {
    const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const touch = (a, b) =>
    a.left + 1 < b.right - 1 && b.left + 1 < a.right - 1 && a.top + 1 < b.bottom - 1 && b.top + 1 < a.bottom - 1;
  const ground = getComputedStyle(document.body).backgroundColor;
  const figures = [...document.querySelectorAll("svg[role=img]")].map((svg) => {
    const box = svg.getBoundingClientRect();
    const scale = box.width / svg.viewBox.baseVal.width;
    const texts = [...svg.querySelectorAll("text")];
    const boxes = texts.map((text) => text.getBoundingClientRect());
    const styles = texts.map((text) => getComputedStyle(text));
    return {
      width: box.width, height: box.height, right: box.right,
      text: Math.min(...styles.map((style) => parseFloat(style.fontSize) * scale)),
      contrast: Math.min(...styles.map((style) => contrast(style.fill, ground))),
      outside: texts.filter((text, k) => boxes[k].left < box.left - 1 || boxes[k].right > box.right + 1
        || boxes[k].top < box.top - 1 || boxes[k].bottom > box.bottom + 1).map((text) => text.textContent.trim()),
      overlapping: texts.filter((text, k) => boxes.some((other, l) => l < k && touch(boxes[k], other)))
        .map((text) => text.textContent.trim()),
    };
  });
  const root = document.documentElement;
  // What is folded: not a word of it is seen, but for the summary.
  const folded = [...document.querySelectorAll("details > :not(summary)")];
  const unfolded = folded.filter((part) => part.checkVisibility({ contentVisibilityAuto: true })).length;
  const words = [...document.querySelectorAll("h1, h2, p, li, td, th, dt, dd, figcaption")];
  return {
    width: innerWidth, scroll: root.scrollWidth, room: root.clientWidth,
    dark: matchMedia("(prefers-color-scheme: dark)").matches, figures, folded: folded.length, unfolded,
    contrast: Math.min(...words.map((word) => contrast(getComputedStyle(word).color, ground))),
  };
})()"#;

/// What the browser saw of a page.
struct Seen {
    result: Value,
    console: Vec<String>,
}

/// Shows `page` on a screen of `width` px.
fn show(page: &str, width: u32, dark: bool) -> Seen {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let name = format!("report_in_browser/{}-{number}", std::process::id());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("page.html");
    fs::write(&file, page).expect("the page");
    let mut browser = Browser::start(&folder);
    browser.size(width, 844);
    browser.media("prefers-color-scheme", if dark { "dark" } else { "light" });
    let address = format!("file://{}", file.display());
    browser.call("Page.navigate", &json!({ "url": address }));
    let begun = Instant::now();
    let is_there = "document.readyState === 'complete' && location.protocol === 'file:'";
    while browser.value(is_there) != json!(true) {
        assert!(begun.elapsed() < PATIENCE, "the page does not come");
        std::thread::sleep(Duration::from_millis(20));
    }
    let result = browser.value(MEASURE);
    let console = browser
        .complaints()
        .iter()
        .map(|event| format!("CONSOLE {event}"))
        .collect();
    let _ = fs::remove_dir_all(&folder);
    Seen { result, console }
}

/// What is wrong with a page of so many figures; nothing where all is well.
fn faults(page: &str, width: u32, dark: bool, figures: usize) -> Vec<String> {
    let Seen { result, console } = show(page, width, dark);
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let mut faults = console;
    let mut check = |holds: bool, fault: String| {
        if !holds {
            faults.push(fault);
        }
    };
    check(
        number(&result["width"]) == f64::from(width),
        format!("the page is {} px wide", result["width"]),
    );
    check(
        result["dark"] == dark,
        format!("dark is {}, asked {dark}", result["dark"]),
    );
    check(
        number(&result["scroll"]) <= number(&result["room"]),
        format!(
            "{} px of content in {} px scroll sideways",
            result["scroll"], result["room"]
        ),
    );
    check(
        number(&result["contrast"]) >= LEAST_CONTRAST,
        format!("contrast of words {}", result["contrast"]),
    );
    let seen = result["figures"].as_array().expect("a list");
    check(seen.len() == figures, format!("{} figures", seen.len()));
    for (k, figure) in seen.iter().enumerate() {
        check(
            number(&figure["width"]) > 200.0 && number(&figure["height"]) > 100.0,
            format!("figure {k} is not seen: {figure}"),
        );
        check(
            number(&figure["right"]) <= f64::from(width),
            format!("figure {k} is cut off: {figure}"),
        );
        check(
            number(&figure["text"]) >= SMALLEST_TEXT,
            format!("figure {k}: text of {} px", figure["text"]),
        );
        check(
            number(&figure["contrast"]) >= LEAST_CONTRAST,
            format!("figure {k}: contrast {}", figure["contrast"]),
        );
        for list in ["outside", "overlapping"] {
            let texts = figure[list].as_array().expect("a list");
            check(texts.is_empty(), format!("figure {k}: {list} {}", figure[list]));
        }
    }
    faults
}

fn upper(overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|set| (*set).to_owned()).collect();
    creepage::SceneFile::read("examples/scenes/full-scale-upper.toml")
        .and_then(|file| file.with(&overrides)?.scene())
        .expect("a scene")
}

/// A page with everything on it: readings, layers, two kinds of vehicles, springs, a clamp, long names, warnings, a failed way.
fn full() -> String {
    let long = "AnEndlessNameWithoutAnySpaceInIt".repeat(4);
    let mut scene = upper(&[
        "traffic.passes=40",
        "ground.rigid_base_depth=12 m",
        "ground.vertical_peak=115 um",
        r#"ground.layers=[{thickness="50 mm", young_modulus="4000 MPa", poisson_ratio=0.35}, {young_modulus="800 MPa", poisson_ratio=0.4}]"#,
        "ends.upstream.spring=1 MN/m",
        "ends.downstream.spring=3 MN/m",
        r#"restraints=[{position="20 m", stiffness="1 MN/m"}]"#,
    ]);
    scene.title = format!("<b>{long}</b>");
    let mut other = TrafficVehicle::point(&long, 5e4, 15.0);
    other.direction = ground_field::Direction::Reverse;
    (scene.vehicles[0].share, other.share) = (0.6, 0.4);
    scene.vehicles.push(other);
    let readings = Readings::from_csv("cell.csv", b"pass,force_n,sigma_n\n1,50,9\n20,200,9\n40,260,9\n")
        .expect("readings");
    let warnings = [format!("a warning about {long}")];
    let options = ReportOptions {
        readings: Some(&readings),
        warnings: &warnings,
        ..ReportOptions::default()
    };
    Report::new(&scene, &options).expect("a report").to_html()
}

fn plain() -> String {
    Report::new(&upper(&[]), &ReportOptions::default())
        .expect("a report")
        .to_html()
}

/// Other units have longer names, and more digits in a table.
fn imperial() -> String {
    let unit = |dimension, symbol| Unit::of(dimension, symbol).expect("a unit");
    let units = Units {
        force: unit(Dimension::Force, "kip"),
        movement: Unit::INCH,
        stiffness: unit(Dimension::ForcePerLength, "kip/in"),
        length: Unit::FOOT,
        weight: unit(Dimension::ForcePerLength, "lbf/ft"),
        modulus: unit(Dimension::Pressure, "psi"),
    };
    let options = ReportOptions {
        units,
        ..ReportOptions::default()
    };
    Report::new(&upper(&[]), &options).expect("a report").to_html()
}

#[test]
#[ignore = "needs Chromium"]
fn the_page_is_well_on_phones_and_desks_by_day_and_night() {
    for page in [plain(), full(), imperial()] {
        for width in [PHONE, DESK] {
            for dark in [false, true] {
                let faults = faults(&page, width, dark, 8);
                assert!(faults.is_empty(), "{width} px, dark {dark}: {faults:#?}");
            }
        }
    }
}

#[test]
#[ignore = "needs Chromium"]
fn millions_of_passes_and_no_friction_are_well_on_a_phone() {
    let many = upper(&["traffic.passes=2000000", "solver.tolerance=0.05"]);
    let none = upper(&["friction.dynamic_coefficient=0", "traffic.passes=3"]);
    // Without friction nothing moves, which no chart shows.
    for (scene, figures) in [(many, 8), (none, 7)] {
        let page = Report::new(&scene, &ReportOptions::default())
            .expect("a report")
            .to_html();
        let faults = faults(&page, PHONE, false, figures);
        assert!(faults.is_empty(), "{faults:#?}");
    }
}

/// The page as printed: the style of paper on a sheet of A4 within its margins. A browser that does not print shows no boxes in margins.
fn printed(page: &str) -> String {
    let printed = page.replacen("@media print {", "@media all {", 1);
    assert_ne!(printed, page, "the page has no style for paper");
    printed
}

#[test]
#[ignore = "needs Chromium"]
fn what_is_folded_is_open_on_paper() {
    let page = plain();
    let seen = |page: &str, width: u32| {
        let Seen { result, console } = show(page, width, false);
        assert_eq!(console, Vec::<String>::new());
        (result["folded"].as_u64(), result["unfolded"].as_u64())
    };
    let (folded, unfolded) = seen(&page, DESK);
    assert!(
        folded > Some(5) && unfolded == Some(0),
        "{folded:?}, {unfolded:?}"
    );
    assert_eq!(seen(&printed(&page), SHEET), (folded, folded));
}

/// Heat, a slope, clamps closer than their numbers, lanes above each other, layers thinner than their labels, deep rock.
fn crowded() -> String {
    let mut scene = upper(&[
        "traffic.passes=40",
        "traffic.per_day=20",
        "duct.slope=0.07",
        "duct.length=137.5 m",
        "ground.rigid_base_depth=60 m",
        r#"ground.layers=[
            {thickness="4 cm", young_modulus="6000 MPa", poisson_ratio=0.35},
            {thickness="8 cm", young_modulus="4500 MPa", poisson_ratio=0.35},
            {thickness="25 cm", young_modulus={top="412.5 MPa", bottom="187.5 MPa"}, poisson_ratio=0.35},
            {thickness="30 m", young_modulus="80 MPa", poisson_ratio=0.4},
            {young_modulus="800 MPa", poisson_ratio=0.4}]"#,
        "ends.upstream.spring=1.234 MN/m",
        "ends.downstream.spring=30 MN/m",
        r#"restraints=[{position="20 m", stiffness="1 MN/m"}, {position="23 m", stiffness="1 MN/m"}, {position="136 m", stiffness="123.4 kN/m"}]"#,
        r#"heat={expansion="17e-6 1/K", daily_swing="15 K"}"#,
        "solver.tolerance=0.1",
    ]);
    let lanes = [
        (0.0, true),
        (0.2, true),
        (-0.4, false),
        (3.5, true),
        (7.0, false),
        (-3.5, true),
        (10.5, true),
    ];
    scene.vehicles = lanes
        .into_iter()
        .enumerate()
        .map(|(k, (lateral_offset, forward))| {
            let mut lane = TrafficVehicle::point(&format!("vehicle in lane {k}"), 5e4, 15.0);
            if !forward {
                lane.direction = ground_field::Direction::Reverse;
            }
            lane.lateral_offset = lateral_offset;
            lane
        })
        .collect();
    Report::new(&scene, &ReportOptions::default())
        .expect("a report")
        .to_html()
}

#[test]
#[ignore = "needs Chromium"]
fn heat_and_crowded_drawings_are_well_on_every_screen_and_on_paper() {
    let page = crowded();
    for (page, width, dark) in [
        (&page, PHONE, false),
        (&page, PHONE, true),
        (&page, DESK, false),
        (&page, DESK, true),
        (&printed(&page), SHEET, false),
    ] {
        // Two drawings; two figures of force, three of heat, two of the cause.
        let faults = faults(page, width, dark, 9);
        assert!(faults.is_empty(), "{width} px, dark {dark}: {faults:#?}");
    }
}

/// The checks find what is wrong.
#[test]
#[ignore = "needs Chromium"]
fn a_fault_is_seen() {
    let page = Report::new(&upper(&["traffic.passes=2"]), &ReportOptions::default())
        .expect("a report")
        .to_html();
    let with = |old: &str, new: &str| {
        assert!(page.contains(old), "{old}");
        page.replacen(old, new, 1)
    };
    let body = "<main>";
    let cases = [
        (
            with(body, "<main><div style=\"width:600px\">wide</div>"),
            "scroll sideways",
        ),
        (
            with("<figure>", "<figure style=\"display:none\">"),
            "figure 0 is not seen",
        ),
        (
            with(body, "<main><img src=\"http://localhost:9/x.png\" alt=\"\"/>"),
            "CONSOLE",
        ),
        (with(body, "<main><script>broken(</script>"), "CONSOLE"),
        (
            with("svg [fill=\"#262626\"]", "svg [fill=\"#000001\"]"),
            "contrast",
        ),
        (with("columns: 2 22rem", "columns: 2"), "text of"),
    ];
    for (page, fault) in &cases {
        let faults = faults(page, PHONE, true, 8);
        assert!(
            faults.iter().any(|found| found.contains(fault)),
            "{fault}: {faults:#?}"
        );
    }
    assert_eq!(faults(&page, PHONE, true, 8), Vec::<String>::new());
}
