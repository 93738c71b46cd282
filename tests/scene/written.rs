//! A scene that is written to a file and read again is the same scene.

use creepage::scene::{
    Duct, End, Following, GroundModel, Law, Layer, Restraint, RouteSection, Scene, SolverMethod,
    TrafficVehicle, Wheel,
};
use fastrand::Rng;
use ground_field::{Direction, Modulus};

use super::FULL;

/// Numbers of a random scene.
struct Draw(Rng);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    /// A number in half of the scenes.
    fn perhaps(&mut self, low: f64, high: f64) -> Option<f64> {
        self.0.bool().then(|| self.between(low, high))
    }

    fn modulus(&mut self) -> Modulus {
        let [top, bottom] = [(); 2].map(|()| self.between(1e6, 1e10));
        if self.0.bool() {
            Modulus::Uniform(top)
        } else {
            Modulus::Linear { top, bottom }
        }
    }

    /// Layers on a half-space, or on rock at a depth.
    fn ground(&mut self) -> (Vec<Layer>, Option<f64>) {
        let count = self.0.usize(1..4);
        let layer = |_| Layer {
            thickness: Some(self.between(0.1, 10.0)),
            young_modulus: self.modulus(),
            poisson_ratio: self.between(0.0, 0.5),
        };
        let mut layers: Vec<Layer> = (0..count).map(layer).collect();
        let depth: f64 = layers.iter().filter_map(|layer| layer.thickness).sum();
        let last = layers.last_mut().expect("a layer");
        last.thickness = None;
        let is_graded = matches!(last.young_modulus, Modulus::Linear { .. });
        (layers, (is_graded || self.0.bool()).then_some(depth))
    }

    fn vehicle(&mut self, number: usize) -> TrafficVehicle {
        let letters: Vec<char> = "abz\"\\\n名ü ".chars().collect();
        let length = self.0.usize(..5);
        let name: String = (0..length).filter_map(|_| self.0.choice(&letters)).collect();
        let mut vehicle = TrafficVehicle::point(&format!("{number}{name}"), 2e5, self.between(1.0, 30.0));
        if self.0.bool() {
            let wheel = |_| Wheel {
                x: self.between(-5.0, 5.0),
                y: self.between(-1.0, 1.0),
                load: self.between(1e3, 1e5),
                contact_radius: self.perhaps(0.05, 0.3).unwrap_or(0.0),
            };
            (vehicle.load, vehicle.wheels) = (None, (0..2).map(wheel).collect());
        }
        if self.0.bool() {
            vehicle.direction = Direction::Reverse;
        }
        vehicle.lateral_offset = self.perhaps(-9.0, 9.0).unwrap_or(0.0);
        vehicle
    }

    fn end(&mut self) -> End {
        match self.0.u8(0..3) {
            0 => End::Free,
            1 => End::Fixed,
            _ => End::Spring(self.between(1.0, 1e9)),
        }
    }

    /// A slope, a bend and a section of other friction.
    fn route(scene: &Scene) -> Vec<RouteSection> {
        let length = scene.duct.length;
        let section = |length| RouteSection {
            length: Some(length),
            ..RouteSection::default()
        };
        let mut route = [0.3 * length, 0.5 * length, length - 0.3 * length - 0.5 * length].map(section);
        route[0].slope = scene.duct.slope;
        route[1].bend_radius = Some(7.0 * scene.duct.depth);
        route[2].dynamic_coefficient = Some(1.5 * scene.friction.dynamic_coefficient);
        route.into()
    }

    fn scene(&mut self) -> Scene {
        let mut scene = super::read(FULL).expect("a scene");
        let length = self.between(1.0, 1e4);
        scene.title = format!("{length} \"quoted\" \\ \t 名\n");
        scene.duct = Duct {
            length,
            depth: self.between(0.1, 10.0),
            lateral_offset: self.between(-9.0, 9.0),
            slope: 0.0,
            inner_diameter: None,
        };
        let ground = &mut scene.ground;
        ground.model = GroundModel::Auto;
        (ground.layers, ground.rigid_base_depth) = self.ground();
        ground.longitudinal_peak = self.perhaps(1e-6, 1e-3);
        ground.vertical_peak = self
            .perhaps(1e-6, 1e-3)
            .filter(|_| ground.longitudinal_peak.is_none());
        (scene.cable.weight, scene.cable.axial_stiffness) = (self.between(1.0, 1e3), self.between(1e5, 1e9));
        scene.cable.normal_load_factor = Some(self.between(0.5, 2.0));
        let (_, law) = *self.0.choice(Law::WORDS).expect("a law");
        scene.friction.law = law;
        scene.friction.shape_factor = (law != Law::Coulomb).then(|| self.between(1.0, 1e9));
        scene.friction.dynamic_coefficient = self.between(0.0, 1.0);
        let (upstream, downstream) = (self.end(), self.end());
        (scene.ends.upstream, scene.ends.downstream) = (upstream, downstream);
        // A cable that nothing holds may slide out of its duct.
        if (upstream, downstream) != (End::Free, End::Free) {
            scene.duct.slope = self.between(-0.9, 0.9);
        }
        let clamp = |_| Restraint {
            holds: self.perhaps(500.0, 2e3),
            ..Restraint::new(self.between(0.0, length), self.between(1.0, 1e9))
        };
        scene.restraints = (0..2).map(clamp).collect();
        if self.0.bool() {
            scene.route = Self::route(&scene);
            scene.duct.slope = 0.0;
        }
        for measure in &mut scene.measures {
            let replaced = measure.restraints.iter_mut().flatten();
            let clamps = replaced.chain(&mut measure.added_restraints);
            clamps.for_each(|clamp| clamp.position = 0.4 * length);
        }
        scene.vehicles = (0..3).map(|number| self.vehicle(number)).collect();
        let traffic = &mut scene.traffic;
        (traffic.order, traffic.seed) = (Following::Interleaved, 1);
        traffic.passes = self.0.u64(1..1_000_000);
        if self.0.bool() {
            let name = |_| scene.vehicles[self.0.usize(..3)].name.clone();
            traffic.sequence = (0..9).map(name).collect();
        } else {
            if self.0.bool() {
                (traffic.order, traffic.seed) = (Following::Random, self.0.u64(..));
            }
            for vehicle in &mut scene.vehicles {
                vehicle.share = self.between(0.1, 5.0);
            }
        }
        let (_, method) = *self.0.choice(SolverMethod::WORDS).expect("a method");
        let solver = &mut scene.solver;
        (solver.method, solver.tolerance) = (method, self.between(1e-4, 0.5));
        solver.node_spacing = self.perhaps(0.1 * length, 0.5 * length);
        (solver.vehicle_step, solver.approach) = (self.perhaps(0.1, 0.5), self.perhaps(0.1, 0.5));
        // The others have none.
        let has_time = !matches!(method, SolverMethod::QuasiStatic | SolverMethod::PassLaw);
        solver.time_step = self.perhaps(0.1, 0.5).filter(|_| has_time);
        scene
    }
}

