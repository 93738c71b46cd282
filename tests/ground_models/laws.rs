//! Superposition and reciprocity, for every model of the ground.

use std::f64::consts::{PI, TAU};

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use ground_field::{Direction, DuctLine, DuctMotion, GroundField, Vehicle, Wheel};
use layered_fem::LayeredFem;

use super::common::{FEM_ACCURACY, line, load, peaks, radii, soil, table_1};

/// Accuracy to which a duct's motion follows its ground: finite elements are smooth from piece to piece only.
fn motion_accuracy(model: &str) -> f64 {
    if model == "fem" { 1e-4 } else { 1e-7 }
}

fn models() -> Vec<(&'static str, Box<dyn GroundField>)> {
    let ground = table_1();
    vec![
        ("boussinesq", Box::new(HalfSpace::new(soil(8e8, 0.4)))),
        (
            "burmister",
            Box::new(LayeredHalfSpace::new(&ground).expect("burmister")),
        ),
        (
            "fem",
            Box::new(LayeredFem::new(&ground, FEM_ACCURACY).expect("fem")),
        ),
    ]
}

#[test]
fn displacements_are_proportional_to_the_force() {
    for (name, model) in models() {
        for contact in [0.0, 0.15] {
            let one = line(&*model, load(1.0, contact), &radii(), 1.2);
            let many = line(&*model, load(3e5, contact), &radii(), 1.2);
            for (u, v) in one.iter().zip(&many) {
                let (u, v) = (*u * 3e5, *v);
                let peak = peaks(&many);
                // One unit force is scaled: equal to rounding, not only to the model's accuracy.
                assert!((u.radial - v.radial).abs() <= 1e-12 * peak[0], "{name}");
                assert!((u.vertical - v.vertical).abs() <= 1e-12 * peak[1], "{name}");
            }
            let none = line(&*model, load(0.0, contact), &[0.4, 2.0], 1.2);
            assert!(
                none.iter().all(|u| u.radial == 0.0 && u.vertical == 0.0),
                "{name}"
            );
        }
    }
}

fn vehicle(wheels: Vec<Wheel>) -> Vehicle {
    Vehicle::new("truck", wheels, 11.0, Direction::Forward).expect("vehicle")
}

/// Two wheels of different contact, side by side and one behind the other, move the duct by the sum of what each does.
#[test]
fn two_wheels_move_the_duct_by_the_sum_of_both() {
    let wheels = [
        Wheel {
            x: 1.7,
            y: 0.9,
            load: load(45e3, 0.15),
        },
        Wheel {
            x: -2.1,
            y: -0.4,
            load: load(30e3, 0.0),
        },
    ];
    let duct = DuctLine::new(1.2, 0.3).expect("duct");
    for (name, model) in models() {
        let accuracy = motion_accuracy(name);
        let motion = |wheels: &[Wheel]| {
            DuctMotion::new(&*model, &vehicle(wheels.to_vec()), duct, 20.0, accuracy).expect("motion")
        };
        let (both, first, second) = (motion(&wheels), motion(&wheels[..1]), motion(&wheels[1..]));
        for k in -60..=60 {
            let xi = 0.25 * f64::from(k);
            let sum = first.longitudinal(xi) + second.longitudinal(xi);
            assert!(
                (both.longitudinal(xi) - sum).abs() <= 1e-12 * both.peak_longitudinal(),
                "{name} {xi}"
            );
            let sum = first.vertical(xi) + second.vertical(xi);
            assert!(
                (both.vertical(xi) - sum).abs() <= 1e-12 * both.peak_vertical(),
                "{name} {xi}"
            );
            // And it is the trait's own answer, turned into the duct's direction.
            let (mut along, mut down) = (0.0, 0.0);
            for wheel in &wheels {
                let (x, y) = (xi - wheel.x, 0.3 - wheel.y);
                let u = model.displacement(wheel.load, x.hypot(y), 1.2).expect("value");
                along += u.radial * x / x.hypot(y);
                down += u.vertical;
            }
            assert!(
                (both.longitudinal(xi) - along).abs() <= 4.0 * accuracy * both.peak_longitudinal(),
                "{name} {xi}: {} for {along}",
                both.longitudinal(xi)
            );
            assert!(
                (both.vertical(xi) - down).abs() <= 4.0 * accuracy * both.peak_vertical(),
                "{name} {xi}: {} for {down}",
                both.vertical(xi)
            );
        }
    }
}

