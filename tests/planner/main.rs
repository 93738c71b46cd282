//! The planner: what it chooses, that looser tolerances never cost more, and that its errors are honest.

mod choices;
mod cost;
mod forecast;
mod honest;
mod scenes;
mod vehicle_steps;
