#![doc = include_str!("../README.md")]

mod axis;
mod cells;
mod chart;
mod drawing;
mod error;
mod frame;
mod legend;
mod mark;
mod palette;
mod panels;
mod reference;
mod scale;
mod series;

pub use axis::Axis;
pub use chart::Chart;
pub use drawing::{Anchor, Drawing, Ink, escaped};
pub use error::FigureError;
pub use palette::dark_style;
pub use panels::Panels;
pub use reference::Reference;
pub use series::Series;