/// Mean over a disc of radius `b` of the displacement toward +x and downward, under a disc of radius `a` whose centre is
/// `apart` metres behind: Gauss–Legendre with 8 points in the square of the radius, midpoints in the angle.
fn mean_over_disc(model: &dyn GroundField, a: f64, b: f64, apart: f64, depth: f64) -> [f64; 2] {
    const RULE: [(f64, f64); 4] = [
        (0.1834346424956498, 0.362683783378362),
        (0.525532409916329, 0.3137066458778873),
        (0.7966664774136267, 0.2223810344533745),
        (0.9602898564975363, 0.1012285362903763),
    ];
    const TURNS: i32 = 24;
    let mut places = Vec::new();
    for (t, weight) in RULE.iter().flat_map(|&(t, w)| [(t, w), (-t, w)]) {
        for k in 0..TURNS {
            let ring = b * f64::sqrt(0.5 * (1.0 + t));
            let (sine, cosine) = (TAU * (f64::from(k) + 0.5) / f64::from(TURNS)).sin_cos();
            let (x, y) = (apart + ring * cosine, ring * sine);
            places.push((x.hypot(y), x / x.hypot(y), 0.5 * weight / f64::from(TURNS)));
        }
    }
    let radii: Vec<f64> = places.iter().map(|place| place.0).collect();
    // The same pressure integrated over each disc: a force of 1 N on both.
    line(model, load(1.0, a), &radii, depth)
        .iter()
        .zip(&places)
        .fold([0.0, 0.0], |sum, (u, place)| {
            [
                sum[0] + place.2 * place.1 * u.radial,
                sum[1] + place.2 * u.vertical,
            ]
        })
}

/// What one disc does to the mean displacement under another of a different size, the other does to the mean under it: on
/// the surface by Betti's theorem, at depth because ground without horizontal structure does not tell which of two discs is
/// spread over the load and which over the place.
#[test]
fn discs_of_different_size_can_change_places() {
    for (name, model) in models() {
        // Each mean is right to the model's accuracy; the closed forms to rounding, but for the quadrature over the disc.
        let accuracy = match name {
            "fem" => 2.0 * FEM_ACCURACY,
            "burmister" => 2e-8,
            _ => 1e-9,
        };
        for (apart, depth) in [(0.9, 0.0), (0.0, 0.8), (0.9, 0.8), (2.0, 1.2)] {
            // The edge of a disc on the surface is not among what the finite elements resolve.
            if name == "fem" && depth == 0.0 {
                continue;
            }
            let one = mean_over_disc(&*model, 0.1, 0.3, apart, depth);
            let other = mean_over_disc(&*model, 0.3, 0.1, apart, depth);
            let peak = peaks(&line(&*model, load(1.0, 0.1), &radii(), depth));
            for component in [0, 1] {
                let gap = (one[component] - other[component]).abs() / peak[component];
                assert!(
                    gap <= accuracy,
                    "{name}, apart {apart}, depth {depth}: {one:?} {other:?}"
                );
            }
            assert!(one[1] > 0.0, "{name}");
        }
    }
}

/// Far from the load the ground is its base: what the discs of two vehicles weigh is all that counts.
#[test]
fn far_away_only_the_weight_counts() {
    for (name, model) in models() {
        let accuracy = if name == "fem" { FEM_ACCURACY } else { 1e-3 };
        let point = model
            .displacement(load(1e5, 0.0), 30.0, 1.2)
            .expect("point")
            .vertical;
        let disc = model
            .displacement(load(1e5, 0.4), 30.0, 1.2)
            .expect("disc")
            .vertical;
        // Boussinesq's settlement at the surface, (1 − ν²) P/(π E r): 1.2 m are (z/r)² = 0.2 % away from it.
        let surface = (1.0 - 0.4 * 0.4) * 1e5 / (PI * 8e8 * 30.0);
        assert!((point / disc - 1.0).abs() <= accuracy, "{name}: {point} {disc}");
        assert!((point / surface - 1.0).abs() <= 0.01, "{name}: {point} {surface}");
    }
}
