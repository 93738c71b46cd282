//! tmp
use crate::level::*;
use crate::grading::Lines;
use ground_field::*;
/// probe
pub struct Probe(Level);
impl Probe {
    /// new
    pub fn new(p: &SoilProfile, alpha: f64, least: usize, stretch: f64) -> Self {
        Self(Level::new(p, Lines::new(p, alpha, least, stretch)).unwrap())
    }
    /// at
    pub fn line(&self, a: f64, z: f64, r: &[f64]) -> Vec<Displacement> {
        let l = self.0.line(a, z).unwrap();
        r.iter().map(|&r| l.at(r)).collect()
    }
    /// size
    pub fn size(&self) -> String { format!("{:?} {} MB", self.0.size(), self.0.bytes()/1000000) }
}
