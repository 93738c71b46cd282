//! The planner: what it chooses, and that looser tolerances never cost more.

mod choices;
mod cost;
mod scenes;
