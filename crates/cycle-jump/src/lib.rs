#![doc = include_str!("../README.md")]

pub mod days;
mod drive;
mod error;
mod flow;
mod jumped;
mod knowledge;
mod peaks;
mod period;
mod record;
mod request;
mod scale;
mod slope;
mod stretches;
mod walk;

pub use error::JumpError;
pub use peaks::peaks;
pub use record::{Beyond, Evolution, Record};
pub use request::{Guide, Jumps, Next, Request};
pub use walk::evolve;
