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
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use devtools::{Browser, CONTRAST_OF, DESK, MIN_CONTRAST, PHONE};
use server::{Explored, creepage};

const PATIENCE: Duration = Duration::from_secs(60);
/// Whether the last full answer and its pass are there.
const RESTS: &str = "settled && !under && film !== null && !/…/.test(get('state').textContent)";
/// Of all words that are seen, the least contrast with what is behind them.
const WORST_CONTRAST: &str = r"
  const behind = (node) => {
    const colour = getComputedStyle(node).backgroundColor;
    return (channels(colour)[3] ?? 1) > 0 || !node.parentElement ? colour : behind(node.parentElement);
  };
  const words = [...document.querySelectorAll('body *')].filter((node) => node.checkVisibility() && !node.disabled
    && [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim()));
  const contrasts = words.map((node) => {
    const style = getComputedStyle(node);
    return [contrast(node instanceof SVGElement ? style.fill : style.color, behind(node)), node.outerHTML];
  });
  return contrasts.reduce((least, found) => found[0] < least[0] ? found : least, [99, '']);";

/// A page that is open.
struct Page {
    browser: Browser,
    explored: Explored,
    downloads: PathBuf,
}

impl Page {
    fn open(width: u32, more: &[&str]) -> Self {
        let explored = Explored::new(more);
        let (mut browser, folder) = Browser::open("explore_in_browser", width, false);
        let downloads = folder.join("downloads");
        fs::create_dir_all(&downloads).expect("a folder");
        let behaviour = json!({ "behavior": "allow", "downloadPath": downloads });
        browser.call("Browser.setDownloadBehavior", &behaviour);
        let address = format!("http://127.0.0.1:{}/?token={}", explored.port, explored.token);
        browser.go(&address, &format!("typeof get !== 'undefined' && {RESTS}"));
        // `rows` is the page's own list of sliders.
        browser.value("globalThis.row_of = (key) => rows.find((row) => row.slider.key === key), 0");
        Self {
            browser,
            explored,
            downloads,
        }
    }

    fn is(&mut self, expression: &str) -> bool {
        self.browser.value(&format!("Boolean({expression})")) == json!(true)
    }

    fn wait(&mut self, expression: &str) {
        self.browser.wait(expression);
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
            assert!(begun.elapsed() < PATIENCE, "no {name}");
            thread::sleep(Duration::from_millis(50));
        }
        path
    }

    /// No word is too faint by day or night, nothing scrolls sideways, every input has a name, nothing stands on the console.
    fn is_well_made(&mut self, when: &str) {
        for colours in ["dark", "light"] {
            self.browser.media("prefers-color-scheme", colours);
            let contrast = self
                .browser
                .value(&format!("(() => {{{CONTRAST_OF}{WORST_CONTRAST}}})()"));
            assert!(
                contrast[0].as_f64() >= Some(MIN_CONTRAST),
                "{when}, {colours}: {contrast}"
            );
        }
        let [wide, room] =
            ["scrollWidth", "clientWidth"].map(|name| format!("document.documentElement.{name}"));
        assert!(self.is(&format!("{wide} <= {room}")), "{when}");
        let unnamed = self.browser.value(
            "[...document.querySelectorAll('button, input, select')].filter((node) => !(node.labels?.length
               || node.getAttribute('aria-label') || node.textContent.trim())).map((node) => node.outerHTML)",
        );
        assert_eq!(unnamed, json!([]), "{when}");
        assert_eq!(self.browser.complaints(), Vec::<Value>::new(), "{when}");
    }
}

/// A whole visit; the numbers are those of the command line.
fn visit(width: u32) {
    let mut page = Page::open(width, &[]);
    page.is_well_made("at first");
    let first = page.force();
    page.press("friction.dynamic_coefficient", 20, "ArrowRight");
    page.press("duct.depth", 5, "ArrowRight");
    page.press("ends.upstream", 3, "ArrowRight");
    assert!(page.is("row_of('ends.upstream').slider.held === 'spring'"));
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
    page.wait("row_of('duct.depth').error.textContent.includes('found 1 mm; allowed: a length')");
    assert!(
        page.is("[...document.querySelectorAll('.error')].filter((node) => node.textContent).length === 1")
    );
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
    let at = page.number("at");
    assert!(page.is("Number(get('place').value) > 0"));
    assert!(page.is("document.querySelectorAll('#film path[stroke=\"var(--accent)\"]').length >= 2"));
    page.click("on");
    assert!(page.number("at") > at);
    page.browser
        .value("go(Math.round(film.pictures.length * 0.6)), 0");
    page.is_well_made("at last");

    let shown = page.force();
    let saved = page.saved("save", "full-scale-upper-explored.toml");
    let saved = saved.to_str().expect("a path in UTF-8");
    let output = |arguments: &[&str]| creepage(arguments).output().expect("the command starts");
    assert_eq!(output(&["check", saved]).status.code(), Some(0));
    let run: Value = serde_json::from_slice(&output(&["run", saved, "--json"]).stdout).expect("JSON");
    let last = run["passes"].as_array().and_then(|passes| passes.last());
    let force = last.expect("passes")["downstream_force_n"]
        .as_f64()
        .expect("a force");
    assert!((force / shown - 1.0).abs() < 1e-9, "{force} {shown}");

    page.click("end");
    page.wait("get('problem').textContent.includes('has ended')");
    assert_eq!(page.explored.ended().code(), Some(0));
}

#[test]
#[ignore = "needs Chromium"]
fn a_visit_on_a_desk_and_on_a_phone_by_day_and_by_night() {
    for width in [DESK, PHONE] {
        visit(width);
    }
}

/// Clamps and heat come and go, passes become years, and the report is a page.
#[test]
#[ignore = "needs Chromium"]
fn what_is_added_has_sliders_and_can_be_taken_away() {
    let mut page = Page::open(DESK, &["--set=traffic.passes=48"]);
    page.browser.media("prefers-reduced-motion", "reduce");
    for (name, key) in [
        ("a clamp in the middle", "restraints.0.position"),
        ("slope", "duct.slope"),
        ("years in place of passes", "traffic.years"),
        ("daily heat", "heat.daily_swing"),
    ] {
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
    assert!(report.contains("<h1>Full-scale experiment, upper phase</h1>"));
    assert!(report.contains("duct.slope=0 %"));
    page.click("reset");
    page.wait("Object.keys(set).length === 0 && row_of('traffic.passes')");
    assert!(page.is("row_of('traffic.passes').slider.value === 48"));
}
