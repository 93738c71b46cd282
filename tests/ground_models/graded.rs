//! A modulus that varies with depth, which only the finite elements take, is the limit of many thin uniform layers.

use burmister::LayeredHalfSpace;
use ground_field::{Base, Displacement, GroundField, Modulus, SoilLayer, SoilProfile};
use layered_fem::LayeredFem;

use super::common::{distance, line, load, radii, soil};

const ACCURACY: f64 = 1e-3;

/// A layer whose modulus varies from `top` to `bottom`, between a road above and soil or rock below.
fn ground(middle: Vec<SoilLayer>, base: Base) -> SoilProfile {
    let road = SoilLayer::uniform(0.15, soil(3e9, 0.35)).expect("road");
    SoilProfile::new([vec![road], middle].concat(), base).expect("profile")
}

/// `count` layers with the modulus in the middle of each.
fn sliced(layer: &SoilLayer, count: u32) -> Vec<SoilLayer> {
    let thickness = layer.thickness() / f64::from(count);
    (0..count)
        .map(|k| {
            let modulus = layer.young_modulus_at((f64::from(k) + 0.5) * thickness);
            SoilLayer::uniform(thickness, soil(modulus, layer.poisson_ratio())).expect("slice")
        })
        .collect()
}

#[test]
fn a_graded_modulus_is_the_limit_of_thin_layers() {
    let wheel = load(5e4, 0.15);
    for (top, bottom, base) in [
        (60e6, 200e6, Base::HalfSpace(soil(200e6, 0.4))),
        (200e6, 20e6, Base::HalfSpace(soil(300e6, 0.35))),
        (40e6, 400e6, Base::Rigid),
    ] {
        let middle = SoilLayer::new(2.4, Modulus::Linear { top, bottom }, 0.4).expect("graded layer");
        let elements = LayeredFem::new(&ground(vec![middle], base), ACCURACY).expect("elements");
        assert!(
            LayeredHalfSpace::new(elements.profile()).is_err(),
            "only the elements take a graded modulus"
        );
        // Interfaces of the slices, however many: between them the error of second order would differ from place to place.
        for depth in [0.75, 1.35, 1.95] {
            let slices = [16, 32, 64].map(|count| {
                let model = LayeredHalfSpace::new(&ground(sliced(&middle, count), base)).expect("transform");
                line(&model, wheel, &radii(), depth)
            });
            let steps = [distance(&slices[1], &slices[0]), distance(&slices[2], &slices[1])];
            for component in [0, 1] {
                // Where the error changes its sign between the radii and slices it is small instead of regular.
                let [first, second] = steps.map(|step| step[component]);
                assert!(second < 0.4 * first || second < 2e-4, "{depth} {steps:?}");
            }
            // One step of Richardson's extrapolation from each pair: their difference bounds the finer one's error.
            let (near, limit) = (
                extrapolated(&slices[0], &slices[1]),
                extrapolated(&slices[1], &slices[2]),
            );
            let left = distance(&limit, &near);
            let found = line(&elements, wheel, &radii(), depth);
            let error = distance(&limit, &found);
            for component in [0, 1] {
                assert!(
                    error[component] <= ACCURACY + left[component],
                    "{top:e} to {bottom:e}, depth {depth}: {error:?}, limit {left:?}"
                );
                assert!(left[component] < 3e-3, "depth {depth}: {left:?}");
            }
        }
    }
}

/// Where the modulus falls by a hundred within half a metre the error is still within its estimate, not only within what was asked.
#[test]
fn the_estimate_holds_where_the_modulus_falls_steeply() {
    let wheel = load(1e5, 0.15);
    for (thickness, top, bottom, base, depth) in [
        (0.5, 1e9, 1e7, 1e7, 0.3),
        (2.0, 5e9, 1e7, 2e7, 1.2),
        (3.46, 1.04e8, 1.8e7, 5e7, 1.2),
        (0.5, 1e7, 1e9, 1e9, 0.3),
    ] {
        let layer = SoilLayer::new(thickness, Modulus::Linear { top, bottom }, 0.3).expect("graded layer");
        let on_base = |layers| SoilProfile::new(layers, Base::HalfSpace(soil(base, 0.3))).expect("profile");
        let slices = [240, 480, 960].map(|count| {
            let model = LayeredHalfSpace::new(&on_base(sliced(&layer, count))).expect("transform");
            line(&model, wheel, &radii(), depth)
        });
        let limit = extrapolated(&slices[1], &slices[2]);
        let left = distance(&limit, &extrapolated(&slices[0], &slices[1]));
        assert!(left[0].max(left[1]) < 3e-5, "{left:?}");
        for asked in [2e-2, 5e-3, 1e-3] {
            let elements = LayeredFem::new(&on_base(vec![layer]), asked).expect("elements");
            // An accuracy out of reach is refused.
            let Ok(found) = elements.displacements(wheel, &radii(), depth) else {
                continue;
            };
            let estimate = elements.error_estimate(wheel, depth).expect("estimate");
            let error = distance(&limit, &found);
            assert!(
                error[0] <= estimate.radial + left[0] && error[1] <= estimate.vertical + left[1],
                "{top:e} to {bottom:e}, asked {asked:e}: {error:?}, {estimate:?}"
            );
        }
    }
}

/// The limit of values with an error of second order at spacings 2 and 1.
fn extrapolated(coarse: &[Displacement], fine: &[Displacement]) -> Vec<Displacement> {
    fine.iter()
        .zip(coarse)
        .map(|(&fine, &coarse)| fine + (fine - coarse) * (1.0 / 3.0))
        .collect()
}

/// Equal at top and bottom, a modulus does not vary: every model takes it.
#[test]
fn a_modulus_with_equal_ends_is_uniform() {
    let modulus = Modulus::Linear {
        top: 70e6,
        bottom: 70e6,
    };
    let written = ground(
        vec![SoilLayer::new(1.0, modulus, 0.35).expect("layer")],
        Base::HalfSpace(soil(40e6, 0.4)),
    );
    let plain = ground(
        vec![SoilLayer::uniform(1.0, soil(70e6, 0.35)).expect("layer")],
        Base::HalfSpace(soil(40e6, 0.4)),
    );
    let values = [written, plain].map(|profile| {
        LayeredHalfSpace::new(&profile)
            .expect("uniform")
            .displacement(load(5e4, 0.15), 0.8, 1.2)
            .expect("value")
    });
    assert_eq!(values[0], values[1]);
}
