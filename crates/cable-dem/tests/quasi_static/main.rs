//! The quasi-static solver against independent answers: published-style reference forces, closed forms, a whole-chain
//! Newton method, physical laws, and hostile parameters.
//!
//! One binary, one idea a file; [`scenes`] holds what they share, [`full_newton`] the independent solver.

mod against_full_newton;
mod closed_forms;
mod coulomb_chains;
mod end_clamps;
mod friction_symmetry;
mod full_newton;
mod heat;
mod reference;
mod refusals;
mod robustness;
mod route;
mod scenes;
#[path = "../shared/mod.rs"]
mod shared;
mod slow_turn;
mod windows;
