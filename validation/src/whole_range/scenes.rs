//! Random scenes over a wide range of every key but histograms and presets: most values as a road has them, some from far beyond that.

use std::fmt::Write;

use fastrand::Rng;

/// Share of the values that come from the wide range.
const ANYWHERE: f64 = 0.06;

/// The scene of this number, as text.
pub fn scene(number: u64) -> String {
    let mut draw = Draw {
        rng: Rng::with_seed(number),
        text: String::new(),
    };
    // Time steps take long: their cables are short as a rule, and their passes few.
    let law = draw.often(&[(4, "sigmoid"), (30, "coulomb"), (66, "elastic-plastic")]);
    let method = draw.often(&[
        (3, "explicit"),
        (2, "quasi-static"),
        (2, "pass-law"),
        (93, "auto"),
    ]);
    let is_short = (law == "sigmoid" || method == "explicit") && !draw.chance(0.1);
    let length = draw.value([4.0, if is_short { 40.0 } else { 300.0 }], [0.5, 3000.0]);
    let depth = draw.value([0.6, 3.0], [0.05, 50.0]);
    let is_heated = !is_short && draw.chance(0.12);
    let diameter = draw.value([0.03, 0.12], [1e-3, 4.0]);
    let arrangement = draw.often(&[
        (85, "single"),
        (4, "trefoil-upper"),
        (4, "trefoil-lower"),
        (4, "cradled-outer"),
        (3, "cradled-middle"),
    ]);
    let bundle = Some((arrangement, diameter)).filter(|bundle| bundle.0 != "single");
    draw.duct(length, depth, bundle);
    draw.ground(depth);
    draw.cable(bundle);
    draw.friction(law);
    draw.held(length);
    let vehicles = draw.vehicles();
    draw.traffic(vehicles, is_heated, is_short);
    if is_heated {
        draw.heat();
    }
    draw.solver(method);
    draw.text
}

