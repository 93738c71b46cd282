//! Where the vehicle stops on its way: the positions of one pass.
//!
//! Over the duct it advances by the mesh's vehicle step. A step is an exact solution as long as no node slips both ways within it:
//! neither may the duct turn, nor may the parts of the duct change the order in which they lead, which decides where a stiff cable
//! goes. Where that happens far away it happens to the whole duct at once and is felt by the whole cable. A turn at the distance d is as wide
//! as d, and a stride of d/100 misses 1e-5 of it: so a vehicle beyond the duct advances by a hundredth of its distance, and by its step at least.

/// Strides to the duct from which on a turn between two positions no longer matters.
const STRIDES: i64 = 100;

/// Vehicle positions in lattice units, ascending, from `approach` before a duct of length `end` to `approach` past it, `stride` apart over
/// the duct.
pub(super) fn schedule(end: i64, approach: i64, stride: i64) -> Vec<i64> {
    let next = |distance: &i64| {
        let longer = distance / STRIDES / stride * stride;
        (*distance < approach).then(|| (distance + longer.max(stride)).min(approach))
    };
    let outward: Vec<i64> = std::iter::successors(Some(0), next).skip(1).collect();
    let over = (end + stride - 1) / stride * stride;
    let before = outward.iter().rev().map(|distance| -distance);
    let after = outward.iter().map(|distance| over + distance);
    before
        .chain((0..=over).step_by(stride as usize))
        .chain(after)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_advances_by_a_hundredth_of_its_distance_and_by_its_step_at_least() {
        for stride in [1, 3] {
            let positions = schedule(100, 5000, stride);
            assert!(positions.is_sorted_by(|a, b| a < b));
            assert_eq!(positions[0], -5000);
            let last = positions[positions.len() - 1];
            assert!((5100..5100 + stride).contains(&last), "{last}");
            for pair in positions.windows(2) {
                let (advance, distance) = (pair[1] - pair[0], (-pair[1]).max(pair[0] - 100).max(0));
                assert!(advance <= stride.max(distance / STRIDES), "{pair:?}");
                assert!(
                    advance >= stride || pair[0] == -5000 || pair[1] == last,
                    "{pair:?}"
                );
            }
        }
        // Ten times as far in a few hundred steps more.
        assert!(schedule(100, 5000, 1).len() < schedule(100, 500, 1).len() + 500);
    }
}
