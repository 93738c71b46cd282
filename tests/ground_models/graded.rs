//! A modulus that varies with depth, which only the finite elements take, is the limit of many thin uniform layers.

use burmister::LayeredHalfSpace;
use ground_field::{Base, Displacement, GroundField, Modulus, SoilLayer, SoilProfile};
use layered_fem::LayeredFem;

use super::common::{distance, line, load, radii, soil};

/// A layer in the middle, between a road above, if there is one, and soil or rock below.
fn ground(road: bool, middle: Vec<SoilLayer>, base: Base) -> SoilProfile {
    let road = road.then(|| testkit::layer(0.15, soil(3e9, 0.35)));
    SoilProfile::new(road.into_iter().chain(middle).collect(), base).expect("profile")
}

/// `count` layers with the modulus in the middle of each.
fn sliced(layer: &SoilLayer, count: u32) -> Vec<SoilLayer> {
    let thickness = layer.thickness() / f64::from(count);
    let slice = |k| {
        let modulus = layer.young_modulus_at((f64::from(k) + 0.5) * thickness);
        testkit::layer(thickness, soil(modulus, layer.poisson_ratio()))
    };
    (0..count).map(slice).collect()
}

/// Where the modulus falls by a hundred within half a metre too the error is within its estimate, not only within what was asked.
#[test]
#[ignore = "seven seconds: .ci/run runs it"]
fn a_graded_modulus_is_the_limit_of_thin_layers() {
    let wheel = load(1e5, 0.15);
    let on = |young| Base::HalfSpace(soil(young, 0.3));
    for (road, thickness, top, bottom, base, depth) in [
        (true, 2.4, 60e6, 200e6, on(2e8), 0.75),
        (true, 2.4, 200e6, 20e6, on(3e8), 1.35),
        (true, 2.4, 40e6, 400e6, Base::Rigid, 1.95),
        (false, 0.5, 1e9, 1e7, on(1e7), 0.3),
        (false, 2.0, 5e9, 1e7, on(2e7), 1.2),
        (false, 3.46, 1.04e8, 1.8e7, on(5e7), 1.2),
        (false, 0.5, 1e7, 1e9, on(1e9), 0.3),
    ] {
        let layer = SoilLayer::new(thickness, Modulus::Linear { top, bottom }, 0.3).expect("graded layer");
        let graded = ground(road, vec![layer], base);
        // Only the elements take a graded modulus.
        assert!(LayeredHalfSpace::new(&graded).is_err());
        let finest = if road { 240 } else { 960 };
        let slices = [finest / 4, finest / 2, finest].map(|count| {
            let slices = ground(road, sliced(&layer, count), base);
            let model = LayeredHalfSpace::new(&slices).expect("transform");
            line(&model, wheel, &radii(), depth)
        });
        // One step of Richardson's extrapolation from each pair: their difference bounds the finer one's error.
        let limit = extrapolated(&slices[1], &slices[2]);
        let left = distance(&limit, &extrapolated(&slices[0], &slices[1]));
        assert!(left[0].max(left[1]) < 3e-5, "{left:?}");
        for asked in [2e-2, 5e-3, 1e-3] {
            let elements = LayeredFem::new(&graded, asked).expect("elements");
            // An accuracy out of reach is refused.
            let Ok(found) = elements.displacements(wheel, &radii(), depth) else {
                assert!(!road, "{top:e}, asked {asked:e}");
                continue;
            };
            let estimate = elements.error_estimate(wheel, depth).expect("estimate");
            assert!(estimate.largest() <= asked);
            let error = distance(&limit, &found);
            let is_within = error[0] <= estimate.radial + left[0] && error[1] <= estimate.vertical + left[1];
            assert!(is_within, "{top:e}, asked {asked:e}: {error:?}, {estimate:?}");
        }
    }
}

/// The limit of values with an error of second order at spacings 2 and 1.
fn extrapolated(coarse: &[Displacement], fine: &[Displacement]) -> Vec<Displacement> {
    let pairs = fine.iter().zip(coarse);
    pairs
        .map(|(&fine, &coarse)| fine + (fine - coarse) * (1.0 / 3.0))
        .collect()
}

/// Equal at top and bottom, a modulus does not vary: every model takes it.
#[test]
fn a_modulus_with_equal_ends_is_uniform() {
    let (top, bottom) = (70e6, 70e6);
    let written = SoilLayer::new(1.0, Modulus::Linear { top, bottom }, 0.35);
    let values = [written, SoilLayer::uniform(1.0, soil(70e6, 0.35))].map(|layer| {
        let profile = ground(
            true,
            vec![layer.expect("layer")],
            Base::HalfSpace(soil(40e6, 0.4)),
        );
        let ground = LayeredHalfSpace::new(&profile).expect("uniform");
        ground.displacement(load(5e4, 0.15), 0.8, 1.2).expect("value")
    });
    assert_eq!(values[0], values[1]);
}
