//! From data to SVG: layout in px, drawn by plotters.

mod canvas;
mod chart;
mod frame;
mod heading;
mod legend;
mod map;
mod mark;
mod series;

pub(super) use canvas::{Canvas, Rect, svg};
pub(super) use chart::chart;
pub(super) use heading::Heading;
pub(super) use map::map;
