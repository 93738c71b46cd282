//! The models of the ground against each other, against printed figures and against an independent solver, through what a
//! user sees: the trait `GroundField`, the motion of a duct, and scenes.

#![allow(
    clippy::doc_markdown,
    reason = "u_r and D_l in the text are formulas, not code"
)]

mod agreement;
mod common;
mod difficult;
mod graded;
mod motion;
mod published;
mod table_1;
mod table_3;
