use boussinesq::HalfSpace;
use cable_dem::*;
use ground_field::*;
use pass_law::*;
fn main() {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).unwrap());
    for dir in [Direction::Forward, Direction::Reverse] {
    let truck = Vehicle::point("t", 196133.0, 11.11).unwrap().driving(dir);
    let m = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0).unwrap(), 1000.0, 1e-10).unwrap();
    for (mu, n) in [(0.25, 108.8), (0.27, 163.2)] {
        let q = mu * n;
        for k in [6.0, 12.0] {
        let law = FrictionLaw::ElasticPlastic { shape_factor: 2e8 / q };
        let c = DuctedCable::new(100.0, 8.01e6, Friction::new(law, q).unwrap()).unwrap();
        let l = AdvanceLaw::new(&c, &m, Resolution::new(1.2).unwrap().with_nodes_per_depth(k).unwrap()).unwrap();
        println!("G0 {:.3} f* {:.5}", l.free_advance() * 1e6, l.saturation() / q);
        for i in 0..=8 { let f = l.saturation() * i as f64 / 8.0; let (g, s) = l.advance(f); let b = l.skew(f).0; print!("[{:.2} {:.2} s{:.2e} b{:.2e} lag {:.2}] ", f / q, g * 1e6, s, b, -b / s); }
        println!();
    }}}
}