/// How a cable lies with two others, and its diameter.
type Bundle = (&'static str, f64);

/// Draws values, and writes them down.
struct Draw {
    rng: Rng,
    text: String,
}

impl Draw {
    fn chance(&mut self, share: f64) -> bool {
        self.rng.f64() < share
    }

    fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        testkit::between(&mut self.rng, low, high)
    }

    /// Evenly over powers of ten, from the range that is usual, or from a wide one.
    fn value(&mut self, usual: [f64; 2], wide: [f64; 2]) -> f64 {
        let range = if self.chance(ANYWHERE) { wide } else { usual };
        10_f64.powf(self.between(range.map(f64::log10)))
    }

    /// A slope, which is of any sign.
    fn slope(&mut self) -> f64 {
        let steepest = if self.chance(ANYWHERE) { 1.0 } else { 0.08 };
        self.between([-steepest, steepest])
    }

    /// One of these words, each as often as its number says.
    fn often(&mut self, words: &[(u32, &'static str)]) -> &'static str {
        let sum: u32 = words.iter().map(|word| word.0).sum();
        let mut left = self.rng.u32(..sum);
        let found = words.iter().find(|(often, _)| {
            let is_found = left < *often;
            left = left.saturating_sub(*often);
            is_found
        });
        found.unwrap_or(&words[0]).1
    }

    fn line(&mut self, key: &str, value: impl std::fmt::Display) {
        writeln!(self.text, "{key} = {value}").expect("a text grows");
    }

    fn table(&mut self, name: &str) {
        writeln!(self.text, "{name}").expect("a text grows");
    }

    /// A key that is given as often as this share.
    fn perhaps(&mut self, share: f64, key: &str, usual: [f64; 2], wide: [f64; 2]) {
        if self.chance(share) {
            self.given(key, usual, wide);
        }
    }

    fn given(&mut self, key: &str, usual: [f64; 2], wide: [f64; 2]) {
        let value = self.value(usual, wide);
        self.line(key, value);
    }

    fn duct(&mut self, length: f64, depth: f64, bundle: Option<Bundle>) {
        self.table("[duct]");
        self.line("length", length);
        self.line("depth", depth);
        if self.chance(0.2) {
            let offset = self.between([-4.0, 4.0]);
            self.line("lateral_offset", offset);
        }
        if let Some((_, diameter)) = bundle {
            let ratio = self.between([2.2, 4.0]);
            self.line("inner_diameter", ratio * diameter);
        }
        if self.chance(0.15) {
            self.route(length, depth);
        } else if self.chance(0.2) {
            let slope = self.slope();
            self.line("slope", slope);
        }
    }

    fn route(&mut self, length: f64, depth: f64) {
        let sections = 1 + self.rng.u8(..5);
        for section in 1..=sections {
            self.table("[[route]]");
            if section < sections {
                let share = self.between([0.3, 1.0]) / f64::from(sections);
                self.line("length", share * length);
            }
            if self.chance(0.5) {
                let slope = self.slope();
                self.line("slope", slope);
            }
            if self.chance(0.4) {
                let radius = depth + self.value([1.0, 100.0], [0.01, 1e6]);
                self.line("bend_radius", radius);
            }
            self.perhaps(0.3, "dynamic_coefficient", [0.1, 0.6], [1e-4, 10.0]);
        }
    }

    fn ground(&mut self, depth: f64) {
        self.table("[ground]");
        let layers = match self.rng.u8(..20) {
            0 => 1 + self.rng.u8(..30),
            1..=10 => 1,
            _ => 2 + self.rng.u8(..3),
        };
        let is_graded = self.chance(0.08);
        let has_rock = self.chance(0.25);
        let model = match (is_graded, layers, has_rock) {
            (true, ..) => self.often(&[(1, "fem"), (3, "auto")]),
            (false, 1, false) => self.often(&[(4, "fem"), (4, "boussinesq"), (4, "burmister"), (88, "auto")]),
            (false, ..) => self.often(&[(4, "fem"), (8, "burmister"), (88, "auto")]),
        };
        self.line("model", format!("\"{model}\""));
        if has_rock {
            let rock = depth + self.value([0.5, 20.0], [0.01, 5000.0]);
            self.line("rigid_base_depth", rock);
        }
        match self.rng.u8(..20) {
            0 => self.given("vertical_peak", [30e-6, 600e-6], [1e-9, 0.01]),
            1 => self.given("longitudinal_peak", [5e-6, 100e-6], [1e-9, 0.01]),
            _ => {}
        }
        for layer in 1..=layers {
            self.table("[[ground.layers]]");
            if layer < layers {
                self.given("thickness", [0.05, 0.6], [0.005, 20.0]);
            }
            let [top, bottom] = [(); 2].map(|()| self.value([2e7, 3e9], [1e4, 1e12]));
            if is_graded && (layer < layers || has_rock) {
                self.line("young_modulus", format!("{{ top = {top}, bottom = {bottom} }}"));
            } else {
                self.line("young_modulus", top);
            }
            let range = if self.chance(ANYWHERE) {
                [0.0, 0.5]
            } else {
                [0.15, 0.48]
            };
            let ratio = self.between(range);
            self.line("poisson_ratio", ratio);
        }
    }

    fn cable(&mut self, bundle: Option<Bundle>) {
        self.table("[cable]");
        self.given("weight", [20.0, 400.0], [0.1, 1e5]);
        if self.chance(0.1) {
            self.given("young_modulus", [1e9, 3e10], [1e6, 1e12]);
            self.given("conductor_area", [1e-4, 2e-3], [1e-6, 0.1]);
        } else {
            self.given("axial_stiffness", [2e6, 5e8], [1e3, 1e12]);
        }
        if let Some((arrangement, diameter)) = bundle {
            self.line("arrangement", format!("\"{arrangement}\""));
            self.line("diameter", diameter);
        } else {
            self.perhaps(0.2, "normal_load_factor", [1.0, 2.0], [0.01, 100.0]);
        }
    }

    fn friction(&mut self, law: &str) {
        self.table("[friction]");
        self.line("law", format!("\"{law}\""));
        self.given("dynamic_coefficient", [0.1, 0.6], [1e-4, 10.0]);
        if law != "coulomb" {
            self.given("shape_factor", [1e6, 1e8], [1.0, 1e18]);
        }
    }

    fn held(&mut self, length: f64) {
        self.table("[ends]");
        for end in ["upstream", "downstream"] {
            let held = match self.rng.u8(..3) {
                0 => "\"free\"".to_owned(),
                1 => "\"fixed\"".to_owned(),
                _ => format!("{{ spring = {} }}", self.value([1e4, 1e8], [1e-3, 1e15])),
            };
            self.line(end, held);
        }
        if self.chance(0.2) {
            for _ in 0..=self.rng.u8(..4) {
                self.table("[[restraints]]");
                let position = self.between([0.0, length]);
                self.line("position", position);
                self.given("stiffness", [1e4, 1e8], [1e-3, 1e15]);
                self.perhaps(0.3, "holds", [100.0, 2e4], [1e-3, 1e9]);
            }
        }
    }

    /// How many there are; they are called v1, v2 and so on.
    fn vehicles(&mut self) -> usize {
        let count = match self.rng.u8(..20) {
            0 => 4 + self.rng.usize(..8),
            1..=10 => 1,
            _ => 2 + self.rng.usize(..2),
        };
        let is_two_way = self.chance(0.4);
        for number in 1..=count {
            self.table("[[vehicles]]");
            self.line("name", format!("\"v{number}\""));
            self.given("speed", [5.0, 30.0], [0.01, 200.0]);
            if is_two_way && self.chance(0.5) {
                self.line("direction", "\"reverse\"");
            }
            if self.chance(0.3) {
                let lane = self.between([-6.0, 6.0]);
                self.line("lateral_offset", lane);
            }
            if count > 1 {
                let share = 1 + self.rng.u32(..3);
                self.line("share", share);
            }
            if self.chance(0.3) {
                self.given("load", [2e4, 3e5], [1.0, 1e7]);
            } else {
                let wheels = self.wheels();
                self.line("wheels", wheels);
            }
        }
        count
    }

    fn wheels(&mut self) -> String {
        let mut x = 0.0;
        let axles: Vec<String> = (0..=self.rng.u8(..4))
            .map(|_| {
                let (load, radius) = (
                    self.value([1e4, 6e4], [1.0, 1e6]),
                    self.value([0.08, 0.25], [0.001, 2.0]),
                );
                let y = self.between([0.8, 1.1]);
                let wheel =
                    |y: f64| format!("{{ x = {x}, y = {y}, load = {load}, contact_radius = {radius} }}");
                let pair = format!("{}, {}", wheel(y), wheel(-y));
                x -= self.between([1.2, 6.0]);
                pair
            })
            .collect();
        format!("[{}]", axles.join(", "))
    }

    fn traffic(&mut self, vehicles: usize, is_heated: bool, is_short: bool) {
        self.table("[traffic]");
        let most = if is_short { 30.0 } else { 1e7 };
        let mut passes = self.value([1.0, most], [1.0, 1e12]).round();
        if is_heated || self.chance(0.1) {
            let per_day = self.value([50.0, 3000.0], [1.0, 1e5]).round();
            self.line("per_day", per_day);
            if is_heated {
                passes = (self.value([1.0, 10_000.0], [0.1, 1e6]) * per_day).ceil();
            }
            if self.chance(0.3) {
                self.line("years", passes / per_day / 365.25);
                passes = 0.0;
            }
        }
        if passes > 0.0 {
            self.line("passes", passes);
        }
        match self.rng.u8(..12) {
            0 => {
                self.line("order", "\"random\"");
                let seed = self.rng.u16(..);
                self.line("seed", seed);
            }
            1 if vehicles > 1 => {
                let places = 2 + self.rng.usize(..8);
                let sequence: Vec<String> = (0..places)
                    .map(|_| format!("\"v{}\"", 1 + self.rng.usize(..vehicles)))
                    .collect();
                self.line("sequence", format!("[{}]", sequence.join(", ")));
            }
            _ => {}
        }
    }

    fn heat(&mut self) {
        self.table("[heat]");
        self.given("expansion", [8e-6, 25e-6], [1e-8, 1e-3]);
        let swing = self.value([2.0, 40.0], [0.01, 500.0]);
        if self.chance(0.3) {
            let points = 2 + self.rng.u8(..4);
            let points: Vec<String> = (0..points)
                .map(|point| {
                    let hour = 24.0 * (f64::from(point) + 0.9 * self.rng.f64()) / f64::from(points);
                    format!("[\"{hour} h\", \"{} K\"]", swing * self.rng.f64())
                })
                .collect();
            self.line("profile", format!("[{}]", points.join(", ")));
        } else {
            self.line("daily_swing", swing);
        }
        if self.chance(0.3) {
            let offset = self.between([-30.0, 30.0]);
            self.line("offset", offset);
        }
    }

    fn solver(&mut self, method: &str) {
        self.table("[solver]");
        self.given("tolerance", [0.03, 0.1], [0.0005, 0.5]);
        self.line("method", format!("\"{method}\""));
        self.perhaps(0.02, "node_spacing", [0.05, 0.5], [0.001, 10.0]);
        self.perhaps(0.02, "vehicle_step", [0.05, 0.5], [0.001, 10.0]);
        self.perhaps(0.02, "approach", [10.0, 60.0], [0.1, 1e4]);
        if method == "explicit" {
            self.perhaps(0.2, "time_step", [1e-6, 1e-4], [1e-9, 1e-2]);
        }
    }
}
