//! The page of `creepage explore` in Chromium, by its keyboard: sliders, a typed value, a refusal, pins, the pass, files; on phones and
//! desks, by day and night.
//!
//! Needs Chromium (Debian's package `chromium`, or `CHROMIUM` in the environment), so it is run by
//! `cargo test --test explore_in_browser -- --ignored`; `.ci/run` does.

#![cfg(all(feature = "explore", unix))]

#[path = "explore/devtools.rs"]
mod devtools;
#[path = "explore/server.rs"]
mod server;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use devtools::Browser;
use server::{Explored, output};

const PHONE: u32 = 390;
const DESK: u32 = 1200;
/// Least contrast of text (WCAG 2.1, success criterion 1.4.3).
const LEAST_CONTRAST: f64 = 4.5;
const PATIENCE: Duration = Duration::from_secs(60);
/// Whether the last full answer and its pass are there.
const RESTS: &str = "settled && !under && film !== null && !/…/.test(get('state').textContent)";
/// Of all words that are seen, the least contrast with what is behind them.
const CONTRAST: &str = r"(() => {
  const channels = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (colour) => channels(colour).slice(0, 3).map((c) => c / 255)
    .map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, k) => sum + [0.2126, 0.7152, 0.0722][k] * c, 0);
  const behind = (node) => {
    const colour = getComputedStyle(node).backgroundColor;
    return (channels(colour)[3] ?? 1) > 0 || !node.parentElement ? colour : behind(node.parentElement);
  };
  let least = [99, ''];
  const words = [...document.querySelectorAll('body *')].filter((node) => node.checkVisibility() && !node.disabled
    && [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim()));
  for (const node of words) {
    const style = getComputedStyle(node);
    const ink = node instanceof SVGElement ? style.fill : style.color;
    const [low, high] = [luminance(ink), luminance(behind(node))].sort((a, b) => a - b);
    least = [Math.min(least[0], (high + 0.05) / (low + 0.05)), (high + 0.05) / (low + 0.05) < least[0] ? node.outerHTML : least[1]];
  }
  return least;
})()";

/// A page that is open.
struct Page {
    browser: Browser,
    explored: Explored,
    downloads: PathBuf,
}

impl Page {
    fn open(width: u32, dark: bool, more: &[&str]) -> Self {
        // Every browser has a profile of its own.
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("explore_in_browser/{}-{number}", std::process::id());
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(folder.join("downloads")).expect("a folder");
        let explored = Explored::new(more);
        let mut browser = Browser::start(&folder);
        let downloads = folder.join("downloads");
        browser.call(
            "Browser.setDownloadBehavior",
            &json!({ "behavior": "allow", "downloadPath": downloads }),
        );
        browser.size(width, 900);
        browser.media("prefers-color-scheme", if dark { "dark" } else { "light" });
        let address = format!("http://127.0.0.1:{}/?token={}", explored.port, explored.token);
        browser.call("Page.navigate", &json!({ "url": address }));
        let mut page = Self {
            browser,
            explored,
            downloads,
        };
        page.wait(RESTS);
        page
    }

    fn is(&mut self, expression: &str) -> bool {
        self.browser
            .value(&format!("typeof get !== 'undefined' && Boolean({expression})"))
            == json!(true)
    }

    fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        while !self.is(expression) {
            assert!(
                begun.elapsed() < PATIENCE,
                "never: {expression}; {}",
                self.browser.value("document.body.innerText")
            );
            thread::sleep(Duration::from_millis(30));
        }
    }

    fn number(&mut self, expression: &str) -> f64 {
        let value = self.browser.value(expression);
        value.as_f64().unwrap_or_else(|| panic!("{expression}: {value}"))
    }

    /// The force after the last pass that the page shows \[N\].
    fn force(&mut self) -> f64 {
        self.number("shown.passes.at(-1).downstream_force_n")
    }

    /// Moves the slider of `key` by so many presses of a key.
    fn press(&mut self, key: &str, presses: usize, press: &str) {
        self.browser.value(&format!("row_of('{key}').range.focus()"));
        for _ in 0..presses {
            self.browser.key(press);
        }
        self.wait("!settled || under");
        self.wait(RESTS);
    }

    /// Types into the field of `key`.
    fn type_into(&mut self, key: &str, text: &str) {
        self.browser.value(&format!(
            "row_of('{key}').field.focus(), row_of('{key}').field.select()"
        ));
        self.browser.call("Input.insertText", &json!({ "text": text }));
        self.browser.key("Enter");
    }

    fn click(&mut self, id: &str) {
        self.browser.value(&format!("get('{id}').click()"));
    }

    /// A file that the page saves.
    fn saved(&mut self, button: &str, name: &str) -> PathBuf {
        self.click(button);
        let (begun, path) = (Instant::now(), self.downloads.join(name));
        while !path.exists() {
            assert!(
                begun.elapsed() < PATIENCE,
                "no {name}: {}",
                self.browser.value("document.body.innerText")
            );
            thread::sleep(Duration::from_millis(50));
        }
        path
    }

    /// No word is too faint, nothing scrolls sideways, every input has a name, nothing stands on the console.
    fn is_well_made(&mut self, when: &str) {
        let contrast = self.browser.value(CONTRAST);
        assert!(contrast[0].as_f64() >= Some(LEAST_CONTRAST), "{when}: {contrast}");
        let (wide, room) = (
            "document.documentElement.scrollWidth",
            "document.documentElement.clientWidth",
        );
        assert!(self.number(wide) <= self.number(room), "{when}");
        let unnamed = self.browser.value(
            "[...document.querySelectorAll('button, input, select')].filter((node) => !(node.labels?.length
               || node.getAttribute('aria-label') || node.textContent.trim())).map((node) => node.outerHTML)",
        );
        assert_eq!(unnamed, json!([]), "{when}");
        assert_eq!(self.browser.complaints(), Vec::<Value>::new(), "{when}");
    }
}

/// A whole visit; the numbers are those of the command line.
fn visit(width: u32, dark: bool) {
    let mut page = Page::open(width, dark, &[]);
    // `rows` is the page's own list of sliders.
    page.browser
        .value("globalThis.row_of = (key) => rows.find((row) => row.slider.key === key), 0");
    page.is_well_made("at first");
    let first = page.force();
    page.press("friction.dynamic_coefficient", 20, "ArrowRight");
    page.press("duct.depth", 5, "ArrowRight");
    page.press("ends.upstream", 3, "ArrowRight");
    assert_eq!(
        page.browser.value("row_of('ends.upstream').slider.held"),
        json!("spring")
    );
    assert!(page.is("row_of('friction.dynamic_coefficient').slider.value > 0.27"));
    let slid = page.force();
    assert!((slid - first).abs() > 1.0, "{first} N, then {slid} N");
    // What it was stays as a grey line.
    assert!(page.is("plots[0].plot.svg.querySelectorAll('polyline[stroke=\"var(--before)\"]').length >= 1"));

    page.type_into("duct.length", "25 m");
    page.wait("row_of('duct.length').slider.value === 25");
    page.wait(RESTS);

    // A refusal stands beside its slider, and goes with its cause.
    page.type_into("duct.depth", "1 mm");
    page.wait(
        "row_of('duct.depth').error.textContent.includes('found 1 mm; allowed: a length greater than 0')",
    );
    let refusals =
        page.number("[...document.querySelectorAll('.error')].filter((node) => node.textContent).length");
    assert_eq!(refusals, 1.0);
    page.is_well_made("refused");
    page.type_into("duct.depth", "1.4");
    page.wait("!row_of('duct.depth').error.textContent && row_of('duct.depth').slider.value === 1.4");
    page.wait(RESTS);

    page.click("pin");
    page.press("cable.axial_stiffness", 10, "ArrowLeft");
    page.click("pin");
    assert!(page.is("!get('comparison').hidden && get('table').querySelectorAll('thead th').length === 4"));
    assert!(page.is("get('comparison').querySelectorAll('polyline[stroke=\"var(--other)\"]').length >= 1"));
    page.browser
        .value("get('limit-force').value = 'downstream=100 N', get('limit-force').onchange()");
    page.wait("get('verdicts').textContent.includes('✗')");
    page.wait(RESTS);

    page.browser.value("go(0), get('speed').value = '3', 0");
    page.click("play");
    page.wait("at > 20 && playing");
    page.click("play");
    let (at, slips) = (
        page.number("at"),
        "[...document.querySelectorAll('#film path[stroke=\"var(--accent)\"]')].length",
    );
    assert!(page.number("Number(get('place').value)") > 0.0 && page.number(slips) >= 2.0);
    page.click("on");
    assert!(page.number("at") > at);
    page.browser
        .value("go(Math.round(film.pictures.length * 0.6)), 0");
    page.is_well_made("at last");

    let shown = page.force();
    let saved = page.saved("save", "full-scale-upper-explored.toml");
    let saved = saved.to_str().expect("a path in UTF-8");
    assert_eq!(output(&["check", saved]).status.code(), Some(0));
    let run: Value = serde_json::from_slice(&output(&["run", saved, "--json"]).stdout).expect("JSON");
    let last = run["passes"]
        .as_array()
        .and_then(|passes| passes.last())
        .expect("passes");
    let force = last["downstream_force_n"].as_f64().expect("a force");
    assert!((force / shown - 1.0).abs() < 1e-9, "{force} {shown}");

    page.click("end");
    page.wait("get('problem').textContent.includes('has ended')");
    assert_eq!(page.explored.ended().code(), Some(0));
}

