//! probe
use ground_field::*;
use layered_fem::Probe;
use std::collections::BTreeMap;
fn prof(case:&str)->Option<(SoilProfile,f64,f64)>{
    let s=|e:f64,n:f64|Soil::new(e*1e6,n).unwrap();
    let l=|h:f64,e:f64,n:f64|SoilLayer::uniform(h/1e3,s(e,n)).unwrap();
    let hs=|v:Vec<SoilLayer>,e,n|SoilProfile::new(v,Base::HalfSpace(s(e,n))).unwrap();
    let rg=|v:Vec<SoilLayer>|SoilProfile::new(v,Base::Rigid).unwrap();
    let t3=hs(vec![l(50.,4000.,0.35),l(50.,800.,0.35)],800.,0.4);
    let five=hs(vec![l(40.,6000.,0.35),l(120.,3000.,0.35),l(200.,400.,0.3),l(600.,120.,0.35)],45.,0.4);
    let q=2.77471435141713;
    Some(match case{
        "hs1"=>(hs(vec![],100.,0.35),0.15,0.7),
        "hs2"=>(hs(vec![],40.,0.5),0.15,0.7),
        "task3"=>(t3,0.15,q),
        "ellea3"=>(hs(vec![l(150.,3000.,0.3),l(600.,200.,0.35)],40.,0.4),0.15,1.1),
        "amad3_bb"=>(hs(vec![l(260.,5000.,0.35),l(500.,200.,0.4)],50.,0.45),0.1508,0.7),
        "five"=>(five,0.15,0.7),
        "stiff1e4"=>(hs(vec![l(200.,30000.,0.2),l(300.,300.,0.35)],3.,0.45),0.15,0.7),
        "thick"=>(hs(vec![l(5000.,200.,0.35),l(5000.,80.,0.35)],20.,0.4),0.15,0.7),
        "rb_homog"=>(rg(vec![l(6000.,100.,0.35)]),0.15,0.7),
        "rb_task3"=>(rg(vec![l(50.,4000.,0.35),l(50.,800.,0.35),l(5900.,800.,0.4)]),0.15,q),
        "pl_task3"=>(t3,0.,0.),"pl_five"=>(five,0.,0.),
        "pl_hs_E100_nu0.35"=>(hs(vec![],100.,0.35),0.,0.),
        "pl_hs_E40_nu0.5"=>(hs(vec![],40.,0.5),0.,0.),
        "pl_hs_E100_nu0"=>(hs(vec![],100.,0.),0.,0.),
        _=>return None,
    })
}
fn main(){
    let alpha:f64=std::env::args().nth(1).unwrap().parse().unwrap();
    let least:usize=std::env::args().nth(2).unwrap().parse().unwrap();
    let stretch:f64=std::env::args().nth(3).unwrap().parse().unwrap();
    let mut data:BTreeMap<String,BTreeMap<u64,Vec<[f64;3]>>>=BTreeMap::new();
    for f in ["computed_layered","computed_point_load","computed_rigid_base"]{
        let t=std::fs::read_to_string(format!("{}/tests/data/{f}.csv",env!("CARGO_MANIFEST_DIR"))).unwrap();
        let h:Vec<&str>=t.lines().next().unwrap().split(',').collect();
        let c=|n:&str|h.iter().position(|x|*x==n).unwrap();
        let (cr,cz,cu,cw)=(c("r_mm"),c("z_mm"),c("ur_mm"),c("uz_mm"));
        for l in t.lines().skip(1){let v:Vec<&str>=l.split(',').collect();
            let g=|i:usize|v[i].parse::<f64>().unwrap()/1e3;
            data.entry(v[0].into()).or_default().entry((g(cz)*1e6) as u64).or_default().push([g(cr),g(cu),g(cw)]);}
    }
    for (case,zs) in &data{
        let Some((p,a,q))=prof(case) else {println!("no {case}");continue};
        let force=if a>0.{q*1e6*std::f64::consts::PI*a*a}else{196133.0};
        let t=std::time::Instant::now();
        let m=Probe::new(&p,alpha,least,stretch);
        let t0=t.elapsed();
        print!("{case:18} {:?} {}",t0,m.size());
        for (z,rows) in zs{let z=*z as f64/1e6; 
            let rr:Vec<f64>=rows.iter().map(|x|x[0]).collect();
            let u=m.line(a,z,&rr);
            let (mut pr,mut pz,mut er,mut ez)=(0f64,0f64,0f64,0f64);
            for (d,x) in u.iter().zip(rows){ pr=pr.max(x[1].abs());pz=pz.max(x[2].abs());
                if x[0]>10.01 {continue}
                er=er.max((d.radial*force-x[1]).abs());ez=ez.max((d.vertical*force-x[2]).abs());}
            print!(" | z{z} {:.1e} {:.1e}",er/pr,ez/pz);
        }
        println!();
    }
}
