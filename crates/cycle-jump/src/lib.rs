#![doc = include_str!("../README.md")]

pub mod days;
mod error;
mod evolve;
mod flow;
mod peaks;
mod period;
mod record;
mod request;
mod rounds;
mod scale;
mod simulation;
mod slope;
mod tuning;
mod within_jump;

pub use error::JumpError;
pub use evolve::evolve;
pub use peaks::peaks;
pub use record::{Beyond, Evolution, Record};
pub use request::{Guide, Jumps, Next, Request};
pub use within_jump::STEADY;