#[test]
#[ignore = "needs Chromium"]
fn a_visit_on_a_desk_and_on_a_phone_by_day_and_by_night() {
    for width in [DESK, PHONE] {
        for dark in [false, true] {
            visit(width, dark);
        }
    }
}

/// Clamps and heat come and go, passes become years, and the report is a page.
#[test]
#[ignore = "needs Chromium"]
fn what_is_added_has_sliders_and_can_be_taken_away() {
    let mut page = Page::open(DESK, false, &["--set=traffic.passes=48"]);
    page.browser.media("prefers-reduced-motion", "reduce");
    page.browser
        .value("globalThis.row_of = (key) => rows.find((row) => row.slider.key === key), 0");
    let keys = [
        "restraints.0.position",
        "duct.slope",
        "traffic.years",
        "heat.daily_swing",
    ];
    for (name, key) in [
        "a clamp in the middle",
        "slope",
        "years in place of passes",
        "daily heat",
    ]
    .iter()
    .zip(keys)
    {
        page.browser.value(&format!(
            "get('add').value = additions().findIndex(([name]) => name === '{name}'), get('add').onchange({{ target: get('add') }})"
        ));
        page.wait(&format!("row_of('{key}')"));
        page.wait(RESTS);
    }
    assert!(page.is("row_of('restraints.0.position').slider.value === 15 && !row_of('traffic.passes')"));
    assert!(page.is("shown.heat && shown.restraints.length === 1"));
    assert!(page.is("!get('film-error').textContent && film.pictures.length > 100"));
    page.press("restraints.0.position", 10, "ArrowLeft");
    assert!(page.is("shown.restraints[0].position_m < 15"));
    for key in ["restraints.0.position", "heat.daily_swing"] {
        page.browser
            .value(&format!("row_of('{key}').node.querySelector('button').click()"));
        page.wait(&format!("!row_of('{key}')"));
        page.wait(RESTS);
    }
    assert!(page.is("!shown.heat && shown.restraints.length === 0"));
    page.is_well_made("without them");
    let report = page.saved("report", "full-scale-upper-explored.html");
    let report = fs::read_to_string(report).expect("a page");
    assert!(
        report.contains("<h1>Full-scale experiment, upper phase</h1>") && report.contains("duct.slope=0 %")
    );
    page.click("reset");
    page.wait("Object.keys(set).length === 0 && row_of('traffic.passes')");
    assert!(page.is("row_of('traffic.passes').slider.value === 48"));
}
