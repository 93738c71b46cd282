//! Figure 13 of the paper: how far friction can stretch a cable, ΔC = μ N′ X²/(2 EA).
//!
//! K. Kashiro et al., section 5.1: the elastic displacement of the cable grows with friction and with the square of the length X on which it acts, and falls with
//! EA; where it reaches the displacement of the duct, the cable follows instead of slipping. Lines: the formula of a bar under
//! even friction, N′ the weight a metre. Points: the cable solver, on a bar of length X held at one end whose duct moves
//! much farther than the bar can stretch, forward at last.
//!
//! `cargo run --release --example figure_13`

mod common;

use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
use common::{Failure, even, save};
use creepage::figure::{Axis, Chart, Reference, Series};
use ground_field::Direction;

/// Displacement of the duct in Table 3 \[m\].
const DUCT: f64 = 35.7e-6;
/// Lengths on which friction acts \[m\].
pub const LENGTHS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

/// A cable of Table 2 with one of its friction coefficients.
pub struct Bar {
    /// Name.
    pub name: &'static str,
    /// μ_d
    pub friction: f64,
    /// N′ \[N/m\].
    pub weight: f64,
    /// EA \[N\].
    pub axial_stiffness: f64,
}

/// Cables and friction coefficients of Table 2.
pub const BARS: [Bar; 5] = [
    bar("single core, μ = 0.3", 0.3, 108.8, 8.01e6),
    bar("single core, μ = 0.4", 0.4, 108.8, 8.01e6),
    bar("single core, μ = 0.5", 0.5, 108.8, 8.01e6),
    bar("triplex, μ = 0.3", 0.3, 112.7, 1.47e6),
    bar("triplex, μ = 0.4", 0.4, 112.7, 1.47e6),
];

const fn bar(name: &'static str, friction: f64, weight: f64, axial_stiffness: f64) -> Bar {
    Bar {
        name,
        friction,
        weight,
        axial_stiffness,
    }
}

impl Bar {
    /// ΔC by the formula \[m\].
    pub fn by_formula(&self, length: f64) -> f64 {
        self.friction * self.weight * length * length / (2.0 * self.axial_stiffness)
    }

    /// Length on which friction stretches the cable as far as the duct moves \[m\].
    pub fn following_length(&self) -> f64 {
        (2.0 * self.axial_stiffness * DUCT / (self.friction * self.weight)).sqrt()
    }

    /// ΔC by the cable solver \[m\].
    ///
    /// # Errors
    ///
    /// Those of the solver.
    pub fn by_solver(&self, length: f64) -> Result<f64, Failure> {
        let friction = Friction::new(FrictionLaw::Coulomb, self.friction * self.weight)?;
        let cable =
            DuctedCable::new(length, self.axial_stiffness, friction)?.with_ends(End::Free, End::Fixed)?;
        let mesh = Mesh::new(length, length / 64.0, length / 128.0)?;
        // A front as wide as the bar takes the duct back ten times as far as the bar stretches; the return to rest takes it
        // forward again.
        let moved = 10.0 * self.by_formula(length);
        let shape = |xi: f64| -0.5 * moved * (1.0 - (xi / length).tanh());
        let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, 18.0 * length)?;
        let mut state = CableState::at_rest(&mesh);
        Ok(QuasiStatic::new(cable, mesh)?
            .pass(&passage, &mut state)?
            .upstream_displacement)
    }
}

fn main() -> Result<(), Failure> {
    let mut chart = Chart::new(
        "Figure 13: how far friction stretches a cable; lines by formula",
        Axis::logarithmic("length X on which friction acts, m"),
        Axis::logarithmic("elastic displacement ΔC, µm"),
    )
    .refer(Reference::horizontal(DUCT * 1e6, "duct of Table 3: 35.7 µm"));
    print!("ΔC, um                 X =");
    for length in &LENGTHS {
        print!("{length:9.1} m");
    }
    println!("   follows the duct's 35.7 um on");
    for (look, bar) in BARS.iter().enumerate() {
        let solved = LENGTHS
            .iter()
            .map(|x| bar.by_solver(*x))
            .collect::<Result<Vec<_>, _>>()?;
        print!("{:21} formula", bar.name);
        for x in &LENGTHS {
            print!(" {:9.3}", bar.by_formula(*x) * 1e6);
        }
        println!("   {:.2} m", bar.following_length());
        print!("{:21} solver ", "");
        for displacement in &solved {
            print!(" {:9.3}", displacement * 1e6);
        }
        println!();
        let curve = even(LENGTHS[0].ln(), LENGTHS[4].ln(), 8)
            .map(|place| (place.exp(), bar.by_formula(place.exp()) * 1e6));
        let points = LENGTHS
            .iter()
            .zip(&solved)
            .map(|(x, displacement)| (*x, displacement * 1e6));
        chart = chart
            .with(Series::line(bar.name, curve).look(look))
            .with(Series::points(if look == 0 { "markers: cable solver" } else { "" }, points).look(look));
    }
    save("figure-13.svg", &chart.to_svg()?)
}
