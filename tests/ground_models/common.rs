//! Grounds, lines of displacements and how far two of them are apart.

use ground_field::{Base, Displacement, GroundField, Soil, SoilProfile, SurfaceLoad};
use proptest::prelude::*;
pub use testkit::{johnson, soil};

/// Accuracy asked of the finite elements.
pub const FEM_ACCURACY: f64 = 5e-3;

pub fn profile(layers: &[(f64, Soil)], base: Base) -> SoilProfile {
    let layers = layers
        .iter()
        .map(|&(thickness, soil)| testkit::layer(thickness, soil));
    SoilProfile::new(layers.collect(), base).expect("profile")
}

/// Table 1 of the paper: surface course and binder on the subgrade.
pub fn table_1() -> SoilProfile {
    profile(
        &[(0.05, soil(4e9, 0.35)), (0.05, soil(8e8, 0.35))],
        Base::HalfSpace(soil(8e8, 0.4)),
    )
}

pub fn load(force: f64, contact_radius: f64) -> SurfaceLoad {
    SurfaceLoad::new(force, contact_radius).expect("load")
}

/// 0 to 10 m, dense around both peaks.
pub fn radii() -> Vec<f64> {
    (0..60)
        .map(|k| 0.05 * f64::from(k))
        .chain((0..15).map(|k| 3.0 + 0.5 * f64::from(k)))
        .collect()
}

pub fn line(field: &dyn GroundField, load: SurfaceLoad, radii: &[f64], depth: f64) -> Vec<Displacement> {
    field.displacements(load, radii, depth).expect("displacements")
}

/// Largest |u_r| and |u_z|.
pub fn peaks(line: &[Displacement]) -> [f64; 2] {
    line.iter().fold([0.0, 0.0], |peak, u| {
        [peak[0].max(u.radial.abs()), peak[1].max(u.vertical.abs())]
    })
}

/// Largest difference of u_r and of u_z, as shares of the peaks of `exact`.
pub fn distance(exact: &[Displacement], found: &[Displacement]) -> [f64; 2] {
    assert_eq!(exact.len(), found.len());
    let peak = peaks(exact);
    exact.iter().zip(found).fold([0.0, 0.0], |worst, (u, v)| {
        // `f64::max` would drop a NaN.
        assert!(v.is_finite(), "{v:?}");
        [
            worst[0].max((u.radial - v.radial).abs() / peak[0]),
            worst[1].max((u.vertical - v.vertical).abs() / peak[1]),
        ]
    })
}

fn logarithmic(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from.ln()..to.ln()).prop_map(f64::exp)
}

pub fn any_soil() -> impl Strategy<Value = Soil> {
    (logarithmic(1e7, 1e10), 0.0..0.49_f64).prop_map(|(e, nu)| soil(e, nu))
}

/// One to five layers of 0.05 to 3 m, 10 MPa to 10 GPa.
pub fn any_layers() -> impl Strategy<Value = Vec<(f64, Soil)>> {
    prop::collection::vec((logarithmic(0.05, 3.0), any_soil()), 1..6)
}

pub fn any_base() -> impl Strategy<Value = Base> {
    prop_oneof![2 => any_soil().prop_map(Base::HalfSpace), 1 => Just(Base::Rigid)]
}

/// A depth of 0.6 to 2 m that lies above the base, if that is rock; `None` if there is none.
pub fn depth_in(layers: &[(f64, Soil)], base: Base, share: f64) -> Option<f64> {
    let bottom = match base {
        Base::Rigid => 0.9 * layers.iter().map(|layer| layer.0).sum::<f64>(),
        Base::HalfSpace(_) => 2.0,
    };
    (bottom > 0.6).then(|| 0.6 + share * (bottom.min(2.0) - 0.6))
}
