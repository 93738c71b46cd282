use boussinesq::HalfSpace;
use cable_dem::*;
use ground_field::*;
#[test]
fn look() {
    let h: f64 = std::env::var("H").map_or(0.1, |v| v.parse().unwrap());
    let st: f64 = std::env::var("ST").map_or(0.05, |v| v.parse().unwrap());
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).unwrap());
    let truck = Vehicle::point("t", 196133.0, 11.11).unwrap();
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0).unwrap(), 100.0, 1e-10).unwrap();
    println!(
        "peaks {:e} {:e} samples {}",
        motion.peak_longitudinal(),
        motion.peak_vertical(),
        motion.samples()
    );
    for (mu, n) in [(0.25, 108.8), (0.27, 163.2)] {
        let q = mu * n;
        for law in [
            FrictionLaw::ElasticPlastic {
                shape_factor: 2e8 / q,
            },
            FrictionLaw::Coulomb,
        ] {
            let cable = DuctedCable::new(30.0, 8.01e6, Friction::new(law, q).unwrap())
                .unwrap()
                .with_ends(End::Free, End::Fixed)
                .unwrap();
            let mesh = Mesh::new(30.0, h, st).unwrap();
            let passage = Passage::new(&cable, &mesh, &motion, 15.0).unwrap();
            let mut solver = QuasiStatic::new(cable, mesh).unwrap();
            let mut state = CableState::at_rest(&mesh);
            let t = std::time::Instant::now();
            let mut stat = Statistics::default();
            for p in 1..=200 {
                let o = solver.pass(&passage, &mut state).unwrap();
                stat += o.statistics;
                if [1, 5, 10, 60, 200].contains(&p) {
                    println!(
                        "{p} {:.2} peak {:.2} up {:.3e}",
                        o.force.downstream, o.peak.downstream, o.upstream_displacement
                    );
                }
            }
            println!("{:?} per pass; {:?}", t.elapsed() / 200, stat);
        }
    }
}
