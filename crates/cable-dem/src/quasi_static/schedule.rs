//! Where the vehicle stops on its way: the positions of one pass.
//!
//! Over the duct it advances by the mesh's vehicle step. A step is an exact solution as long as no node slips both ways within it:
//! neither may the duct turn, nor may the parts of the duct change the order in which they lead, which decides where a stiff cable
//! goes. Where that happens far away it happens to the whole duct at once and is felt by the whole cable. So the vehicle keeps its
//! step beyond the duct too until the shape has turned for the last time, and half as far again, or until it is a hundred steps away: a
//! turn at the distance d is as wide as d, and a stride of d/100 misses 1e-5 of it. Tails that are a sum of two
//! powers, −a/ξᵐ + b/ξⁿ, have their steepest slope within 1.5 of the distance of their turn. A wheel on a
//! half-space (ν = 0.4) pushes the duct away within six depths and pulls it in beyond; the pull is largest at twelve, and changes
//! fastest after that at eighteen.
//!
//! Farther out the step doubles wherever the straight chord it replaces misses the path by no more than one step does at the
//! sharpest bend; for a stride s the miss is |D(ξ) − ½ (D(ξ − s) + D(ξ + s))|. From there a vehicle is followed to 300 m in some
//! thirty steps.

use crate::approach::SETTLED;

/// Ratio of a stride to its distance from the duct at most.
const LARGEST_STRIDE_SHARE: f64 = 0.5;
/// Share of the largest displacement by which the duct has to come back for a turn to count. Less is the noise of a table.
const TURN: f64 = 1e-4;
/// Strides to the vehicle from which on a turn between two positions no longer matters.
const STRIDES: i64 = 100;

/// Vehicle positions in lattice units, ascending, from `approach` before a duct of length `end` to `approach` past it, about
/// `stride` apart over the duct. `shape` is D on the lattice, `origin` the index of ξ = 0 in it.
pub(super) fn schedule(shape: &[f64], origin: usize, end: i64, approach: i64, stride: i64) -> Vec<i64> {
    let allowed = largest_bend(shape, stride as usize);
    // Distances from the vehicle beyond which each stride is short enough, ahead of it and behind.
    let mut limits: Vec<(i64, [i64; 2])> = vec![(stride, [0, 0])];
    let settled = outermost_turns(shape, origin).map(|distance| (SETTLED * distance as f64) as i64);
    let mut longer = 2 * stride;
    while longer <= approach {
        let outermost = outermost_bends(shape, origin, longer as usize, allowed);
        let least = (longer as f64 / LARGEST_STRIDE_SHARE) as i64;
        limits.push((
            longer,
            [0, 1].map(|side| {
                let followed = settled[side].min(longer * STRIDES);
                outermost[side].max(followed).max(least)
            }),
        ));
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

fn largest_bend(shape: &[f64], stride: usize) -> f64 {
    (0..shape.len())
        .map(|at| bend(shape, at, stride))
        .fold(0.0, f64::max)
}

/// How far ahead of the vehicle and behind it a stride last bends the path by more than `allowed`, in lattice units.
fn outermost_bends(shape: &[f64], origin: usize, stride: usize, allowed: f64) -> [i64; 2] {
    let sharp = |at: &usize| bend(shape, *at, stride) > allowed;
    let ahead = (origin..shape.len()).rev().find(sharp);
    [ahead, (0..origin).find(sharp)].map(|at| distance(at, origin))
}

/// How far ahead of the vehicle and behind it the shape turns for the last time, in lattice units.
fn outermost_turns(shape: &[f64], origin: usize) -> [i64; 2] {
    let noise = TURN * shape.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    let ahead = first_turn((origin..shape.len()).rev(), shape, noise);
    [ahead, first_turn(0..origin, shape, noise)].map(|at| distance(at, origin))
}

fn distance(at: Option<usize>, origin: usize) -> i64 {
    at.map_or(0, |at| at.abs_diff(origin) as i64)
}

/// Where the shape first comes back by more than `noise`, as one walks along `path`.
fn first_turn(path: impl Iterator<Item = usize>, shape: &[f64], noise: f64) -> Option<usize> {
    let (mut highest, mut lowest): (Option<usize>, Option<usize>) = (None, None);
    // Up or down, once that is clear.
    let mut rising = None;
    for at in path {
        let (top, bottom) = (highest.unwrap_or(at), lowest.unwrap_or(at));
        match rising {
            Some(true) | None if shape[at] < shape[top] - noise => {
                if rising.is_some() {
                    return highest;
                }
                rising = Some(false);
            }
            Some(false) | None if shape[at] > shape[bottom] + noise => {
                if rising.is_some() {
                    return lowest;
                }
                rising = Some(true);
            }
            _ => {}
        }
        highest = Some(if shape[at] >= shape[top] { at } else { top });
        lowest = Some(if shape[at] <= shape[bottom] { at } else { bottom });
    }
    None
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
    fn a_vehicle_is_followed_ten_times_as_far_in_a_few_more_steps() {
        let (near, far) = (positions(500), positions(5000));
        for positions in [&near, &far] {
            assert!(positions.is_sorted_by(|a, b| a < b));
            assert!((0..=100).all(|over| positions.contains(&over)));
        }
        assert_eq!((far[0], far[far.len() - 1]), (-5000, 5100));
        assert!(far.len() < near.len() + 40, "{} after {}", far.len(), near.len());
    }

    #[test]
    fn steps_stay_until_the_shape_has_turned_for_the_last_time() {
        // Like a wheel's: (ξ³ − 6ξ)/(1 + ξ²)² turns where ξ⁴ − 21 ξ² + 6 = 0, at 0.54 and last at 4.55.
        let turn = (0.5 * (21.0 + (21.0_f64 * 21.0 - 24.0).sqrt())).sqrt();
        let shape: Vec<f64> = (-2000..=2000)
            .map(|j| 0.1 * f64::from(j))
            .map(|xi| (xi.powi(3) - 6.0 * xi) / (1.0 + xi * xi).powi(2))
            .collect();
        for found in outermost_turns(&shape, 2000) {
            assert!((0.1 * found as f64 - turn).abs() <= 0.1, "{found}, not {turn}");
        }
        let positions = schedule(&shape, 2000, 100, 1000, 1);
        let near = (SETTLED * 10.0 * turn) as i64;
        assert!((-near..=100 + near).all(|position| positions.contains(&position)));
        assert!(positions.len() < 2 * near as usize + 200, "{}", positions.len());
        // Noise is no turn.
        let noisy: Vec<f64> = shape
            .iter()
            .zip([1e-6, -1e-6].into_iter().cycle())
            .map(|(d, noise)| d + noise)
            .collect();
        assert_eq!(outermost_turns(&noisy, 2000), outermost_turns(&shape, 2000));
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
        let settled = outermost_turns(&shape, 40_000).map(|distance| (SETTLED * distance as f64) as i64);
        assert!(
            settled.iter().all(|settled| (14_000..15_000).contains(settled)),
            "{settled:?}"
        );
        for pair in positions.windows(2) {
            let (stride, distance) = (pair[1] - pair[0], (-pair[1]).max(pair[0] - 100));
            let is_near = distance < settled[0].min(settled[1]);
            assert!(
                !is_near || stride == 1 || STRIDES * stride <= distance,
                "{pair:?}"
            );
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
