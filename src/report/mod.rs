//! A report: one self-contained HTML page about a scene, which loads nothing.
//!
//! It holds the scene in words and as drawings, the important numbers, figures of the force, the movement and the motion behind them, ways to hold
//! the cable compared with each other, and how all of that was computed and how wrong it may be. It is legible on a phone, on paper,
//! and on light and dark screens.
//!
//! The numbers are those of one [`Run`](crate::Run) of the scene. Each way to hold the cable is a separate run, at a tolerance of at least
//! 5 %, all on one mesh ([`crate::design::compare`]). A way that fails is stated on the page with its reason.
//!
//! ```
//! use creepage::{Scene, report::{Report, ReportOptions}};
//!
//! let text = std::fs::read_to_string("examples/scenes/full-scale-upper.toml")?;
//! let mut scene = Scene::from_toml("full-scale-upper.toml", &text)?;
//! scene.traffic.passes = 5;
//! let report = Report::new(&scene, &ReportOptions::default())?;
//! let page = report.to_html();
//! assert!(page.contains("Full-scale experiment, upper phase"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agreement;
mod cause;
mod certainty;
mod chart;
mod content;
mod force;
mod heat;
mod holding;
mod html;
mod measures;
mod page;
mod pass_axis;
mod route;
mod section;
mod source;

pub use content::{Report, ReportOptions};
pub use source::Source;
