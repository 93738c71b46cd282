//! Any number of vehicles over a cable: few simulated passes, and jumps between them.
mod error;
mod flow;
mod knowledge;
mod period;
mod record;
mod request;
mod scale;
mod slope;
mod walk;

pub use error::JumpError;
pub use record::{Beyond, Evolution, Record};
pub use request::{Guide, Jumps, Next, Request};
pub use walk::evolve;
