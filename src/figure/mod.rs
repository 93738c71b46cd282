//! Figures as data: say what stands in a chart or a map, and get an SVG.
//!
//! A [`Chart`] holds series of points over two axes, with reference lines, bands and notes. A [`Map`] holds a grid of cells,
//! coloured by class or by value. [`Panels`] sets several of them beside and below one another. None of them knows of
//! drawing: plotters draws, on a white ground, with real text of 14 px and more.
//!
//! Series differ by colour (Okabe and Ito's, made for colour-blind eyes) and by dash and marker, classes by colour and by
//! a mark in the cell, so that a figure can be read in grey. The legend stands below the plot, where it covers no data. The same figure always
//! gives the same bytes.
//!
//! # Limits
//!
//! Widths of texts are estimated, generously, since an SVG is laid out by whoever shows it. A text for which there is no room is an
//! error, not a text cut off.
//!
//! ```
//! use creepage::figure::{Axis, Chart, Reference, Series};
//!
//! let force = |pass: f64| 550.0 * (1.0 - (-pass / 15.0).exp());
//! let svg = Chart::new("Force at the fixed end", Axis::logarithmic("passes"), Axis::linear("force, N"))
//!     .with(Series::line("computed", (1..=200).map(|pass| (f64::from(pass), force(f64::from(pass))))))
//!     .with(Series::points("measured", [(1.0, 40.0), (10.0, 260.0), (100.0, 555.0)]))
//!     .refer(Reference::horizontal(550.0, "saturation"))
//!     .to_svg()?;
//! assert!(svg.starts_with("<svg") && svg.contains("measured"));
//! # Ok::<(), creepage::figure::FigureError>(())
//! ```

mod axis;
mod chart;
mod dark;
mod draw;
mod error;
mod map;
mod palette;
mod panels;
mod scale;
mod series;

pub use axis::Axis;
pub use chart::Chart;
pub use dark::dark_style;
pub use error::FigureError;
pub use map::{Class, GridAxis, Map};
pub use panels::{Panel, Panels};
pub use series::{Note, Reference, Series};
