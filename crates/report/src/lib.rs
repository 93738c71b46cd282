#![doc = include_str!("../README.md")]

mod agreement;
mod cause;
mod certainty;
mod chart;
mod content;
mod force;
mod heat;
mod html;
mod page;
mod pass_axis;
mod route;
mod section;
mod source;
#[doc(hidden)]
pub mod words;
pub mod workbook;

pub use content::{Report, ReportOptions};
pub use source::Source;
