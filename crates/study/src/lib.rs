#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod book;
pub mod design;
pub mod measures;
#[doc(hidden)]
pub mod output;
pub mod sweep;
