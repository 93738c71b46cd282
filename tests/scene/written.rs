//! A scene that is written to a file and read again is the same scene.

use creepage::scene::{
    Duct, End, FrictionLaw, GroundModel, Order, PeakScaling, Restraint, Scene, Solver, SolverMethod,
    TrafficVehicle,
};
use ground_field::{Base, Direction, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad, Vehicle, Wheel};
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

/// Layers on a half-space, or on rock whose depth a file could give.
fn profile() -> impl Strategy<Value = SoilProfile> {
    let layers = vec((length(), modulus(), 0.0..=0.5), 1..4);
    (layers, any::<bool>()).prop_map(|(layers, rock)| {
        let mut depth = 0.0;
        let mut upper = Vec::new();
        let (last, others) = layers.split_last().expect("a layer");
        for (thickness, modulus, ratio) in others {
            depth += thickness;
            upper.push(SoilLayer::new(*thickness, *modulus, *ratio).expect("a layer"));
        }
        let (thickness, modulus, ratio) = *last;
        let base = match modulus {
            Modulus::Uniform(modulus) if !rock => Base::HalfSpace(Soil::new(modulus, ratio).expect("a soil")),
            modulus => {
                let above: f64 = upper.iter().map(SoilLayer::thickness).sum();
                let thickness = (depth + thickness) - above;
                upper.push(SoilLayer::new(thickness, modulus, ratio).expect("a layer"));
                Base::Rigid
            }
        };
        SoilProfile::new(upper, base).expect("a profile")
    })
}

fn vehicle(index: usize) -> impl Strategy<Value = TrafficVehicle> {
    let wheel = (-5.0..5.0, -1.0..1.0, 1e3..1e5, prop_oneof![Just(0.0), 0.05..0.3]);
    let wheels = prop_oneof![Just(vec![(0.0, 0.0, 2e5, 0.0)]), vec(wheel, 1..4)];
    let lane = prop_oneof![Just(0.0), -9.0..9.0];
    (wheels, 1.0..30.0, any::<bool>(), lane, "[a-z\"\\\\\n名ü ]{0,5}").prop_map(
        move |(wheels, speed, reverse, lateral_offset, name)| {
            let wheels = wheels.into_iter().map(|(x, y, force, radius)| Wheel {
                x,
                y,
                load: SurfaceLoad::new(force, radius).expect("a load"),
            });
            let direction = if reverse {
                Direction::Reverse
            } else {
                Direction::Forward
            };
            let vehicle = Vehicle::new(format!("{index}{name}"), wheels.collect(), speed, direction);
            TrafficVehicle {
                vehicle: vehicle.expect("a vehicle"),
                share: 1.0,
                lateral_offset,
            }
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

fn law() -> impl Strategy<Value = FrictionLaw> {
    let shape_factor = || 1.0..1e9;
    prop_oneof![
        Just(FrictionLaw::Coulomb),
        shape_factor().prop_map(|shape_factor| FrictionLaw::ElasticPlastic { shape_factor }),
        shape_factor().prop_map(|shape_factor| FrictionLaw::Sigmoid { shape_factor }),
    ]
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

fn scene() -> impl Strategy<Value = Scene> {
    let duct = (1.0..1e4, length(), -9.0..9.0);
    let scaling = option::of((any::<bool>(), 1e-6..1e-3));
    let clamps = vec((0.0..=1.0, 1.0..1e9), 0..3);
    let vehicles = (vehicle(0), vehicle(1), vehicle(2));
    let numbers = (1.0..1e3, 1e5..1e9, 0.5..2.0, 0.0..1.0, 1..1_000_000_u64);
    (
        duct,
        (profile(), scaling),
        (law(), numbers),
        (end(), end(), clamps),
        vehicles,
        passes(),
        solver(),
    )
        .prop_map(
            |(
                duct,
                (profile, scaling),
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
                scene.ground.profile = profile;
                scene.ground.scaling = scaling.map(|(along, peak)| {
                    if along {
                        PeakScaling::Longitudinal(peak)
                    } else {
                        PeakScaling::Vertical(peak)
                    }
                });
                scene.friction.law = law;
                let cable = &mut scene.cable;
                (cable.weight, cable.axial_stiffness, cable.normal_load_factor) =
                    (numbers.0, numbers.1, numbers.2);
                (scene.friction.dynamic_coefficient, scene.traffic.passes) = (numbers.3, numbers.4);
                (scene.ends.upstream, scene.ends.downstream) = (upstream, downstream);
                let restraint = |(share, stiffness)| Restraint {
                    position: share * length,
                    stiffness,
                };
                scene.restraints = clamps.into_iter().map(restraint).collect();
                // A cable that nothing holds may slide out of its duct.
                if (upstream, downstream) != (End::Free, End::Free) {
                    scene.duct.slope = 0.1 * lateral_offset;
                }
                scene.vehicles = vec![vehicles.0, vehicles.1, vehicles.2];
                let shares = match passes {
                    Passes::Shares(shares, seed) => {
                        scene.traffic.order = seed.map_or(Order::Interleaved, |seed| Order::Random { seed });
                        shares
                    }
                    Passes::Sequence(sequence) => {
                        let count = |index| sequence.iter().filter(|&&i| i == index).count() as f64;
                        let shares = (0..3).map(count).collect();
                        scene.traffic.order = Order::Sequence(sequence);
                        shares
                    }
                };
                // As reading a file makes them sum to 1.
                let largest = shares.iter().fold(0.0, |a: f64, b| a.max(*b));
                let sum: f64 = shares.iter().map(|share| share / largest).sum();
                for (vehicle, share) in scene.vehicles.iter_mut().zip(&shares) {
                    vehicle.share = share / largest / sum;
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
