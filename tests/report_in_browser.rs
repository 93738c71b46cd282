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
use std::path::PathBuf;

use creepage::report::{Report, ReportOptions};
use creepage::scene::{Dimension, TrafficVehicle, Unit};
use creepage::{Readings, Scene, SceneFile, Units};
use ground_field::Direction;
use serde_json::Value;

use devtools::{Browser, CONTRAST_OF, DESK, MIN_CONTRAST, PHONE};

/// A4 without its margins of 15 mm, at 96 px an inch.
const SHEET: u32 = 680;
/// Smallest text of a figure that is read on a phone \[px\].
const SMALLEST_TEXT: f64 = 10.0;

/// What the page measures of itself.
const MEASURE: &str = r#"
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
  };"#;

/// What the browser saw of a page.
struct Seen {
    result: Value,
    console: Vec<String>,
}

/// A browser that shows one page after the other.
struct Screen {
    browser: Browser,
    // Dropped after the browser, which writes there.
    folder: Folder,
    count: usize,
}

/// A folder that goes with its owner.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

impl Screen {
    fn new() -> Self {
        let (browser, folder) = Browser::open("report_in_browser", DESK, false);
        Self {
            browser,
            folder: Folder(folder),
            count: 0,
        }
    }

    /// Shows `page` on a screen of `width` px.
    fn show(&mut self, page: &str, width: u32, dark: bool) -> Seen {
        self.count += 1;
        let name = format!("page-{}.html", self.count);
        let file = self.folder.0.join(&name);
        fs::write(&file, page).expect("the page");
        self.browser.screen(width, dark);
        let is_there = format!("document.readyState === 'complete' && location.pathname.endsWith('/{name}')");
        self.browser.go(&format!("file://{}", file.display()), &is_there);
        let result = self
            .browser
            .value(&format!("(() => {{{CONTRAST_OF}{MEASURE}}})()"));
        let complaints = self.browser.complaints();
        let console = complaints
            .iter()
            .map(|event| format!("CONSOLE {event}"))
            .collect();
        Seen { result, console }
    }

    /// What is wrong with a page of so many figures; nothing if all is well.
    fn faults(&mut self, page: &str, width: u32, dark: bool, figures: usize) -> Vec<String> {
        faults(self.show(page, width, dark), width, dark, figures)
    }
}

fn faults(seen: Seen, width: u32, dark: bool, figures: usize) -> Vec<String> {
    let Seen { result, console } = seen;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let of = |name: &str| number(&result[name]);
    let seen = result["figures"].as_array().expect("a list");
    let wide = f64::from(width);
    #[rustfmt::skip]
    let mut checks = vec![
        (of("width") == wide, format!("the page is {} px wide", result["width"])),
        (result["dark"] == dark, format!("dark is {}, asked {dark}", result["dark"])),
        (of("scroll") <= of("room"), format!("{} px scroll sideways", result["scroll"])),
        (of("contrast") >= MIN_CONTRAST, format!("contrast of words {}", result["contrast"])),
        (seen.len() == figures, format!("{} figures", seen.len())),
    ];
    for (k, figure) in seen.iter().enumerate() {
        let of = |name: &str| number(&figure[name]);
        let is_empty = |name: &str| figure[name].as_array().is_some_and(Vec::is_empty);
        #[rustfmt::skip]
        let of_figure = [
            (of("width") > 200.0 && of("height") > 100.0, format!("figure {k} is not seen: {figure}")),
            (of("right") <= wide, format!("figure {k} is cut off: {figure}")),
            (of("text") >= SMALLEST_TEXT, format!("figure {k}: text of {} px", figure["text"])),
            (of("contrast") >= MIN_CONTRAST, format!("figure {k}: contrast {}", figure["contrast"])),
            (is_empty("outside"), format!("figure {k}: outside {}", figure["outside"])),
            (is_empty("overlapping"), format!("figure {k}: overlapping {}", figure["overlapping"])),
        ];
        checks.extend(of_figure);
    }
    let wrong = checks.into_iter().filter(|check| !check.0);
    console.into_iter().chain(wrong.map(|check| check.1)).collect()
}

