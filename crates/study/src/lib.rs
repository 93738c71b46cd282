#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod book;
pub mod design;
pub mod measures;
#[doc(hidden)]
pub mod output;
mod shared_mesh;
mod springs;
pub mod sweep;
