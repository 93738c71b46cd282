//! What one would fit, and whether it holds whatever is not known: for every measure the worst combination of the unknowns.
//!
//! Each measure is run in every combination of the lowest, the middle and the highest value of what is uncertain, friction at five places:
//! force against friction is a hill, and neither end of an interval is the safe one. Where a parabola through the highest points has its
//! top, the worst is looked for closer (module `hill`). Springs and places of clamps are chosen for the combinations that prove worst.
//!
//! Runs that look for the worst have a tolerance of 5 % and share one mesh; the worst itself, and whatever is within a tenth of its limit,
//! is run with the scene's own tolerance.

mod answer;
mod hill;
mod runs;
mod study;
mod unknown;
mod ways;

pub use answer::{Comparison, Failure, MeasureAnswer, Nearest, Outcome};
pub use study::Study;
pub use unknown::{Combination, FRICTION_KEY};
