//! Sweeps: one scene with many values of some keys.
//!
//! Keys take listed values ([`Axis`]), and every combination is a point of a grid, the last key
//! changing fastest. Keys may also be drawn from a distribution: then every point of the grid is
//! computed with the same samples, and the forces have quantiles ([`Band`]).
//!
//! All cores work, each on one point. Finished rows stand in a file beside the output until the last
//! is done, so that a sweep that was interrupted or killed goes on with the others and ends with the
//! same file, byte for byte, its rows in the order of the grid. A point that fails is a row with its
//! error. Memory: about 400 bytes a point.
//!
//! In place of a grid a sweep may have rows ([`Sweep::of_rows`], [`Sweep::of_table`]): a table of
//! ducts, each with its own values, of which any part can be computed anywhere.
//!
//! Samples: the number u of a sample follows from the seed, the key, the row's id and the sample's
//! number alone, and its value is the quantile of u, so nothing depends on the threads, on the
//! other keys or on the other rows.
//!
//! ```
//! use creepage_scene::SceneFile;
//! use creepage_study::sweep::{Axis, Samples, Sweep};
//!
//! let file = SceneFile::read("../../examples/scenes/full-scale-upper.toml")?;
//! let axes = vec![Axis::parse("friction.dynamic_coefficient=0.2:0.4:0.1")?, Axis::parse("duct.depth=1.2m,2m")?];
//! let sweep = Sweep::new(file, axes, Samples::default())?;
//! assert_eq!(sweep.count(), 6);
//! assert_eq!(sweep.scene(3)?.duct.depth, 2.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod bands;
mod columns;
mod compute;
mod distribution;
mod duct_list;
mod error;
mod finished;
mod grid;
mod limits;
mod map;
mod numbers;
mod run;
mod samples;
mod table;

pub use axis::Axis;
pub use bands::{Band, Quantiles};
pub use columns::{AnswerColumn, AnswerValues};
pub use distribution::Distribution;
pub use duct_list::read as read_rows;
pub use error::SweepError;
pub use grid::{SAMPLE_TOLERANCE, Sweep};
pub use limits::PointLimits;
pub use map::MapValue;
pub use run::{Evaluate, SweepOptions, SweepSummary};
pub use samples::Samples;
pub use table::ending;
