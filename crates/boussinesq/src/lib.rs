#![doc = include_str!("../README.md")]
#![allow(
    clippy::doc_markdown,
    reason = "u_r and k_c in the text are formulas, not code"
)]

mod disc;
mod elliptic;
mod half_space;
mod shape;

pub use half_space::{HalfSpace, Stress};
