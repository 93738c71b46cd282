//! Whether a cable creeps at all, and how much force there can be, without a run.
//!
//! *Problem.* Friction can move the cable in its duct only as far as the cable does not follow the
//! duct elastically. *Number.* With q the largest friction per metre, z the depth and D = max|D_l|,
//!
//! Q = q z²/(EA D)
//!
//! compares the stretch that friction can impose over a depth with what the duct does. Under one
//! concentrated load on a half-space the shape of D_l is given, so that for one Poisson's ratio and
//! one sheath the friction locked in at saturation, f*/q, and the advance of the first passes,
//! G(0)/D, depend on Q alone. The force in a duct of length L is then f* L plus what its ends add;
//! as Q f*/q has a largest value over Q, there is a force that no friction exceeds.
//!
//! *Limits.* One concentrated load, a half-space with ν = 0.4, traffic one way, a level duct, no
//! clamps; the table is for a sheath with EA/(S z²) = 0.056, S = q b/2, and a stiffer one raises
//! f*/q by up to 0.03. Elsewhere the numbers are rough: a go or no-go, not a force to design with.
//! *Origin.* Runs of `validation/src/occurrence.rs`, pass after pass; `tests/occurrence.rs` repeats some.

use ground_field::DuctMotion;
use serde::Serialize;

use crate::ground::peak;
use creepage_scene::Scene;

/// What runs gave for one value of Q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Q = q z²/(EA D).
    pub number: f64,
    /// f*/q, the friction locked in at saturation as a share of the largest.
    pub locked_share: f64,
    /// G(0)/D, how far one of the first passes moves a free cable, in peaks of D_l.
    pub advance_share: f64,
}

const fn row(number: f64, locked_share: f64, advance_share: f64) -> Row {
    Row {
        number,
        locked_share,
        advance_share,
    }
}

/// Made by `cargo run --release -p creepage-validation occurrence`, at 24 nodes a depth.
pub const TABLE: [Row; 12] = [
    row(0.05, 0.8149, 1.561),
    row(0.1, 0.7787, 1.920),
    row(0.2, 0.7225, 2.115),
    row(0.3, 0.6673, 2.021),
    row(0.4, 0.6063, 1.789),
    row(0.5, 0.5357, 1.575),
    row(0.6, 0.4558, 1.386),
    row(0.8, 0.3234, 1.060),
    row(1.0, 0.2327, 0.802),
    row(1.5, 0.1036, 0.363),
    row(2.0, 0.0424, 0.135),
    row(3.0, 0.0033, 0.006),
];

/// Q of the largest Q f*/q: more friction than that makes a smaller force.
pub const TOP: f64 = 0.6;
/// Q above which nothing creeps.
pub const NOTHING_ABOVE: f64 = TABLE[TABLE.len() - 1].number;
/// Largest Q f*/q of all runs, rounded up: 0.274 with the table's sheath, 0.291 with one ten times
/// as stiff. No friction makes more force than this times EA D L/z², and what the ends add.
const CEILING: f64 = 0.3;
/// What a fixed end adds at most, in EA D/z. A duct that slopes adds the cable's weight along it.
const CEILING_OF_END: f64 = 1.2;
/// Poisson's ratio of the table, and how far another may be from it to count as the same.
const POISSON_RATIO: (f64, f64) = (0.4, 0.05);

/// The row at any Q: straight lines in ln Q between the rows, the first row below, nothing above
/// the last.
pub fn at(number: f64) -> Row {
    let next = TABLE.partition_point(|row| row.number < number);
    if next == TABLE.len() || number.is_nan() {
        return row(number, 0.0, 0.0);
    }
    let (before, after) = (TABLE[next.saturating_sub(1)], TABLE[next]);
    let to_after = (number / before.number).ln() / (after.number / before.number).ln();
    let share = if next > 0 { to_after } else { 1.0 };
    let read = |before: f64, after: f64| before + share * (after - before);
    let locked_share = read(before.locked_share, after.locked_share);
    row(
        number,
        locked_share,
        read(before.advance_share, after.advance_share),
    )
}

