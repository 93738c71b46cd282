//! Where the vehicle stops on its way: the positions of one pass.
//!
//! Over the duct it advances by the mesh's vehicle step. A step is an exact solution as long as no node slips both ways within it.
//! Far away the whole duct turns at once: a turn at the distance d is as wide as d, and a stride of d/50 misses 5e-5 of it: the force
//! of traffic changes by less than 1e-6. So the vehicle takes strides of a fiftieth of the distance of its wheels, wherever that is more
//! than a step.

/// Strides in the distance of the vehicle.
const STRIDES: i64 = 50;

/// Vehicle positions in lattice units, ascending, from `approach` before a duct of length `end` to `approach` past it, for a vehicle whose
/// wheels reach `half_length` from its origin; over the duct and near it they are `step` apart.
pub(super) fn schedule(end: i64, approach: i64, half_length: i64, step: i64) -> Vec<i64> {
    let farther = |distance: &i64| {
        let stride = step.max((distance - half_length) / STRIDES);
        (*distance < approach).then(|| (distance + stride).min(approach))
    };
    let outward = || std::iter::successors(Some(0), farther).skip(1);
    let over = (end + step - 1) / step * step;
    let mut positions: Vec<i64> = outward().map(|distance| -distance).collect();
    positions.reverse();
    positions.extend((0..=over).step_by(step as usize));
    positions.extend(outward().map(|distance| over + distance));
    positions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strides_are_a_fiftieth_of_the_distance() {
        for (approach, half_length, step) in [(500, 40, 1), (5000, 40, 1), (30_000, 7, 2), (90, 200, 3)] {
            let positions = schedule(99, approach, half_length, step);
            let over = 99 + (step - 99 % step) % step;
            assert_eq!(
                (positions[0], positions[positions.len() - 1]),
                (-approach, over + approach)
            );
            for pair in positions.windows(2) {
                let (stride, distance) = (pair[1] - pair[0], (-pair[1]).max(pair[0] - over));
                assert!(
                    stride > 0 && (stride <= step || STRIDES * stride <= distance - half_length),
                    "{pair:?}"
                );
                assert!(distance >= 0 || stride == step, "{pair:?}");
            }
        }
        // Ten times as far takes 50 ln 10 more on either side.
        let (near, far) = (schedule(99, 5000, 40, 1), schedule(99, 50_000, 40, 1));
        assert!(far.len() - near.len() < 240, "{} {}", near.len(), far.len());
    }
}
