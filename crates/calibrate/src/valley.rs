//! The floor of the deviance's valley: points at which all parameters but one had been fitted.
//!
//! Where parameters make up for each other the valley is narrow and bent. The point to start the next fit from lies on the floor
//! as known so far, along whichever parameter it was followed, not on the tangent at the optimum.

use nalgebra::DVector;

/// Two points closer than this in a free variable give no direction.
const APART: f64 = 1e-3;
/// How far beyond its points the floor is drawn out, in their distance.
const FARTHEST_OUT: f64 = 2.0;

/// Known points of the floor, the optimum first.
pub(crate) struct Valley {
    points: Vec<DVector<f64>>,
}

impl Valley {
    pub fn new(optimum: &DVector<f64>) -> Self {
        Self {
            points: vec![optimum.clone()],
        }
    }

    pub fn add(&mut self, point: DVector<f64>) {
        self.points.push(point);
    }

    /// Drops the points that are `wrong`; the optimum stays.
    pub fn forget(&mut self, wrong: impl Fn(&DVector<f64>) -> bool) {
        let mut first = true;
        self.points
            .retain(|point| std::mem::take(&mut first) || !wrong(point));
    }

    /// Where the floor should be at z_k = `held`; `tangent` is its direction at the optimum per change of z_k.
    pub fn floor(&self, k: usize, held: f64, tangent: &DVector<f64>) -> DVector<f64> {
        let mut points: Vec<&DVector<f64>> = self.points.iter().collect();
        points.sort_by(|a, b| (a[k] - held).abs().total_cmp(&(b[k] - held).abs()));
        let nearest = points[0];
        let others = || {
            points[1..]
                .iter()
                .filter(|point| (point[k] - nearest[k]).abs() > APART)
        };
        let across = |point: &&&DVector<f64>| (point[k] - held) * (nearest[k] - held) < 0.0;
        let partner = others().find(across).or_else(|| others().next());
        let mut floor = match partner {
            Some(partner) => {
                let spacing = partner[k] - nearest[k];
                let share = ((held - nearest[k]) / spacing).clamp(-FARTHEST_OUT, 1.0);
                nearest + (*partner - nearest) * share
            }
            None => nearest + tangent * (held - nearest[k]),
        };
        floor[k] = held;
        floor
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::dvector;

    use super::Valley;

    /// On a bent floor, z_1 = z_0², chords are followed, not the tangent.
    #[test]
    fn the_floor_is_followed() {
        let mut valley = Valley::new(&dvector![0.0, 0.0]);
        let tangent = dvector![1.0, 0.0];
        assert_eq!(valley.floor(0, 2.0, &tangent), dvector![2.0, 0.0]);
        valley.add(dvector![2.0, 4.0]);
        assert_eq!(valley.floor(0, 1.0, &tangent), dvector![1.0, 2.0]);
        assert_eq!(valley.floor(0, 3.0, &tangent), dvector![3.0, 6.0]);
        // The same points, seen along the other variable.
        assert_eq!(valley.floor(1, 2.0, &tangent), dvector![1.0, 2.0]);
    }
}