#[test]
fn a_written_scene_is_read_as_it_was() {
    for seed in 0..2000 {
        let scene = Draw(Rng::with_seed(seed)).scene();
        let text = scene.to_toml();
        let read = super::read(&text).unwrap_or_else(|error| panic!("{seed}: {error}\n{text}"));
        assert_eq!(read, scene, "{seed}");
    }
}

#[test]
fn every_example_is_written_and_read_as_it_was() {
    let folder = std::fs::read_dir("examples/scenes").expect("the examples");
    let paths: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    assert!(paths.len() >= 2, "{}", paths.len());
    let mut scenes: Vec<Scene> = paths
        .iter()
        .map(|path| Scene::from_file(path).expect("a scene"))
        .collect();
    // The same with a profile of the day's heat.
    let profile =
        "heat={ expansion = \"1.2e-5 /K\", profile = [[\"1 h\", \"0.1 K\"], [\"50000 s\", \"13 K\"]] }";
    scenes.push(crate::scenes::upper(&["traffic.per_day=24", profile]));
    for scene in scenes {
        let text = scene.to_toml();
        let read = super::read(&text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, scene, "{text}");
        assert_eq!(read.to_toml(), text);
    }
}

#[test]
fn words_are_those_of_the_file() {
    for (word, model) in GroundModel::WORDS {
        assert_eq!((model.to_string().as_str(), word.parse()), (*word, Ok(*model)));
    }
    for (word, method) in SolverMethod::WORDS {
        assert_eq!((method.to_string().as_str(), word.parse()), (*word, Ok(*method)));
    }
    let unknown = "newton".parse::<SolverMethod>().expect_err("no method");
    assert!(
        unknown.starts_with("found \"newton\"; allowed: auto"),
        "{unknown}"
    );
}
