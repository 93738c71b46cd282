//! Sweeps: one scene with many values of some keys.
//!
//! Keys take listed values ([`Axis`]), and every combination is a point of a grid, the last key changing fastest. Keys may also be
//! drawn from a distribution: then every point of the grid is computed with the same samples, and the forces have quantiles
//! ([`Band`]).
//!
//! All cores work, each on one point. A finished point is kept at once in a journal beside the output, so that a sweep
//! that was interrupted or killed goes on where it was and ends with the same file, byte for byte. The table stands in the order
//! of the grid; a point that fails is a row with its error. Memory: about 100 bytes a point.
//!
//! In place of a grid a sweep may have rows ([`Sweep::of_rows`], [`Sweep::of_table`]): a table of ducts, each with its own values, of which any
//! part can be computed anywhere. [`Evaluator`] computes single rows.
//!
//! Samples: the number u of a sample follows from the seed, the key, the row's id and the sample's number alone, and its value is the quantile of
//! u, so nothing depends on the threads, on the other keys or on the other rows.
//!
//! ```
//! use creepage::SceneFile;
//! use creepage::sweep::{Axis, Samples, Sweep};
//!
//! let file = SceneFile::read("examples/scenes/full-scale-upper.toml")?;
//! let axes = vec![Axis::parse("friction.dynamic_coefficient=0.2:0.4:0.1")?, Axis::parse("duct.depth=1.2m,2m")?];
//! let sweep = Sweep::new(file, axes, Samples::default())?;
//! assert_eq!(sweep.count(), 6);
//! assert_eq!(sweep.scene(3)?.duct.depth, 2.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answers;
mod axis;
mod bands;
mod columns;
mod compute;
mod distribution;
mod error;
mod evaluator;
mod grid;
mod journal;
mod known_ground;
mod list;
#[cfg(feature = "plot")]
mod map;
mod numbers;
mod options;
mod row;
mod rows;
mod run;
mod sink;
mod table;
#[cfg(feature = "xlsx")]
mod xlsx;

pub use answers::{AnswerColumn, AnswerValues};
pub use axis::{Axis, AxisValues};
pub use bands::{Band, Quantiles};
pub use distribution::Distribution;
pub use error::SweepError;
pub use evaluator::Evaluator;
pub use grid::{SAMPLE_TOLERANCE, Samples, Sweep};
pub use list::read as read_rows;
#[cfg(feature = "plot")]
pub use map::{MapValue, SweepMap};
pub use options::{Evaluate, SweepOptions};
pub use row::{Answer, HeatAnswer, PointError, Row};
pub use run::SweepSummary;
#[cfg(feature = "cli")]
pub(crate) use table::Format;