fn upper(overrides: &[&str]) -> Scene {
    let file = SceneFile::read("examples/scenes/full-scale-upper.toml");
    file.and_then(|file| file.with(overrides)?.scene())
        .expect("a scene")
}

fn page(scene: &Scene, options: &ReportOptions<'_>) -> String {
    Report::new(scene, options).expect("a report").to_html()
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
    other.direction = Direction::Reverse;
    (scene.vehicles[0].share, other.share) = (0.6, 0.4);
    scene.vehicles.push(other);
    let readings = b"pass,force_n,sigma_n\n1,50,9\n20,200,9\n40,260,9\n";
    let readings = Readings::from_csv("cell.csv", readings).expect("readings");
    let warnings = [format!("a warning about {long}")];
    let options = ReportOptions {
        readings: Some(&readings),
        warnings: &warnings,
        ..ReportOptions::default()
    };
    page(&scene, &options)
}

fn plain() -> String {
    page(&upper(&[]), &ReportOptions::default())
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
    page(&upper(&[]), &options)
}

#[test]
#[ignore = "needs Chromium"]
fn the_page_is_well_on_phones_and_desks_by_day_and_night() {
    let mut screen = Screen::new();
    for page in [plain(), full(), imperial()] {
        for width in [PHONE, DESK] {
            for dark in [false, true] {
                let faults = screen.faults(&page, width, dark, 8);
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
    let mut screen = Screen::new();
    // Without friction nothing moves, which no chart shows.
    for (scene, figures) in [(many, 8), (none, 7)] {
        let faults = screen.faults(&page(&scene, &ReportOptions::default()), PHONE, false, figures);
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
    let (page, mut screen) = (plain(), Screen::new());
    let mut seen = |page: &str, width: u32| {
        let Seen { result, console } = screen.show(page, width, false);
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
    let lane = |(k, (lateral_offset, direction)): (usize, (f64, Direction))| TrafficVehicle {
        lateral_offset,
        direction,
        ..TrafficVehicle::point(&format!("vehicle in lane {k}"), 5e4, 15.0)
    };
    let there = [0.0, 0.2, 3.5, -3.5, 10.5].map(|offset| (offset, Direction::Forward));
    let back = [-0.4, 7.0].map(|offset| (offset, Direction::Reverse));
    scene.vehicles = there.into_iter().chain(back).enumerate().map(lane).collect();
    page(&scene, &ReportOptions::default())
}

#[test]
#[ignore = "needs Chromium"]
fn heat_and_crowded_drawings_are_well_on_every_screen_and_on_paper() {
    let (page, mut screen) = (crowded(), Screen::new());
    for (page, width, dark) in [
        (&page, PHONE, false),
        (&page, PHONE, true),
        (&page, DESK, false),
        (&page, DESK, true),
        (&printed(&page), SHEET, false),
    ] {
        // Two drawings; two figures of force, three of heat, two of the cause.
        let faults = screen.faults(page, width, dark, 9);
        assert!(faults.is_empty(), "{width} px, dark {dark}: {faults:#?}");
    }
}

/// The checks find what is wrong.
#[test]
#[ignore = "needs Chromium"]
fn a_fault_is_seen() {
    let page = page(&upper(&["traffic.passes=2"]), &ReportOptions::default());
    #[rustfmt::skip]
    let faulty = [
        ("<main>", "<main><div style=\"width:600px\">wide</div>", "scroll sideways"),
        ("<figure>", "<figure style=\"display:none\">", "figure 0 is not seen"),
        ("<main>", "<main><img src=\"http://localhost:9/x.png\" alt=\"\"/>", "CONSOLE"),
        ("<main>", "<main><script>broken(</script>", "CONSOLE"),
        ("svg [fill=\"#262626\"]", "svg [fill=\"#000001\"]", "contrast"),
        ("columns: 2 22rem", "columns: 2", "text of"),
    ];
    let mut screen = Screen::new();
    for (old, new, fault) in faulty {
        assert!(page.contains(old), "{old}");
        let faults = screen.faults(&page.replacen(old, new, 1), PHONE, true, 8);
        let is_seen = faults.iter().any(|found| found.contains(fault));
        assert!(is_seen, "{fault}: {faults:#?}");
    }
    assert_eq!(screen.faults(&page, PHONE, true, 8), Vec::<String>::new());
}
