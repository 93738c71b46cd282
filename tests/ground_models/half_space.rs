//! Ground of one soil is Boussinesq's half-space in every model, however many layers it is written in.

use boussinesq::HalfSpace;
use burmister::{DEFAULT_ACCURACY, LayeredHalfSpace};
use ground_field::{Base, GroundField};
use layered_fem::LayeredFem;

use super::common::{FEM_ACCURACY, distance, johnson, line, load, profile, radii, soil};

/// Every model that can be asked, with its promised share of the peak. The base differs from the layers by `contrast`, so that
/// nothing can be recognised as one soil and short-cut.
fn models(nu: f64, contrast: f64) -> Vec<(&'static str, Box<dyn GroundField>, f64)> {
    let one = soil(80e6, nu);
    let ground = profile(
        &[(0.3, one), (1.1, one)],
        Base::HalfSpace(soil(80e6 * (1.0 + contrast), nu)),
    );
    vec![
        ("boussinesq", Box::new(HalfSpace::new(one)), 1e-12),
        (
            "burmister",
            Box::new(LayeredHalfSpace::new(&ground).expect("burmister")),
            DEFAULT_ACCURACY,
        ),
        (
            "fem",
            Box::new(LayeredFem::new(&ground, FEM_ACCURACY).expect("fem")),
            FEM_ACCURACY,
        ),
    ]
}

#[test]
fn one_soil_is_boussinesq_under_a_point_load() {
    for (nu, contrast) in [(0.0, 0.0), (0.4, 1e-13), (0.49, 1e-13)] {
        for (name, model, accuracy) in models(nu, contrast) {
            for depth in [0.6, 1.2, 2.0] {
                let exact: Vec<_> = radii()
                    .iter()
                    .map(|&r| johnson(soil(80e6, nu), 1e5, r, depth))
                    .collect();
                let found = line(&*model, load(1e5, 0.0), &radii(), depth);
                let error = distance(&exact, &found);
                assert!(
                    error[0] <= accuracy && error[1] <= accuracy,
                    "{name}, nu {nu}, depth {depth}: {error:?}"
                );
            }
        }
    }
}

/// On the axis of a disc the settlement is an elementary integral of eq. 3.18 over the pressure (Johnson, section 3.4).
#[test]
fn one_soil_settles_on_the_axis_of_a_disc_as_the_integral_says() {
    let (force, a, nu, e) = (5e4, 0.15, 0.35, 80e6);
    let pressure = force / (std::f64::consts::PI * a * a);
    for (name, model, accuracy) in models(nu, 1e-13) {
        for z in [0.3, 0.6, 1.2, 2.0_f64] {
            let root = a.hypot(z);
            // ∫ eq. 3.18 over the disc: ∫ z²/R³ ρ dρ = z − z²/root and ∫ 1/R ρ dρ = root − z.
            let exact = (1.0 + nu) * pressure / e * (z - z * z / root + 2.0 * (1.0 - nu) * (root - z));
            let found = model.displacement(load(force, a), 0.0, z).expect("axis").vertical;
            assert!(
                (found / exact - 1.0).abs() <= accuracy,
                "{name}, z {z}: {found} for {exact}"
            );
        }
    }
}
