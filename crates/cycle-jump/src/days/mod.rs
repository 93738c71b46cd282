//! Days of traffic and heat: a day is the period of [`crate::evolve`].
//!
//! *Problem.* A cable is brought to the temperature of the moment before every pass, which grows
//! and shrinks it against a friction that traffic takes away a little at a time. Years of that are
//! millions of passes. *Way.* What happens in a day is a list of events: the temperature changes, a
//! vehicle passes. The cable's displacement at midnight determines the next day, so that days are
//! jumped over as periods of passes are, and where a day changes next to nothing all days to come
//! repeat it, but for a drift.
//!
//! On a day with many passes few of them are simulated. Over many periods of the traffic a node
//! advances by v in each against the friction f̄ = Φ(v) that stays locked in, a law that passes
//! over a short cable measure once ([`LockedLaw`]). What it misses, near ends and where heat makes
//! the cable slip, a simulated period measures in force: r = f̄ − Φ(v), at some moments of the day.
//! From one to the next a single implicit step solves
//!
//! w (Φ(v) + r) + w p + θ = K u,  u̇ = v,
//!
//! whose one answer lies within the limits of friction, whatever r is. r goes on half as fast as it
//! changed from one simulated period to the next. At midnight it is forgotten: kept, it would give
//! a day a memory, and days would never settle.
//!
//! *Limits.* As for [`crate::evolve`]; the same traffic at all hours. The number of simulated
//! periods a day (the knots of [`Day::new`]) is the caller's: two runs with different numbers show
//! each other's error.

mod cable;
mod day;
mod evolve;
mod extremes;
mod heat;
mod law;
mod part;
mod step;

pub use day::Day;
pub use evolve::{Days, DaysRequest, Row, evolve_days};
pub use extremes::Extremes;
pub use heat::DailyHeat;
pub use law::LockedLaw;
