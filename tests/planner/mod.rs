//! The planner: what it chooses, that looser tolerances never cost more, and that its errors are honest.

mod choices;
mod cost;
mod honest;
mod scenes;
