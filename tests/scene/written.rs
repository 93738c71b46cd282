//! A scene that is written to a file and read again is the same scene.

use creepage::scene::{
    Duct, End, Following, GroundModel, Law, Layer, Restraint, RouteSection, Scene, Solver, SolverMethod,
    TrafficVehicle, Wheel,
};
use ground_field::{Direction, Modulus};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

use super::FULL;

fn length() -> impl Strategy<Value = f64> {
    0.1..10.0
}

fn modulus() -> impl Strategy<Value = Modulus> {
    let pressure = || 1e6..1e10;
    prop_oneof![
        pressure().prop_map(Modulus::Uniform),
        (pressure(), pressure()).prop_map(|(top, bottom)| Modulus::Linear { top, bottom }),
    ]
}

/// Layers on a half-space, or on rock.
fn ground() -> impl Strategy<Value = (Vec<Layer>, Option<f64>)> {
    let layers = vec((length(), modulus(), 0.0..=0.5), 1..4);
    (layers, option::of(length())).prop_map(|(layers, above_rock)| {
        let mut layers: Vec<Layer> = layers
            .into_iter()
            .map(|(thickness, young_modulus, poisson_ratio)| Layer {
                thickness: Some(thickness),
                young_modulus,
                poisson_ratio,
            })
            .collect();
        let last = layers.last_mut().expect("a layer");
        let (depth, is_graded) = (
            last.thickness.take(),
            matches!(last.young_modulus, Modulus::Linear { .. }),
        );
        let above: f64 = layers.iter().filter_map(|layer| layer.thickness).sum();
        let rock = above_rock.or(depth.filter(|_| is_graded));
        (layers, rock.map(|depth| above + depth))
    })
}

fn vehicle(index: usize) -> impl Strategy<Value = TrafficVehicle> {
    let wheel = (-5.0..5.0, -1.0..1.0, 1e3..1e5, prop_oneof![Just(0.0), 0.05..0.3]);
    let wheels = prop_oneof![Just(vec![(0.0, 0.0, 2e5, 0.0)]), vec(wheel, 1..4)];
    let lane = prop_oneof![Just(0.0), -9.0..9.0];
    (wheels, 1.0..30.0, any::<bool>(), lane, "[a-z\"\\\\\n名ü ]{0,5}").prop_map(
        move |(wheels, speed, reverse, lateral_offset, name)| {
            let wheel = |(x, y, load, contact_radius)| Wheel {
                x,
                y,
                load,
                contact_radius,
            };
            let mut vehicle = TrafficVehicle::point(&format!("{index}{name}"), 2e5, speed);
            if wheels != [(0.0, 0.0, 2e5, 0.0)] {
                (vehicle.load, vehicle.wheels) = (None, wheels.into_iter().map(wheel).collect());
            }
            if reverse {
                vehicle.direction = Direction::Reverse;
            }
            vehicle.lateral_offset = lateral_offset;
            vehicle
        },
    )
}

fn end() -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (1.0..1e9).prop_map(End::Spring)
    ]
}

fn law() -> impl Strategy<Value = (Law, Option<f64>)> {
    let laws = prop::sample::select(Law::WORDS);
    (laws, 1.0..1e9).prop_map(|((_, law), b)| (law, (law != Law::Coulomb).then_some(b)))
}

fn solver() -> impl Strategy<Value = Solver> {
    let method = prop::sample::select(SolverMethod::WORDS).prop_map(|(_, method)| method);
    let optional = || option::of(0.1..0.5);
    (method, 1e-4..0.5, optional(), optional(), optional(), optional()).prop_map(
        |(method, tolerance, node_spacing, vehicle_step, time_step, approach)| Solver {
            method,
            tolerance,
            node_spacing,
            vehicle_step,
            // These have none.
            time_step: time_step
                .filter(|_| !matches!(method, SolverMethod::QuasiStatic | SolverMethod::PassLaw)),
            approach,
        },
    )
}

/// The vehicles' shares as a file gives them, or their order.
#[derive(Debug, Clone)]
enum Passes {
    Shares(Vec<f64>, Option<u64>),
    Sequence(Vec<usize>),
}

fn passes() -> impl Strategy<Value = Passes> {
    prop_oneof![
        (vec(0.1..5.0, 3), option::of(any::<u64>())).prop_map(|(shares, seed)| Passes::Shares(shares, seed)),
        vec(0..3_usize, 1..9).prop_map(Passes::Sequence),
    ]
}

/// A slope, a bend and a section of other friction.
fn route(length: f64, depth: f64, slope: f64, dynamic_coefficient: Option<f64>) -> Vec<RouteSection> {
    vec![
        RouteSection {
            length: Some(0.3 * length),
            slope,
            ..RouteSection::default()
        },
        RouteSection {
            length: Some(0.5 * length),
            bend_radius: Some(7.0 * depth),
            ..RouteSection::default()
        },
        RouteSection {
            length: Some(length - 0.3 * length - 0.5 * length),
            dynamic_coefficient,
            ..RouteSection::default()
        },
    ]
}