/// What to expect of a scene before anything is run. The names of the fields are those of the JSON
/// document, units included.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Occurrence {
    /// Q = q z²/(EA D), D the largest max|D_l| of all vehicles.
    pub q_number: f64,
    /// f*/q: the share of the largest friction that stays locked in along the duct once nothing
    /// changes any more; 0 if nothing creeps.
    pub locked_share: f64,
    /// How far one of the first passes moves a cable that nothing holds \[m\].
    pub first_advance_m: f64,
    /// No friction makes more force than about this in the scene's duct \[N\].
    pub ceiling_n: f64,
    /// Whether the scene is other than one concentrated load on a half-space, one way: then all of
    /// this is rough.
    pub rough: bool,
}

impl Occurrence {
    /// `None` if nothing moves the duct.
    pub fn new(scene: &Scene, motions: &[DuctMotion]) -> Option<Self> {
        let displacement = peak(motions);
        let limit = scene.friction_limit();
        let (depth, length) = (scene.duct.depth, scene.duct.length);
        // EA D/z, the force that the duct's motion alone could make over a depth.
        let force = scene.cable.axial_stiffness * displacement / depth;
        let number = limit * depth / force;
        if !number.is_finite() {
            return None;
        }
        let expected = at(number);
        let by_motion = force * (CEILING * length / depth + CEILING_OF_END);
        Some(Self {
            q_number: number,
            locked_share: expected.locked_share,
            first_advance_m: expected.advance_share * displacement,
            ceiling_n: by_motion + scene.body_force().abs() * length,
            rough: !is_of_the_table(scene),
        })
    }

    /// Whether a cable creeps at all.
    pub fn creeps(&self) -> bool {
        self.q_number <= NOTHING_ABOVE
    }
}

/// One concentrated load right above the duct, one way, on a half-space with the table's Poisson's
/// ratio, no clamps.
fn is_of_the_table(scene: &Scene) -> bool {
    let (Ok(profile), [traffic]) = (scene.ground.profile(), &scene.vehicles[..]) else {
        return false;
    };
    let (Some(soil), [wheel]) = (profile.homogeneous(), &traffic.wheels()[..]) else {
        return false;
    };
    (soil.poisson_ratio() - POISSON_RATIO.0).abs() <= POISSON_RATIO.1
        && wheel.contact_radius == 0.0
        && wheel.y == 0.0
        && scene.offset_from(traffic) == 0.0
        && scene.duct.slope == 0.0
        && scene.route.is_empty()
        && scene.restraints.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_falls_between_its_rows_too_and_keeps_them() {
        for row in TABLE {
            let read = at(row.number);
            assert!((read.locked_share - row.locked_share).abs() < 1e-12);
            assert!((read.advance_share - row.advance_share).abs() < 1e-12);
        }
        let mut before = f64::INFINITY;
        for k in 0..=1000 {
            let share = at(0.03 * (4.0_f64 / 0.03).powf(f64::from(k) / 1000.0)).locked_share;
            assert!(
                share <= before && (0.0..1.0).contains(&share),
                "{share} after {before}"
            );
            before = share;
        }
        assert_eq!(before, 0.0);
    }

    #[test]
    fn the_table_has_its_top_there() {
        let force = |row: &Row| row.number * row.locked_share;
        let top = TABLE.iter().max_by(|a, b| force(a).total_cmp(&force(b)));
        assert_eq!(top.map(|row| row.number), Some(TOP));
    }

    /// f* may be a little more between the rows than at them.
    #[test]
    fn the_ceiling_is_above_the_table() {
        for k in 0..=1000 {
            let number = 0.05 + 2.95 * f64::from(k) / 1000.0;
            assert!(number * at(number).locked_share < CEILING, "{number}");
        }
    }
}
