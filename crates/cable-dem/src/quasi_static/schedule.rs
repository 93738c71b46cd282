//! Where the vehicle stops on its way: the positions of one pass.
//!
//! A step is an exact solution as long as no node slips both ways within it: the duct may not turn in it, nor may the parts of the duct
//! change the order in which they lead, which decides where a stiff cable goes. Over the duct the vehicle advances by the mesh's
//! vehicle step. Beyond it, at the distance d from the parts of the shape that count, what happens is as wide as d: a stride of d/100
//! misses 1e-5 of a turn there.

/// Share of the largest displacement from which a part of the shape counts as a wheel, from which distances are measured.
const WHEEL: f64 = 0.05;
/// Strides in the distance that is left to a vehicle.
const STRIDES: i64 = 100;

/// Vehicle positions in lattice units, ascending, from `approach` before a duct of length `end` to `approach` past it, about
/// `stride` apart over the duct. `shape` is D on the lattice, `origin` the index of ξ = 0 in it.
pub(super) fn schedule(shape: &[f64], origin: usize, end: i64, approach: i64, stride: i64) -> Vec<i64> {
    let largest = shape.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    let wheels = (0..shape.len()).filter(|&at| shape[at].abs() > WHEEL * largest);
    let reach = wheels.map(|at| at.abs_diff(origin) as i64).max().unwrap_or(0);
    let outward = std::iter::successors(Some(0), |&distance: &i64| {
        let next = distance + stride.max((distance - reach) / STRIDES);
        (distance < approach).then_some(next.min(approach))
    });
    let outward: Vec<i64> = outward.skip(1).collect();
    let over = (end + stride - 1) / stride * stride;
    let before = outward.iter().rev().map(|distance| -distance);
    let along = (0..=over).step_by(stride as usize);
    before
        .chain(along)
        .chain(outward.iter().map(|distance| over + distance))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wheel of the width `width` at `at`, in lattice units, out to ±40000.
    fn wheel(at: f64, width: f64) -> Vec<f64> {
        let shape = |j: i32| {
            let xi = (f64::from(j) - at) / width;
            xi / (1.0 + xi * xi).powf(1.5)
        };
        (-40_000..=40_000).map(shape).collect()
    }

    #[test]
    fn strides_are_at_most_a_hundredth_of_the_distance_to_the_outermost_wheel() {
        // It counts to 4.4 widths.
        for (at, width) in [(0.0, 10.0), (990.0, 10.0), (-990.0, 10.0), (0.0, 2000.0)] {
            let positions = schedule(&wheel(at, width), 40_000, 100, 30_000, 1);
            assert_eq!((positions[0], positions[positions.len() - 1]), (-30_000, 30_100));
            assert!((0..=100).all(|over| positions.contains(&over)));
            let counts = at.abs() as i64 + (4.3 * width) as i64;
            for pair in positions.windows(2) {
                let (stride, distance) = (pair[1] - pair[0], (-pair[0]).max(pair[1] - 100));
                assert!(
                    stride > 0 && (stride == 1 || STRIDES * stride <= distance - counts),
                    "{pair:?}"
                );
            }
        }
    }

    #[test]
    fn a_vehicle_is_followed_ten_times_as_far_in_a_few_more_steps() {
        // 100 ln 10 on either side, and more where strides are of one or two steps.
        let shape = wheel(0.0, 10.0);
        let positions = |approach| schedule(&shape, 40_000, 100, approach, 1).len();
        assert!(
            positions(10_000) < positions(1000) + 2 * 350,
            "{}",
            positions(10_000)
        );
    }
}
