//! How sure it is that no springs stay within the limits.

use super::pair::finest_step;
use super::search::ACCURACY;
use super::trade_off::Design;

/// Why springs within the limits may have been missed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// The nearest exceeds its limits by less than its estimated error.
    Error,
    /// The nearest exceeds its limits by less than this share, the step in which stiffnesses were tried.
    Step(f64),
}

impl Design {
    /// Why there may be springs within the limits though none were found; `None` where some were found, or the nearest exceeds a limit by
    /// more than the estimated error and the step of the search.
    pub fn doubt(&self) -> Option<Doubt> {
        let nearest = self.nearest.as_ref()?;
        let step = match self.places[..] {
            [_] => ACCURACY,
            _ => finest_step(),
        };
        match self.excess() - 1.0 {
            over if over < nearest.error_estimate => Some(Doubt::Error),
            over if over < step => Some(Doubt::Step(step)),
            _ => None,
        }
    }
}
