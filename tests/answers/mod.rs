//! Every answer can be true: forces balance, numbers are finite, errors are stated and cover, or there is a typed error.

mod axles;
mod balance;
pub mod common;
pub mod long_term;
mod meshes;
mod mixes;
mod road;
mod saturation;
mod search;
