//! Whether a cable creeps at all, and how much force there can be, without a run.
//!
//! *Problem.* Friction can move the cable in its duct only as far as the cable does not follow the duct elastically. *Number.* With q
//! the largest friction per metre, z the depth and D = max|D_l|,
//!
//! Q = q z²/(EA D)
//!
//! compares the stretch that friction can impose over a depth with what the duct does. Under one concentrated load on
//! a half-space the shape of D_l is given, so that for one Poisson's ratio and one sheath the friction locked in at
//! saturation, f*/q, and the advance of the first passes, G(0)/D, depend on Q alone. The force in a duct of length L is then f* L
//! plus what its ends add; as Q f*/q has a largest value over Q, there is a force that no friction exceeds.
//!
//! *Limits.* One concentrated load, a half-space with ν = 0.4, traffic one way, no clamps; the table is for a sheath with
//! EA/(S z²) = 0.056, S = q b/2, and a stiffer one raises f*/q by up to 0.03. Elsewhere the numbers are rough: a go or no-go, not a
//! force to design with. *Origin.* Runs of `examples/occurrence.rs`, pass after pass; `tests/occurrence.rs` repeats some.

use ground_field::DuctMotion;
use serde::Serialize;

use crate::scene::Scene;

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

/// Made by `cargo run --release --example occurrence`, at 24 nodes a depth.
pub const TABLE: [Row; 12] = [
    row(0.05, 0.8126, 1.50),
    row(0.1, 0.7786, 1.88),
    row(0.2, 0.7218, 2.10),
    row(0.3, 0.6676, 2.02),
    row(0.4, 0.6073, 1.79),
    row(0.5, 0.5350, 1.57),
    row(0.6, 0.4537, 1.38),
    row(0.8, 0.3229, 1.065),
    row(1.0, 0.2324, 0.801),
    row(1.5, 0.1041, 0.366),
    row(2.0, 0.0424, 0.134),
    row(3.0, 0.0028, 0.006),
];
