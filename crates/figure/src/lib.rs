#![doc = include_str!("../README.md")]

mod axis;
mod chart;
mod draw;
mod drawing;
mod error;
mod palette;
mod panels;
mod scale;
mod series;

pub use axis::Axis;
pub use chart::Chart;
pub use drawing::{Anchor, Drawing, Ink};
pub use error::FigureError;
pub use palette::dark_style;
pub use panels::Panels;
pub use series::{Reference, Series};
