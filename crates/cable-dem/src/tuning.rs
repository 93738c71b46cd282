//! Numbers that were found by experiment, with what they cost or lose.
//!
//! Times are those of nine cables of 30 to 1000 m under one to five wheels, relative to the value
//! that stands here; differences below 10 % are noise.

/// Share of the friction limit by which friction and equilibrium may be off outside the windows
/// while a vehicle passes.
///
/// Against solves of the whole cable this moves the force by less than 1e-4 of q L (in 1400 random
/// scenes with [`WATCHED_SHARE`] of 0.05, but for one cable held by nothing: 5e-4).
pub const UNBALANCED_SHARE: f64 = 1e-3;

/// The same share at ends and clamps, whose forces are read: a tenth. Twice: three lanes take 0.98 of the node updates, and of a thousand
/// random cables that are heated one differs from its mirror image by more than 1e-7; a tenth: 1.09 times.
pub const UNBALANCED_SUPPORT: f64 = 0.1 * UNBALANCED_SHARE;

/// Nodes are watched where adhesion reaches this part of [`UNBALANCED_SHARE`]. From 0.025 to 0.25 the
/// forces of traffic do not change by more than 1e-6; at 0.25 days with heat take 1.4 times as long.
pub const WATCHED_SHARE: f64 = 0.05;

/// A node is quiet when the force that its last move put on the next node is below this part of
/// [`UNBALANCED_SHARE`]. With 0.125, 0.5 and 1 it takes as long, and the force of twenty passes over
/// 30 m changes by 3e-7, 2e-6 and 2e-5.
pub const QUIET_SHARE: f64 = 0.25;

/// Nodes between two windows from which on each is solved on its own. With 8 it takes 0.9 to 1.0
/// times as long, with 32 1.0 to 1.2 times, with one window for all 1.2 to 1.5 times.
pub const GAP: usize = 16;

/// Nodes by which a window hardly ever grows in a step: so far beside what begins to slip the cable
/// presses on bends anew. Without them forces of two in five cables in tight bends differ from
/// their mirror image by up to 6e-6, with them by rounding. 600 m with a bend of 314 m take 0.55 of
/// the time that pressing wherever adhesion reaches takes.
pub const GROWN: usize = 64;

/// Nodes of which one question is asked together: whether any of them slips. Asking one by one
/// takes 1.3 times as long over 300 m.
pub const BLOCK: usize = 64;

/// Nodes that are looked at for slip while one is eliminated: 0.5 ns and 9 ns. Without counting them a cable that hardly slips refined its
/// mesh for more than 100 s, where it now stops after 3 s.
pub const WATCHED_PER_UPDATE: usize = 16;

/// Largest share of the duct's peak displacement that an element may leave out. Under one wheel at
/// depth z elements of z/3, z/2 and z leave out 28, 45 and 90 %; the force after fifty passes is
/// then off by 1.4, 3 and 14 %. With 5 m in a duct at 1.2 m it had the other sign.
pub const MAX_LEFT_OUT: f64 = 0.65;

/// Turns of D_l by less than this share of its peak do not count when the length of a vehicle's
/// approach is found. Over rock D_l turns again and again, each time by far less.
pub const NEGLIGIBLE_TURN: f64 = 1e-5;

/// Largest share of the heat that friction may return in an explicit pass. Sound passes measured
/// below 1e-8, passes whose force was off by 3 % above 5e-3, chatter from 4e-2 to 5e-1.
pub const MAX_RETURNED: f64 = 1e-3;

/// Largest share of the energy that may be out of balance in an explicit pass. Sound passes
/// measured below 1e-5.
pub const MAX_UNBALANCED: f64 = 0.01;
