//! Where the vehicle stops on its way: the positions of one pass.
//!
//! Over the duct it advances by the mesh's vehicle step. A step is an exact solution as long as no
//! node slips both ways within it: neither may the duct turn, nor may the parts of the duct change
//! the order in which they lead, which decides where a stiff cable goes. Where that happens far
//! away it happens to the whole duct at once and is felt by the whole cable. So the vehicle keeps
//! its step beyond the duct too until it is a hundred steps away: a turn at the distance d is as
//! wide as d, and a stride of d/100 misses 1e-5 of it. A wheel on a half-space (ν = 0.4) pushes the
//! duct away within six depths and pulls it in beyond; the pull is largest at twelve, and changes
//! fastest after that at eighteen.
//!
//! Farther out the step doubles wherever it is a hundredth of the distance at most and the straight
//! chord it replaces misses the path by no more than one step does at the sharpest bend; for a
//! stride s the miss is |D(ξ) − ½ (D(ξ − s) + D(ξ + s))|.

/// Distance of the vehicle from the duct, in strides, from which on a turn of the duct between two
/// positions no longer matters: it is as wide as the distance d, and a stride of d/100 misses 1e-5
/// of it.
const STRIDES: i64 = 100;

/// Vehicle positions in lattice units, ascending, from `approach` before a duct of length `end` to `approach` past it, about
/// `stride` apart over the duct. `shape` is D on the lattice, `origin` the index of ξ = 0 in it.
pub(super) fn schedule(shape: &[f64], origin: usize, end: i64, approach: i64, stride: i64) -> Vec<i64> {
    let bends = |stride: i64| move |at: usize| bend(shape, at, stride as usize);
    let allowed = (0..shape.len()).map(bends(stride)).fold(0.0, f64::max);
    // Distances from the vehicle beyond which each stride is short enough, ahead of it and behind.
    let mut limits: Vec<(i64, [i64; 2])> = vec![(stride, [0, 0])];
    let mut longer = 2 * stride;
    while longer * STRIDES <= approach {
        let sharp = |at: &usize| bends(longer)(*at) > allowed;
        let outermost = [(origin..shape.len()).rev().find(sharp), (0..origin).find(sharp)];
        let distance = |at: Option<usize>| at.map_or(0, |at| at.abs_diff(origin) as i64);
        limits.push((longer, outermost.map(|at| distance(at).max(longer * STRIDES))));
        longer *= 2;
    }
    let outward = |side: usize| {
        let mut distance = 0;
        let limits = &limits;
        std::iter::from_fn(move || {
            if distance >= approach {
                return None;
            }
            let fits = limits.iter().rev().find(|(_, limit)| distance >= limit[side]);
            distance = (distance + fits.map_or(stride, |(stride, _)| *stride)).min(approach);
            Some(distance)
        })
    };
    let over = (end + stride - 1) / stride * stride;
    let mut positions: Vec<i64> = outward(0).map(|distance| -distance).collect();
    positions.reverse();
    positions.extend((0..=over).step_by(stride as usize));
    positions.extend(outward(1).map(|distance| over + distance));
    positions
}

/// |D(ξ) − ½ (D(ξ − s) + D(ξ + s))| at lattice point `at`; beyond its ends the shape stays as it is there.
fn bend(shape: &[f64], at: usize, stride: usize) -> f64 {
    let last = shape.len() - 1;
    let (before, after) = (at.saturating_sub(stride), (at + stride).min(last));
    (shape[at] - 0.5 * (shape[before] + shape[after])).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ξ/(1 + ξ²) with a tail 1/ξ, in steps of 0.1, out to ±1000.
    fn positions(approach: i64) -> Vec<i64> {
        let shape: Vec<f64> = (-10_000..=10_000)
            .map(|j| 0.1 * f64::from(j))
            .map(|xi| xi / (1.0 + xi * xi))
            .collect();
        schedule(&shape, 10_000, 100, approach, 1)
    }

    #[test]
    fn a_vehicle_is_followed_ten_times_as_far_in_less_than_a_hundred_more_steps_an_octave() {
        let (near, far) = (positions(500), positions(5000));
        for positions in [&near, &far] {
            assert!(positions.is_sorted_by(|a, b| a < b));
            assert!((0..=100).all(|over| positions.contains(&over)));
        }
        assert_eq!((far[0], far[far.len() - 1]), (-5000, 5100));
        let octaves = 2.0 * 10.0_f64.log2();
        let more = (far.len() - near.len()) as f64;
        assert!(more < 100.0 * octaves, "{more}");
    }

    #[test]
    fn a_turn_far_away_is_passed_in_strides_of_a_hundredth_of_its_distance() {
        // A wheel over a duct at 10 steps, and a slab that is hundreds of depths wide: ξ (ξ² − c²)/(c² + ξ²)², c = 4000, turns last at 2.4 c.
        let c = 4000.0_f64;
        let shape: Vec<f64> = (-40_000..=40_000)
            .map(f64::from)
            .map(|xi| xi * (xi * xi - c * c) / (c * c + xi * xi).powi(2) + 0.01 * xi / (100.0 + xi * xi))
            .collect();
        let positions = schedule(&shape, 40_000, 100, 30_000, 1);
        assert!(positions.len() < 2000, "{}", positions.len());
        for pair in positions.windows(2) {
            let (stride, distance) = (pair[1] - pair[0], (-pair[1]).max(pair[0] - 100));
            assert!(stride == 1 || STRIDES * stride <= distance, "{pair:?}");
        }
    }

    #[test]
    fn strides_grow_outward_and_leave_out_no_more_than_a_step_over_the_duct() {
        let positions = positions(5000);
        let value = |j: f64| 0.1 * j / (1.0 + 0.01 * j * j);
        // Over the duct: D″ is largest at ξ = √2 − 1, where it is 1.457.
        let allowed = 1.01 * 0.5 * 0.01 * 1.46;
        for pair in positions.windows(2) {
            let (a, b) = (pair[0] as f64, pair[1] as f64);
            // The node at either end of the duct, the nearer one to the vehicle.
            let node = if a < 0.0 { 0.0 } else { 100.0 };
            let middle = value(node - 0.5 * (a + b)) - 0.5 * (value(node - a) + value(node - b));
            assert!(middle.abs() <= allowed, "from {a} to {b}: {middle:e}");
        }
    }
}
