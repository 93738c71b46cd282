//! What one would fit, and whether it holds whatever is not known.
//!
//! Each measure is run in every combination of the lowest, the middle and the highest value of what is uncertain, friction at five places:
//! force against friction is a hill, and neither end of an interval is the safe one. Where a parabola through the highest points has its
//! top, the worst is looked for closer (module `closer`). Springs and places of clamps are chosen for the combinations that prove worst.
//!
//! Runs that look for the worst have a tolerance of 5 % and share one mesh; the scene's own tolerance decides where the worst is within a
//! tenth of its limit, and for the measure that is recommended.

mod answer;
mod closer;
mod runs;
mod study;
mod unknown;
mod ways;

pub use answer::{Comparison, Effort, Extreme, Held, HeldClamp, HeldEnds, MeasureAnswer, Outcome};
pub use study::Study;
pub use unknown::{FRICTION_KEY, Unknown};
