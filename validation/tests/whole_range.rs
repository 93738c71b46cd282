//! Random scenes over the whole allowed range of the keys: few quick ones of the ten thousand.

use creepage::Scene;
use creepage_validation::whole_range::judged::{Outcome, judged, run};
use creepage_validation::whole_range::{scenes, twins};

/// Scenes that take less than a quarter of a second each, with finite elements, time steps, the sigmoid law, layers whose modulus varies,
/// sections, bends, clamps that slip, heat, bundles, random orders, sequences and meshes of their own among them.
const QUICK: [u64; 28] = [
    7, 18, 22, 42, 74, 80, 87, 92, 96, 99, 103, 116, 139, 153, 173, 190, 242, 254, 270, 279, 317, 336, 340,
    345, 346, 358, 379, 395,
];
/// Of these, some of each kind but finite elements, whose meshes have lengths of their own.
const TWINS: [u64; 8] = [7, 80, 99, 173, 279, 317, 340, 346];
/// A twin is the same scene: what it differs in is rounding.
const ROUNDING: f64 = 1e-7;

#[test]
fn answers_over_the_whole_range_of_every_key_can_be_true() {
    for number in QUICK {
        let (outcome, run) = judged(&scenes::scene(number));
        assert_eq!(outcome, Outcome::Right, "scene {number}");
        let stated = run.map(|run| run.error_estimate.relative);
        assert!(
            stated.is_some_and(|stated| stated <= 0.5),
            "scene {number}: {stated:?}"
        );
    }
}

/// No direction of the duct and no size is distinguished: a scene seen from the other side of the road, and one at four times the size with
/// the same gravity and densities, have the same answers.
#[test]
fn mirrored_and_enlarged_scenes_have_the_same_answers() {
    for number in TWINS {
        let scene = Scene::from_toml("scene", &scenes::scene(number)).expect("a valid scene");
        let own = run(&scene).expect("an answer");
        for (twin, off) in [
            ("mirror", twins::mirror(&scene, &own)),
            ("larger", twins::larger(&scene, &own)),
        ] {
            let worst = off.expect("an answer").into_iter().fold(0.0, f64::max);
            assert!(worst <= ROUNDING, "scene {number}, {twin}: {worst}");
        }
    }
}

/// So heavy a cable hardly slips: on coarse meshes only its end on a spring moves, and nothing shows the 330 N that the sharpest bend leaves in it.
#[test]
fn slip_that_only_fine_meshes_show_is_not_missed() {
    let mut scene = Scene::from_toml("scene", HEAVY).expect("a valid scene");
    let run = creepage::run(&scene).expect("an answer");
    scene.solver.tolerance = 0.01;
    let finer = creepage::run(&scene).expect("an answer");
    let forces = [&run, &finer].map(|run| run.passes[0].max_compression_n);
    let stated = run.error_estimate.relative;
    assert!(
        (forces[0] - forces[1]).abs() <= stated * forces[1],
        "{forces:?}, {stated}"
    );
}

/// The vehicle is so slow that inertia does not count.
const HEAVY: &str = r#"
[duct]
length = 5
depth = 1.2562660087920139
[ground]
vertical_peak = 0.0002112765293739545
[[ground.layers]]
thickness = 0.09778972067849749
young_modulus = 2170961779.480049
poisson_ratio = 0.35761683255731014
[[ground.layers]]
thickness = 0.15604542670828725
young_modulus = 1173572395.6943913
poisson_ratio = 0.4675288297876613
[[ground.layers]]
thickness = 0.43635481556622513
young_modulus = 1528891669.4716902
poisson_ratio = 0.27095653873571446
[[ground.layers]]
young_modulus = 73527174.33326934
poisson_ratio = 0.21904984067191852
[cable]
weight = 37938.468340930616
axial_stiffness = 34350849.684726074
[friction]
dynamic_coefficient = 0.25552148282346315
shape_factor = 54595446.61029038
[ends]
upstream = "free"
downstream = { spring = 21281.29760067977 }
[[vehicles]]
speed = 1.0
load = 56176.5812631776
[traffic]
passes = 1
[solver]
tolerance = 0.03951564188815697
"#;
