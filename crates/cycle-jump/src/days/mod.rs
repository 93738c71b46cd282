//! Days of traffic and heat: few real passes a day, steps of many periods between them, and whole days without any.
//!
//! *Problem.* A cable is brought to the temperature of the moment before every pass, which grows and shrinks it against a friction that
//! traffic takes away a little at a time. Years of that are millions of passes. *Way.* Over many periods a node advances by v in each against the
//! friction f̄ = Φ(v) that stays locked in, a law that passes over a short cable measure once ([`LockedLaw`]). What it misses, near ends
//! and where heat makes the cable slip, a real period measures in force: r = f̄ − Φ(v), at some moments of the day. Between two of them
//! one implicit step solves
//!
//! w (Φ(v) + r) + w p + θ = K u,  u̇ = v,
//!
//! whose one answer lies within the limits of friction, whatever r is. Days that follow each other have nearly the same defects: they
//! are lived without real passes, in blocks that are held to a real day at their end, until a day is like the one before but for a drift.
//!
//! *Limits.* As for [`crate::evolve`]; the same traffic at all hours. The number of real periods a day ([`Day::knots`]) is the caller's:
//! two runs with different numbers show each other's error.

mod day;
mod diary;
mod extremes;
mod heat;
mod law;
mod life;
mod living;
mod rate;
mod rows;

pub use day::Day;
pub use extremes::Extremes;
pub use heat::DailyHeat;
pub use law::LockedLaw;
pub use life::{DayRecord, Days, DaysRequest, live};
pub use rows::Row;
