use boussinesq::HalfSpace;
use cable_dem::*;
use ground_field::*;
use pass_law::*;
fn motion(reach: f64, p: f64) -> DuctMotion {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).unwrap());
    let truck = Vehicle::point("t", p, 11.11).unwrap();
    DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0).unwrap(), reach, 1e-10).unwrap()
}
fn main() {
    let m = motion(1000.0, 196133.0);
    let ea = 8.01e6;
    let k: f64 = std::env::args().nth(1).map_or(6.0, |v| v.parse().unwrap());
    for (mu, n, len, passes) in [(0.25, 108.8, 30.0, vec![1, 5, 10, 60, 300]), (0.27, 163.2, 30.0, vec![1, 5, 10, 60, 200, 400]), (0.25, 108.8, 100.0, vec![5, 10, 20, 30, 50, 100, 200, 500, 1500])] {
        let q = mu * n;
        let law = FrictionLaw::ElasticPlastic { shape_factor: 2e8 / q };
        let c = DuctedCable::new(len, ea, Friction::new(law, q).unwrap()).unwrap().with_ends(End::Free, End::Fixed).unwrap();
        let t = std::time::Instant::now();
        let streams = [(m.clone(), 1.0)];
        let l = PassLaw::new(&c, &streams, Resolution::new(1.2).unwrap().with_nodes_per_depth(k).unwrap()).unwrap().with_approach(15.0, &streams);
        let t1 = t.elapsed();
        let e = l.run(&passes).unwrap();
        println!("prep {t1:?} run {:?} {:?} {:?} {}", t.elapsed() - t1, l.preparation(), e.statistics, e.left_table);
        let mesh = Mesh::new(len, 1.2 / k, 0.6 / k).unwrap();
        let passage = Passage::new(&c, &mesh, &m, 15.0).unwrap();
        let mut solver = QuasiStatic::new(c.clone(), mesh).unwrap();
        let mut st = CableState::at_rest(&mesh);
        for p in 1..=*passes.last().unwrap() {
            let o = solver.pass(&passage, &mut st).unwrap();
            if let Some(r) = e.records.iter().find(|r| r.pass == p) {
                println!("{p:5} direct {:.1} law {:.1} ({:+.1} %)  peak {:.1} {:.1} up {:.2} {:.2}mm", o.force.downstream, r.downstream_force, 100.0 * (r.downstream_force / o.force.downstream - 1.0), o.peak.downstream, r.downstream_peak, o.upstream_displacement * 1e3, r.upstream_displacement * 1e3);
            }
        }
    }
}