/// So that they are in the duct.
fn clamps_of_measures_at(scene: &mut Scene, position: f64) {
    for measure in &mut scene.measures {
        let replaced = measure.restraints.iter_mut().flatten();
        let clamps = replaced.chain(&mut measure.added_restraints);
        clamps.for_each(|clamp| clamp.position = position);
    }
}

fn scene() -> impl Strategy<Value = Scene> {
    let duct = (1.0..1e4, length(), -9.0..9.0);
    let scaling = option::of((any::<bool>(), 1e-6..1e-3));
    let clamps = vec((0.0..=1.0, 1.0..1e9), 0..3);
    let vehicles = (vehicle(0), vehicle(1), vehicle(2));
    let numbers = (1.0..1e3, 1e5..1e9, 0.5..2.0, 0.0..1.0, 1..1_000_000_u64);
    (
        duct,
        (ground(), scaling),
        (law(), numbers),
        (end(), end(), clamps),
        vehicles,
        passes(),
        solver(),
    )
        .prop_map(
            |(
                duct,
                ((layers, rock), scaling),
                (law, numbers),
                (upstream, downstream, clamps),
                vehicles,
                passes,
                solver,
            )| {
                let mut scene = Scene::from_toml("written.toml", FULL).expect("a scene");
                scene.title = format!("{duct:?} \"quoted\" \\ \t 名\n");
                let (length, depth, lateral_offset) = duct;
                scene.duct = Duct {
                    length,
                    depth,
                    lateral_offset,
                    slope: 0.0,
                    inner_diameter: None,
                };
                scene.ground.model = GroundModel::Auto;
                (scene.ground.layers, scene.ground.rigid_base_depth) = (layers, rock);
                let peak = |wanted| {
                    scaling
                        .filter(|(along, _)| *along == wanted)
                        .map(|(_, peak)| peak)
                };
                (scene.ground.longitudinal_peak, scene.ground.vertical_peak) = (peak(true), peak(false));
                (scene.friction.law, scene.friction.shape_factor) = law;
                let cable = &mut scene.cable;
                (cable.weight, cable.axial_stiffness, cable.normal_load_factor) =
                    (numbers.0, numbers.1, Some(numbers.2));
                (scene.friction.dynamic_coefficient, scene.traffic.passes) = (numbers.3, numbers.4);
                (scene.ends.upstream, scene.ends.downstream) = (upstream, downstream);
                let restraint = |(share, stiffness)| Restraint::new(share * length, stiffness);
                scene.restraints = clamps.into_iter().map(restraint).collect();
                // A cable that nothing holds may slide out of its duct.
                if (upstream, downstream) != (End::Free, End::Free) {
                    scene.duct.slope = 0.1 * lateral_offset;
                }
                // Here and there a clamp that slips, and a route in the place of a slope.
                let has_friction = scene.friction.dynamic_coefficient > 0.0;
                if let Some(clamp) = scene.restraints.first_mut().filter(|_| has_friction) {
                    clamp.holds = Some(1e3 * numbers.2);
                }
                if lateral_offset > 0.0 {
                    let slope = std::mem::take(&mut scene.duct.slope);
                    let rougher = Some(1.5 * scene.friction.dynamic_coefficient);
                    scene.route = route(length, depth, slope, rougher);
                }
                clamps_of_measures_at(&mut scene, 0.4 * length);
                scene.vehicles = vec![vehicles.0, vehicles.1, vehicles.2];
                let traffic = &mut scene.traffic;
                (traffic.order, traffic.seed) = (Following::Interleaved, 1);
                match passes {
                    Passes::Shares(shares, seed) => {
                        if let Some(seed) = seed {
                            (traffic.order, traffic.seed) = (Following::Random, seed);
                        }
                        for (vehicle, share) in scene.vehicles.iter_mut().zip(shares) {
                            vehicle.share = share;
                        }
                    }
                    Passes::Sequence(sequence) => {
                        let name = |index: usize| scene.vehicles[index].name.clone();
                        traffic.sequence = sequence.into_iter().map(name).collect();
                    }
                }
                scene.solver = solver;
                scene.solver.node_spacing = scene.solver.node_spacing.map(|spacing| spacing * length);
                scene
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_written_scene_is_read_as_it_was(scene in scene()) {
        let text = scene.to_toml();
        let read = Scene::from_toml("written.toml", &text);
        prop_assert!(read.is_ok(), "{}\n{text}", read.unwrap_err());
        prop_assert_eq!(read.unwrap(), scene);
    }
}

#[test]
fn every_example_is_written_and_read_as_it_was() {
    let folder = std::fs::read_dir("examples/scenes").expect("the examples");
    let paths: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    assert!(paths.len() >= 2, "{}", paths.len());
    for path in paths {
        let scene = Scene::from_file(&path).expect("a scene");
        let text = scene.to_toml();
        let read = Scene::from_toml("written.toml", &text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, scene, "{}", path.display());
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
    let expected = "found \"newton\"; allowed: auto, quasi-static, explicit, pass-law";
    assert_eq!(unknown, expected);
}
